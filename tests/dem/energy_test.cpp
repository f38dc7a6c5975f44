// The energy ledger closes: what is stored, lost and gained adds up.
#include "dem/energy.h"

#include <gtest/gtest.h>

#include <utility>

#include "core/worst.h"
#include "tests/dem/small_scenes.h"

namespace lahar::dem {
namespace {

using testing::one_material;
using testing::options;
using testing::sphere;

constexpr double kG = 9.81;

/// Largest departure of the ledger's total from its first value, as a fraction of `scale` J. In the middle of an impact
/// it is of order dt, as a loss is booked for a whole kick when half of it is done; that does not pile up.
double worst_closure(Solids& solids, int steps, double scale) {
  solids.step();
  const double first = solids.ledger().total();
  double worst = 0;
  for (int n = 0; n < steps; ++n) {
    solids.step();
    keep_worst(worst, std::abs(solids.ledger().total() - first));
  }
  return worst / scale;
}

Solids bouncing(double dt) {
  Particles p;
  ParticleSpec s = sphere({0, 0, 0.05}, 0.02, 2650, {1, 0, 0});
  s.angular_velocity = {0, -30, 10};
  p.add(s);
  return {p, {}, one_material(1e8, 0.25, 0.4, 0.7), testing::ground(), options(dt, {0, 0, -kG})};
}

TEST(EnergyLedger, bouncing_spinning_sphere_closes_and_better_with_smaller_steps) {
  Solids coarse = bouncing(1e-5), fine = bouncing(2.5e-6);
  const double scale = 0.5 * coarse.particles().mass[0];
  const double start = coarse.ledger().stored();
  EXPECT_LT(worst_closure(coarse, 50000, scale), 4e-3);
  EXPECT_LT(worst_closure(fine, 200000, scale), 1e-3);
  EXPECT_GT(coarse.ledger().contact_damping, 0.05 * scale);
  EXPECT_GT(coarse.ledger().friction, 0.05 * scale);
  EXPECT_NEAR(coarse.ledger().total(), start, 1e-4 * scale);
  EXPECT_NEAR(fine.ledger().total(), start, 1e-5 * scale);
}

TEST(EnergyLedger, sliding_sphere_turns_two_sevenths_of_its_energy_into_friction) {
  Particles p;
  p.add(sphere({0, 0, 0.02}, 0.02, 2650, {1, 0, 0}));
  Solids solids(p, {}, one_material(1e8, 0.25, 0.3, 0.5), testing::ground(), options(1e-5, {0, 0, -kG}));
  const double start = 0.5 * p.mass[0];
  EXPECT_LT(worst_closure(solids, 30000, start), 1e-4);
  EXPECT_NEAR(solids.ledger().friction / start, 2.0 / 7, 1e-3);
}

TEST(EnergyLedger, dry_cloud_in_a_box_closes) {
  Solids solids(testing::loose_grains(4, 4, 4, 0.02, 0.04, 2), {}, one_material(1e7, 0.25, 0.5, 0.5),
                testing::open_box({0.33, 0.33, 1}), options(2e-5, {0, 0, -kG}));
  const double scale = solids.ledger().stored();
  EXPECT_LT(worst_closure(solids, 20000, scale), 2e-3);
  EXPECT_GT(solids.ledger().dissipated(), 0.1 * scale);
}

TEST(EnergyLedger, dissipated_energy_never_falls) {
  Solids solids(testing::loose_grains(3, 3, 4, 0.02, 0.04, 6), {}, one_material(1e7, 0.25, 0.5, 0.3),
                testing::open_box({0.25, 0.25, 1}), options(2e-5, {0, 0, -kG}));
  double before = 0;
  for (int n = 0; n < 10000; ++n) {
    solids.step();
    EXPECT_GE(solids.ledger().dissipated(), before);
    before = solids.ledger().dissipated();
  }
  EXPECT_GT(before, 0);
}

TEST(EnergyLedger, belt_brings_in_the_energy_that_the_grain_gains_and_loses) {
  Walls walls;
  walls.add({"belt", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}, WallSlip::no_slip, 0, Vec3(0.5, 0, 0)});
  Particles p;
  p.add(sphere({0, 0, 0.02}, 0.02, 2650));
  Solids solids(p, {}, one_material(1e8, 0.25, 0.3, 0.5), walls, options(1e-5, {0, 0, -kG}));
  const double scale = 0.5 * p.mass[0] * 0.25;
  EXPECT_LT(worst_closure(solids, 20000, scale), 1e-3);
  EXPECT_GT(solids.ledger().external_work, 0.1 * scale);
}

TEST(EnergyLedger, terms_add_up_to_the_total) {
  Solids solids = bouncing(1e-5);
  solids.advance(20000);
  double sum = 0;
  for (const auto& [name, value] : solids.ledger().terms()) sum += value;
  EXPECT_NEAR(sum, solids.ledger().total(), 1e-14);
  EXPECT_GT(solids.ledger().total(), 1e-3);
}

TEST(EnergyLedger, grain_taken_out_of_a_pile_leaves_no_gap) {
  Particles p;
  p.add(sphere({0, 0, 0.0199}, 0.02, 2650));
  p.add(sphere({0, 0, 0.0597}, 0.02, 2650));  // presses on the lower one, which presses on the ground
  for (const ParticleIndex leaves : {0, 1}) {
    Solids solids(p, {}, one_material(1e8, 0.25, 0.4, 1), testing::ground(), options(1e-5, {0, 0, -kG}));
    solids.step();
    const double before = solids.ledger().total(), springs = solids.ledger().elastic_normal;
    solids.remove(leaves);
    EXPECT_NEAR(solids.ledger().total(), before, 1e-9 * springs);
    solids.step();
    EXPECT_NEAR(solids.ledger().total(), before, 0.02 * springs);
    EXPECT_LT(solids.ledger().elastic_normal, 0.9 * springs);
  }
}

/// Lists that are built anew before the next step know a removed particle no longer; what its contacts' springs held is
/// lost as if they had come apart. On a ball as large as the grain that rolls on it R* is half of that on a plane, and
/// a rolling spring holds a quarter.
TEST(EnergyLedger, springs_of_a_grain_taken_out_are_lost_where_lists_are_built_at_once) {
  const Shape plane = HalfSpace{Vec3::Zero(), Vec3::UnitZ()}, ball = SolidSphere{{0, 0, -0.02}, 0.02};
  for (const auto& [shape, rolling_friction] :
       {std::pair{plane, 0.0}, std::pair{plane, 0.3}, std::pair{ball, 0.0}, std::pair{ball, 0.3}}) {
    Walls walls;
    walls.add({"below", shape});
    Particles p;
    ParticleSpec lower = sphere({0, 0, 0.01995}, 0.02, 2650, {0.02, 0, 0});
    lower.angular_velocity = {0, -2, 0};
    p.add(lower);
    ParticleSpec upper = sphere({0, 0, 0.0598}, 0.02, 2650, {-0.02, 0, 0});
    upper.angular_velocity = {0, 2, 0};
    p.add(upper);
    Materials materials = one_material(1e8, 0.25, 0.9, 1);
    if (rolling_friction > 0) materials.set_pair(0, 0, 0.9, 1, rolling_friction);
    Solids solids(p, {}, materials, walls, options(1e-6, {0, 0, -kG}));
    solids.advance(300);
    const EnergyLedger before = solids.ledger();
    const double springs = before.elastic_tangential + before.elastic_rolling;
    ASSERT_GT(before.elastic_tangential, 1e-6);
    ASSERT_TRUE(rolling_friction == 0 || before.elastic_rolling > 0.1 * springs);
    solids.remove(0);
    ParticleSpec far_away = sphere({5, 0, 0}, 0.02, 2650);
    far_away.state = ParticleState::fixed;
    solids.particles().add(far_away);  // lists are built anew
    const double with_it = solids.ledger().total();
    solids.step();
    const EnergyLedger after = solids.ledger();
    EXPECT_NEAR(after.total(), with_it, 0.02 * springs);
    EXPECT_EQ(after.elastic_tangential, 0);
    EXPECT_EQ(after.elastic_rolling, 0);
    EXPECT_NEAR(after.friction - before.friction, before.elastic_tangential, 0.02 * springs);
    EXPECT_NEAR(after.rolling - before.rolling, before.elastic_rolling, 0.02 * springs);
  }
}

/// What springs of rolling held at a wall that opens is lost at once, and held no longer: a row that is written before
/// the next step counts it once. Without dampers nothing else changes, but for rounding.
TEST(EnergyLedger, rolling_springs_at_a_wall_that_opens_count_once) {
  Wall gate{"gate", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}};
  gate.opens_at = 1;
  Walls walls;
  walls.add(gate);
  Particles p;
  ParticleSpec s = sphere({0, 0, 0.01995}, 0.02, 2650);
  s.angular_velocity = {0, 2, 0};
  p.add(s);
  Materials materials = one_material(1e8, 0.25, 0.9, 1);
  materials.set_pair(0, 0, 0.9, 1, 0.4);
  Solids solids(p, {}, materials, walls, options(1e-6, {0, 0, -kG}));
  solids.advance(300);
  const EnergyLedger before = solids.ledger();
  ASSERT_GT(before.elastic_rolling, 1e-6);
  ASSERT_TRUE(solids.open_walls_by(gate.opens_at));
  const EnergyLedger after = solids.ledger();
  const double rounding = 1e-9 * before.elastic_rolling;
  EXPECT_NEAR(after.elastic_rolling, 0, rounding);
  EXPECT_NEAR(after.rolling - before.rolling, before.elastic_rolling, rounding);
  EXPECT_NEAR(after.total(), before.total(), rounding);
}

