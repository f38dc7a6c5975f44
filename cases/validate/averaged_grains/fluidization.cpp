// Free grains on a grate in a column of water whose stream from below slowly grows: the bed lifts at the speed at which
// Ergun's pressure drop carries its weight. Read is the speed at which the liquid bears the whole weight of all grains
// above one of the bed's planes, whichever comes first: what grains have moved by then hangs on how soft they are. (Its
// lowest layers stay longer: averaged over two diameters they have the water below the grate around them.)
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "cases/validate/averaged_grains/averaged_bed.h"
#include "cases/validate/entry.h"

namespace lahar::validate {

namespace {

constexpr double kGravity = 9.81, kDiameter = 0.02, kDensity = 2500, kCell = 0.02, kGrate = 0.06;
const Vec3 kColumn(0.16, 0.16, 0.9);  // m; water overflows at the top

/// Superficial speed at which Ergun's pressure drop carries a bed, m/s.
double ergun_speed(double phi, double viscosity) {
  const double eps = 1 - phi, e3 = eps * eps * eps;
  const double a = 1.75 * phi / (e3 * kDiameter), b = 150 * phi * phi * viscosity / (e3 * kDiameter * kDiameter);
  const double c = phi * (kDensity / kLiquidDensity - 1) * kGravity;
  return (-b + std::sqrt(b * b + 4 * a * c)) / (2 * a);
}

double mean_height(const dem::Particles& p) {
  double sum = 0;
  for (const double z : p.position.z) sum += z;
  return sum / static_cast<double>(p.size());
}

struct Lift {
  double fraction = 0;  ///< solid, of the bed at rest
  double speed = 0;     ///< m/s, superficial, at which the liquid bears all that is above a plane of the bed
};

/// The force of the liquid on the grains above a plane over their weight, of the plane where it is largest; none with
/// less than a tenth of the bed above it. `impulse` (N s) of the liquid by grain, over `time` (s).
double borne_share(const dem::Particles& p, const std::vector<double>& impulse, double time) {
  std::vector<dem::ParticleIndex> from_above(p.size());
  std::iota(from_above.begin(), from_above.end(), dem::ParticleIndex{0});
  std::sort(from_above.begin(), from_above.end(), [&](auto i, auto j) { return p.position.z[i] > p.position.z[j]; });
  double largest = 0, borne = 0, weight = 0;
  for (std::size_t n = 0; n < from_above.size(); ++n) {
    const dem::ParticleIndex i = from_above[n];
    borne += impulse[i] / time, weight += p.mass[i] * kGravity;
    if (10 * n > from_above.size()) largest = std::max(largest, borne / weight);
  }
  return largest;
}

/// The stream grows from three to thirteen tenths of about what Ergun's drag asks for.
Lift lift(double viscosity) {
  constexpr double at_rest = 4, ramp = 10;  // s: the bed settles; the stream grows
  constexpr int steps_a_reading = 200;
  const double area = kColumn.x() * kColumn.y(), volume = std::numbers::pi / 6 * std::pow(kDiameter, 3);
  const double expected = ergun_speed(0.6, viscosity), first = 0.3 * expected, last = 1.3 * expected;
  AveragedBed bed{.size = kColumn,
                  .cell_size = kCell,
                  .periodic = false,
                  .time_step = 5e-4,
                  .viscosity = viscosity,
                  .fluid_gravity = Vec3(0, 0, -kGravity),
                  .grain_gravity = Vec3(0, 0, -kGravity),
                  .diameter = kDiameter,
                  .density = kDensity,
                  .exchange = coupling::AveragedGrains{0.04, coupling::BedDrag::gidaspow, false},
                  .youngs_modulus = 1e8,
                  .grate = kGrate,
                  .water_level = 0.8,
                  .inflows = {{"stream",
                               Vec3::Zero(),
                               Vec3(kColumn.x(), kColumn.y(), kCell),
                               Vec3::Zero(),
                               {{{at_rest, first * area}, {at_rest + ramp, last * area}}}}}};
  std::vector<Vec3> centres = loose_lattice(Vec3(kColumn.x(), kColumn.y(), 0.5), kDiameter, 0.523, 3);
  for (Vec3& c : centres) c.z() += kGrate;
  auto step = make_bed(bed, centres);
  const dem::Solids& solids = *step->solids();
  const auto count = static_cast<double>(centres.size());
  while (step->time() < at_rest) step->advance();
  Lift found;
  found.fraction = volume * count / (area * 2 * (mean_height(solids.particles()) - kGrate));
  const auto speed_at = [&](double time) { return first + (last - first) * (time - at_rest) / ramp; };
  double share = 0, speed = first;  // at the last reading
  while (step->time() < at_rest + ramp) {
    const double share_before = share, speed_before = speed, from = step->time();
    std::vector<double> impulse(centres.size(), 0.0);
    for (int n = 0; n < steps_a_reading; ++n) {
      step->advance();
      for (dem::ParticleIndex i = 0; i < impulse.size(); ++i)
        impulse[i] += bed.time_step * solids.particles().external_force.z[i];
    }
    share = borne_share(solids.particles(), impulse, step->time() - from);
    speed = speed_at(0.5 * (from + step->time()));
    if (share < 1) continue;
    found.speed = speed_before + (speed - speed_before) * (1 - share_before) / (share - share_before);
    break;
  }
  return found;
}

Row lift_row(double viscosity) {
  const Lift found = lift(viscosity);
  const double expected = ergun_speed(found.fraction, viscosity);
  return relative_row(fmt::format("speed that lifts a bed of phi {:.3f}, Re {:.3g}, m/s", found.fraction,
                                  expected * kDiameter / viscosity),
                      found.speed, expected, 0.15);
}

std::vector<Row> run(const Context& context) {
  if (context.quick) return {lift_row(1e-4)};
  return {lift_row(1e-6), lift_row(1e-4)};
}

}  // namespace

Entry fluidization() {
  return {"averaged_grains.fluidization", {"Ergun 1952 (minimum fluidization: pressure drop = weight)"}, run};
}

}  // namespace lahar::validate
