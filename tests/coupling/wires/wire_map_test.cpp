#include "coupling/wires/wire_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "coupling/grains/grain_coupling.h"
#include "tests/coupling/chains.h"

namespace lahar::coupling {
namespace {

/// Distance of a point from the segment a-b.
double segment_distance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  return (p - a - std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0) * along).norm();
}

/// Fluid everywhere in a periodic box with cells of 1 m and steps of 1 s.
template <class Real>
void fill_all(lbm::Fluid<Real>& fluid) {
  const double period = fluid.options().domain.upper.y();
  fluid.fill_everything(
      [&](const Vec3& p) {
        return Vec3(0.02 * std::sin(2 * std::numbers::pi * p.y() / period), 0.01, 0.01 * std::cos(0.5 * p.x()));
      },
      [](const Vec3&) { return 0.0; });
}

/// Calls visit(centre, fields, cell) for all cells of blocks with body fields.
template <class Real, class Visit>
void for_body_cells(lbm::Fluid<Real>& fluid, const Visit& visit) {
  auto& grid = fluid.grid();
  for (const lbm::BlockIndex b : grid.owned())
    if (grid.block(b).body)
      for (int n = 0; n < lbm::kBlockCells; ++n) visit(grid.centre(b, n), *grid.block(b).body, n);
}

template <class Real>
double mapped_volume(lbm::Fluid<Real>& fluid) {
  double sum = 0;
  for_body_cells(fluid, [&](const Vec3&, const lbm::BodyFields<Real>& f, int n) {
    sum += static_cast<double>(f.solid_fraction[n]);
  });
  return sum;
}

double length_of(const Chains& c) {
  double sum = 0;
  for (std::size_t k = 0; k < c.bonds.size(); ++k)
    sum += (c.particles.position[c.bonds.i[k]] - c.particles.position[c.bonds.j[k]]).norm();
  return sum;
}

Vec3 any_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vec3(normal(random), normal(random), normal(random)).normalized();
}

/// Rings, bent lines and straight ones, 4 cells thick, anywhere: the mapped volume is pi r^2 times their length.
TEST(WireMap, VolumeIsRight) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  lbm::Fluid<double> fluid(stream(48, 1, 1));
  fill_all(fluid);
  SolidFields<double> fields;
  const double d = 4;
  for (const int beads : {0, 12, 24}) {  // a straight line, a coarse and a fine ring
    double mean = 0, square = 0;
    const int samples = 25;
    for (int k = 0; k < samples; ++k) {
      const Vec3 centre = Vec3::Constant(24) + Vec3(uniform(random), uniform(random), uniform(random));
      const Vec3 axis = any_direction(random);
      Chains c;
      if (beads == 0)
        c.add(straight_line(centre - 16 * axis, centre + 16 * axis, 9), d, false);
      else
        c.add(circle(centre, axis, 26, beads), d, true);
      WireMap<double> map(c.particles, c.bonds, {2, 0}, 1);
      fields.open(fluid.grid());
      map.update(fluid, c.particles, c.bonds, fields);
      const double error = mapped_volume(fluid) / (std::numbers::pi * d * d / 4 * length_of(c)) - 1;
      mean += error / samples, square += error * error / samples;
      EXPECT_NEAR(map.wet_volume() / mapped_volume(fluid), 1, 1e-12);
    }
    EXPECT_LT(std::abs(mean), 0.003) << beads;
    EXPECT_LT(std::sqrt(square), 0.01) << beads;
  }
}

/// No cell is covered twice along a chain, and none in the middle of it is missed.
TEST(WireMap, PiecesFitTogether) {
  std::mt19937 random(5);
  lbm::Fluid<double> fluid(by_distance(stream(48, 1, 1)));
  fill_all(fluid);
  SolidFields<double> fields;
  for (int k = 0; k < 8; ++k) {
    const Vec3 axis = any_direction(random), centre(24.3, 23.8, 24.1);
    Chains c;
    c.add(circle(centre, axis, 28, 14), 5, true);
    WireMap<double> map(c.particles, c.bonds, {2}, 1);
    fields.open(fluid.grid());
    map.update(fluid, c.particles, c.bonds, fields);
    double least = 1, most = 0;
    int inside = 0;
    for_body_cells(fluid, [&](const Vec3& p, const lbm::BodyFields<double>& f, int n) {
      most = std::max(most, f.solid_fraction[n]);
      double distance = 1e9;
      for (std::size_t b = 0; b < c.bonds.size(); ++b)
        distance = std::min(
            distance, segment_distance(p, c.particles.position[c.bonds.i[b]], c.particles.position[c.bonds.j[b]]));
      if (distance > 1.8) return;
      ++inside;
      least = std::min({least, f.solid_fraction[n], f.drag[n] / kInteriorDrag});
    });
    EXPECT_GT(inside, 800);
    EXPECT_DOUBLE_EQ(most, 1);
    EXPECT_DOUBLE_EQ(least, 1);
  }
}

