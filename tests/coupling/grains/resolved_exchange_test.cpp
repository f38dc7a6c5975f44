#include "coupling/grains/resolved_exchange.h"

#include <gtest/gtest.h>

#include "coupling/grains/grain_coupling.h"
#include "lbm/free_surface/covered_cells.h"
#include "tests/coupling/tanks.h"

namespace lahar::coupling {
namespace {

/// A grain of 8 cells in a periodic stream, held.
struct HeldGrain {
  explicit HeldGrain(const lbm::FluidOptions& options) : fluid(options), grains(ResolvedGrains{0}, options) {
    fluid.fill_everything([](const Vec3&) { return Vec3(0.02, 0, 0); }, [](const Vec3&) { return 0.0; });
    dem::ParticleSpec spec = grain(place, 4, 2000);
    spec.state = dem::ParticleState::fixed;
    particles.add(spec);
  }
  Vec3 step() {
    fields.open(fluid.grid());
    grains.update(fluid, particles, fields);
    fields.close(fluid.grid());
    fluid.step();
    particles.external_force.fill(Vec3::Zero());
    return grains.add_forces(fluid, particles);
  }
  Vec3 place{12.3, 11.6, 12.1};
  lbm::Fluid<double> fluid;
  GrainCoupling<double> grains;
  SolidFields<double> fields;
  dem::Particles particles;
};

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
  for (const bool by_wall : {true, false}) {
    const auto options = stream(24, 1, 1);
    HeldGrain held(by_wall ? by_distance(options) : options);
    for (int s = 0; s < 5; ++s) {
      const Vec3 got = held.step(), gave = momentum_given_to_bodies(held.fluid.grid());
      EXPECT_GT(gave.norm(), 0.01);
      EXPECT_LT((got - gave).norm(), 1e-12 * gave.norm());
    }
    EXPECT_NE(held.particles.external_force.x[0], 0);
  }
}

}  // namespace
}  // namespace lahar::coupling
