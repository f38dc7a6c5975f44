// Liquids through fixed random beds under a body force: the drag that comes out is that of the law at the bed's solid
// fraction, whatever cells and averaging length. The laws are written down twice, in
// grains_in_fluid/closed_forms.h and in coupling/grains/bed_drag.h.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "cases/validate/averaged_grains/averaged_bed.h"
#include "cases/validate/entry.h"
#include "cases/validate/grains_in_fluid/closed_forms.h"
#include "cases/validate/grains_in_fluid/hard_spheres.h"

namespace lahar::validate {

namespace {

constexpr double kBox = 0.3, kDiameter = 0.05, kTolerance = 0.03;  // m, m

struct Question {
  double fraction, viscosity, cell_size, averaging_length;
  coupling::BedDrag law;
};

struct Answer {
  double reynolds, coefficient;  ///< U d / nu, F as in closed_forms.h
};

Answer ask(const Question& q) {
  const double volume = std::numbers::pi / 6 * kDiameter * kDiameter * kDiameter;
  const auto count = static_cast<std::size_t>(std::lround(q.fraction * kBox * kBox * kBox / volume));
  const double phi = static_cast<double>(count) * volume / (kBox * kBox * kBox);
  constexpr double gravity = 1;  // m/s^2
  AveragedBed bed{.size = Vec3::Constant(kBox),
                  .cell_size = q.cell_size,
                  .periodic = true,
                  .time_step = 0.05 * q.cell_size,
                  .viscosity = q.viscosity,
                  .fluid_gravity = Vec3(gravity, 0, 0),
                  .grain_gravity = Vec3::Zero(),
                  .diameter = kDiameter,
                  .density = 2500,
                  .state = dem::ParticleState::fixed,
                  .exchange = coupling::AveragedGrains{q.averaging_length, q.law, false}};
  auto step = make_bed(bed, hard_spheres(count, kBox, kDiameter, 1));
  double former = 0, mean = 0;
  for (int round = 0; round < 60; ++round) {
    for (int n = 0; n < 100; ++n) step->advance();
    mean = mean_velocity(*step).x();
    if (round > 2 && std::abs(mean / former - 1) < 1e-4) break;
    former = mean;
  }
  return {mean * kDiameter / q.viscosity,
          gravity * kDiameter * kDiameter * (1 - phi) / (18 * q.viscosity * mean * phi)};
}

Row beetstra_row(double fraction, double viscosity, double cell_size, double length) {
  const Answer a = ask({fraction, viscosity, cell_size, length, coupling::BedDrag::beetstra});
  return relative_row(fmt::format("F, Beetstra, phi {}, Re {:.3g}, cells of {:.2f} d, averaged over {:.1f} d", fraction,
                                  a.reynolds, cell_size / kDiameter, length / kDiameter),
                      a.coefficient, drag_of_pack(fraction, a.reynolds), kTolerance);
}

Row ergun_row(double fraction, double viscosity) {
  const Answer a = ask({fraction, viscosity, 0.0375, 0.15, coupling::BedDrag::gidaspow});
  return relative_row(fmt::format("F, Gidaspow against Ergun, phi {}, Re {:.3g}", fraction, a.reynolds), a.coefficient,
                      drag_of_bed(fraction, a.reynolds), kTolerance);
}

std::vector<Row> run(const Context& context) {
  if (context.quick) return {ergun_row(0.5, 1e-3)};
  std::vector<Row> rows;
  for (const double fraction : {0.4, 0.5, 0.6})
    for (const double viscosity : {1e-2, 1e-3, 1e-4}) {
      rows.push_back(ergun_row(fraction, viscosity));
      rows.push_back(beetstra_row(fraction, viscosity, 0.0375, 0.15));
    }
  for (const double cell_size : {0.01875, 0.0125}) rows.push_back(beetstra_row(0.5, 1e-3, cell_size, 0.15));
  for (const double length : {0.1, 0.3}) rows.push_back(beetstra_row(0.5, 1e-3, 0.0375, length));
  return rows;
}

}  // namespace

Entry bed_drag() {
  return {"averaged_grains.bed_drag", {"Beetstra et al. 2007, eq. 17; Ergun 1952", {"random_array_drag.csv"}}, run};
}

}  // namespace lahar::validate
