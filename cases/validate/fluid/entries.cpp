#include "cases/validate/fluid/entries.h"

namespace lahar::validate {

std::vector<Entry> fluid_entries() {
  return {
      bingham_channel(),
  };
}

}  // namespace lahar::validate
