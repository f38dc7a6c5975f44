#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "core/parallel.h"
#include "coupling/coupled_step.h"
#include "coupling/grains/bed_drag.h"
#include "coupling/yield_drag.h"
#include "tests/coupling/tanks.h"

namespace lahar::coupling {
namespace {

constexpr double kRadius = 0.02, kRho = 1000;

/// Grains, or beads, in rows, that do not touch, through a periodic box of 16 cells of 2 cm.
dem::Solids in_rows(const Vec3& gravity, dem::ParticleState state = dem::ParticleState::free,
                    dem::ParticleKind kind = dem::ParticleKind::grain) {
  dem::Particles particles;
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 5; ++y)
      for (int z = 0; z < 5; ++z) {
        dem::ParticleSpec spec = grain(0.064 * Vec3(x + 0.4, y + 0.4, z + 0.4), kRadius, 2500);
        spec.state = state, spec.kind = kind;
        particles.add(spec);
      }
  dem::SolidsOptions options;
  options.gravity = gravity;
  options.time_step = 1;  // set by the coupled step
  return {std::move(particles), dem::Bonds{}, rock(), Walls{}, options};
}

CouplingOptions averaged(double length, BedDrag drag = BedDrag::di_felice) {
  return {.grains = AveragedGrains{.averaging_length = length, .drag = drag},
          .thin_wires = ThinWires::uncoupled,
          .substeps = 5};
}

template <class Real>
std::unique_ptr<CoupledStep<Real>> box_of_grains(const Vec3& gravity, const Vec3& velocity_lu = Vec3::Zero(),
                                                 BedDrag drag = BedDrag::di_felice,
                                                 dem::ParticleState state = dem::ParticleState::free,
                                                 lbm::BodyWeighting weighting = lbm::kBodyWeighting) {
  lbm::FluidOptions fluid = stream(16, 0.02, 1e-3);
  fluid.weighting = weighting;
  fluid.gravity = gravity;
  fluid.kinematic_viscosity = 1e-5;
  auto step = std::make_unique<CoupledStep<Real>>(fluid, in_rows(gravity, state), averaged(0.08, drag));
  step->fluid()->fill_everything([&](const Vec3&) { return velocity_lu; }, [](const Vec3&) { return 0.0; });
  return step;
}

/// Of liquid and grains by volume, m/s.
template <class Real>
Vec3 mixture_velocity(CoupledStep<Real>& step) {
  Vec3 sum = Vec3::Zero();
  double cells = 0;
  step.fluid()->for_each_wet_cell([&](const lbm::WetCell& c) { sum += c.velocity, ++cells; });
  return sum / cells;
}

constexpr double kBox = 0.32 * 0.32 * 0.32, kGrain = 4.0 / 3 * std::numbers::pi * kRadius * kRadius * kRadius;
constexpr double kSolid = 125 * kGrain / kBox;  // of the box

/// The liquid between grains: what moves in the cells less what moves in the grains' place.
template <class Real>
Vec3 liquid_velocity(CoupledStep<Real>& step) {
  const dem::Particles& p = step.solids()->particles();
  Vec3 sum = kBox * mixture_velocity(step);
  for (dem::ParticleIndex i = 0; i < p.size(); ++i) sum -= kGrain * p.velocity[i];
  return sum / (kBox * (1 - kSolid));
}

/// Before the first step, too, the liquid between grains is known: they rest, and all that moves is the liquid's.
TEST(AveragedExchange, KnowsTheLiquidBeforeTheFirstStep) {
  lbm::FluidOptions fluid = stream(16, 0.02, 1e-3);
  CoupledStep<double> step(fluid, in_rows(Vec3::Zero()), averaged(0.08));
  step.fill({{Vec3::Zero(), Vec3::Constant(0.32), Vec3(0.5, 0, 0)}});
  Vec3 sum = Vec3::Zero();
  double cells = 0;
  step.fluid()->for_each_wet_cell([&](const lbm::WetCell& c) { sum += step.liquid_velocity(c), ++cells; });
  EXPECT_NEAR(sum.x() / cells, 0.5 / (1 - kSolid), 0.01 * 0.5);
}

/// Momentum of liquid and grains, and both sides of the step's books; the weighting is of resolved bodies alone. The
/// cells know the grains' velocity of the step before. The fluid's step is halved on the way.
TEST(AveragedExchange, MomentumIsKept) {
  for (const auto weighting : {lbm::BodyWeighting::wall_distance, lbm::BodyWeighting::inertial}) {
    const auto step =
        box_of_grains<double>(Vec3::Zero(), Vec3::Zero(), BedDrag::di_felice, dem::ParticleState::free, weighting);
    dem::Particles& p = step->solids()->particles();
    for (dem::ParticleIndex i = 0; i < p.size(); ++i) p.velocity.set(i, Vec3(0.1, 0.02 * (i % 3), 0));
    const auto momentum_after_a_step = [&] {
      Vec3 in_place = Vec3::Zero(), of_grains = Vec3::Zero();
      for (dem::ParticleIndex i = 0; i < p.size(); ++i) in_place += kRho * kGrain * p.velocity[i];
      step->advance();
      for (dem::ParticleIndex i = 0; i < p.size(); ++i) of_grains += p.mass[i] * p.velocity[i];
      const Vec3 of_liquid = kRho * kBox * mixture_velocity(*step) - in_place;
      EXPECT_LT((step->liquid_momentum() - of_liquid).norm(), 1e-9 * of_liquid.norm());
      return Vec3(of_liquid + of_grains);
    };
    const Vec3 start = momentum_after_a_step();
    const double slip = (p.velocity[0] - liquid_velocity(*step)).norm();
    for (int n = 0; n < 400; ++n) {
      if (n == 200) step->fluid()->set_time_step(5e-4);
      step->advance();
    }
    EXPECT_LT((p.velocity[0] - liquid_velocity(*step)).norm(), 0.8 * slip);
    EXPECT_LT((momentum_after_a_step() - start).norm(), 1e-9 * start.norm());
    EXPECT_LT(step->audit().relative(), 1e-12);
  }
}

/// A grain that is taken out between two steps leaves the momentum of the liquid as it is.
TEST(AveragedExchange, MomentumOfTheLiquidOutlivesAGrain) {
  const auto step = box_of_grains<double>(Vec3::Zero());
  dem::Particles& p = step->solids()->particles();
  for (dem::ParticleIndex i = 0; i < p.size(); ++i) p.velocity.set(i, Vec3(0.1, 0, 0));
  step->advance();
  const Vec3 before = step->liquid_momentum();
  EXPECT_GT(before.norm(), 0);
  step->solids()->remove(7);
  EXPECT_LT((step->liquid_momentum() - before).norm(), 1e-12 * before.norm());
}

/// An exchange that is put in by hand counts as that of the options does.
TEST(AveragedExchange, IsKnownByWhatItDoes) {
  lbm::FluidOptions fluid = stream(16, 0.02, 1e-3);
  fluid.gravity = Vec3::Zero();
  const CouplingOptions options = averaged(0.08);
  CouplingOptions none = options;
  none.grains = ResolvedGrains{};
  CoupledStep<double> chosen(fluid, in_rows(Vec3::Zero()), options),
      injected(fluid, in_rows(Vec3::Zero()), none, make_grain_exchange<double>(options.grains, fluid));
  for (CoupledStep<double>* step : {&chosen, &injected}) {
    dem::Particles& p = step->solids()->particles();
    for (dem::ParticleIndex i = 0; i < p.size(); ++i) p.velocity.set(i, Vec3(0.1, 0, 0));
    step->fluid()->fill_everything([](const Vec3&) { return Vec3(0.01, 0, 0); }, [](const Vec3&) { return 0.0; });
    step->advance();
  }
  EXPECT_EQ(injected.liquid_momentum(), chosen.liquid_momentum());
}

/// Water and grains that fall together feel nothing of each other: no buoyancy acts along the fall, and none drags.
TEST(AveragedExchange, MixtureInFreeFallStaysTogether) {
  const Vec3 gravity(2, 0, 0);
  const auto step = box_of_grains<double>(gravity);
  for (int n = 0; n < 300; ++n) step->advance();
  const dem::Particles& p = step->solids()->particles();
  const double expected = 0.6;  // m/s
  EXPECT_NEAR(liquid_velocity(*step).x(), expected, 0.02 * expected);
  for (dem::ParticleIndex i = 0; i < p.size(); ++i) EXPECT_NEAR(p.velocity[i].x(), expected, 0.02 * expected);
}

/// Held grains slow a stream as the law says: rho du/dt = -n beta u, as no pressure acts along a periodic box (the
/// grains feel the drag less what the liquid in their place would need to slow down).
TEST(AveragedExchange, HeldGrainsSlowTheLiquid) {
  for (const BedDrag law : {BedDrag::di_felice, BedDrag::gidaspow, BedDrag::beetstra}) {
    const auto step = box_of_grains<double>(Vec3::Zero(), Vec3(0.02, 0, 0), law, dem::ParticleState::fixed);
    double u = 0.02 * 0.02 / 1e-3 / (1 - kSolid);
    const double start = u;
    for (int n = 0; n < 200; ++n) {
      step->advance();
      const double beta = bed_drag(
          law, {.diameter = 2 * kRadius, .solid_fraction = kSolid, .speed = u, .density = kRho, .viscosity = 1e-5});
      u -= 1e-3 * 125 / kBox * beta * u / kRho;
    }
    EXPECT_LT(u, 0.95 * start);
    EXPECT_NEAR(liquid_velocity(*step).x() / start, u / start, 0.04 * (1 - u / start));
  }
}

/// Beads that feel the law of grains are lone ones to it, whose volume no cell holds: as u slows down they slow the
/// liquid in their place, too, (1 + n V) rho du/dt = -n beta u.
TEST(AveragedExchange, HeldBeadsSlowTheLiquidByTheSameLaw) {
  lbm::FluidOptions fluid = stream(16, 0.02, 1e-3);
  fluid.kinematic_viscosity = 1e-5;
  CouplingOptions options = averaged(0.08);
  std::get<AveragedGrains>(options.grains).beads_as_grains = true;
  options.thin_wires = ThinWires::uncoupled;
  CoupledStep<double> step(fluid, in_rows(Vec3::Zero(), dem::ParticleState::fixed, dem::ParticleKind::bead), options);
  step.fluid()->fill_everything([](const Vec3&) { return Vec3(0.02, 0, 0); }, [](const Vec3&) { return 0.0; });
  double u = 0.02 * 0.02 / 1e-3;
  const double start = u;
  for (int n = 0; n < 200; ++n) {
    step.advance();
    const double beta =
        bed_drag(BedDrag::di_felice,
                 {.diameter = 2 * kRadius, .solid_fraction = 0, .speed = u, .density = kRho, .viscosity = 1e-5});
    u -= 1e-3 * 125 / kBox * beta * u / (kRho * (1 + kSolid));
  }
  EXPECT_LT(u, 0.95 * start);
  EXPECT_NEAR(mixture_velocity(step).x() / start, u / start, 0.04 * (1 - u / start));
}

/// A held grain in a steady vortex, u = A (sin kx cos ky, -cos kx sin ky, 0), feels rho V (u . grad) u across the
/// stream, at an eighth of a wave along both axes rho V A^2 k/2 along x and y; the drag acts along the stream. Nodes
/// two cells apart, 64 cells a wave: means and differences of sines take 2 % off.
TEST(AveragedExchange, HeldGrainFeelsTheLiquidTurn) {
  constexpr double cell = 0.02, wave = 64 * cell, k = 2 * std::numbers::pi / wave, lu = 0.05, dt = 1e-3, radius = 0.004;
  lbm::FluidOptions fluid = stream(64, cell, dt);
  fluid.domain.upper.z() = 8 * cell;
  fluid.kinematic_viscosity = 1e-5;
  dem::Particles particles;
  dem::ParticleSpec held = grain(Vec3(wave / 8, wave / 8, 4 * cell), radius, 2500);
  held.state = dem::ParticleState::fixed;
  particles.add(held);
  dem::SolidsOptions options;
  options.time_step = 1;
  CoupledStep<double> step(fluid, dem::Solids(particles, {}, rock(), {}, options), averaged(2 * cell));
  step.fluid()->fill_everything(
      [&](const Vec3& p) {
        return Vec3(lu * std::sin(k * p.x()) * std::cos(k * p.y()), -lu * std::cos(k * p.x()) * std::sin(k * p.y()), 0);
      },
      [&](const Vec3& p) { return 0.75 * lu * lu * (std::cos(2 * k * p.x()) + std::cos(2 * k * p.y())); });
  for (int n = 0; n < 40; ++n) step.advance();
  const double speed = lu * cell / dt, volume = 4.0 / 3 * std::numbers::pi * radius * radius * radius;
  const double expected = kRho * volume * speed * speed * k / std::numbers::sqrt2;
  const Vec3 force = step.solids()->particles().external_force[0];
  EXPECT_NEAR((force.x() + force.y()) / std::numbers::sqrt2, expected, 0.04 * expected);
  EXPECT_GT((force.x() - force.y()) / std::numbers::sqrt2, expected);  // the drag
  EXPECT_LT(step.audit().relative(), 1e-12);
}

/// A grain as heavy as water stays where it is; under water a heavy one weighs less by the water in its place.
TEST(AveragedExchange, BuoyancyOfWaterAtRest) {
  lbm::FluidOptions fluid = tank(Vec3(0.32, 0.32, 0.32), 0.02, 2e-4);
  dem::Particles particles;
  particles.add(grain(Vec3(0.1, 0.1, 0.1), kRadius, kRho));
  particles.add(grain(Vec3(0.22, 0.2, 0.1), kRadius, 2500));
  dem::SolidsOptions options;
  options.gravity = fluid.gravity;
  options.time_step = 1;
  CoupledStep<double> step(fluid, dem::Solids(particles, {}, rock(), {}, options), averaged(0.08));
  step.fill({{Vec3::Zero(), Vec3(0.32, 0.32, 0.24)}});
  for (int n = 0; n < 50; ++n) step.advance();
  const dem::Particles& p = step.solids()->particles();
  EXPECT_NEAR(p.velocity[0].z(), 0, 0.02 * 9.81 * step.time());
  EXPECT_NEAR(p.velocity[1].z(), -0.6 * 9.81 * step.time(), 0.03 * 9.81 * step.time());
}

/// In thick liquid at rest, too, which leaves its collisions with half a step of gravity: a grain as heavy as it does
/// not sink at that (docs/decisions/0092).
TEST(AveragedExchange, NeutralGrainStaysInThickLiquidAtRest) {
  lbm::FluidOptions fluid = tank(Vec3(0.32, 0.32, 0.32), 0.02, 2e-4);
  fluid.kinematic_viscosity = 3e-3;
  dem::Particles particles;
  particles.add(grain(Vec3(0.15, 0.13, 0.1), kRadius, kRho));
  dem::SolidsOptions options;
  options.gravity = fluid.gravity;
  options.time_step = 1;
  CoupledStep<double> step(fluid, dem::Solids(particles, {}, rock(), {}, options), averaged(0.08));
  step.fill({{Vec3::Zero(), Vec3(0.32, 0.32, 0.24)}});
  for (int n = 0; n < 600; ++n) step.advance();
  EXPECT_NEAR(step.solids()->particles().velocity[0].z(), 0, 0.05 * 0.5 * 9.81 * fluid.time_step);
}

/// Grains of one cell and of half a cell that lie on a slope in steps are lifted by the weight of the water in their
/// place, though they are spread over cells of the wall.
TEST(AveragedExchange, BuoyancyOnAWall) {
  lbm::FluidOptions fluid = tank(Vec3(0.32, 0.32, 0.32), 0.02, 2e-4);
  fluid.kinematic_viscosity = 1e-3;
  const HalfSpace slope{Vec3(0.16, 0.16, 0.07), Vec3(-0.5, 0, std::sqrt(0.75))};
  fluid.domain.walls.add({"slope", slope});
  const Vec3 along(slope.normal.z(), 0, -slope.normal.x());
  dem::Particles particles;
  for (int k = 0; k < 8; ++k)
    for (const double radius : {0.01, 0.005}) {
      dem::ParticleSpec spec = grain(Vec3(slope.point + (0.0153 * k - 0.06) * along + radius * slope.normal +
                                          (radius > 0.006 ? 0.05 : -0.05) * Vec3::UnitY()),
                                     radius, 2500);
      spec.state = dem::ParticleState::fixed;
      particles.add(spec);
    }
  dem::SolidsOptions options;
  options.time_step = 1;
  CoupledStep<double> step(fluid, dem::Solids(particles, {}, rock(), {}, options), averaged(0.08));
  step.fill({{Vec3::Zero(), Vec3(0.32, 0.32, 0.28)}});
  for (int n = 0; n < 400; ++n) step.advance();
  const dem::Particles& p = step.solids()->particles();
  for (dem::ParticleIndex i = 0; i < p.size(); ++i) {
    const double weight = kRho * 4.0 / 3 * std::numbers::pi * std::pow(p.radius[i], 3) * 9.81;  // of the water
    EXPECT_NEAR(p.external_force[i].z(), weight, 2e-3 * weight) << p.radius[i];
  }
}

/// Grains that fall in raise the level; no liquid is lost.
TEST(AveragedExchange, LiquidIsKeptWhereGrainsFallIn) {
  lbm::FluidOptions fluid = tank(Vec3(0.32, 0.32, 0.48), 0.02, 2e-4);
  fluid.kinematic_viscosity = 0.001;
  dem::Particles particles;
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y) particles.add(grain(Vec3(0.04 + 0.08 * x, 0.04 + 0.08 * y, 0.2), kRadius, 2500));
  Walls walls;
  walls.add({"bed", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}});
  dem::SolidsOptions options;
  options.gravity = fluid.gravity;
  options.time_step = 1;
  CoupledStep<float> step(fluid, dem::Solids(particles, {}, rock(), walls, options), averaged(0.08));
  step.fill({{Vec3::Zero(), Vec3(0.32, 0.32, 0.16)}});
  for (int n = 0; n < 2000; ++n) step.advance();
  EXPECT_NEAR(step.fluid()->mass_drift(), 0, 1e-6);
  EXPECT_LT(step.audit().relative(), 1e-6);
  double volume = 0;
  step.fluid()->for_each_wet_cell([&](const lbm::WetCell& c) { volume += c.fill_level; });
  const double grains = 16 * 4.0 / 3 * std::numbers::pi * std::pow(kRadius / 0.02, 3);
  EXPECT_NEAR(volume, 16 * 16 * 8 + grains, 0.02 * grains);
}

