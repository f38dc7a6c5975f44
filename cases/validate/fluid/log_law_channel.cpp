// Turbulent flow of water between two rough beds 2 h apart, far too coarse to resolve them: the wall model gives their
// stress, Smagorinsky the rest. In the mean each bed carries the push, u_tau^2 = g h, and with the
// logarithmic law over the whole depth (Keulegan 1938) the bulk velocity is U = u_tau / kappa [ln(h/z0) - 1], z0 =
// k_s/30.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "cases/validate/entry.h"
#include "lbm/boundary/wall_model.h"
#include "lbm/step/fluid.h"

namespace lahar::validate {
namespace {

constexpr double kKarman = 0.41;

struct Mean {
  double bulk = 0, stress = 0;
  double gained = 0;  ///< momentum that the water gained meanwhile, per area of bed and time
};

/// Lilly 1967: what an inertial range asks of Smagorinsky's model.
constexpr double kLilly = 0.17;

/// u_tau / kappa [ln(h/z0) - 1]
double bulk_by_law(int depth, double friction, double roughness) {
  return friction / kKarman * (std::log(30 * depth / roughness) - 1);
}

/// Lattice units; starts with the given share of the law's bulk velocity; mean over the second half of the run.
Mean run_channel(int depth, double friction, double roughness, double share, double turnovers) {
  const double viscosity = 1e-5 / 3;  // tau - 1/2 = 1e-5
  lbm::FluidOptions o;
  o.domain.upper = Vec3(4 * depth, 2 * depth, 2 * depth);
  o.domain.cell_size = o.time_step = o.density = 1;
  o.domain.faces.fill(lbm::FaceKind::periodic);
  o.domain.faces[4] = o.domain.faces[5] = lbm::FaceKind::closed;
  Wall bed{"bed", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}, WallSlip::wall_model};
  bed.roughness = roughness;
  o.domain.walls.add(bed);
  bed.shape = HalfSpace{Vec3(0, 0, 2 * depth), -Vec3::UnitZ()};
  o.domain.walls.add(bed);
  o.kinematic_viscosity = viscosity;
  o.smagorinsky = kLilly;
  o.gravity = Vec3(friction * friction / depth, 0, 0);
  lbm::Fluid<float> fluid(o);
  fluid.measure_walls();
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const double start = share * bulk_by_law(depth, friction, roughness);
  // Rolls along the stream as deep as the channel, and noise: noise alone decays before turbulence is there.
  fluid.fill_everything(
      [&](const Vec3& p) {
        const double profile = start + friction / kKarman * (std::log(std::min(p.z(), 2 * depth - p.z()) / depth) + 1);
        const double k = std::numbers::pi / depth, y = k * p.y() + 0.3 * std::sin(k * p.x()), z = k * p.z();
        const Vec3 roll = 2 * friction * Vec3(0, std::sin(y) * std::cos(z), -std::cos(y) * std::sin(z));
        return Vec3(Vec3(profile, 0, 0) + roll + 2 * friction * Vec3(normal(random), normal(random), normal(random)));
      },
      [](const Vec3&) { return 0.0; });
  const auto steps = static_cast<int>(turnovers * depth / friction);
  const auto impulse = [&] {
    double sum = 0;
    for (const lbm::WallLoad& load : fluid.wall_loads()) sum += load.impulse.x();
    return sum;
  };
  const auto bulk_velocity = [&] {
    double sum = 0, cells = 0;
    fluid.for_each_wet_cell([&](const lbm::WetCell& c) { sum += c.velocity.x(), cells += 1; });
    return sum / cells;
  };
  Mean mean;
  int samples = 0;
  double impulse_before = 0, velocity_before = 0;
  for (int s = 1; s <= steps; ++s) {
    fluid.step();
    if (s == steps / 2) impulse_before = impulse(), velocity_before = bulk_velocity();
    if (s < steps / 2 || s % 50 != 0) continue;
    mean.bulk += bulk_velocity(), ++samples;
  }
  const double area = 2 * 4.0 * depth * 2 * depth, time = steps - steps / 2;
  return {mean.bulk / samples, (impulse() - impulse_before) / (area * time),
          depth * (bulk_velocity() - velocity_before) / time};
}

std::vector<Row> run(const Context& context) {
  const int depth = context.quick ? 8 : 16;
  const double friction = 0.006, roughness = 0.5;
  const double expected = bulk_by_law(depth, friction, roughness);
  // What it starts with decays within U / (2 u_tau) = 7 turnovers: only a long run may start elsewhere.
  const Mean model = context.quick ? run_channel(depth, friction, roughness, 1, 10)
                                   : run_channel(depth, friction, roughness, 0.85, 36);
  const std::string cells = std::to_string(depth) + " cells deep: ";
  return {relative_row(cells + "bulk velocity / u_tau, wall model", model.bulk / friction, expected / friction,
                       context.quick ? 0.12 : 0.05),
          note_row(cells + "the law for half the roughness", bulk_by_law(depth, friction, roughness / 2) / friction),
          note_row(cells + "the law for twice the roughness", bulk_by_law(depth, friction, 2 * roughness) / friction),
          relative_row(cells + "stress at the bed / (g h)", model.stress / (friction * friction), 1, 0.1),
          relative_row(cells + "stress and momentum gained / (g h)",
                       (model.stress + model.gained) / (friction * friction), 1, 1e-3)};
}

}  // namespace

Entry log_law_channel() { return {"fluid.log_law_channel", {"logarithmic law, Keulegan 1938"}, run}; }

}  // namespace lahar::validate
