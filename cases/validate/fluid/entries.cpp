#include "cases/validate/fluid/entries.h"

#include "cases/validate/fluid/surface_entries.h"

namespace lahar::validate {

std::vector<Entry> fluid_entries() {
  std::vector<Entry> entries = {
      bingham_channel(),
      log_law_channel(),
  };
  for (Entry& e : surface_entries()) entries.push_back(std::move(e));
  return entries;
}

}  // namespace lahar::validate