/// The velocity that is mapped and the loads that come back are adjoint: force, moment and power of the exchange are
/// those on the beads, whatever the beads do.
TEST(WireMap, LoadsAreAdjointToTheVelocity) {
  for (const bool distance : {true, false}) {
    std::mt19937 random(3);
    const auto options = stream(32, 1, 1);
    lbm::Fluid<double> fluid(distance ? by_distance(options) : options);
    fill_all(fluid);
    SolidFields<double> fields;
    Chains c;
    c.add(circle(Vec3(16.2, 15.7, 16.4), Vec3(0.3, 0.5, 0.8).normalized(), 18, 9), 4, true, dem::ParticleState::free,
          1e9);
    c.add(straight_line(Vec3(6, 7, 5), Vec3(22, 9, 6), 4), 3, false, dem::ParticleState::free, 1e9);
    for (std::size_t i = 0; i < c.particles.size(); ++i) {
      c.particles.velocity.set(i, 0.02 * any_direction(random));
      c.particles.angular_velocity.set(i, 0.01 * any_direction(random));
    }
    WireMap<double> map(c.particles, c.bonds, {2}, 1);
    fields.open(fluid.grid());
    map.update(fluid, c.particles, c.bonds, fields);
    fluid.step();
    const Vec3 total = map.add_forces(fluid, c.particles);
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero(), on_beads = Vec3::Zero(), moment_on_beads = Vec3::Zero();
    double power = 0, power_of_beads = 0, scale = 0;
    for_body_cells(fluid, [&](const Vec3& p, const lbm::BodyFields<double>& f, int n) {
      if (f.exchange_weight[n] == 0) return;
      const Vec3 part(f.momentum_exchange_x[n], f.momentum_exchange_y[n], f.momentum_exchange_z[n]);
      const Vec3 velocity =
          Vec3(f.weighted_velocity_x[n], f.weighted_velocity_y[n], f.weighted_velocity_z[n]) / f.exchange_weight[n];
      force += part, moment += p.cross(part), power += part.dot(velocity), scale += part.norm();
    });
    const double to_si = fluid.units().force_to_si(1.0);
    for (std::size_t i = 0; i < c.particles.size(); ++i) {
      const Vec3 f = c.particles.external_force[i] / to_si, t = c.particles.external_torque[i] / to_si;
      on_beads += f, moment_on_beads += c.particles.position[i].cross(f) + t;
      power_of_beads += f.dot(c.particles.velocity[i]) + t.dot(c.particles.angular_velocity[i]);
    }
    ASSERT_GT(scale, 1e-3);
    EXPECT_LT((total - force).norm(), 1e-12 * scale);
    EXPECT_LT((on_beads - force).norm(), 1e-12 * scale);
    EXPECT_LT((moment_on_beads - moment).norm(), 1e-12 * 32 * scale);
    EXPECT_LT(std::abs(power_of_beads - power), 1e-12 * 0.1 * scale);
  }
}

/// The cells take all of a change of the beads' motion in one step, and that comes back, however long the step was in
/// which it changed.
TEST(WireMap, InertiaComesBackWholeWhenTheStepChanges) {
  for (const bool distance : {true, false})
    for (const double time_step : {0.5, 1.2}) {  // after one of 1 s
      const auto options = stream(32, 1, 1);
      lbm::Fluid<double> fluid(distance ? by_distance(options) : options);
      fill_all(fluid);
      SolidFields<double> fields;
      const Vec3 centre(16.2, 15.7, 16.4), faster(2e-3, 1e-3, -3e-3), spun(-1e-4, 2e-4, 3e-4);
      Chains c;
      c.add(circle(centre, Vec3(0.3, 0.5, 0.8).normalized(), 18, 9), 4, true, dem::ParticleState::free, 1e9);
      WireMap<double> map(c.particles, c.bonds, {2}, 1);
      const auto step = [&] {
        c.particles.external_force.fill(Vec3::Zero()), c.particles.external_torque.fill(Vec3::Zero());
        fields.open(fluid.grid());
        map.update(fluid, c.particles, c.bonds, fields);
        fields.close(fluid.grid());
        fluid.step();
        map.add_forces(fluid, c.particles);
      };
      step();
      for (std::size_t i = 0; i < c.particles.size(); ++i) {  // as one rigid body
        c.particles.velocity.add(i, faster + spun.cross(c.particles.position[i] - centre));
        c.particles.angular_velocity.add(i, spun);
      }
      fluid.set_time_step(time_step);
      step();
      const auto& units = fluid.units();
      ASSERT_EQ(units.time_step, time_step);
      Vec3 impulse = Vec3::Zero(), moment = Vec3::Zero();
      double scale = 0;
      for_body_cells(fluid, [&](const Vec3& p, const lbm::BodyFields<double>& f, int n) {
        if (f.exchange_weight[n] == 0) return;
        const double spared = distance ? std::min(f.solid_fraction[n], f.coverage_weight[n]) : f.coverage_weight[n];
        const Vec3 change = units.mass() * spared * (faster + spun.cross(p - centre));
        const Vec3 given(f.momentum_exchange_x[n], f.momentum_exchange_y[n], f.momentum_exchange_z[n]);
        const Vec3 all = change + units.mass() * units.velocity_to_si(1.0) * given;
        impulse += all, moment += (p - centre).cross(all), scale += change.norm();
      });
      Vec3 got = Vec3::Zero(), turn = Vec3::Zero();
      for (std::size_t i = 0; i < c.particles.size(); ++i) {
        const Vec3 force = c.particles.external_force[i], torque = c.particles.external_torque[i];
        got += units.time_step * force;
        turn += units.time_step * ((c.particles.position[i] - centre).cross(force) + torque);
      }
      ASSERT_GT(scale, 0);
      EXPECT_LT((got - impulse).norm(), 1e-9 * scale);
      EXPECT_LT((turn - moment).norm(), 1e-9 * 9 * scale);
    }
}

