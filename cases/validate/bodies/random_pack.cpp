// Flow through fixed random arrays of equal spheres, periodic, driven by a body force g: with F the drag without the
// buoyancy of the pressure gradient over 3 pi nu d U (U the superficial velocity), g = 18 nu U phi F / (d^2 (1 - phi)).
#include <fmt/format.h>

#include <numbers>
#include <random>

#include "cases/validate/bodies/entries.h"
#include "cases/validate/bodies/sphere_flow.h"

namespace lahar::validate {

namespace {

constexpr double kFinal = 3e-3;  // change of the mean velocity between two spans of time

/// Beetstra, van der Hoef & Kuipers 2007 (AIChE J. 53:489), eq. 17; +-8 % on its own data (random_array_drag.csv).
double beetstra(double phi, double re) {
  const double e = 1 - phi;
  return 10 * phi / (e * e) + e * e * (1 + 1.5 * std::sqrt(phi)) +
         0.413 * re / (24 * e * e) * (1 / e + 3 * phi * e + 8.4 * std::pow(re, -0.343)) /
             (1 + std::pow(10, 3 * phi) * std::pow(re, -(1 + 4 * phi) / 2));
}

/// Centres of `count` spheres in a periodic cube: random places, pushed apart until none overlap.
std::vector<Vec3> random_centres(std::size_t count, double box, double diameter, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Vec3> at(count);
  for (Vec3& p : at)
    for (int a = 0; a < 3; ++a) p[a] = box * static_cast<double>(random()) / 4294967296.0;
  for (int round = 0; round < 20000; ++round) {
    double worst = 0;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = i + 1; j < count; ++j) {
        Vec3 d = at[j] - at[i];
        for (int a = 0; a < 3; ++a) d[a] -= box * std::round(d[a] / box);
        const double gap = d.norm() - 1.01 * diameter;
        if (gap >= 0) continue;
        worst = std::max(worst, diameter - d.norm());
        at[j] -= 0.5 * gap * d.normalized(), at[i] += 0.5 * gap * d.normalized();
      }
    if (worst <= 0) break;
  }
  for (Vec3& p : at)
    for (int a = 0; a < 3; ++a) p[a] -= box * std::floor(p[a] / box);
  return at;
}

struct Pack {
  int cells;
  double fraction, reynolds;
};

struct PackResult {
  double drag, reynolds, diameter, shifted_viscosity;
  coupling::MomentumAudit audit;
};

PackResult flow_through(const Pack& pack, double diameter, double speed, const Immersion& immersion) {
  using std::numbers::pi;
  const double box = pack.cells, phi = pack.fraction;
  const auto count = static_cast<std::size_t>(std::lround(6 * phi * box * box * box / (pi * std::pow(diameter, 3))));
  const double d = std::cbrt(6 * phi * box * box * box / (pi * static_cast<double>(count)));
  const double nu = speed * d / pack.reynolds;
  const double g = 18 * nu * speed * phi * beetstra(phi, pack.reynolds) / (d * d * (1 - phi));
  SphereFlow<double> flow(Vec3i::Constant(pack.cells), nu, g * Vec3::UnitX(), immersion,
                          random_centres(count, box, d, 5), d / 2, speed / (1 - phi) * Vec3::UnitX());
  const int span = static_cast<int>(std::lround(0.5 * (1 - phi) * speed / g)) + 200;
  double former = 0, mean = 0;
  for (int round = 0; round < 40; ++round) {
    mean = 0;
    for (int s = 0; s < span; ++s) {
      flow.step();
      if (s % 20 == 0) mean += flow.mean_velocity().x() / ((span + 19) / 20);
    }
    if (round > 2 && std::abs(mean / former - 1) < kFinal) break;
    former = mean;
  }
  return {g * d * d * (1 - phi) / (18 * nu * mean * phi), mean * d / nu, d, 3 * nu, flow.audit()};
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  std::vector<Pack> packs;
  for (const double phi : context.quick ? std::vector{0.4} : std::vector{0.4, 0.5, 0.55})
    for (const double re : context.quick ? std::vector{1.0} : std::vector{0.1, 1.0, 10.0, 100.0})
      packs.push_back({context.quick ? 24 : 32, phi, re});
  coupling::MomentumAudit worst;
  for (const Pack& pack : packs) {
    // The slower the flow, the larger the viscosity: tau - 1/2 from 0.15 to 0.006.
    const double speed = pack.reynolds < 5    ? 0.002 * std::min(1.0, 4 * pack.reynolds)
                         : pack.reynolds < 50 ? 0.02
                                              : 0.025;
    // Two relaxation times carry creeping flow with a place of the wall that does not depend on tau, and are unstable
    // at the larger Reynolds numbers.
    Immersion immersion;
    if (pack.reynolds > 5) immersion.collision = lbm::CollisionOperator::central_moments;
    const PackResult r = flow_through(pack, 8, speed, immersion);
    if (r.audit.relative() > worst.relative()) worst = r.audit;
    rows.push_back(relative_row(fmt::format("F, phi {:.2f}, Re {:.3g}, {:.1f} cells, tau - 1/2 = {:.2g}", pack.fraction,
                                            r.reynolds, r.diameter, r.shifted_viscosity),
                                r.drag, beetstra(pack.fraction, r.reynolds),
                                context.quick ? 0.15 : 0.10));  // 21 spheres scatter
  }
  rows.push_back(audit_row("worst of all", worst));
  return rows;
}

}  // namespace

Entry random_pack() {
  return {"bodies.random_pack", "Beetstra et al. 2007, eq. 17 (random_array_drag.csv), +-8 % on its data", run};
}

}  // namespace lahar::validate