/// What the grains lose in a step the water gains, that in cells that are a quarter full too.
TEST(AveragedExchange, MomentumIsKeptAtTheSurface) {
  lbm::FluidOptions fluid = tank(Vec3(0.32, 0.32, 0.32), 0.02, 2e-4);
  fluid.gravity = Vec3::Zero();
  dem::Particles particles;
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y) particles.add(grain(Vec3(0.04 + 0.08 * x, 0.04 + 0.08 * y, 0.12), kRadius, 2500));
  for (dem::ParticleIndex i = 0; i < particles.size(); ++i) particles.velocity.set(i, Vec3(0.1, 0, 0));
  dem::SolidsOptions options;
  options.time_step = 1;
  CoupledStep<double> step(fluid, dem::Solids(particles, {}, rock(), {}, options), averaged(0.08));
  step.fill({{Vec3::Zero(), Vec3(0.32, 0.32, 0.165)}});
  step.advance();
  Vec3 of_water = Vec3::Zero(), on_grains = Vec3::Zero();
  step.fluid()->for_each_wet_cell(
      [&](const lbm::WetCell& c) { of_water += kRho * std::pow(0.02, 3) * c.fill_level * c.velocity; });
  const dem::Particles& p = step.solids()->particles();
  for (dem::ParticleIndex i = 0; i < p.size(); ++i) on_grains += step.time() * Vec3(p.external_force[i]);
  EXPECT_LT(on_grains.x(), 0);
  EXPECT_LT((of_water + on_grains).norm(), 1e-6 * on_grains.norm());
}

