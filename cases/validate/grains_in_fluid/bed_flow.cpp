#include "cases/validate/grains_in_fluid/bed_flow.h"

#include <cmath>
#include <numbers>

#include "cases/validate/grains_in_fluid/closed_forms.h"
#include "cases/validate/grains_in_fluid/hard_spheres.h"
#include "core/units.h"

namespace lahar::validate {

Bed make_bed(double fraction, int cells_per_diameter, int diameters) {
  using std::numbers::pi;
  Bed bed;
  bed.fraction = fraction;
  bed.box = diameters * cells_per_diameter;
  const double volume = fraction * bed.box * bed.box * bed.box;
  const auto count = std::lround(6 * volume / (pi * std::pow(cells_per_diameter, 3)));
  bed.diameter = std::cbrt(6 * volume / (pi * static_cast<double>(count)));
  const auto place = fraction > 0.6 ? jammed_spheres : hard_spheres;
  bed.centres = place(static_cast<std::size_t>(count), bed.box, bed.diameter, 1);
  return bed;
}

Immersion debris_immersion() {
  Immersion immersion;
  immersion.collision = lbm::CentralMoments{};
  immersion.smagorinsky = 0.16;
  return immersion;
}

template <class Real>
BedDrag drag_of_flow(const Bed& bed, double viscosity, double gravity, double expected, const Immersion& immersion,
                     double drift) {
  constexpr double final_change = 5e-3;  // of the mean velocity between two spans of time
  const double d = bed.diameter, pores = 1 - bed.fraction;
  SphereFlow<Real> flow(Vec3i::Constant(bed.box), viscosity, gravity * Vec3::UnitX(), immersion, bed.centres, d / 2,
                        (expected / pores - drift * expected) * Vec3::UnitX());
  flow.move_spheres(-drift * expected * Vec3::UnitX());
  const int span = 400 + static_cast<int>(0.5 * pores * expected / gravity);
  double former = 0, mean = 0;
  for (int round = 0; round < 30; ++round) {
    mean = 0;
    for (int s = 0; s < span; ++s) {
      flow.step();
      if (s % 20 == 0) mean += (flow.mean_velocity().x() + drift * expected) / ((span + 19) / 20);
    }
    if (round > 2 && std::abs(mean / former - 1) < final_change) break;
    former = mean;
  }
  return {mean * d / viscosity, gravity * d * d * pores / (18 * viscosity * mean * bed.fraction)};
}

template <class Real>
BedDrag drag_of_gravel(const Bed& bed, double speed, const Immersion& immersion, double drift) {
  constexpr double diameter = 0.05, water = 1e-6, gradient = 0.1;  // m, m^2/s, hydraulic
  const double d = bed.diameter, dx = diameter / d;
  const LatticeUnits units{dx, 0.1 * dx / speed, 1000};
  const double nu = units.viscosity_to_lu(water), g = gradient * units.acceleration_to_lu(9.81);
  // F / Re of Ergun's bed where its drag is quadratic
  const double quadratic = drag_of_bed(bed.fraction, 3000) / 3000;
  const double expected = std::sqrt(g * d * (1 - bed.fraction) / (18 * bed.fraction * quadratic));
  return drag_of_flow<Real>(bed, nu, g, expected, immersion, drift);
}

template BedDrag drag_of_flow<float>(const Bed&, double, double, double, const Immersion&, double);
template BedDrag drag_of_flow<double>(const Bed&, double, double, double, const Immersion&, double);
template BedDrag drag_of_gravel<float>(const Bed&, double, const Immersion&, double);
template BedDrag drag_of_gravel<double>(const Bed&, double, const Immersion&, double);

}  // namespace lahar::validate
