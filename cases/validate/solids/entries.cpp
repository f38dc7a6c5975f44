#include "cases/validate/solids/entries.h"

namespace lahar::validate {

std::vector<Entry> solids_entries() {
  return {};
}

}  // namespace lahar::validate
