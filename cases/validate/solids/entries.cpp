#include "cases/validate/solids/entries.h"

#include "cases/validate/solids/calibration_entries.h"

namespace lahar::validate {

std::vector<Entry> solids_entries() {
  std::vector<Entry> entries;
  for (Entry& e : calibration_entries()) entries.push_back(std::move(e));
  return entries;
}

}  // namespace lahar::validate