/// A stream of water `depth` (m) deep over a slipping bed through grains at rest that fill all of it evenly (one a cell
/// of 2 cm), nodes 0.16 m apart.
struct StreamThroughGrains {
  static constexpr double kSpacing = 0.02, kGrain = 0.0098, kSpeed = 0.4;
  double solid_fraction = sphere_volume() / (kSpacing * kSpacing * kSpacing);
  std::unique_ptr<CoupledStep<double>> step;

  StreamThroughGrains(double depth, const Vec3& gravity, double time_step) {
    lbm::FluidOptions fluid;
    fluid.domain.upper = Vec3(0.32, 0.32, 0.48);
    fluid.domain.cell_size = kSpacing;
    fluid.domain.faces.fill(lbm::FaceKind::periodic);
    fluid.domain.faces[4] = lbm::FaceKind::closed, fluid.domain.faces[5] = lbm::FaceKind::open;
    fluid.domain.slip = WallSlip::free_slip;
    fluid.time_step = time_step;
    fluid.gravity = gravity;
    fluid.kinematic_viscosity = 1e-6;
    dem::Particles particles;
    const int layers = static_cast<int>(std::lround(depth / kSpacing));
    for (int x = 0; x < 16; ++x)
      for (int y = 0; y < 16; ++y)
        for (int z = 0; z < layers; ++z) {
          dem::ParticleSpec spec = grain(kSpacing * Vec3(x + 0.5, y + 0.5, z + 0.5), kGrain, 2500);
          spec.state = dem::ParticleState::fixed;
          particles.add(spec);
        }
    dem::SolidsOptions options;
    options.gravity = gravity;
    options.time_step = 1;  // set by the coupled step
    dem::Solids solids(std::move(particles), dem::Bonds{}, rock(), Walls{}, options);
    step = std::make_unique<CoupledStep<double>>(fluid, std::move(solids), averaged(0.15, BedDrag::gidaspow));
    step->fill({{Vec3::Zero(), Vec3(0.32, 0.32, depth), Vec3(kSpeed, 0, 0)}});
  }

