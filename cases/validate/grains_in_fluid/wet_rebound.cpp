// A sphere settles in a viscous liquid and bounces on the floor: its rebound over that in vacuum depends on the Stokes
// number St = rho_s d v / (9 mu) of its impact (with the added mass in it references would be 0.02 higher at most), as
// exp(-35 / St) (Legendre, Daniel & Guiraud 2005, Phys. Fluids 17:097105: a fit to measurements of drops and of solid
// spheres by Gondret, Lance & Petit 2002 and Joseph et al. 2001).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/validate/entry.h"
#include "cases/validate/grains_in_fluid/sphere_tanks.h"
#include "core/worst.h"

namespace lahar::validate {

namespace {

constexpr double kDensityRatio = 8, kRestitution = 0.97, kSpeed = 0.05;  // steel in a liquid; lu

/// Gap over diameter at which the rebound is measured: what the cameras of the experiments tell from contact.
constexpr double kSeen = 0.05;

struct Rebound {
  double stokes = 0, ratio = 0;  ///< of the highest speed before the contact; speed at kSeen after over it
  double nearest = 1;            ///< gap over diameter
  double audit = 0;
};

template <class Real>
Rebound bounce(double stokes, int diameter) {
  const double nu = kDensityRatio * diameter * kSpeed / (9 * stokes), reynolds = kSpeed * diameter / nu;
  const double drag = 24 / reynolds * (1 + 0.15 * std::pow(reynolds, 0.687));  // Schiller & Naumann 1935
  SphereTank t;
  t.cells = Vec3i::Constant(5 * diameter);
  t.cells.z() = 6 * diameter;
  t.depth = 5.7 * diameter;
  t.viscosity = nu;
  t.smagorinsky = 0;
  // Weight less buoyancy is the drag at this speed: pi/6 d^3 (s - 1) g = pi/8 cd d^2 v^2.
  t.gravity = 0.75 * drag * kSpeed * kSpeed / (diameter * (kDensityRatio - 1));
  t.diameter = diameter;
  t.place = Vec3(2.5 * diameter + 0.2, 2.5 * diameter - 0.1, 4 * diameter);
  t.velocity = Vec3(0, 0, -0.9 * kSpeed);
  t.density = kDensityRatio;
  t.youngs_modulus = 1e4, t.restitution = kRestitution;
  t.substeps = 40;
  t.immersion.radius_shift = coupling::radius_shift_at(reynolds / diameter);
  t.lubrication = true;
  const auto tank = make_tank<Real>(t);
  auto& step = *tank;
  const dem::Particles& p = step.solids()->particles();
  double before = 0, after = 0, nearest = 1;
  bool touched = false;
  const int most = static_cast<int>(8 * diameter / kSpeed);
  for (int s = 0; s < most && after == 0; ++s) {
    step.advance();
    const double speed = p.velocity.z[0], gap = p.position.z[0] - 0.5 * diameter;
    before = std::max(before, -speed), nearest = std::min(nearest, gap / diameter);
    touched = touched || speed > 0;
    if (touched && speed <= 0) break;  // it falls again
    if (touched && gap > kSeen * diameter) after = speed;
  }
  return {kDensityRatio * diameter * before / (9 * nu), after / before / kRestitution, nearest,
          step.audit().relative()};
}

std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    std::vector<Row> rows;
    double audit = 0;
    const auto ask = [&](double stokes, int diameter) {
      const Rebound found = bounce<Real>(stokes, diameter);
      keep_worst(audit, found.audit);
      const std::string of = fmt::format("St {:.3g}, {} cells", found.stokes, diameter);
      const double measured = std::exp(-35 / found.stokes);
      if (measured > 0.05) {
        rows.push_back(absolute_row("rebound over that in vacuum, " + of, found.ratio, measured, 0.1));
      } else {  // none to speak of: it has to have been there
        rows.push_back(at_most_row("rebound over that in vacuum, " + of, found.ratio, 0.03));
        rows.push_back(at_most_row("nearest to the floor, diameters, " + of, found.nearest, 0.01));
      }
    };
    // Asked for; four fifths of them are reached.
    for (const double stokes : {10.0, 24.0, 50.0, 100.0, 640.0, 1250.0}) {
      if (context.quick && stokes != 50) continue;
      ask(stokes, 8);
      if (!context.quick && stokes < 30) ask(stokes, 16);
    }
    rows.push_back(at_most_row("momentum audit", audit, sizeof(Real) == 8 ? 1e-10 : 1e-4));
    return rows;
  });
}

}  // namespace

Entry wet_rebound() { return {"grains_in_fluid.wet_rebound", {"Legendre, Daniel & Guiraud 2005, exp(-35/St)"}, run}; }

}  // namespace lahar::validate
