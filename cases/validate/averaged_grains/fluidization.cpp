// Free grains on a grate in a column of water whose stream from below slowly grows: the bed lifts at the speed at which
// Ergun's pressure drop carries its weight. Read is the speed at which its middle has risen by a quarter of a diameter,
// which no compression gives, less what the stream has grown by since the bed came loose: from then on it goes up with
// the excess of the stream, v = U - U_mf, by (U - U_mf)^2/(2 dU/dt). (Its lowest layers stay longer: averaged over two
// diameters they have the water below the grate around them.)
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

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
  double speed = 0;     ///< m/s, superficial, at which it comes loose
};

/// The stream grows from three to sixteen tenths of about what Ergun's drag asks for. No speed if the bed stays.
Lift lift(double viscosity) {
  constexpr double at_rest = 4, ramp = 13;  // s: the bed settles; the stream grows
  const double area = kColumn.x() * kColumn.y(), volume = std::numbers::pi / 6 * std::pow(kDiameter, 3);
  const double expected = ergun_speed(0.6, viscosity), first = 0.3 * expected, last = 1.6 * expected;
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
  const double start = mean_height(solids.particles()), rise = kDiameter / 4, growth = (last - first) / ramp;
  while (step->time() < at_rest + ramp && mean_height(solids.particles()) < start + rise) step->advance();
  const double fraction = volume * count / (area * 2 * (start - kGrate));
  if (mean_height(solids.particles()) < start + rise) return {.fraction = fraction, .speed = 0};
  return {.fraction = fraction, .speed = first + growth * (step->time() - at_rest) - std::sqrt(2 * growth * rise)};
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