  static double sphere_volume() { return 4.0 / 3 * std::numbers::pi * kGrain * kGrain * kGrain; }
  [[nodiscard]] double drag_by_the_law() const {  // N, of a grain
    const double slip = kSpeed / (1 - solid_fraction);
    return slip * bed_drag(BedDrag::gidaspow, {.diameter = 2 * kGrain,
                                               .solid_fraction = solid_fraction,
                                               .speed = slip,
                                               .density = kRho,
                                               .viscosity = 1e-6});
  }
};

// Whatever part of an averaging length the water is deep: each grain feels the same solid fraction and speed.
TEST(AveragedExchange, AUniformMixtureIsOneUpToItsSurface) {
  for (const double depth : {0.10, 0.12, 0.16, 0.18, 0.24, 0.32, 0.40}) {
    StreamThroughGrains stream(depth, Vec3::Zero(), 1e-4);
    stream.step->advance();
    const dem::Particles& p = stream.step->solids()->particles();
    double least = 1e300, most = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double over_law = p.external_force.x[i] / stream.drag_by_the_law();
      least = std::min(least, over_law), most = std::max(most, over_law);
    }
    EXPECT_NEAR(least, 1, 0.03) << depth << " m";  // the first step brakes the water
    EXPECT_NEAR(most, 1, 0.03) << depth << " m";
  }
}

