// A sphere meets a rigid plate head-on with the restitution that was asked for: test 3 of Chung & Ooi (2011, Granular
// Matter 13:643-656).
#include <fmt/format.h>

#include "cases/validate/dem/impact.h"

namespace lahar::validate {
namespace {

ImpactSpec cast_iron() {
  return {.radius = 0.0025, .density = 7000, .youngs_modulus = 100e9, .poisson_ratio = 0.25, .speed = 3.9};
}

std::vector<Row> run(const Context&) {
  std::vector<Row> rows;
  ImpactLedger ledger;
  for (const auto& [name, sphere] : {std::pair{"aluminium oxide", aluminium_oxide()}, {"cast iron", cast_iron()}}) {
    for (const double e : {0.2, 0.4, 0.6, 0.8, 1.0}) {
      ImpactSpec s = sphere;
      s.restitution = e;
      const Impact i = run_impact(s);
      rows.push_back(relative_row(fmt::format("{}: restitution", name), i.restitution, e, 0.01));
      ledger.add(s, i);
    }
  }
  ledger.rows(rows);
  return rows;
}

}  // namespace

Entry damped_impact() { return {"dem.damped_impact", {"Chung & Ooi 2011, Granular Matter 13:643, test 3"}, run}; }

}  // namespace lahar::validate
