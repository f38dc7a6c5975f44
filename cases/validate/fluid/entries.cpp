#include "cases/validate/fluid/entries.h"

namespace lahar::validate {

std::vector<Entry> fluid_entries() {
  return {
      bingham_channel(),
      log_law_channel(),
  };
}

}  // namespace lahar::validate
