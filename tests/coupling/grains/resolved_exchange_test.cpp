#include "coupling/grains/resolved_exchange.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "coupling/coupled_step.h"
#include "coupling/grains/grain_coupling.h"
#include "lbm/free_surface/covered_cells.h"
#include "tests/coupling/tanks.h"

namespace lahar::coupling {
namespace {

/// A grain of 8 cells in a periodic stream, held.
struct HeldGrain {
  explicit HeldGrain(const lbm::FluidOptions& options, double density = 2000)
      : fluid(options), grains(ResolvedGrains{0}, options) {
    fluid.fill_everything([](const Vec3&) { return Vec3(0.02, 0, 0); }, [](const Vec3&) { return 0.0; });
    dem::ParticleSpec spec = grain(place, 4, density);
    spec.state = dem::ParticleState::fixed;
    particles.add(spec);
  }
  Vec3 step() {
    fields.open(fluid.grid());
    grains.update(fluid, particles, fields);
    fields.close(fluid.grid());
    fluid.step();
    particles.external_force.fill(Vec3::Zero()), particles.external_torque.fill(Vec3::Zero());
    return grains.add_forces(fluid, particles);
  }
  Vec3 place{12.3, 11.6, 12.1};
  lbm::Fluid<double> fluid;
  GrainCoupling<double> grains;
  SolidFields<double> fields;
  dem::Particles particles;
};

constexpr auto kWeightings = {lbm::BodyWeighting::solid_fraction, lbm::BodyWeighting::wall_distance,
                              lbm::BodyWeighting::inertial};

lbm::FluidOptions weighted(const lbm::FluidOptions& options, lbm::BodyWeighting weighting) {
  return by_wall_distance(weighting) ? by_distance(options, weighting) : by_fraction(options);
}

/// By distance the cells with their centre inside the sphere are covered, and B is as large as it gets there; by eps
/// none is.
TEST(ResolvedExchange, CoversTheCellsWithTheirCentreInside) {
  for (const bool by_wall : {true, false}) {
    const auto options = stream(24, 1, 1);
    HeldGrain held(by_wall ? by_distance(options) : options);
    held.step();
    const auto& grid = held.fluid.grid();
    const lbm::CoverageWeightLaw& law = held.fluid.coverage_weight_law();
    int covered = 0;
    for (const lbm::BlockIndex b : grid.owned())
      for (int n = 0; n < lbm::kBlockCells; ++n) {
        const bool inside = by_wall && (grid.centre(b, n) - held.place).norm() < 4;
        EXPECT_EQ(lbm::is_covered(grid.block(b), n), inside);
        if (!lbm::is_covered(grid.block(b), n)) continue;
        ++covered;
        EXPECT_EQ(grid.block(b).body->coverage_weight[n], law.largest);
      }
    EXPECT_EQ(covered > 200, by_wall);
  }
}

TEST(ResolvedExchange, ForcesAreWhatTheCellsGave) {
  for (const auto weighting : kWeightings) {
    HeldGrain held(weighted(stream(24, 1, 1), weighting));
    for (int s = 0; s < 5; ++s) {
      const Vec3 got = held.step(), gave = momentum_given_to_bodies(held.fluid.grid());
      EXPECT_GT(gave.norm(), 0.01);
      EXPECT_LT((got - gave).norm(), 1e-12 * gave.norm());
    }
    EXPECT_NE(held.particles.external_force.x[0], 0);
  }
}

/// visit(arm from the grain's centre, fields, place in the block) for the cells that it exchanges momentum with.
template <class Visit>
void for_cells_of(const HeldGrain& held, const Visit& visit) {
  const auto& grid = held.fluid.grid();
  for (const lbm::BlockIndex b : grid.owned()) {
    const lbm::BodyFields<double>* f = grid.block(b).body;
    for (int n = 0; f && n < lbm::kBlockCells; ++n)
      if (f->exchange_weight[n] > 0) visit(Vec3(grid.centre(b, n) - held.place), *f, n);
  }
}

/// The cells move with the grain's surface, v + w x r, and the grain gets the moment of what they give; while it spins
/// up, the inertia of the liquid in its place, or of what the cells bring along of it, is no load.
TEST(ResolvedExchange, SpinAndTorque) {
  for (const auto weighting : kWeightings) {
    HeldGrain held(weighted(stream(24, 1, 1), weighting), 1e9);
    const Vec3 velocity(0.02, 0.01, -0.01), spin(0.01, -0.02, 0.015), faster(2e-3, 1e-3, -3e-3);
    held.particles.velocity.set(0, velocity), held.particles.angular_velocity.set(0, spin);
    const auto torque_of_cells = [&](double& scale) {
      Vec3 torque = Vec3::Zero();
      for_cells_of(held, [&](const Vec3& arm, const lbm::BodyFields<double>& f, int n) {
        const Vec3 given(f.momentum_exchange_x[n], f.momentum_exchange_y[n], f.momentum_exchange_z[n]);
        torque += arm.cross(given), scale += arm.norm() * given.norm();
      });
      return torque;
    };
    const double to_si = held.fluid.units().torque_to_si(1.0);
    held.step();
    int cells = 0;
    for_cells_of(held, [&](const Vec3& arm, const lbm::BodyFields<double>& f, int n) {
      const Vec3 moves =
          Vec3(f.weighted_velocity_x[n], f.weighted_velocity_y[n], f.weighted_velocity_z[n]) / f.exchange_weight[n];
      EXPECT_LT((moves - velocity - spin.cross(arm)).norm(), 1e-12);
      ++cells;
    });
    EXPECT_GT(cells, 250);
    double scale = 0;
    const Vec3 first = torque_of_cells(scale);
    EXPECT_GT(first.norm(), 1e-3 * scale);
    EXPECT_LT((held.particles.external_torque[0] / to_si - first).norm(), 1e-12 * scale);
    held.particles.angular_velocity.add(0, faster);
    held.step();
    const Vec3 spared = held.particles.external_torque[0] / to_si - torque_of_cells(scale);
    double in_place = 0, brought_along = 0;  // about any axis 2/3 of the squared arms
    for_cells_of(held, [&](const Vec3& arm, const lbm::BodyFields<double>& f, int n) {
      in_place += 2.0 / 3 * arm.squaredNorm() * f.solid_fraction[n];
      brought_along += 2.0 / 3 * arm.squaredNorm() * f.coverage_weight[n];
    });
    const double inertia = 0.4 * 4.0 / 3 * std::numbers::pi * std::pow(4.0, 5);
    EXPECT_NEAR(in_place / inertia, 1, 0.1);
    EXPECT_LT((spared - std::min(in_place, brought_along) * faster).norm(), 1e-9 * inertia * faster.norm());
  }
}

/// The cells take all of a change of the grain's motion in one step, and that comes back, however long the step was in
/// which it changed. (By `inertial` the slip of the liquid in its place comes back, too.)
TEST(ResolvedExchange, InertiaComesBackWholeWhenTheStepChanges) {
  for (const auto weighting : kWeightings)
    for (const double time_step : {0.5, 1.2}) {  // after one of 1 s
      HeldGrain held(weighted(stream(24, 1, 1), weighting), 1e9);
      held.step();
      const Vec3 faster(2e-3, 1e-3, -3e-3), spun(-1e-3, 2e-3, 3e-3);
      held.particles.velocity.add(0, faster), held.particles.angular_velocity.add(0, spun);
      held.fluid.set_time_step(time_step);
      const Vec3 gave = held.step();
      const auto& units = held.fluid.units();
      ASSERT_EQ(units.time_step, time_step);
      Vec3 moment = Vec3::Zero();
      double in_place = 0, brought_along = 0, inertia_in_place = 0, inertia_brought_along = 0;
      for_cells_of(held, [&](const Vec3& arm, const lbm::BodyFields<double>& f, int n) {
        moment += arm.cross(Vec3(f.momentum_exchange_x[n], f.momentum_exchange_y[n], f.momentum_exchange_z[n]));
        const double about_any_axis = 2.0 / 3 * arm.squaredNorm();
        in_place += f.solid_fraction[n], inertia_in_place += about_any_axis * f.solid_fraction[n];
        brought_along += f.coverage_weight[n], inertia_brought_along += about_any_axis * f.coverage_weight[n];
      });
      const double mass = units.mass(), dt = units.time_step;
      const Vec3 change = mass * std::min(in_place, brought_along) * faster,
                 turn = mass * std::min(inertia_in_place, inertia_brought_along) * spun;
      const Vec3 impulse = dt * (held.particles.external_force[0] - units.force_to_si(1.0) * gave),
                 angular = dt * (held.particles.external_torque[0] - units.torque_to_si(1.0) * moment);
      if (weighting != lbm::BodyWeighting::inertial) {
        EXPECT_LT((impulse - change).norm(), 1e-9 * change.norm());
      }
      EXPECT_LT((angular - turn).norm(), 1e-9 * turn.norm());
    }
}

/// A sphere that turns slowly in liquid at rest: 8 pi mu R^3 w (Lamb 1932, art. 334), 2 % more among its images in
/// the periodic box.
TEST(ResolvedExchange, TorqueOnASphereThatTurnsSlowly) {
  constexpr double spin = 1e-3, viscosity = 1.0 / 6, radius = 4;
  lbm::FluidOptions options = by_distance(stream(24, 1, 1));
  options.kinematic_viscosity = viscosity, options.density = 1;
  HeldGrain held(options, 1e6);
  held.fluid.fill_everything([](const Vec3&) { return Vec3(Vec3::Zero()); }, [](const Vec3&) { return 0.0; });
  held.particles.angular_velocity.set(0, Vec3(0, spin, 0));
  for (int s = 0; s < 600; ++s) held.step();
  const Vec3 torque = held.particles.external_torque[0];
  EXPECT_NEAR(torque.y() / (-8 * std::numbers::pi * viscosity * std::pow(radius, 3) * spin), 1.02, 0.1);
  EXPECT_LT(std::hypot(torque.x(), torque.z()), 0.01 * std::abs(torque.y()));
}

/// Thick liquid at rest leaves its collisions with half a step of gravity, which drags at no body (0110): a neutral
/// sphere stays where it is.
TEST(ResolvedExchange, NeutralGrainStaysInThickLiquidAtRest) {
  for (const auto weighting : {lbm::BodyWeighting::wall_distance, lbm::BodyWeighting::inertial}) {
    lbm::FluidOptions fluid = by_distance(tank(Vec3(0.32, 0.32, 0.4), 0.02, 1e-3), weighting);
    fluid.kinematic_viscosity = 3e-3;
    dem::Particles particles;
    particles.add(grain(Vec3(0.157, 0.163, 0.15), 0.06, fluid.density));
    dem::SolidsOptions options;
    options.gravity = fluid.gravity;
    options.time_step = 1;
    CouplingOptions coupling;
    coupling.substeps = 10;
    CoupledStep<double> step(fluid, dem::Solids(particles, {}, rock(), {}, options), coupling);
    step.fill({{Vec3::Zero(), Vec3(0.32, 0.32, 0.36)}});
    for (int n = 0; n < 800; ++n) step.advance();
    EXPECT_NEAR(step.solids()->particles().velocity[0].z(), 0, 0.1 * 0.5 * 9.81 * fluid.time_step);
  }
}

/// Four layers of held grains that fill 0.45 of thick liquid at rest are lifted by the weight of the liquid in their
/// place, and the bed bears its pressure.
TEST(ResolvedExchange, PacksInThickLiquidAtRestAreLiftedByItsWeight) {
  for (const auto weighting : {lbm::BodyWeighting::wall_distance, lbm::BodyWeighting::inertial}) {
    constexpr double dx = 0.02, width = 16 * dx, depth = 20 * dx, radius = 1.9 * dx, pitch = width / 4;
    lbm::FluidOptions fluid = by_distance(tank(Vec3(width, width, 24 * dx), dx, 1e-3), weighting);
    fluid.kinematic_viscosity = 1e-2;
    fluid.smagorinsky = 0;
    dem::Particles particles;
    double weight = 0;  // of the liquid in the grains' place
    for (int layer = 0; layer < 4; ++layer) {
      const int across = layer % 2 == 0 ? 4 : 3;
      const double start = layer % 2 == 0 ? 0.5 : 1;
      for (int x = 0; x < across; ++x)
        for (int y = 0; y < across; ++y) {
          dem::ParticleSpec one =
              grain(Vec3((x + start) * pitch, (y + start) * pitch, (1 + 1.5 * layer) * radius), radius, 2500);
          one.state = dem::ParticleState::fixed;
          particles.add(one);
          weight += fluid.density * 4.0 / 3 * std::numbers::pi * std::pow(radius, 3) * 9.81;
        }
    }
    dem::SolidsOptions options;
    options.time_step = 1;
    CoupledStep<double> step(fluid, dem::Solids(particles, {}, rock(), {}, options), {});
    step.fill({{Vec3::Zero(), Vec3(width, width, depth)}});
    double lift = 0, pressure = 0;
    int steps = 0, cells = 0;
    for (int n = 0; n < 600; ++n) {
      step.advance();
      if (n < 300) continue;
      ++steps;
      const dem::Particles& p = step.solids()->particles();
      for (dem::ParticleIndex i = 0; i < p.size(); ++i) lift += p.external_force[i].z();
    }
    step.fluid()->for_each_wet_cell([&](const lbm::WetCell& c) {
      if (c.centre.z() < dx && c.solid_fraction < 0.01) pressure += c.pressure, ++cells;
    });
    EXPECT_NEAR(lift / steps / weight, 1, 0.05);
    EXPECT_NEAR(pressure / cells / (fluid.density * 9.81 * (depth - dx / 2)), 1, 0.05);
  }
}

}  // namespace
}  // namespace lahar::coupling
