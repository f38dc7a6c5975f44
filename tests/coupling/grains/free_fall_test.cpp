// A block of water and grains that falls through gas: gravity alone acts on it, so that both fall by g t, whatever they
// do to each other. What an exchange takes from the one and does not give to the other shows here, and in no audit.
#include <gtest/gtest.h>

#include <random>

#include "core/worst.h"
#include "coupling/coupled_step.h"
#include "tests/coupling/tanks.h"

namespace lahar::coupling {
namespace {

constexpr double kCell = 0.02, kStep = 2.8e-4;  // m, s

struct Falls {
  double grains = 0, liquid = 0;  ///< speed over g t
  double surface = 0;             ///< interface cells over those at the start
  double drift = 0;               ///< largest of the liquid's mass
};

double interface_cells(lbm::Fluid<float>& fluid) {
  double sum = 0;
  for (const lbm::BlockIndex b : fluid.grid().owned())
    if (const auto* surface = fluid.grid().block(b).surface) sum += surface->count;
  return sum;
}

/// Grains and a box of water that fall for a time.
Falls fall(const lbm::FluidOptions& fluid, const dem::Particles& particles, const dem::Materials& materials,
           const CouplingOptions& coupling, const Vec3& lower, const Vec3& upper, double duration) {
  dem::SolidsOptions options;
  options.gravity = fluid.gravity;
  options.time_step = 1;  // set by the coupled step
  CoupledStep<float> step(fluid, dem::Solids(particles, {}, materials, Walls{}, options), coupling);
  step.fill({{lower, upper}});
  const double surface = interface_cells(*step.fluid());
  Falls falls;
  while (step.time() < duration) {
    step.advance();
    keep_worst(falls.drift, std::abs(step.fluid()->mass_drift()));
  }
  falls.surface = interface_cells(*step.fluid()) / surface;
  const double speed = 9.81 * step.time();
  const dem::Particles& p = step.solids()->particles();
  for (dem::ParticleIndex i = 0; i < p.size(); ++i)
    falls.grains -= p.velocity[i].z() / speed / static_cast<double>(p.size());
  double volume = 0;
  step.fluid()->for_each_wet_cell([&](const lbm::WetCell& c) {
    const double liquid = std::max(0.0, c.fill_level - c.solid_fraction);
    falls.liquid -= liquid * c.velocity.z() / speed, volume += liquid;
  });
  falls.liquid /= volume;
  return falls;
}

/// Grains in rows within a free block.
Falls fall_in_rows(const CouplingOptions& coupling, lbm::BodyWeighting weighting, double radius) {
  dem::Particles particles;
  const double pitch = 2.5 * radius;
  const int count = static_cast<int>(0.3 / pitch);
  for (int x = 0; x < count; ++x)
    for (int y = 0; y < count; ++y)
      for (int z = 0; z < count; ++z)
        particles.add(grain(Vec3(0.09, 0.09, 1.09) + pitch * Vec3(x + 0.5, y + 0.5, z + 0.5), radius, 2500));
  return fall(by_distance(tank(Vec3(0.48, 0.48, 1.6), kCell, kStep), weighting), particles, rock(), coupling,
              Vec3(0.08, 0.08, 1.08), Vec3(0.4, 0.4, 1.4), 0.25);
}

CouplingOptions averaged() {
  return {.grains = AveragedGrains{.averaging_length = 0.15, .drag = BedDrag::di_felice},
          .thin_wires = ThinWires::uncoupled,
          .substeps = 5};
}

TEST(FreeFall, OfResolvedGrainsInWater) {
  const CouplingOptions resolved{
      .grains = ResolvedGrains{.radius_shift = -0.2}, .thin_wires = ThinWires::uncoupled, .substeps = 5};
  for (const double radius : {0.02, 0.04}) {
    const Falls falls = fall_in_rows(resolved, lbm::BodyWeighting::inertial, radius);
    EXPECT_NEAR(falls.grains, 1, 0.01) << radius;
    EXPECT_NEAR(falls.liquid, 1, 0.01) << radius;
  }
}

TEST(FreeFall, OfAveragedGrainsInWater) {
  const Falls falls = fall_in_rows(averaged(), lbm::BodyWeighting::wall_distance, 0.02);
  EXPECT_NEAR(falls.grains, 1, 0.01);
  EXPECT_NEAR(falls.liquid, 1, 0.01);
}

/// At 4.4 m/s, down a shaft that rubs nowhere, with grains at random places that hardly push each other: the block's
/// ends stay flat (docs/decisions/0064).
TEST(FreeFall, AnAveragedMixtureStaysWhole) {
  lbm::FluidOptions fluid = tank(Vec3(0.32, 0.32, 2.4), kCell, kStep);
  fluid.domain.slip = WallSlip::free_slip;
  fluid.kinematic_viscosity = 1e-6;
  constexpr double kRadius = 0.021;
  const Vec3 lower(0, 0, 1.7), upper(0.32, 0.32, 2.3);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  dem::Particles particles;
  for (int n = 0; n < 200000; ++n) {
    const Vec3 at(share(random), share(random), share(random));
    const Vec3 place = lower + Vec3::Constant(kRadius) + at.cwiseProduct(upper - lower - Vec3::Constant(2 * kRadius));
    bool free = true;
    for (dem::ParticleIndex i = 0; i < particles.size() && free; ++i)
      free = (particles.position[i] - place).norm() > 1.7 * kRadius;
    if (free) particles.add(grain(place, kRadius, 2500));
  }
  ASSERT_GT(particles.size(), 600);
  dem::Materials soft;
  soft.add({"soft", 10, 0.3});
  soft.set_pair(0, 0, 0.3, 0.7);
  const Falls falls = fall(fluid, particles, soft, averaged(), lower, upper, 0.45);
  EXPECT_NEAR(falls.grains, 1, 0.003);
  EXPECT_NEAR(falls.liquid, 1, 0.004);
  EXPECT_LT(falls.surface, 1.4);
  EXPECT_LT(falls.drift, 1e-6);
}

}  // namespace
}  // namespace lahar::coupling
