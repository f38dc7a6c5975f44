#include "cases/validate/bodies/entries.h"

namespace lahar::validate {

std::vector<Entry> bodies_entries() {
  return {};
}

}  // namespace lahar::validate