/// A block is written again where a piece in it moves, and what stands there is what a fresh mapping would write;
/// grains share blocks with wires.
TEST(WireMap, WritesOnlyWhatMoved) {
  lbm::Fluid<float> fluid(by_distance(stream(48, 1, 1)));
  fill_all(fluid);
  Chains c;
  c.add(straight_line(Vec3(10.3, 4, 10), Vec3(10.3, 44, 10), 11), 4, false);
  c.add(straight_line(Vec3(36.3, 4, 36), Vec3(36.3, 44, 36), 11), 4, false);
  c.particles.add(grain(Vec3(14, 12, 12), 3, 2500));
  WireMap<float> map(c.particles, c.bonds, {2}, 1);
  GrainCoupling<float> grains(ResolvedGrains{}, fluid.options());
  SolidFields<float> fields;
  const auto update = [&](auto& wires, auto& bodies) {
    fields.open(fluid.grid());
    bodies.update(fluid, c.particles, fields);
    wires.update(fluid, c.particles, c.bonds, fields);
    fields.close(fluid.grid());
  };
  const auto written = [&] {
    std::vector<float> all;
    for_body_cells(fluid, [&](const Vec3&, const lbm::BodyFields<float>& f, int n) {
      all.insert(all.end(), {f.solid_fraction[n], f.exchange_weight[n], f.drag[n], f.weighted_velocity_x[n],
                             f.weighted_velocity_z[n]});
    });
    return all;
  };
  update(map, grains);
  const std::size_t all = map.written_blocks();
  update(map, grains);
  const std::size_t with_grain = map.written_blocks();
  EXPECT_GT(with_grain, 0U);  // grains and wires together: always
  EXPECT_LT(with_grain, 9U);
  c.particles.position.add(15, Vec3(0.2, 0, 0.1));
  c.particles.velocity.set(18, Vec3(0.01, 0, 0));
  update(map, grains);
  EXPECT_GT(map.written_blocks(), with_grain);
  EXPECT_LT(map.written_blocks(), all / 2 + with_grain);
  const std::vector<float> kept = written();
  WireMap<float> fresh(c.particles, c.bonds, {2}, 1);
  GrainCoupling<float> fresh_grains(ResolvedGrains{}, fluid.options());
  fields = {};
  update(fresh, fresh_grains);
  EXPECT_EQ(kept, written());
}