/// Drag on a wire of 6 mm in the middle of a periodic stream whose liquid has 1 m/s, with grains at rest in it or not.
double drag_on_a_wire(bool among_grains) {
  lbm::FluidOptions fluid = stream(16, 0.02, 1e-4);
  fluid.kinematic_viscosity = 1e-6;
  constexpr double d = 0.006, radius = 0.0098, phi = 4.0 / 3 * std::numbers::pi * 0.49 * 0.49 * 0.49;
  dem::BondSort sort;
  sort.axial.stiffness = {1e6, 1e6, 1e6};
  sort.bond_radius = d / 2;
  dem::Particles particles;
  dem::Bonds bonds;
  bonds.add_sort(sort);
  for (int k = 0; k < 21; ++k) {
    dem::ParticleSpec bead = grain(Vec3(0.16, 0.1 + k * d, 0.16), d / 2, 7800);
    bead.kind = dem::ParticleKind::bead, bead.state = dem::ParticleState::fixed;
    particles.add(bead);
    if (k > 0) bonds.add({static_cast<dem::ParticleIndex>(k - 1), static_cast<dem::ParticleIndex>(k), 0}, particles);
  }
  for (int k = 0; among_grains && k < 16 * 16 * 16; ++k) {
    dem::ParticleSpec spec = grain(0.02 * Vec3(k / 256 + 0.5, k / 16 % 16 + 0.5, k % 16 + 0.5), radius, 2500);
    spec.state = dem::ParticleState::fixed;
    particles.add(spec);
  }
  dem::SolidsOptions options;
  options.time_step = 1;  // set by the coupled step
  options.gravity = Vec3::Zero();
  CouplingOptions coupling = averaged(0.15, BedDrag::gidaspow);
  coupling.thin_wires = ThinWires::drag_law;
  CoupledStep<double> step(fluid, dem::Solids(std::move(particles), std::move(bonds), rock(), Walls{}, options),
                           coupling);
  const double speed = (among_grains ? 1 - phi : 1) * 1e-4 / 0.02;  // of liquid and grains together, lu
  step.fluid()->fill_everything([&](const Vec3&) { return Vec3(speed, 0, 0); }, [](const Vec3&) { return 0.0; });
  step.advance();
  const dem::Particles& p = step.solids()->particles();
  double force = 0;
  for (std::size_t i = 0; i < p.size(); ++i) force += p.kind[i] == dem::ParticleKind::bead ? p.external_force.x[i] : 0;
  return force;
}

