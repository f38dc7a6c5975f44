// A sphere that resists rolling: on a plane of 20 degrees it rests while mu_r >= tan(angle) and rolls down with
// 5/7 g (sin - mu_r cos) otherwise; on the level it stops after 7/10 v0^2 / (mu_r g). Rigid-body theory: the torque
// balance about the contact is 7/5 m R^2 w' = m g R sin - mu_r R m g cos.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "cases/validate/dem/ledger_watch.h"
#include "cases/validate/dem/solid_scenes.h"
#include "cases/validate/entry.h"

namespace lahar::validate {

namespace {

constexpr double kAngle = 20 * std::numbers::pi / 180, kFriction = 0.7, kRadius = SphereOnPlane::kRadius;

/// How far the centre may get before the sphere rests, m, by energy. Neither spring is wound up at the start, so that
/// they overshoot. With torques over R (t of the weight, the limit l) and the stiffness k of both springs: the weight
/// does t (Rw + d) on the way Rw that is rolled and d that the surface gives; the springs hold k d^2 / 2 and l^2 / 2k,
/// and rolling on takes l (Rw - l/k). Hence (l - t) Rw <= (t^2 + l^2) / 2k, and at rest d = t/k. The dashpots make it
/// less.
double longest_start(const dem::Solids& solids, double rolling_friction) {
  const dem::MaterialPair& pair = solids.materials().pair(0, 0);
  const double weight = solids.particles().mass[0] * kGravity, normal = weight * std::cos(kAngle);
  const double overlap = std::pow(normal / (4.0 / 3 * pair.effective_modulus * std::sqrt(kRadius)), 2.0 / 3);
  const double stiffness = 8 * pair.effective_shear_modulus * std::sqrt(kRadius * overlap);
  const double t = weight * std::sin(kAngle), l = rolling_friction * normal;
  return 0.5 * (t * t + l * l) / (stiffness * (l - t)) + t / stiffness;
}

void advance(dem::Solids& solids, LedgerWatch& watch, double time) {
  advance_watched(solids, watch, static_cast<int>(std::lround(time / solids.options().time_step)), 100);
}

void ask_slope(std::vector<Row>& rows, double rolling_friction, double time) {
  const SphereOnPlane scene{kAngle, kFriction, rolling_friction};
  dem::Solids solids = scene.solids();
  LedgerWatch watch(solids);
  advance(solids, watch, 0.1 * time);  // the spring is wound up within 0.3 ms
  const double start = solids.particles().velocity[0].dot(scene.down()), start_time = solids.time();
  advance(solids, watch, 0.9 * time);
  const double speed = solids.particles().velocity[0].dot(scene.down());
  if (rolling_friction >= std::tan(kAngle)) {
    const std::string name = fmt::format("20 degrees, mu_r {:.2f}, rests", rolling_friction);
    rows.push_back(at_most_row(name + ": way down, m", solids.particles().position[0].dot(scene.down()),
                               longest_start(solids, rolling_friction)));
    rows.push_back(at_most_row(name + ": speed, m/s", std::abs(speed), 1e-7));
    return;
  }
  const std::string name = fmt::format("20 degrees, mu_r {:.2f}, rolls", rolling_friction);
  const double a = 5.0 / 7 * kGravity * (std::sin(kAngle) - rolling_friction * std::cos(kAngle));
  rows.push_back(relative_row(name + ": acceleration, m/s2", (speed - start) / (solids.time() - start_time), a, 1e-3));
  rows.push_back(relative_row(name + ": radius x spin / speed",
                              kRadius * solids.particles().angular_velocity.y[0] / speed, 1, 1e-3));
  rows.push_back(watch.row(name));
}

void ask_level(std::vector<Row>& rows, double rolling_friction, double speed) {
  dem::Solids solids = SphereOnPlane{0, kFriction, rolling_friction, speed}.solids();
  LedgerWatch watch(solids);
  const double way = 0.7 * speed * speed / (rolling_friction * kGravity);
  advance(solids, watch, 2.4 * way / speed);  // it stops after 2 way / speed
  const std::string name = fmt::format("level, mu_r {:.2f}, {:g} m/s", rolling_friction, speed);
  rows.push_back(relative_row(name + ": way, m", solids.particles().position.x[0], way, 1e-3));
  rows.push_back(at_most_row(name + ": speed at the end, m/s", solids.particles().velocity[0].norm(), 1e-7));
  rows.push_back(watch.row(name));
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  for (const double rolling_friction : {0.0, 0.1, 0.3, 0.35, 0.37, 0.6})  // tan 20 degrees = 0.364
    ask_slope(rows, rolling_friction, context.quick ? 0.05 : 0.5);
  ask_level(rows, 0.3, context.quick ? 0.2 : 0.5);
  if (!context.quick) ask_level(rows, 0.05, 0.5);
  return rows;
}

}  // namespace

Entry rolling_friction() { return {"dem.rolling_friction", {"rigid-body theory"}, run}; }

}  // namespace lahar::validate
