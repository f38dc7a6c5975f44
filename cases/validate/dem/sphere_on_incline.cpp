// A sphere on a plane of 35 degrees: it rolls without slip while mu >= 2/7 tan(angle), with 5/7 g sin(angle), and
// slides otherwise, with g (sin - mu cos) (rigid-body theory).
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "cases/validate/dem/ledger_watch.h"
#include "cases/validate/dem/solid_scenes.h"
#include "cases/validate/entry.h"

namespace lahar::validate {

namespace {

constexpr double kAngle = 35 * std::numbers::pi / 180;

void ask(std::vector<Row>& rows, double friction, double time) {
  const SphereOnPlane scene{kAngle, friction};
  dem::Solids solids = scene.solids();
  LedgerWatch watch(solids);
  advance_watched(solids, watch, static_cast<int>(std::lround(time / solids.options().time_step)), 100);
  const bool rolls = friction >= 2.0 / 7 * std::tan(kAngle);
  const double reached = solids.time();
  const double a = kGravity * (rolls ? 5.0 / 7 * std::sin(kAngle) : std::sin(kAngle) - friction * std::cos(kAngle));
  const std::string name = fmt::format("friction {:.2f}, {}", friction, rolls ? "rolls" : "slides");
  rows.push_back(
      relative_row(name + ": acceleration, m/s2", solids.particles().velocity[0].dot(scene.down()) / reached, a, 1e-3));
  if (friction > 0) {
    const double spin = (rolls ? a : 2.5 * friction * kGravity * std::cos(kAngle)) / SphereOnPlane::kRadius;
    rows.push_back(relative_row(name + ": angular acceleration, rad/s2",
                                solids.particles().angular_velocity.y[0] / reached, spin, 1e-3));
  }
  rows.push_back(watch.row(name));
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  const double time = context.quick ? 0.1 : 1.0;
  for (const double friction : {0.0, 0.1, 0.19, 0.21, 0.5, 0.7}) ask(rows, friction, time);
  return rows;
}

}  // namespace

Entry sphere_on_incline() { return {"dem.sphere_on_incline", {"rigid-body theory"}, run}; }

}  // namespace lahar::validate
