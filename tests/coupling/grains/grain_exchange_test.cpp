// The interface holds another exchange than the resolved one: a point force by Stokes' law, with no wall of a grain in
// the cells.
#include "coupling/grains/grain_exchange.h"

#include <gtest/gtest.h>

#include <numbers>

#include "coupling/coupled_step.h"
#include "coupling/grains/sphere_rows.h"
#include "lbm/step/cell_moments.h"
#include "tests/coupling/tanks.h"

namespace lahar::coupling {
namespace {

/// F = 6 pi mu r (u - v) with the velocity u of the cell at the grain's centre; the opposite goes into that cell.
class PointDrag final : public GrainExchange<double> {
 public:
  void shape_sphere(double /*radius*/, GridSphere<double>& sphere) const override {
    sphere.surface = -2, sphere.reach = covered_reach(sphere);
  }
  void prepare(const lbm::Fluid<double>& /*fluid*/, const dem::Particles& /*particles*/,
               const GrainMap<double>& /*map*/) override {}
  void write_block(lbm::Fluid<double>& fluid, const GrainMap<double>& map, std::size_t block) const override {
    lbm::BodyFields<double>& f = *fluid.grid().block(static_cast<lbm::BlockIndex>(block)).body;
    for (const std::uint32_t k : map.by_block().in(block)) {
      const GrainInBlock& pair = map.pairs()[k];
      for_covered_rows(map.sphere(pair.grain), pair.lowest,
                       [&](int row, const Row<double>& eps) { add_to_row(f.solid_fraction + row, eps); });
    }
  }

  ExchangedMomentum give_impulses(lbm::Fluid<double>& fluid, const GrainMap<double>& map,
                                  const DisplacedVolume<double>& /*displaced*/, dem::Particles& particles,
                                  SolidFields<double>& /*fields*/) override {
    ExchangedMomentum sum;
    const auto& units = fluid.units();
    const double viscosity = units.viscosity_to_lu(fluid.options().kinematic_viscosity);
    for (const GrainInBlock& pair : map.pairs()) {
      const GridSphere<double>& s = map.sphere(pair.grain);
      const Vec3i cell = Vec3(s.centre[0], s.centre[1], s.centre[2]).array().floor().cast<int>() - pair.lowest.array();
      if (cell.minCoeff() < 0 || cell.maxCoeff() >= lbm::kBlockWidth) continue;
      const int n = lbm::cell_index(cell.x(), cell.y(), cell.z());
      lbm::Block<double>& block = fluid.grid().block(pair.block);
      if (!lbm::is_wet(block.type[static_cast<std::size_t>(n)])) continue;
      const dem::ParticleIndex i = particles.index(map.grains()[pair.grain].id);
      const auto liquid = lbm::outgoing_moments(fluid.grid(), {pair.block, n}, fluid.parity());
      const Vec3 slip = Vec3(liquid.u[0], liquid.u[1], liquid.u[2]) - Vec3(s.velocity[0], s.velocity[1], s.velocity[2]);
      const Vec3 force = 6 * std::numbers::pi * viscosity * particles.radius[i] / units.cell_size * slip;
      particles.external_force.add(i, force * units.force_to_si(1.0));
      lbm::ImpulseFields<double>& impulse = fluid.grid().require_impulse(pair.block);
      impulse.x[n] -= force.x(), impulse.y[n] -= force.y(), impulse.z[n] -= force.z();
      sum.to_solids += force, sum.from_fluid += force;
    }
    return sum;
  }

