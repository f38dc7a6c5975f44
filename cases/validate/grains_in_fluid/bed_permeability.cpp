// Water and thicker liquids through fixed beds of grains of a few cells, as a debris flow resolves them: periodic packs
// driven by a body force g, with F the drag without the buoyancy of the pressure gradient over 3 pi nu d U (U the
// superficial velocity), g = 18 nu U phi F / (d^2 (1 - phi)). The radius at which the fluid comes to rest is that for
// the cell Reynolds number U dx / nu (coupling_options.h), collision and eddies are those of debris flow scenes.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "cases/validate/entry.h"
#include "cases/validate/grains_in_fluid/closed_forms.h"
#include "cases/validate/grains_in_fluid/hard_spheres.h"
#include "cases/validate/grains_in_fluid/sphere_flow.h"
#include "core/units.h"

namespace lahar::validate {

namespace {

constexpr double kSmagorinsky = 0.16;
constexpr double kFinal = 5e-3;      // change of the mean velocity between two spans of time
constexpr double kTolerance = 0.20;  // of the drag; the references differ by as much at some volume fractions

struct Bed {
  double fraction;
  int cells_per_diameter;
  int box;  ///< cells along an edge

  /// How many spheres come nearest to the fraction, and their exact diameter, cells.
  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(
        std::lround(6 * fraction * std::pow(static_cast<double>(box) / cells_per_diameter, 3) / std::numbers::pi));
  }
  [[nodiscard]] double diameter() const {
    return std::cbrt(6 * fraction * box * box * box / (std::numbers::pi * static_cast<double>(count())));
  }
};

Bed bed_of(double fraction, int cells) { return {fraction, cells, cells == 2 ? 16 : cells == 4 ? 32 : 40}; }

/// Superficial velocity, lu, once the flow is steady. `expected`: about what it will be.
double velocity_through(const Bed& bed, double viscosity, double gravity, double expected, double radius_shift) {
  const double d = bed.diameter(), share = 1 - bed.fraction;
  Immersion immersion;
  immersion.collision = lbm::CentralMoments{};
  immersion.smagorinsky = kSmagorinsky;
  immersion.radius_shift = radius_shift;
  SphereFlow<float> flow(Vec3i::Constant(bed.box), viscosity, gravity * Vec3::UnitX(), immersion,
                         hard_spheres(bed.count(), bed.box, d, 1), d / 2, expected / share * Vec3::UnitX());
  const int span = 400 + static_cast<int>(0.5 * share * expected / gravity);
  double former = 0, mean = 0;
  for (int round = 0; round < 30; ++round) {
    mean = 0;
    for (int s = 0; s < span; ++s) {
      flow.step();
      if (s % 20 == 0) mean += flow.mean_velocity().x() / ((span + 19) / 20);
    }
    if (round > 2 && std::abs(mean / former - 1) < kFinal) break;
    former = mean;
  }
  return mean;
}

struct Drag {
  double reynolds, coefficient;  ///< F
};

Drag drag_of(const Bed& bed, double velocity, double viscosity, double gravity) {
  const double d = bed.diameter();
  return {velocity * d / viscosity, gravity * d * d * (1 - bed.fraction) / (18 * viscosity * velocity * bed.fraction)};
}

/// Liquids of which `reynolds` is expected, up to the 1000 that Beetstra's drag is for. Ergun's is 1.3 to 1.7 times as
/// large there.
Row liquid_row(const Bed& bed, double reynolds) {
  // Slow enough for the momentum that the body force gives in a step to be small beside the flow's.
  const double d = bed.diameter(), u = std::min(0.005, 0.002 * reynolds / d), nu = u * d / reynolds;
  const double g = 18 * nu * u * bed.fraction * drag_of_pack(bed.fraction, reynolds) / (d * d * (1 - bed.fraction));
  const double cell_reynolds = reynolds / d;
  const Drag found = drag_of(bed, velocity_through(bed, nu, g, u, coupling::radius_shift_at(cell_reynolds)), nu, g);
  return relative_row(fmt::format("F, phi {:.2f}, {} cells, Re {:.3g} (cell Re {:.2g}), Beetstra", bed.fraction,
                                  bed.cells_per_diameter, found.reynolds, found.reynolds / d),
                      found.coefficient, drag_of_pack(bed.fraction, found.reynolds), kTolerance);
}

constexpr double kDiameter = 0.05, kViscosity = 1e-6, kGravity = 9.81;  // gravel in water, m, m^2/s, m/s^2
constexpr double kGradient = 0.1;                                       // hydraulic
constexpr double kSceneSpeed = 7;                                       // m/s, 0.1 lu, sets the time step

/// Water through gravel at the time step of a flow of `speed` m/s, with the shift of fast flow.
Drag gravel_drag(const Bed& bed, double speed) {
  const double dx = kDiameter / bed.diameter();
  const LatticeUnits units{dx, 0.1 * dx / speed, 1000};
  const double nu = units.viscosity_to_lu(kViscosity), g = kGradient * units.acceleration_to_lu(kGravity);
  const double f = drag_of_bed(bed.fraction, 3000);
  const double expected = std::sqrt(g * bed.diameter() * (1 - bed.fraction) / (18 * bed.fraction * f / 3000));
  return drag_of(bed, velocity_through(bed, nu, g, expected, coupling::kRadiusShiftFast), nu, g);
}

Row gravel_row(const Bed& bed) {
  const Drag found = gravel_drag(bed, kSceneSpeed);
  return relative_row(fmt::format("F, phi {:.2f}, {} cells, Re {:.3g}, water through gravel, Ergun", bed.fraction,
                                  bed.cells_per_diameter, found.reynolds),
                      found.coefficient, drag_of_bed(bed.fraction, found.reynolds), kTolerance);
}

/// How much of the drag is the time step's: F Re is the same at all of them where the drag is quadratic.
Row time_step_row(const Bed& bed) {
  const auto quadratic = [](const Drag& drag) { return drag.coefficient / drag.reynolds; };
  return relative_row(fmt::format("F / Re, phi {:.2f}, {} cells, water through gravel: 4 times the time step",
                                  bed.fraction, bed.cells_per_diameter),
                      quadratic(gravel_drag(bed, 0.5 * kSceneSpeed)), quadratic(gravel_drag(bed, 2 * kSceneSpeed)),
                      0.10);
}

std::vector<Row> run(const Context& context) {
  if (context.quick) return {gravel_row(bed_of(0.5, 4))};
  std::vector<Row> rows;
  for (const int cells : {2, 4, 8})
    for (const double fraction : {0.4, 0.5, 0.6}) rows.push_back(gravel_row(bed_of(fraction, cells)));
  for (const int cells : {2, 4, 8}) rows.push_back(time_step_row(bed_of(0.5, cells)));
  for (const int cells : {2, 4, 8})
    for (const double fraction : {0.4, 0.5, 0.6})
      for (const double reynolds : {0.1, 1.0, 10.0, 100.0, 1000.0})
        rows.push_back(liquid_row(bed_of(fraction, cells), reynolds));
  return rows;
}

}  // namespace

Entry bed_permeability() {
  return {"grains_in_fluid.bed_permeability",
          {"Beetstra et al. 2007, eq. 17, to Re 1000; Ergun 1952 beyond", {"random_array_drag.csv"}},
          run};
}

}  // namespace lahar::validate
