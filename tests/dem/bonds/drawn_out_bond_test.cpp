// A dissipator may be drawn out to a hundred times its own length. Its shear then turns its ends with a long lever: the
// damper must know that lever, and so must the limit of the time step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "dem/solids.h"
#include "dem/time_step.h"
#include "tests/dem/small_scenes.h"

namespace lahar::dem {
namespace {

constexpr double kRadius = 0.00785, kSpacing = 2 * kRadius;  // m, wire of Li, Zhao & Kwan (2020), section 3.3

BondSort wire(double stiffness, double damping_ratio) {
  BondSort sort;
  sort.axial.stiffness = {stiffness, stiffness, stiffness};
  sort.shear_stiffness = stiffness;
  sort.bond_radius = kRadius;
  sort.damping_ratio = damping_ratio;
  return sort;
}

/// A dissipator of their Table 3 between a fixed bead and a piece of cable that ends in a second fixed bead, drawn out
/// by `drawn` m and then at rest but for a turn of the bead next to it.
Solids drawn_out(double drawn, double damping_ratio, double time_step) {
  Particles p;
  Bonds bonds;
  for (int k = 0; k < 6; ++k) {
    ParticleSpec bead = testing::sphere(Vec3(k * kSpacing, 0, 0), kRadius, 7800);
    bead.kind = ParticleKind::bead;
    bead.state = k == 0 || k == 5 ? ParticleState::fixed : ParticleState::free;
    bead.body = 0;
    p.add(bead);
  }
  BondSort brake = wire(3.5e8, damping_ratio);
  brake.axial.stiffness = {3.5e8, 3.5e7, 3.5e7};
  brake.axial.force_limit[0] = 12e3;
  bonds.add_sort(brake);
  bonds.add_sort(wire(8e11, damping_ratio));
  for (unsigned k = 0; k < 5; ++k) bonds.add({k, k + 1, k == 0 ? 0 : 1}, p);
  for (std::size_t k = 1; k < 6; ++k) p.position.x[k] += drawn;
  bonds.elongation[0] = drawn;
  p.angular_velocity.z[1] = 1;
  SolidsOptions options = testing::options(time_step);
  options.watchdog.interval = 1;
  return {p, bonds, testing::one_material(1e11, 0.3, 0, 1), Walls{}, options};
}

TEST(DrawnOutBond, SwingsOfItsEndsDieOutWithinTheLimitOfTheStep) {
  constexpr double kStep = 4e-6;  // s
  for (const double drawn : {0.1, 0.7, 1.2, 1.8}) {
    Solids solids = drawn_out(drawn, 0.02, kStep);
    ASSERT_LT(kStep, bond_time_step(solids.bonds(), solids.particles())) << drawn;
    solids.advance(0);
    const double energy = solids.ledger().total();
    double fastest = 0;  // rad/s; 1 at the start
    for (int n = 0; n < 4000; ++n) {
      solids.step();
      fastest = std::max(fastest, std::abs(solids.particles().angular_velocity.z[1]));
    }
    EXPECT_LT(fastest, 1.05) << drawn;
    EXPECT_LT(std::abs(solids.particles().angular_velocity.z[1]), 0.05) << drawn;
    EXPECT_NEAR(solids.ledger().total(), energy, 1e-4) << drawn;  // J; the cable springs back with about 1 J
  }
}

/// Each brake is looked at as it grows, not only the longest: here one of 1 m was looked at before a stiffer one grows.
TEST(DrawnOutBond, AShorterOneThatIsStifferIsSeenToo) {
  Particles p;
  Bonds bonds;
  const auto add_bead = [&](double x, double y, ParticleState state) {
    ParticleSpec bead = testing::sphere(Vec3(x, y, 0), kRadius, 7800);
    bead.kind = ParticleKind::bead, bead.state = state, bead.body = 0;
    p.add(bead);
  };
  for (const double shear : {3.5e8, 3.5e9}) {
    BondSort brake = wire(shear, 0.02);
    brake.axial.stiffness = {shear, 1e3, 1e3};
    brake.axial.force_limit[0] = 1;
    bonds.add_sort(brake);
  }
  for (const unsigned k : {0U, 1U}) {
    add_bead(0, k, ParticleState::fixed), add_bead(kSpacing, k, ParticleState::free);
    bonds.add({2 * k, 2 * k + 1, static_cast<int>(k)}, p);
  }
  p.position.x[1] += 1, bonds.elongation[0] = 1;
  SolidsOptions options = testing::options(4e-6);
  options.watchdog.interval = 1;
  Solids solids(p, bonds, testing::one_material(1e11, 0.3, 0, 1), Walls{}, options);
  EXPECT_NO_THROW(solids.advance(2));
  solids.particles().velocity.x[3] = 1000;
  EXPECT_THROW(solids.advance(230), NumericalFailure);
}

TEST(DrawnOutBond, ItsDampingKeepsItsShareOfCritical) {
  // One free bead on a long brake that is held at its far end: the bead turns and shifts against the shear of the
  // brake.
  constexpr double kDrawn = 1.0, kRatio = 0.02;
  Particles p;
  Bonds bonds;
  for (int k = 0; k < 2; ++k) {
    ParticleSpec bead = testing::sphere(Vec3(k * kSpacing, 0, 0), kRadius, 7800);
    bead.state = k == 0 ? ParticleState::fixed : ParticleState::free;
    p.add(bead);
  }
  BondSort brake = wire(3.5e8, kRatio);
  brake.axial.stiffness = {3.5e8, 0, 0};  // pulls with the same force however long it is
  brake.axial.force_limit[0] = 1e-3;
  bonds.add_sort(brake);
  bonds.add({0, 1, 0}, p);
  p.position.x[1] += kDrawn;
  bonds.elongation[0] = kDrawn;
  p.angular_velocity.z[1] = 1;
  const double area = std::numbers::pi * kRadius * kRadius, lever = 0.5 * (kSpacing + kDrawn);
  const double rate = std::sqrt(3.5e8 * area * (1 / p.mass[1] + lever * lever / p.inertia[1]));  // rad/s
  constexpr double kStep = 2e-7;
  Solids solids(p, bonds, testing::one_material(1e11, 0.3, 0, 1), Walls{}, testing::options(kStep));
  const double after = 8 / rate * 2 * std::numbers::pi;  // eight swings
  double largest = 0;                                    // in the ninth
  while (solids.time() < 9.0 / 8 * after) {
    solids.step();
    if (solids.time() > after) largest = std::max(largest, std::abs(solids.particles().angular_velocity.z[1]));
  }
  const double expected = std::exp(-kRatio * rate * after);
  EXPECT_GT(largest, 0.85 * expected);
  EXPECT_LT(largest, 1.05 * expected);
}

/// Limit of the step for the bead beside the drawn-out brake, by hand: the brake holds it at one end, the wire at both.
double limit_of(double drawn) {
  const double area = std::numbers::pi * kRadius * kRadius, lever = 0.5 * (kSpacing + drawn);
  const double inertia = 0.4 * 7800 * 4.0 / 3.0 * std::numbers::pi * std::pow(kRadius, 5);
  return 2 / std::sqrt(area * (3.5e8 * lever * lever + 2 * 8e11 * kRadius * kRadius) / inertia);
}

TEST(DrawnOutBond, LowersTheLimitOfTheStep) {
  for (const double drawn : {2.5, 4.0}) {
    const Solids solids = drawn_out(drawn, 0, 1e-6);
    EXPECT_NEAR(bond_time_step(solids.bonds(), solids.particles()) / limit_of(drawn), 1, 1e-9) << drawn;
  }
}

TEST(DrawnOutBond, StopsTheRunWhenTheStepIsTooLongForIt) {
  EXPECT_NO_THROW(drawn_out(4, 0, 0.9 * limit_of(4)).advance(50));
  try {
    drawn_out(4, 0, 1.1 * limit_of(4)).advance(50);
    FAIL() << "a step beyond the limit was not found";
  } catch (const NumericalFailure& failure) {
    EXPECT_NE(std::string(failure.what()).find("drawn out"), std::string::npos) << failure.what();
  }
}

}  // namespace
}  // namespace lahar::dem