  void gather_block(const lbm::Fluid<double>& /*fluid*/, const GrainMap<double>& /*map*/,
                    std::size_t /*block*/) override {}
  Vec3 finish(const lbm::Fluid<double>& fluid, const GrainMap<double>& map, std::size_t grain, double wet_volume,
              dem::Particles& particles) override {
    const double mass = wet_volume * fluid.units().mass();
    particles.external_force.add(particles.index(map.grains()[grain].id), -mass * fluid.options().gravity);
    return Vec3::Zero();
  }
  void transfer(Archive& /*archive*/) override {}
};

dem::Solids two_grains(const Vec3& gravity) {
  dem::Particles particles;
  particles.add(grain(Vec3(0.103, 0.112, 0.1), 0.005, 2500));
  particles.add(grain(Vec3(0.16, 0.159, 0.13), 0.007, 2500));  // in several blocks
  particles.velocity.set(0, Vec3(0.2, 0, 0.1));
  particles.velocity.set(1, Vec3(-0.1, 0.2, 0));
  dem::SolidsOptions options;
  options.gravity = gravity;
  options.time_step = 1;  // set by the coupled step
  return {std::move(particles), dem::Bonds{}, rock(), Walls{}, options};
}

Vec3 momentum_of(CoupledStep<double>& step) {
  Vec3 sum = Vec3::Zero();
  const auto& fluid = *step.fluid();
  const double cell = std::pow(fluid.units().cell_size, 3), to_drho = fluid.units().pressure_to_si(1.0 / 3);
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) { sum += 1000 * cell * (1 + c.pressure / to_drho) * c.velocity; });
  return sum;
}

/// What the grains lose the water gets: by the books of the step, and by the momentum of both.
TEST(GrainExchange, APointForceConservesMomentum) {
  lbm::FluidOptions fluid = stream(16, 0.02, 1e-3);
  fluid.kinematic_viscosity = 0.002;  // a grain answers the explicit force within a few steps
  CoupledStep<double> step(fluid, two_grains(Vec3::Zero()), {.substeps = 5}, std::make_unique<PointDrag>());
  step.fluid()->fill_everything([](const Vec3&) { return Vec3(Vec3::Zero()); }, [](const Vec3&) { return 0.0; });
  const auto of_grains = [&] {
    const dem::Particles& p = step.solids()->particles();
    return Vec3(p.mass[0] * p.velocity[0] + p.mass[1] * p.velocity[1]);
  };
  const Vec3 start = of_grains();
  for (int s = 0; s < 100; ++s) step.advance();
  const Vec3 water = momentum_of(step), lost = start - of_grains();
  EXPECT_GT(lost.norm(), 0.2 * start.norm());
  EXPECT_LT((water - lost).norm(), 1e-9 * start.norm());
  EXPECT_LT(step.audit().relative(), 1e-12);
  const auto& grid = step.fluid()->grid();
  for (const lbm::BlockIndex b : grid.owned()) {
    EXPECT_EQ(grid.block(b).impulse, nullptr);  // used up
    const lbm::BodyFields<double>* const body = grid.block(b).body;
    if (!body) continue;
    for (const double weight : body->exchange_weight) EXPECT_EQ(weight, 0);
  }
}

/// The ledger of the liquid is the same for every exchange: grains that fall in raise the level, none is lost.
TEST(GrainExchange, LiquidIsKeptWithoutWallsOfGrains) {
  lbm::FluidOptions fluid = tank(Vec3(0.32, 0.32, 0.32), 0.02, 2e-4);
  fluid.kinematic_viscosity = 0.01;
  CoupledStep<double> step(fluid, two_grains(fluid.gravity), {.substeps = 5}, std::make_unique<PointDrag>());
  step.fill({{Vec3::Zero(), Vec3(0.32, 0.32, 0.08)}});
  step.solids()->particles().position.set(0, Vec3(0.103, 0.112, 0.2));
  for (int s = 0; s < 400; ++s) step.advance();
  EXPECT_LT(step.audit().relative(), 1e-12);
  EXPECT_NEAR(step.fluid()->mass_drift(), 0, 1e-10);
}

TEST(GrainExchange, ChoiceMakesTheExchange) {
  EXPECT_NE(make_grain_exchange<double>(ResolvedGrains{}, {}), nullptr);
  EXPECT_EQ(make_grain_exchange<double>(UncoupledGrains{}, {}), nullptr);
  EXPECT_THROW(GrainCoupling<double>(UncoupledGrains{}, {}), std::logic_error);
}

}  // namespace
}  // namespace lahar::coupling
