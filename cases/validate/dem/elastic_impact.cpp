#include "cases/validate/dem/elastic_impact.h"

#include "cases/validate/reference_table.h"

namespace lahar::validate {

std::vector<Row> elastic_rows(std::initializer_list<ElasticImpact> impacts) {
  const ReferenceTable hertz = reference("dem_hertz.csv");
  ImpactLedger ledger;
  std::vector<Row> rows;
  for (const auto& [material, name, spec] : impacts) {
    const ReferenceTable known = hertz.where("case", name);
    const Impact i = run_impact(spec);
    ledger.add(spec, i);
    rows.push_back(
        relative_row(material + ": largest overlap, um", 1e6 * i.max_overlap, known.number("delta_max_um"), 0.01));
    rows.push_back(relative_row(material + ": largest force, N", i.max_force, known.number("F_max_N"), 0.01));
    rows.push_back(relative_row(material + ": duration, us", 1e6 * i.duration, known.number("duration_us"), 0.01));
    rows.push_back(relative_row(material + ": restitution", i.restitution, 1, 0.01));
  }
  ledger.rows(rows);
  return rows;
}

}  // namespace lahar::validate
