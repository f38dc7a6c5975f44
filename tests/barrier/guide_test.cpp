#include "barrier/guide.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lahar::barrier {
namespace {

constexpr double kSpacing = 0.01;

/// A straight cable along x whose beads stand `along` m further and `aside` m off the axis of a guide at 0.1 m.
struct GuidedCable {
  dem::Particles particles;
  dem::Bonds bonds;
  Guides guides;
  Wire wire;

  GuidedCable(double along, double aside, GuideStiffness stiffness = {.stiffness = 1e6, .damping_ratio = 0})
      : guides(stiffness) {
    WireSpec spec;
    for (int k = 0; k < 20; ++k) spec.line.points.push_back(Vec3(k * kSpacing + along, aside, 0));
    spec.properties = {kSpacing, 7800, 0};
    dem::BondSort sort;
    sort.axial.stiffness = {1e9, 1e9, 1e9};
    sort.bond_radius = 0.005;
    spec.sort = bonds.add_sort(sort);
    wire = add_wire(spec, particles, bonds);
    guides.add(wire, Vec3(0.1, 0, 0), Vec3::UnitX(), kSpacing);
    guides.apply(particles);
  }
  [[nodiscard]] Vec3 force() const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < particles.size(); ++i) sum += particles.external_force[i];
    return sum;
  }
};

TEST(Guide, HoldsACableSidewaysTheSameWhereverItsBeadsStand) {
  for (const double along : {0.0, 0.001, 0.0033, 0.005, 0.0099}) {
    const GuidedCable cable(along, 2e-3);
    EXPECT_NEAR(cable.force().y(), -1e6 * 2e-3, 1e-6) << along;
    EXPECT_NEAR(cable.guides.energy(), 0.5 * 1e6 * 4e-6, 1e-9) << along;
    EXPECT_NEAR(cable.guides.largest_force(), 2e3, 1e-6) << along;
  }
}

TEST(Guide, ForcesAreTheSlopeOfItsEnergy) {
  // Between beads the two weights change along the axis: a bent cable feels that, and the energy knows.
  const auto bent = [](double shift) {
    GuidedCable cable(0.004, 2e-3);
    cable.particles.position.x[9] += shift;
    cable.particles.position.y[10] = 5e-3;
    cable.guides.apply(cable.particles);
    return cable;
  };
  const double step = 1e-7;
  const double slope = (bent(step).guides.energy() - bent(-step).guides.energy()) / (2 * step);
  EXPECT_NEAR(bent(0).particles.external_force.x[9], -slope, 1e-6 * std::abs(slope));
  EXPECT_GT(std::abs(slope), 1.0);
}

TEST(Guide, LetsGoOfBeadsThatHavePassed) {
  GuidedCable cable(0, 2e-3);
  EXPECT_NE(cable.particles.external_force.y[10], 0);
  for (double& x : cable.particles.position.x) x += 5 * kSpacing;
  cable.guides.apply(cable.particles);
  EXPECT_EQ(cable.particles.external_force.y[10], 0);
  EXPECT_NE(cable.particles.external_force.y[5], 0);
}

TEST(Guide, TellsWhenACableHasSlippedOut) {
  GuidedCable cable(0.0033, 0);
  EXPECT_NEAR(cable.guides.loosest().grip, 1, 1e-9);
  for (double& x : cable.particles.position.x) x += 0.1;  // its first bead is 0.0033 m beyond the guide
  cable.guides.apply(cable.particles);
  EXPECT_NEAR(cable.guides.loosest().grip, 0.67, 1e-9);
  for (double& x : cable.particles.position.x) x += 0.1;
  cable.guides.apply(cable.particles);
  EXPECT_EQ(cable.guides.loosest().grip, 0);
  EXPECT_EQ(cable.guides.loosest().point, Vec3(0.1, 0, 0));
}

TEST(Guide, DampsSidewaysMotionOnly) {
  GuidedCable cable(0, 0, {.stiffness = 1e6, .damping_ratio = 0.5});
  for (std::size_t i = 0; i < cable.particles.size(); ++i) cable.particles.velocity.set(i, Vec3(3, 0.2, -0.1));
  cable.guides.apply(cable.particles);
  EXPECT_EQ(cable.force().x(), 0);
  EXPECT_LT(cable.force().y(), 0);
  EXPECT_NEAR(cable.force().y(), -2 * cable.force().z(), 1e-9);
}

}  // namespace
}  // namespace lahar::barrier
