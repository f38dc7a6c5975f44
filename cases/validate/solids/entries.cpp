#include "cases/validate/solids/entries.h"

#include "cases/validate/solids/calibration_entries.h"

namespace lahar::validate {

std::vector<Entry> solids_entries() {
  std::vector<Entry> entries = chung_ooi();
  for (const auto& make : {incline_35, rolling_incline, restitution, hard_h15, hard_h16, hard_h9, cantilever, catenary,
                           column_collapse, energy_ledger, post, two_spans, hexagonal_mesh, wire_sliding})
    entries.push_back(make());
  for (Entry& e : calibration_entries()) entries.push_back(std::move(e));
  return entries;
}

}  // namespace lahar::validate
