// A dissipator in a cable, stretched and let go: does it follow its law of two or three stages, in force and slope, and
// is the energy the area under it, with elastic (paper) and plastic unloading?
#include "cases/energy_dissipator/energy_dissipator.h"

#include <string>

#include "cases/energy_dissipator/report.h"
#include "cases/validate/barrier/result_rows.h"

namespace lahar::validate {

namespace {

std::vector<Row> run(const Context& context) {
  cases::EnergyDissipator table_2, bilinear;
  bilinear.stiffness = {3.5e8, 3.5e7};  // Table 3, as in the rockfall test
  bilinear.force_limit = {12e3};
  bilinear.last_force = 15.6e3;
  std::vector<Row> rows;
  for (const auto& [name, brake] : {std::pair{"three stages", table_2}, std::pair{"two stages", bilinear}})
    for (const auto unloading : {cases::BrakeUnloading::elastic, cases::BrakeUnloading::plastic}) {
      cases::EnergyDissipator b = brake;
      b.unloading = unloading;
      const std::string what =
          std::string(name) + (unloading == cases::BrakeUnloading::elastic ? ", elastic" : ", plastic");
      const cases::BrakeCurve curve = cases::stretch(b);
      for (Row& row : rows_of(cases::dissipator_checks(curve, b), what + ": ")) rows.push_back(std::move(row));
      if (!context.plots.empty())
        cases::draw_dissipator(
            context.plots / ("energy_dissipator_" + std::to_string(b.stiffness.size()) +
                             (b.unloading == cases::BrakeUnloading::elastic ? "" : "_plastic") + ".png"),
            curve, b);
    }
  return rows;
}

}  // namespace

Entry energy_dissipator() {
  return {"barrier.energy_dissipator", {"Li, Zhao & Kwan 2020, Eq. (1), section 3.2, Table 2"}, run};
}

}  // namespace lahar::validate