/// Two bonded beads with opposite velocities, free to fly apart, to meet or to slide past each other.
Solids breaking_pair(const Vec3& velocity, double tensile_strength, double shear_strength, double dt) {
  Particles p;
  p.add(sphere({0, 0, 0}, 0.003, 7800, -velocity));
  p.add(sphere({0.006, 0, 0}, 0.003, 7800, velocity));
  Bonds bonds;
  BondSort wire;
  wire.axial.stiffness = {1e11, 1e11, 1e11};
  wire.shear_stiffness = 1e11;
  wire.bond_radius = 0.003;
  wire.tensile_strength = tensile_strength;
  wire.shear_strength = shear_strength;
  bonds.add_sort(wire);
  bonds.add({0, 1, 0}, p);
  return {p, bonds, one_material(1e10, 0.25, 0.1, 1), {}, options(dt)};
}

TEST(EnergyLedger, bond_that_snaps_has_taken_from_its_ends_what_is_booked) {
  Solids solids = breaking_pair({3, 0, 0}, 5e6, 5e6, 2e-7);
  const double scale = 9 * solids.particles().mass[0];
  solids.step();
  const double first = solids.ledger().total();
  solids.advance(200);
  EXPECT_NEAR(solids.ledger().total(), first, 5e-4 * scale);
  EXPECT_EQ(solids.bonds().intact[0], 0);
  EXPECT_GT(solids.ledger().bonds.breakage, 0.02 * scale);
}

