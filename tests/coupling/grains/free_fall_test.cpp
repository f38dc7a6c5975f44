// A block of water and grains that falls through gas: gravity alone acts on it, so that both fall by g t, whatever they
// do to each other. What an exchange takes from the one and does not give to the other shows here, and in no audit.
#include <gtest/gtest.h>

#include "coupling/coupled_step.h"
#include "tests/coupling/tanks.h"

namespace lahar::coupling {
namespace {

constexpr double kCell = 0.02, kStep = 2.8e-4;  // m, s

struct Falls {
  double grains = 0, liquid = 0;  ///< speed over g t
  double surface = 0;             ///< number of interface cells over that at the start
  double drift = 0;               ///< largest of the liquid's mass
};

double interface_cells(lbm::Fluid<float>& fluid) {
  double sum = 0;
  for (const lbm::BlockIndex b : fluid.grid().owned())
    if (const auto* surface = fluid.grid().block(b).surface) sum += surface->count;
  return sum;
}

Falls after_free_fall(const CouplingOptions& coupling, lbm::BodyWeighting weighting, double radius, double duration) {
  const lbm::FluidOptions fluid = by_distance(tank(Vec3(0.48, 0.48, 1.6), kCell, kStep), weighting);
  dem::Particles particles;
  const double pitch = 2.5 * radius;
  const int count = static_cast<int>(0.3 / pitch);
  for (int x = 0; x < count; ++x)
    for (int y = 0; y < count; ++y)
      for (int z = 0; z < count; ++z)
        particles.add(grain(Vec3(0.09, 0.09, 1.09) + pitch * Vec3(x + 0.5, y + 0.5, z + 0.5), radius, 2500));
  dem::SolidsOptions options;
  options.gravity = fluid.gravity;
  options.time_step = 1;  // set by the coupled step
  CoupledStep<float> step(fluid, dem::Solids(particles, {}, rock(), Walls{}, options), coupling);
  step.fill({{Vec3(0.08, 0.08, 1.08), Vec3(0.4, 0.4, 1.4)}});
  const double surface = interface_cells(*step.fluid());
  Falls falls;
  while (step.time() < duration) {
    step.advance();
    falls.drift = std::max(falls.drift, std::abs(step.fluid()->mass_drift()));
  }
  falls.surface = interface_cells(*step.fluid()) / surface;
  const dem::Particles& p = step.solids()->particles();
  for (dem::ParticleIndex i = 0; i < p.size(); ++i) falls.grains -= p.velocity[i].z();
  falls.grains /= static_cast<double>(p.size());
  double volume = 0;
  step.fluid()->for_each_wet_cell([&](const lbm::WetCell& c) {
    const double liquid = std::max(0.0, c.fill_level - c.solid_fraction);
    falls.liquid -= liquid * c.velocity.z(), volume += liquid;
  });
  falls.liquid /= volume;
  const double speed = 9.81 * step.time();
  return {falls.grains / speed, falls.liquid / speed};
}

CouplingOptions resolved(double radius_shift) {
  return {.grains = ResolvedGrains{.radius_shift = radius_shift}, .thin_wires = ThinWires::uncoupled, .substeps = 5};
}

TEST(FreeFall, OfResolvedGrainsInWater) {
  for (const double radius : {0.02, 0.04}) {
    const Falls falls = after_free_fall(resolved(-0.2), lbm::BodyWeighting::inertial, radius, 0.25);
    EXPECT_NEAR(falls.grains, 1, 0.01) << radius;
    EXPECT_NEAR(falls.liquid, 1, 0.01) << radius;
  }
}

TEST(FreeFall, OfAveragedGrainsInWater) {
  const CouplingOptions averaged{.grains = AveragedGrains{.averaging_length = 0.15, .drag = BedDrag::di_felice},
                                 .thin_wires = ThinWires::uncoupled,
                                 .substeps = 5};
  for (const double radius : {0.02, 0.04}) {
    const Falls falls = after_free_fall(averaged, lbm::BodyWeighting::wall_distance, radius, 0.38);
    EXPECT_NEAR(falls.grains, 1, 0.005) << radius;
    EXPECT_NEAR(falls.liquid, 1, 0.01) << radius;
    EXPECT_LT(falls.surface, 1.3) << radius;  // it stays whole
    EXPECT_LT(falls.drift, 1e-6) << radius;
  }
}

}  // namespace
}  // namespace lahar::coupling