// As fast as in open water, but with liquid around only a part of it.
TEST(AveragedExchange, WiresFeelTheLiquidBetweenTheGrains) {
  const double phi = 4.0 / 3 * std::numbers::pi * 0.49 * 0.49 * 0.49;
  EXPECT_NEAR(drag_on_a_wire(true) / drag_on_a_wire(false), 1 - phi, 0.05);
}

/// However stiff the drag, grain and liquid only come to one velocity.
TEST(AveragedExchange, StiffDragDoesNotOvershoot) {
  lbm::FluidOptions fluid = stream(16, 0.02, 1e-3);
  fluid.kinematic_viscosity = 0.05;  // mud: the grain answers within a small part of the step
  CoupledStep<double> step(fluid, in_rows(Vec3::Zero()), averaged(0.08));
  step.fluid()->fill_everything([](const Vec3&) { return Vec3(Vec3::Zero()); }, [](const Vec3&) { return 0.0; });
  dem::Particles& p = step.solids()->particles();
  for (dem::ParticleIndex i = 0; i < p.size(); ++i) p.velocity.set(i, Vec3(0.1, 0, 0));
  double last = 0.1;
  for (int n = 0; n < 100; ++n) {
    step.advance();
    const double slip = (p.velocity[0] - liquid_velocity(step)).x();
    EXPECT_GE(slip, -1e-3);
    EXPECT_LE(slip, last + 1e-3);
    last = slip;
  }
  EXPECT_LT(last, 0.005);
}

