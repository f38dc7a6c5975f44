#include "cases/validate/solids/entries.h"

namespace lahar::validate {

std::vector<Entry> solids_entries() {
  std::vector<Entry> entries = chung_ooi();
  for (const auto& make : {restitution}) entries.push_back(make());
  return entries;
}

}  // namespace lahar::validate