/// What drags of their own steps gave the beads no cell did: it is taken back from them, all of it in time, from those
/// of a broken wire too. Beads that are held, dry or dragged by another law have none.
TEST(WireMap, WhatDragsGaveIsTakenBack) {
  lbm::Fluid<double> fluid(by_distance(stream(48, 1, 1)));
  fluid.fill_everything([](const Vec3&) { return Vec3(Vec3::Zero()); }, [](const Vec3&) { return 0.0; });
  Chains c;
  c.add(straight_line(Vec3(10.3, 4, 10), Vec3(10.3, 44, 10), 11), 4, false, dem::ParticleState::free);
  c.particles.state[0] = dem::ParticleState::fixed, c.particles.inverse_mass[0] = 0;
  WireMap<double> map(c.particles, c.bonds, {2}, 1);
  SolidFields<double> fields;
  const auto step = [&] {
    c.particles.external_force.fill(Vec3::Zero()), c.particles.external_torque.fill(Vec3::Zero());
    map.follow_breakage(c.particles, c.bonds);
    fields.open(fluid.grid());
    map.update(fluid, c.particles, c.bonds, fields);
    fields.close(fluid.grid());
    fluid.step();
    map.add_forces(fluid, c.particles);
    std::vector<dem::LiquidDrag> drags;
    map.add_drags(
        fluid.units().time_step, c.particles, [](dem::ParticleId id) { return id == 5; }, drags);
    return drags;
  };
  auto drags = step();
  ASSERT_EQ(drags.size(), 9U);
  const Vec3 impulse(0.5, -1, 2), spin(0.1, 0.2, -0.3);
  for (dem::LiquidDrag& drag : drags) {
    EXPECT_GT(drag.coefficient.across, 0);
    EXPECT_EQ(drag.coefficient.along, drag.coefficient.across);
    EXPECT_GT(drag.spin_coefficient, 0);
    drag.impulse = impulse, drag.angular_impulse = spin;
  }
  map.collect(drags);
  c.bonds.intact[2] = c.bonds.intact[3] = 0;
  Vec3 back = Vec3::Zero(), back_of_stump = Vec3::Zero(), spin_back = Vec3::Zero();
  for (int s = 0; s < 240; ++s) {
    map.collect(step());
    back += fluid.units().time_step * c.particles.external_force[8];
    back_of_stump += fluid.units().time_step * c.particles.external_force[3];
    spin_back += fluid.units().time_step * c.particles.external_torque[8];
  }
  EXPECT_LT((back + impulse).norm(), 1e-9);
  EXPECT_LT((back_of_stump + impulse).norm(), 1e-9);
  EXPECT_LT((spin_back + spin).norm(), 1e-9);
}

/// A bar lowered lengthwise and askew through the surface raises the level by its volume, is carried by the weight of
/// the water that it displaces, and no water is lost, also when it is taken out by a break.
TEST(WireMap, LoweredBarRaisesTheLevel) {
  auto options = by_distance(tank(Vec3(0.48, 0.48, 0.6), 0.02, 4e-4));
  lbm::Fluid<double> fluid(options);
  fluid.fill({{Vec3::Zero(), Vec3(0.48, 0.48, 0.3)}});
  Chains c;
  c.add(straight_line(Vec3(0.141, 0.237, 0.4), Vec3(0.341, 0.247, 0.46), 4), 0.08, false);
  WireMap<double> map(c.particles, c.bonds, {2}, 0.02);
  SolidFields<double> fields;
  const double volume = std::numbers::pi * 0.04 * 0.04 * length_of(c), speed = 0.4, dt = fluid.units().time_step;
  const auto fill = [&] {
    double sum = 0;
    fluid.for_each_wet_cell([&](const lbm::WetCell& cell) { sum += cell.fill_level; });
    return sum * 8e-6;
  };
  const auto step = [&](const Vec3& velocity) {
    for (std::size_t i = 0; i < c.particles.size(); ++i) {
      c.particles.velocity.set(i, velocity);
      c.particles.position.add(i, velocity * dt);
    }
    c.particles.external_force.fill(Vec3::Zero()), c.particles.external_torque.fill(Vec3::Zero());
    fields.open(fluid.grid());
    map.update(fluid, c.particles, c.bonds, fields);
    fields.close(fluid.grid());
    fluid.step();
    map.add_forces(fluid, c.particles);
  };
  const double start = fill();
  while (c.particles.position.z[3] > 0.2) step(Vec3(0, 0, -speed));
  double lift = 0, rise = 0;
  for (int s = 0; s < 900; ++s) {
    step(Vec3::Zero());
    if (s < 400) continue;
    for (std::size_t i = 0; i < c.particles.size(); ++i) lift += c.particles.external_force.z[i] / 500;
    rise += (fill() - start) / 500;
  }
  EXPECT_NEAR(map.wet_volume() * 8e-6 / volume, 1, 0.02);
  EXPECT_NEAR(rise / volume, 1, 0.05);
  EXPECT_NEAR(lift / (9810 * volume), 1, 0.05);
  EXPECT_NEAR(fluid.mass_drift(), 0, 1e-12);
  std::fill(c.bonds.intact.begin(), c.bonds.intact.end(), 0);
  EXPECT_TRUE(map.follow_breakage(c.particles, c.bonds));
  for (int s = 0; s < 100; ++s) step(Vec3::Zero());
  EXPECT_EQ(map.wet_volume(), 0);
  EXPECT_EQ(c.particles.external_force[1], Vec3::Zero());
  EXPECT_NEAR(fluid.mass_drift(), 0, 1e-12);
}

}  // namespace
}  // namespace lahar::coupling