/// Grains that sink at a constant speed through mud, which is driven upwards so that all together stays in its place:
/// what they feel is their weight in every step, also when the step has changed. (The slip itself changes by a part of
/// the half step of gravity that is in the liquid's velocity: the twentieth that is allowed.)
TEST(AveragedExchange, StiffDragIsTheSameAfterAChangeOfTheStep) {
  lbm::FluidOptions fluid = stream(16, 0.02, 1e-3);
  fluid.kinematic_viscosity = 0.05;
  fluid.gravity = Vec3(0, 0, kSolid * 2500 / ((1 - kSolid) * kRho));
  CoupledStep<double> step(fluid, in_rows(Vec3(0, 0, -1)), averaged(0.08));
  step.fluid()->fill_everything([](const Vec3&) { return Vec3(Vec3::Zero()); }, [](const Vec3&) { return 0.0; });
  const auto force = [&] { return step.solids()->particles().external_force[0].z(); };
  for (int n = 0; n < 300; ++n) step.advance();
  const double weight = 2500 * kGrain;
  EXPECT_NEAR(force(), weight, 0.002 * weight);
  for (const double factor : {0.5, 2.0}) {
    step.fluid()->set_time_step(factor * step.fluid()->units().time_step);
    for (int n = 0; n < 20; ++n) {
      step.advance();
      EXPECT_NEAR(force(), weight, 0.055 * weight) << "step " << n << " after the change by " << factor;
    }
  }
}

