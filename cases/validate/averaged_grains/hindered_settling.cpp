// Glass beads that settle in a closed vessel, alone and many together: the speed in the middle of the swarm before its
// top comes down, against the drag of a lone sphere and the power law of Richardson & Zaki 1954 with the power of Khan
// & Richardson 1989 (Chem. Eng. Comm. 78:111), (4.8 - n)/(n - 2.4) = 0.043 Ar^0.57.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/validate/averaged_grains/averaged_bed.h"
#include "cases/validate/entry.h"

namespace lahar::validate {

namespace {

constexpr double kGravity = 9.81, kDiameter = 0.01, kDensity = 2500, kCell = 0.01;
const Vec3 kVessel(0.16, 0.16, 0.48);  // m

/// Of a lone sphere whose drag is `excess(Re)` times Stokes', m/s.
template <class Excess>
double terminal_speed(double viscosity, const Excess& excess) {
  const double stokes = (kDensity / kLiquidDensity - 1) * kGravity * kDiameter * kDiameter / (18 * viscosity);
  double u = 1e-6;
  for (int k = 0; k < 200; ++k) u = 0.5 * (u + stokes / excess(u * kDiameter / viscosity));
  return u;
}

/// By the drag of Schiller & Naumann 1935.
double measured_speed(double viscosity) {
  return terminal_speed(viscosity, [](double re) { return 1 + 0.15 * std::pow(re, 0.687); });
}

/// By the drag of Dallavalle 1948, which the law has for a lone sphere.
double speed_of_law(double viscosity) {
  return terminal_speed(viscosity, [](double re) { return std::pow(0.63 * std::sqrt(re) + 4.8, 2) / 24; });
}

double power(double viscosity) {
  const double ar = std::pow(kDiameter, 3) * (kDensity / kLiquidDensity - 1) * kGravity / (viscosity * viscosity);
  const double x = 0.043 * std::pow(ar, 0.57);
  return (4.8 + 2.4 * x) / (1 + x);
}

struct Swarm {
  double fraction, speed;  ///< solid; m/s, mean of the beads in the middle third of the vessel
};

/// Of about this solid fraction; 0: one bead.
Swarm settle(double fraction, double viscosity, double length) {
  AveragedBed bed{.size = kVessel,
                  .cell_size = kCell,
                  .periodic = false,
                  .time_step = 3e-4,  // the swarm's weight compresses the fluid by less than a hundredth
                  .viscosity = viscosity,
                  .fluid_gravity = Vec3::Zero(),  // the same flow as with it: beads get their weight less buoyancy
                  .grain_gravity = Vec3(0, 0, -kGravity * (1 - kLiquidDensity / kDensity)),
                  .diameter = kDiameter,
                  .density = kDensity,
                  .exchange = coupling::AveragedGrains{length, coupling::BedDrag::di_felice, false}};
  const std::vector<Vec3> centres =
      fraction > 0 ? loose_lattice(kVessel, kDiameter, fraction, 1) : std::vector<Vec3>{Vec3(0.078, 0.083, 0.4)};
  auto step = make_bed(bed, centres);
  const double passage = kVessel.z() / measured_speed(viscosity);
  double sum = 0, count = 0;
  while (step->time() < 0.4 * passage) {
    step->advance();
    if (step->time() < 0.2 * passage) continue;
    const dem::Particles& p = step->solids()->particles();
    for (dem::ParticleIndex i = 0; i < p.size(); ++i)
      if (fraction == 0 || std::abs(p.position.z[i] / kVessel.z() - 0.5) < 1 / 6.0) sum -= p.velocity.z[i], ++count;
  }
  const double volume = std::numbers::pi / 6 * std::pow(kDiameter, 3);
  return {static_cast<double>(centres.size()) * volume / kVessel.prod(), sum / count};
}

std::vector<Row> lone_rows(double viscosity) {
  const auto label = [&](const char* over, double length) {
    return fmt::format("speed of a lone bead over {}, Re {:.2g}, averaged over {:.0f} d", over,
                       measured_speed(viscosity) * kDiameter / viscosity, length / kDiameter);
  };
  std::vector<Row> rows;
  for (const double length : {0.02, 0.04, 0.08}) {
    const double speed = settle(0, viscosity, length).speed;
    rows.push_back(relative_row(label("that of its law", length), speed / speed_of_law(viscosity), 1, 0.05));
    if (length == 0.04)
      rows.push_back(relative_row(label("the measured", length), speed / measured_speed(viscosity), 1, 0.10));
  }
  return rows;
}

Row swarm_row(double fraction, double viscosity) {
  const double lone = measured_speed(viscosity), n = power(viscosity);
  const Swarm found = settle(fraction, viscosity, 0.04);
  return relative_row(fmt::format("speed over a lone bead's, phi {:.2f}, Re {:.2g}: (1 - phi)^{:.2f}", found.fraction,
                                  lone * kDiameter / viscosity, n),
                      found.speed / lone, std::pow(1 - found.fraction, n), 0.10);
}

std::vector<Row> run(const Context& context) {
  if (context.quick) return {swarm_row(0.3, 1e-4)};
  std::vector<Row> rows;
  for (const double viscosity : {1e-3, 1e-4})
    for (const Row& row : lone_rows(viscosity)) rows.push_back(row);
  for (const double viscosity : {1e-3, 1e-4})
    for (const double fraction : {0.1, 0.2, 0.3, 0.45}) rows.push_back(swarm_row(fraction, viscosity));
  return rows;
}

}  // namespace

Entry hindered_settling() {
  return {"averaged_grains.hindered_settling",
          {"Richardson & Zaki 1954 with Khan & Richardson 1989; Schiller & Naumann 1935"},
          run};
}

}  // namespace lahar::validate
