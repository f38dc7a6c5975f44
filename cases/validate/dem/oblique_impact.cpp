// A sphere meets a rigid plate at an angle, with friction: test 4 of Chung & Ooi (2011, Granular Matter 13:643-656).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/validate/dem/impact.h"
#include "cases/validate/reference_table.h"

namespace lahar::validate {
namespace {

ImpactSpec oblique(double degrees) {
  ImpactSpec s = aluminium_oxide();
  s.restitution = 0.98;
  s.friction = 0.092;
  s.angle = degrees * std::numbers::pi / 180;
  return s;
}

/// A sphere that slides all along loses mu (1 + e) of its normal velocity sideways and gets 5/2 of that as spin.
void theory_rows(std::vector<Row>& rows) {
  for (const double degrees : {40.0, 50.0, 60.0, 70.0, 80.0}) {
    const ImpactSpec s = oblique(degrees);
    const double loss = s.friction * (1 + s.restitution);
    const Impact i = run_impact(s);
    rows.push_back(relative_row(fmt::format("{:.0f} degrees, slides: tangential restitution", degrees),
                                i.tangential_ratio, 1 - loss / std::tan(s.angle), 0.01));
    rows.push_back(relative_row(fmt::format("{:.0f} degrees, slides: spin, rad/s", degrees), i.spin,
                                -2.5 * loss * s.speed * std::cos(s.angle) / s.radius, 0.01));
  }
}

/// Curves digitised from the paper, within 2 %.
void digitised_rows(std::vector<Row>& rows) {
  const ReferenceTable curves = reference("chungooi_test4.csv");
  ImpactLedger ledger;
  for (const auto& [degrees, ratio] : curves.where("quantity", "et_AlOxide").points("incident_angle_deg", "value")) {
    const Impact i = run_impact(oblique(degrees));
    rows.push_back(
        relative_row(fmt::format("{:.1f} degrees: tangential restitution", degrees), i.tangential_ratio, ratio, 0.03));
    ledger.add(oblique(degrees), i);
  }
  const auto spins = curves.where("quantity", "omega_AlOxide_rad_s").points("incident_angle_deg", "value");
  double largest = 0;
  for (const auto& [degrees, spin] : spins) largest = std::max(largest, std::abs(spin));
  for (const auto& [degrees, spin] : spins)
    rows.push_back(absolute_row(fmt::format("{:.1f} degrees: spin / {} rad/s", degrees, largest),
                                run_impact(oblique(degrees)).spin / largest, spin / largest, 0.03));
  ledger.rows(rows);
}

std::vector<Row> run(const Context&) {
  std::vector<Row> rows;
  theory_rows(rows);
  digitised_rows(rows);
  return rows;
}

}  // namespace

Entry oblique_impact() {
  return {"dem.oblique_impact", {"Chung & Ooi 2011, Granular Matter 13:643, test 4", {"chungooi_test4.csv"}}, run};
}

}  // namespace lahar::validate
