// Water and thicker liquids through beds of grains of a few cells, at rest and moving. Collision and eddies are those
// of debris flow scenes. The radius at which the fluid comes to rest is that for the cell Reynolds number U dx / nu
// (coupling_options.h), by the default weighting, or that of the scenes for all liquids, with theirs.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "cases/validate/entry.h"
#include "cases/validate/grains_in_fluid/bed_flow.h"
#include "cases/validate/grains_in_fluid/closed_forms.h"

namespace lahar::validate {

namespace {

constexpr double kTolerance = 0.20;  // of the drag; the references differ by as much at some volume fractions

/// 8 diameters wide, of fine cells 5, which take less time.
Bed bed_of(double fraction, int cells) { return make_bed(fraction, cells, cells == 8 ? 5 : 8); }

constexpr auto kWallDistance = lbm::BodyWeighting::wall_distance, kInertial = lbm::BodyWeighting::inertial;

std::string name_of(lbm::BodyWeighting weighting, double shift) {
  return fmt::format("{}, shift {:.2f}: ", weighting == kInertial ? "inertial" : "wall_distance", shift);
}

/// Liquids of which `reynolds` is expected, up to the 1000 that Beetstra's drag is for. Ergun's is 1.3 to 1.7 times as
/// large there.
Row liquid_row(const Bed& bed, double reynolds, lbm::BodyWeighting weighting, double shift) {
  // Slow enough for the momentum that the body force gives in a step to be small beside the flow's.
  const double d = bed.diameter, u = std::min(0.005, 0.002 * reynolds / d), nu = u * d / reynolds;
  const double g = 18 * nu * u * bed.fraction * drag_of_pack(bed.fraction, reynolds) / (d * d * (1 - bed.fraction));
  Immersion immersion = debris_immersion();
  immersion.weighting = weighting;
  immersion.radius_shift = shift;
  const BedDrag found = drag_of_flow<float>(bed, nu, g, u, immersion);
  return relative_row(
      fmt::format("{}F, phi {:.2f}, {} cells, Re {:.3g} (cell Re {:.2g}), Beetstra", name_of(weighting, shift),
                  bed.fraction, std::lround(bed.diameter), found.reynolds, found.reynolds / d),
      found.coefficient, drag_of_pack(bed.fraction, found.reynolds), kTolerance);
}

constexpr double kSceneSpeed = 7;  // m/s, of the paper's case

BedDrag gravel_drag(const Bed& bed, lbm::BodyWeighting weighting, double speed, double drift = 0) {
  Immersion immersion = debris_immersion();
  immersion.weighting = weighting;
  immersion.radius_shift = coupling::kRadiusShiftFast;
  return drag_of_gravel<float>(bed, speed, immersion, drift);
}

std::string name_of(lbm::BodyWeighting weighting) { return name_of(weighting, coupling::kRadiusShiftFast); }

Row gravel_row(const Bed& bed, lbm::BodyWeighting weighting) {
  const BedDrag found = gravel_drag(bed, weighting, kSceneSpeed);
  return relative_row(fmt::format("{}F, phi {:.2f}, {} cells, Re {:.3g}, water through gravel, Ergun",
                                  name_of(weighting), bed.fraction, std::lround(bed.diameter), found.reynolds),
                      found.coefficient, drag_of_bed(bed.fraction, found.reynolds), kTolerance);
}

/// How much of the drag is the time step's: F / Re is the same at all of them where the drag is quadratic.
Row time_step_row(const Bed& bed, lbm::BodyWeighting weighting) {
  const auto quadratic = [](const BedDrag& drag) { return drag.coefficient / drag.reynolds; };
  return relative_row(fmt::format("{}F / Re, phi {:.2f}, {} cells, water through gravel: 4 times the time step",
                                  name_of(weighting), bed.fraction, std::lround(bed.diameter)),
                      quadratic(gravel_drag(bed, weighting, 0.5 * kSceneSpeed)),
                      quadratic(gravel_drag(bed, weighting, 2 * kSceneSpeed)), 0.10);
}

/// The same bed in a stream of the same velocity past it, but moving: what water at rest does to falling grains.
Row moving_row(const Bed& bed, lbm::BodyWeighting weighting, double drift) {
  const auto quadratic = [](const BedDrag& drag) { return drag.coefficient / drag.reynolds; };
  return relative_row(fmt::format("{}F / Re, phi {:.2f}, {} cells, water through gravel: the bed moves, {:g} times U",
                                  name_of(weighting), bed.fraction, std::lround(bed.diameter), drift),
                      quadratic(gravel_drag(bed, weighting, kSceneSpeed, drift)),
                      quadratic(gravel_drag(bed, weighting, kSceneSpeed)), 0.10);
}

std::vector<Row> run(const Context& context) {
  if (context.quick) return {gravel_row(bed_of(0.5, 4), kWallDistance), moving_row(bed_of(0.5, 2), kInertial, 1)};
  std::vector<Row> rows;
  for (const auto weighting : {kWallDistance, kInertial}) {
    for (const int cells : {2, 4, 8})
      for (const double fraction : {0.4, 0.5, 0.6}) rows.push_back(gravel_row(bed_of(fraction, cells), weighting));
    for (const int cells : {2, 4, 8}) rows.push_back(time_step_row(bed_of(0.5, cells), weighting));
    for (const int cells : {2, 4, 8})
      for (const double drift : {1.0, 30.0}) rows.push_back(moving_row(bed_of(0.5, cells), weighting, drift));
  }
  for (const int cells : {2, 4, 8})
    for (const double fraction : {0.4, 0.5, 0.6}) {
      const Bed bed = bed_of(fraction, cells);
      for (const double reynolds : {0.1, 1.0, 10.0, 100.0, 1000.0})
        rows.push_back(liquid_row(bed, reynolds, kWallDistance, coupling::radius_shift_at(reynolds / bed.diameter)));
    }
  // As the study has it (cases/debris_flow/scene.toml), whose packs are of 0.64.
  for (const int cells : {2, 4})
    for (const double fraction : {0.4, 0.5, 0.6, 0.64}) {
      const Bed bed = bed_of(fraction, cells);
      for (const double reynolds : {1.0, 10.0, 100.0, 1000.0})
        rows.push_back(liquid_row(bed, reynolds, kInertial, coupling::kRadiusShiftFast));
    }
  return rows;
}

}  // namespace

Entry bed_permeability() {
  return {"grains_in_fluid.bed_permeability",
          {"Beetstra et al. 2007, eq. 17, to Re 1000; Ergun 1952 beyond", {"random_array_drag.csv"}},
          run};
}

}  // namespace lahar::validate