TEST(EnergyLedger, bond_that_breaks_under_pressure_hands_over_to_the_contact) {
  Solids solids = breaking_pair({-3, 3, 0}, 1e9, 2e6, 2e-7);
  const double scale = 18 * solids.particles().mass[0];
  solids.step();
  const double first = solids.ledger().total();
  double pressed = 0;
  for (int n = 0; n < 300; ++n) {
    solids.step();
    pressed = std::max(pressed, solids.ledger().elastic_normal);
  }
  EXPECT_EQ(solids.bonds().intact[0], 0);
  EXPECT_GT(pressed, 0.005 * scale);
  EXPECT_NEAR(solids.ledger().total(), first, 1e-3 * scale);
}

TEST(MotionEnergy, adds_up_translation_rotation_and_height) {
  Particles p;
  ParticleSpec s = sphere({0, 0, 2}, 0.1, 1000, {3, 4, 0});
  s.angular_velocity = {0, 0, 5};
  p.add(s);
  p.add(s);
  p.remove(1);
  const EnergyLedger e = motion_energy(p, {0, 0, -10});
  EXPECT_NEAR(e.kinetic, 12.5 * p.mass[0], 1e-12);
  EXPECT_NEAR(e.rotational, 0.5 * 0.4 * p.mass[0] * 0.01 * 25, 1e-12);
  EXPECT_NEAR(e.gravitational, 20 * p.mass[0], 1e-12);
  EXPECT_NEAR(motion_energy(p, 0, {0, 0, -10}), e.stored(), 1e-12);
}

}  // namespace
}  // namespace lahar::dem