/// Grains that begin to move: as in the Newtonian liquid that drags as much on a sphere. Liquid and grains together are
/// at rest, so that liquid goes the other way.
TEST(AveragedExchange, MudDragsAsItsFlowLawSays) {
  constexpr double speed = 0.1, viscosity = 1e-3, side = kRadius / 0.064;
  constexpr double slip = speed / (1 - 4.0 / 3 * std::numbers::pi * side * side * side), rate = slip / (2 * kRadius);
  const auto slowed_by = [&](const lbm::RheologyOptions& law, double kinematic_viscosity) {
    lbm::FluidOptions fluid = stream(16, 0.02, 1e-4);
    fluid.kinematic_viscosity = kinematic_viscosity, fluid.rheology = law;
    CoupledStep<double> step(fluid, in_rows(Vec3::Zero()), averaged(0.08));
    step.fluid()->fill_everything([](const Vec3&) { return Vec3(Vec3::Zero()); }, [](const Vec3&) { return 0.0; });
    dem::Particles& p = step.solids()->particles();
    for (dem::ParticleIndex i = 0; i < p.size(); ++i) p.velocity.set(i, Vec3(speed, 0, 0));
    for (int n = 0; n < 3; ++n) step.advance();
    return speed - p.velocity[0].x();
  };
  const double yield = 10 * kRho * viscosity * rate;  // Bn = 10
  const double as_newtonian = slowed_by({}, viscosity * sphere_yield_factor(10));
  EXPECT_GT(as_newtonian, 8 * slowed_by({}, viscosity));
  EXPECT_NEAR(slowed_by({lbm::FlowLaw::bingham, yield, 0, 1, 10}, viscosity) / as_newtonian, 1, 0.02);
  const double consistency = kRho * viscosity * std::sqrt(rate);  // the same viscosity at this rate
  EXPECT_NEAR(slowed_by({lbm::FlowLaw::herschel_bulkley, yield, consistency, 0.5, 10}, 1e-6) / as_newtonian, 1, 0.02);
}

/// Every bit, on one thread and on three.
TEST(AveragedExchange, DoesNotDependOnThreads) {
  const auto end = [](int threads) {
    const ThreadLimit limit(threads);
    const auto step = box_of_grains<float>(Vec3(2, 0, -1), Vec3(0.02, 0.01, 0));
    for (int n = 0; n < 50; ++n) step->advance();
    return std::tuple{step->solids()->particles().position.x, step->solids()->particles().velocity.z,
                      mixture_velocity(*step), step->audit().relative()};
  };
  EXPECT_EQ(end(1), end(3));
}

}  // namespace
}  // namespace lahar::coupling
