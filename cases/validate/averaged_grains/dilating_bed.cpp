// A bed of grains in water that is drawn apart upwards, as a dense bed is when it starts to flow: water has to get in,
// and its suction holds the grains. With the velocity of the grains v = z s'/s, s the stretch, the closed floor makes
// the water pass them with the superficial velocity -v, and by Ergun's pressure drop the force of the water on the
// grains of a column of area A is
//   F = -A int_0^h [150 mu phi^2 v / ((1 - phi)^3 d^2) + 1.75 rho phi v^2 / ((1 - phi)^3 d)] dz,  phi = phi_0 / s.
// The grains are moved by hand. Without gravity: what is left is suction alone.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/validate/averaged_grains/averaged_bed.h"
#include "cases/validate/entry.h"
#include "cases/validate/grains_in_fluid/hard_spheres.h"
#include "coupling/grains/bed_drag.h"

namespace lahar::validate {

namespace {

constexpr double kSide = 0.32, kHeight = 0.64, kWater = 1e-6;          // m, m, m^2/s
constexpr double kRate = 0.5, kRamp = 0.05, kStart = 0.1, kEnd = 0.3;  // 1/s; s: to that rate, and what is measured

struct Stretch {
  double stretch, rate;  ///< s; its change, 1/s
};

Stretch stretch_at(double t) {
  const double eased = std::min(t, kRamp);
  return {1 + kRate * (eased * eased / (2 * kRamp) + t - eased), kRate * eased / kRamp};
}

/// Pressure drop of a bed per length, Pa/m, for a superficial velocity.
using PressureDrop = double (*)(double phi, double diameter, double velocity);

double ergun(double phi, double diameter, double velocity) {
  const double e3 = std::pow(1 - phi, 3);
  return 150 * kLiquidDensity * kWater * phi * phi * velocity / (e3 * diameter * diameter) +
         1.75 * kLiquidDensity * phi * velocity * velocity / (e3 * diameter);
}

/// Drag of all grains over what is left for the liquid: the whole pressure drop.
double di_felice(double phi, double diameter, double velocity) {
  const double re = velocity * diameter / kWater, a = 1.5 - std::log10(re),
               lone = std::pow(0.63 + 4.8 / std::sqrt(re), 2);
  const double chi = 3.7 - 0.65 * std::exp(-a * a / 2);
  return 0.75 * phi / diameter * lone * kLiquidDensity * velocity * velocity * std::pow(1 - phi, -chi - 1);
}

/// N, of the pressure drop over the bed.
double suction(PressureDrop drop, double phi0, double diameter, double t) {
  constexpr int layers = 100;
  const auto [s, rate] = stretch_at(t);
  double sum = 0;
  for (int k = 0; k < layers; ++k)
    sum += drop(phi0 / s, diameter, rate / s * (k + 0.5) / layers * kHeight * s) * kHeight * s / layers;
  return kSide * kSide * sum;
}

/// A random pack, periodic sideways, its lowest centre half a diameter above the floor.
std::vector<Vec3> pack(double fraction, double diameter) {
  const double volume = std::numbers::pi / 6 * std::pow(diameter, 3);
  const auto count = static_cast<std::size_t>(std::lround(fraction * std::pow(kSide, 3) / volume));
  std::vector<Vec3> centres = hard_spheres(count, kSide, diameter, 1);
  for (std::size_t k = 0; k < count; ++k) centres.push_back(centres[k] + Vec3(0, 0, kSide));
  for (Vec3& c : centres) c.z() += diameter / 2;
  return centres;
}

struct Bed {
  double fraction, diameter, cell_size;
};

/// Mean over the time that is measured, of the measured over that of a law.
double suction_ratio(const Bed& bed, const coupling::GrainExchangeChoice& exchange, PressureDrop drop,
                     lbm::BodyWeighting weighting = lbm::kBodyWeighting) {
  constexpr double scene_speed = 7;  // m/s, of the paper's case: sets the time step
  const double d = bed.diameter;
  const std::vector<Vec3> centres = pack(bed.fraction, d);
  const double solid = static_cast<double>(centres.size()) * std::numbers::pi / 6 * std::pow(d, 3);
  auto step = make_bed({.size = Vec3(kSide, kSide, 0.96),
                        .cell_size = bed.cell_size,
                        .periodic = true,
                        .upright = true,
                        .time_step = 0.1 * bed.cell_size / scene_speed,
                        .viscosity = kWater,
                        .diameter = d,
                        .state = dem::ParticleState::fixed,
                        .exchange = exchange,
                        .weighting = weighting},
                       centres);
  dem::Particles& grains = step->solids()->particles();
  double found = 0, expected = 0;
  while (step->time() < kEnd) {
    const auto [s, rate] = stretch_at(step->time());
    for (dem::ParticleIndex i = 0; i < grains.size(); ++i)
      grains.velocity.set(i, Vec3(0, 0, rate / s * (grains.position.z[i] - d / 2)));
    step->advance();
    if (step->time() < kStart) continue;
    for (const double f : grains.external_force.z) found -= f;
    expected += suction(drop, solid / (kSide * kSide * kHeight), d, step->time());
  }
  return found / expected;
}

std::string about(const Bed& bed) {
  return fmt::format("phi {:g}, {} cells a diameter", bed.fraction, std::lround(bed.diameter / bed.cell_size));
}

Row resolved_row(const Bed& bed, lbm::BodyWeighting weighting) {
  const double ratio = suction_ratio(bed, coupling::ResolvedGrains{coupling::kRadiusShiftFast}, ergun, weighting);
  const char* const name = weighting == lbm::BodyWeighting::inertial ? "inertial, " : "";
  return relative_row("suction over Ergun's: resolved, " + (name + about(bed)), ratio, 1, 0.20);
}

constexpr double kPapers = 0.15, kShort = 0.08;  // m, averaging lengths

/// Against the pressure drop of its own law.
Row averaged_row(const Bed& bed, double length, coupling::BedDrag law, PressureDrop drop, const char* name) {
  const double ratio = suction_ratio(bed, coupling::AveragedGrains{length, law, false}, drop);
  return relative_row(fmt::format("suction over {}'s: averaged over {:g} m, {}", name, length, about(bed)), ratio, 1,
                      0.20);
}

/// What the choice of the law makes.
Row law_row(const Bed& bed) {
  const double time = 0.5 * (kStart + kEnd);
  return note_row(fmt::format("suction by Di Felice, by Ergun, N: phi {:g}, d {:g} m", bed.fraction, bed.diameter),
                  suction(di_felice, bed.fraction, bed.diameter, time),
                  suction(ergun, bed.fraction, bed.diameter, time));
}

std::vector<Row> run(const Context& context) {
  using coupling::BedDrag;
  const auto weightings = {lbm::BodyWeighting::wall_distance, lbm::BodyWeighting::inertial};
  if (context.quick) return {resolved_row({0.58, 0.04, 0.02}, lbm::BodyWeighting::wall_distance)};
  std::vector<Row> rows;
  for (const double fraction : {0.5, 0.58})
    for (const double diameter : {0.04, 0.08}) {
      for (const double cell_size : {0.02, 0.01})
        for (const auto weighting : weightings)
          rows.push_back(resolved_row({fraction, diameter, cell_size}, weighting));
      const Bed bed{fraction, diameter, 0.02};
      rows.push_back(averaged_row(bed, kPapers, BedDrag::gidaspow, ergun, "Ergun"));
      rows.push_back(averaged_row(bed, kPapers, BedDrag::di_felice, di_felice, "Di Felice"));
      if (2 * diameter <= kShort) rows.push_back(averaged_row(bed, kShort, BedDrag::gidaspow, ergun, "Ergun"));
      rows.push_back(law_row(bed));
    }
  return rows;
}

}  // namespace

Entry dilating_bed() {
  return {"averaged_grains.dilating_bed",
          {"Ergun 1952 and Di Felice 1994 (pressure drop along a bed that water flows into)"},
          run};
}

}  // namespace lahar::validate
