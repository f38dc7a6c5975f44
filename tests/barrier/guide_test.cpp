#include "barrier/guide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry.h"
#include "dem/solids.h"

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
    guides.add(wire, Vec3(0.1, 0, 0));
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
  }
}

TEST(Guide, ForcesAreTheSlopeOfItsEnergy) {
  // A cable with a kink at its guide, nearest in the middle of a segment and at a bead.
  for (const double along : {0.004, 0.0098}) {
    const auto bent = [&](std::size_t bead, int axis, double shift) {
      GuidedCable cable(along, 2e-3);
      auto& p = cable.particles.position;
      for (std::size_t k = 10; k < p.size(); ++k) p.y[k] += 0.6 * (p.x[k] - p.x[9]);
      (axis == 0 ? p.x : axis == 1 ? p.y : p.z)[bead] += shift;
      cable.guides.apply(cable.particles);
      return cable;
    };
    double largest = 0;
    for (std::size_t bead = 8; bead < 12; ++bead)
      for (int axis = 0; axis < 3; ++axis) {
        const double step = 1e-8;
        const double slope =
            (bent(bead, axis, step).guides.energy() - bent(bead, axis, -step).guides.energy()) / (2 * step);
        EXPECT_NEAR(bent(bead, axis, 0).particles.external_force[bead][axis], -slope, 0.01) << bead << " " << axis;
        largest = std::max(largest, std::abs(slope));
      }
    EXPECT_GT(largest, 100.0);
  }
}

TEST(Guide, ACableSlidesThroughAtAnAngleWithoutResistance) {
  // A straight cable that runs through its guide at 45 degrees, 2 mm beside it: wherever its beads stand the force is
  // normal to the cable and the energy the same.
  const Vec3 direction = Vec3(1, 1, 0).normalized(), normal(-direction.y(), direction.x(), 0);
  for (const double along : {0.0, 0.0011, 0.0033, 0.005, 0.0099}) {
    GuidedCable cable(0, 0);
    for (std::size_t k = 0; k < cable.particles.size(); ++k)
      cable.particles.position.set(
          k, Vec3(0.1, 0, 0) + (static_cast<double>(k) * kSpacing - 0.1 + along) * direction + 2e-3 * normal);
    cable.guides.apply(cable.particles);
    EXPECT_NEAR(cable.force().dot(direction), 0, 1e-6) << along;
    EXPECT_NEAR(cable.force().dot(normal), -2e3, 1e-6) << along;
    EXPECT_NEAR(cable.guides.energy(), 2, 1e-9) << along;
  }
}

TEST(Guide, LetsGoOfBeadsThatHavePassed) {
  GuidedCable cable(0.001, 2e-3);
  EXPECT_NE(cable.particles.external_force.y[10], 0);
  for (double& x : cable.particles.position.x) x += 5 * kSpacing;
  cable.guides.apply(cable.particles);
  EXPECT_EQ(cable.particles.external_force.y[10], 0);
  EXPECT_NE(cable.particles.external_force.y[5], 0);
}

TEST(Guide, TellsWhenACableHasSlippedOut) {
  GuidedCable cable(0.0033, 0);
  EXPECT_FALSE(cable.guides.slipped_out());
  for (double& x : cable.particles.position.x) x += 0.09;  // the guide is between its first two beads
  cable.guides.apply(cable.particles);
  ASSERT_TRUE(cable.guides.slipped_out());
  EXPECT_EQ(*cable.guides.slipped_out(), Vec3(0.1, 0, 0));
}

/// Of critical for one bead, c = 2 d sqrt(k m), however the two beads beside the guide share it.
TEST(Guide, DampsSidewaysMotionOnly) {
  constexpr double stiffness = 1e6, ratio = 0.5;
  const double mass = 7800 * M_PI / 6 * kSpacing * kSpacing * kSpacing;
  const double damper = 2 * ratio * std::sqrt(stiffness * mass);
  for (const double along : {0.0, 0.0033}) {
    GuidedCable cable(along, 0, {.stiffness = stiffness, .damping_ratio = ratio});
    for (std::size_t i = 0; i < cable.particles.size(); ++i) cable.particles.velocity.set(i, Vec3(3, 0.2, -0.1));
    cable.guides.apply(cable.particles);
    EXPECT_NEAR(cable.force().x(), 0, 1e-9 * damper) << along;
    EXPECT_NEAR(cable.force().y(), -0.2 * damper, 1e-9 * damper) << along;
    EXPECT_NEAR(cable.force().z(), 0.1 * damper, 1e-9 * damper) << along;
  }
}

/// One bead in a guide, all others held: it comes to rest a twentieth below the step that is stable, and swings up a
/// twentieth above it, by its spring (0.3) or by its damper (0.6, 1).
TEST(Guide, KnowsItsLongestStableStep) {
  for (const double ratio : {0.3, 0.6, 1.0})
    for (const double share : {0.95, 1.05}) {
      const GuideStiffness stiffness{.stiffness = 1e6, .damping_ratio = ratio};
      dem::Particles p;
      for (int k = 0; k < 5; ++k)
        p.add({.position = Vec3(0.02 * k, 0, 0),
               .radius = 0.005,
               .density = 7800,
               .kind = dem::ParticleKind::bead,
               .state = k == 2 ? dem::ParticleState::free : dem::ParticleState::fixed,
               .body = 0});
      dem::Materials materials;
      materials.add({"steel", 1e9, 0.3});
      dem::SolidsOptions options;
      options.gravity = Vec3::Zero();
      options.time_step = share * guide_time_step(stiffness, p.mass[2]);
      Guides guides(stiffness);
      guides.add({.first_bead = 0, .beads = 5}, p.position[2]);
      p.position.y[2] = 1e-9;
      dem::Solids solids(std::move(p), dem::Bonds{}, std::move(materials), Walls{}, options);
      const auto aside = [&] {
        return std::abs(solids.particles().position.y[2]) +
               options.time_step * std::abs(solids.particles().velocity.y[2]);
      };
      for (int n = 0; n < 300 && aside() < 1e-7; ++n) {
        guides.apply(solids.particles());
        solids.step();
      }
      if (share < 1) {
        EXPECT_LT(aside(), 1e-10) << ratio;
      } else {
        EXPECT_GT(aside(), 1e-8) << ratio;
      }
    }
}

}  // namespace
}  // namespace lahar::barrier
