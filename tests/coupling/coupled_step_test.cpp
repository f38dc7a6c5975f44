#include "coupling/coupled_step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <optional>

#include "core/parallel.h"
#include "tests/coupling/chains.h"

namespace lahar::coupling {
namespace {

/// On a floor; with sides where `boxed`.
dem::Solids grains(const lbm::FluidOptions& fluid, const std::vector<dem::ParticleSpec>& specs, bool boxed = false) {
  dem::Particles particles;
  for (const auto& s : specs) particles.add(s);
  dem::SolidsOptions options;
  options.gravity = fluid.gravity;
  options.time_step = fluid.time_step / 10;
  Walls walls;
  walls.add({"floor", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}});
  for (const Vec3& inward : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)})
    if (boxed) walls.add({"side", HalfSpace{inward.sum() > 0 ? fluid.domain.lower : fluid.domain.upper, inward}});
  return {std::move(particles), dem::Bonds{}, rock(), std::move(walls), options};
}

/// What the solids got is what the fluid gave, read cell by cell on the other side.
TEST(CoupledStep, MomentumAudit) {
  const auto by_eps = tank(Vec3(0.32, 0.32, 0.48), 0.02, 2e-4);
  for (const auto& fluid : {by_eps, by_distance(by_eps, lbm::BodyWeighting::inertial)}) {
    CoupledStep<double> step(
        fluid, grains(fluid, {grain(Vec3(0.15, 0.16, 0.35), 0.04, 2500), grain(Vec3(0.2, 0.11, 0.1), 0.02, 600)}),
        {.thin_wires = ThinWires::uncoupled, .substeps = 10});
    step.fill({{Vec3::Zero(), Vec3(0.32, 0.32, 0.24)}});
    for (int s = 0; s < 1500; ++s) step.advance();
    EXPECT_LT(step.audit().relative(), 1e-10);
    EXPECT_NEAR(step.fluid()->mass_drift(), 0, 1e-10);
    EXPECT_LT(step.solids()->particles().position.z[0], 0.2);    // the heavy one has sunk
    EXPECT_GT(step.solids()->particles().position.z[1], 0.105);  // the light one rises
  }
}

/// Liquid up to a level inside a cell, with a sphere that stands out of it: it has the liquid's volume less that of the
/// sphere below the level, wherever in the cell that is.
TEST(CoupledStep, LiquidIsFilledAroundGrainsThatStandOutOfIt) {
  constexpr double dx = 0.02, radius = 0.03, centre = 0.05, side = 0.2;
  for (const auto weighting : {lbm::BodyWeighting::wall_distance, lbm::BodyWeighting::inertial})
    for (const double level : {0.04, 0.042, 0.044, 0.048, 0.05, 0.052, 0.056, 0.06}) {
      auto fluid = by_distance(tank(Vec3(side, side, side), dx, 1e-3), weighting);
      fluid.gravity = Vec3::Zero();
      CoupledStep<double> step(fluid, grains(fluid, {grain(Vec3(0.1, 0.1, centre), radius, 2500)}),
                               {.thin_wires = ThinWires::uncoupled, .substeps = 10});
      step.fill({{Vec3::Zero(), Vec3(side, side, level)}});
      const double h = level - (centre - radius), cap = std::numbers::pi * h * h * (radius - h / 3);
      const double liquid = step.fluid()->liquid_mass() / 1000;
      EXPECT_NEAR(liquid, side * side * level - cap, 0.05 * cap) << level;
      EXPECT_EQ(step.fluid()->mass_drift(), 0);
    }
}

/// A sphere that lies in the liquid, in cells that end beside it: all of it is displaced, but for what cells that it
/// covers have too much, since they are whole.
TEST(CoupledStep, GrainsThatLieInTheLiquidDisplaceAllOfThemselves) {
  constexpr double dx = 0.02, radius = 0.03;
  auto fluid = by_distance(tank(Vec3(0.2, 0.2, 0.2), dx, 1e-3), lbm::BodyWeighting::inertial);
  fluid.gravity = Vec3::Zero();
  for (const double end : {0.11, 0.112, 0.115, 0.118}) {
    CoupledStep<double> step(fluid, grains(fluid, {grain(Vec3(end - radius, 0.1, 0.05), radius, 2500)}),
                             {.thin_wires = ThinWires::uncoupled, .substeps = 10});
    step.fill({{Vec3::Zero(), Vec3(end, 0.2, 0.1)}});
    const double ball = 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3);
    EXPECT_NEAR(step.fluid()->liquid_mass() / 1000, end * 0.2 * 0.1 - ball, 0.04 * ball) << end;
  }
}

/// A step that adapts is short before a fast grain reaches the water, which rests until then.
TEST(CoupledStep, TheStepKnowsOfGrainsInTheAir) {
  auto fluid = by_distance(tank(Vec3(0.32, 0.32, 0.64), 0.02, 1e-3), lbm::BodyWeighting::inertial);
  fluid.adaptive_time_step = true;
  constexpr double speed = 6;  // 0.3 lu at first
  dem::ParticleSpec boulder = grain(Vec3(0.16, 0.16, 0.5), 0.04, 2500);
  boulder.velocity = Vec3(0, 0, -speed);
  CoupledStep<double> step(fluid, grains(fluid, {boulder}), {.thin_wires = ThinWires::uncoupled, .substeps = 10});
  step.fill({{Vec3::Zero(), Vec3(0.32, 0.32, 0.1)}});
  const auto bottom = [&] { return step.solids()->particles().position.z[0] - 0.04; };
  while (bottom() > 0.12) step.advance();
  EXPECT_LE(step.time_step() * speed / 0.02, 1.5 * fluid.lattice_velocity);
  EXPECT_EQ(step.fluid()->time_step_record().longest, 1e-3) << "it began with the one asked for";
  while (step.time() < 0.2) step.advance();
  EXPECT_LT(step.audit().relative(), 1e-10);
  // Grains that the water does not feel leave its step alone.
  CoupledStep<double> apart(fluid, grains(fluid, {boulder}), {.thin_wires = ThinWires::uncoupled, .substeps = 10},
                            nullptr);
  apart.fill({{Vec3::Zero(), Vec3(0.32, 0.32, 0.1)}});
  for (int s = 0; s < 40; ++s) apart.advance();
  EXPECT_GE(apart.time_step(), 1e-3);
}

/// A drop that hits a dry grain holds a part of a cell, and gives no more than that has.
TEST(CoupledStep, ADropGivesAGrainItsOwnMomentum) {
  constexpr double dx = 0.01, dt = 2e-4, speed = 0.1 * dx / dt, share = 0.3;
  for (const auto weighting : {lbm::BodyWeighting::wall_distance, lbm::BodyWeighting::inertial}) {
    auto fluid = by_distance(tank(Vec3(0.32, 0.16, 0.16), dx, dt), weighting);
    fluid.gravity = Vec3::Zero();
    dem::ParticleSpec target = grain(Vec3(0.2, 0.08, 0.08), 0.04, 2500);
    target.state = dem::ParticleState::fixed;
    CoupledStep<double> step(fluid, grains(fluid, {target}), {.thin_wires = ThinWires::uncoupled, .substeps = 10});
    step.fill(
        {{.lower = Vec3(0.1, 0.08, 0.08), .upper = Vec3(0.1 + share * dx, 0.09, 0.09), .velocity = {speed, 0, 0}}});
    double given = 0;
    for (int s = 0; s < 400; ++s) {
      step.advance();
      given += dt * step.solids()->particles().external_force.x[0];
    }
    const double has = share * 1000 * dx * dx * dx * speed;
    EXPECT_GT(given, 0.2 * has);  // what is left when a covered cell closes again goes with the liquid
    EXPECT_LT(given, 1.3 * has);
  }
}

/// An inflow wets cells that a grain covers, too; what it pushes the grain with is what it brings.
TEST(CoupledStep, AnInflowOverAGrainBringsItsOwnMomentum) {
  for (const auto weighting : {lbm::BodyWeighting::wall_distance, lbm::BodyWeighting::inertial}) {
    auto fluid = by_distance(tank(Vec3(0.32, 0.32, 0.32), 0.02, 2e-4), weighting);
    fluid.gravity = Vec3::Zero();
    constexpr double speed = 1, discharge = 1e-6;
    fluid.inflows.push_back(
        {"spring", Vec3(0.12, 0.12, 0.16), Vec3(0.2, 0.2, 0.2), Vec3(speed, 0, 0), {{{0, discharge}, {1, discharge}}}});
    CoupledStep<double> step(fluid, grains(fluid, {grain(Vec3(0.16, 0.16, 0.16), 0.08, 2500)}),
                             {.thin_wires = ThinWires::uncoupled, .substeps = 10});
    step.fill({});
    const dem::Particles& p = step.solids()->particles();
    for (int s = 0; s < 200; ++s) {
      step.advance();
      EXPECT_LT(p.mass[0] * std::abs(p.velocity.x[0]), 1.1 * step.fluid()->inflow_mass() * speed) << s;
    }
  }
}

/// Force along x in the first step on an upright wire in water that `fill` puts in, with a fixed grain there or none.
double first_drag_on_wire(const lbm::FluidOptions& fluid, const GrainExchangeChoice& exchange,
                          const std::optional<Vec3>& grain_at, const std::function<void(CoupledStep<double>&)>& fill) {
  constexpr std::size_t beads = 21;
  Chains c;
  c.add(straight_line(Vec3(0.32, 0.321, 0.25), Vec3(0.32, 0.321, 0.37), beads), 0.006, false);
  if (grain_at) {
    auto beside = grain(*grain_at, 0.02, 2500);
    beside.state = dem::ParticleState::fixed;
    c.particles.add(beside);
  }
  dem::SolidsOptions options;
  options.gravity = Vec3::Zero();
  options.time_step = 1;  // set by the coupled step
  CoupledStep<double> step(fluid, dem::Solids{std::move(c.particles), std::move(c.bonds), rock(), Walls{}, options},
                           {.grains = exchange, .substeps = 5});
  fill(step);
  step.advance();
  double sum = 0;
  for (std::size_t n = 0; n < beads; ++n) sum += step.solids()->particles().external_force.x[n];
  return sum;
}

/// Grains make the fields of blocks that wires sample in the same step: no sweep has left velocities there yet.
TEST(CoupledStep, AWireBesideGrainsFeelsTheStreamFromTheFirstStep) {
  lbm::FluidOptions fluid = by_distance(stream(32, 0.02, 1e-4));
  fluid.kinematic_viscosity = 1e-6;
  const auto first_drag = [&](const GrainExchangeChoice& exchange, const std::optional<Vec3>& grain_at) {
    return first_drag_on_wire(fluid, exchange, grain_at, [](CoupledStep<double>& step) {
      step.fluid()->fill_everything([](const Vec3&) { return Vec3(0.01, 0, 0); }, [](const Vec3&) { return 0.0; });
    });
  };
  const Vec3 far(0.45, 0.36, 0.31);
  const double alone = first_drag(ResolvedGrains{}, std::nullopt);
  EXPECT_GT(alone, 1);
  EXPECT_NEAR(first_drag(ResolvedGrains{}, far), alone, 0.02 * alone);
  EXPECT_NEAR(first_drag(AveragedGrains{.averaging_length = 0.15}, far), alone, 0.05 * alone);
}

/// So does one in a scene, whose grains are put in as it is filled.
TEST(CoupledStep, AWireBesideGrainsFeelsWaterThatBeginsInMotion) {
  lbm::FluidOptions fluid = by_distance(tank(Vec3(0.64, 0.64, 0.64), 0.02, 1e-4), lbm::BodyWeighting::inertial);
  fluid.gravity = Vec3::Zero();
  fluid.kinematic_viscosity = 1e-6;
  const auto first_drag = [&](const std::optional<Vec3>& grain_at) {
    return first_drag_on_wire(fluid, ResolvedGrains{}, grain_at, [](CoupledStep<double>& step) {
      step.fill({{Vec3::Zero(), Vec3(0.64, 0.64, 0.56), Vec3(2, 0, 0)}});
    });
  };
  const double alone = first_drag(std::nullopt);
  EXPECT_GT(alone, 1);
  EXPECT_NEAR(first_drag(Vec3(0.42, 0.36, 0.31)), alone, 0.05 * alone);
}

/// A free wire in a stream, and two grains with a film between them elsewhere: what acts on the wire beside the liquid
/// is nothing, as its bonds cancel.
TEST(CoupledStep, ForcesAfterFilmsContainTheMeanDragOfTheStep) {
  lbm::FluidOptions fluid = by_distance(stream(32, 0.02, 1e-4));
  fluid.kinematic_viscosity = 1e-6;
  for (const GrainFilms films : {GrainFilms::none, GrainFilms::lubrication}) {
    Chains c;
    c.add(straight_line(Vec3(0.4, 0.25, 0.4), Vec3(0.4, 0.4, 0.4), 31), 0.005, false, dem::ParticleState::free, 1500);
    const std::size_t beads = c.particles.size();
    c.particles.add(grain({0.1, 0.1, 0.1}, 0.04, 2500));
    c.particles.add(grain({0.185, 0.1, 0.1}, 0.04, 2500));
    dem::SolidsOptions options;
    options.gravity = Vec3::Zero();
    options.time_step = 1;  // set by the coupled step
    CoupledStep<double> step(fluid, dem::Solids{std::move(c.particles), std::move(c.bonds), rock(), Walls{}, options},
                             {.films = films, .substeps = 10});
    step.fluid()->fill_everything([](const Vec3&) { return Vec3(0.01, 0, 0); }, [](const Vec3&) { return 0.0; });
    for (int n = 0; n < 3; ++n) {
      step.advance();
      const dem::Particles& p = step.solids()->particles();
      Vec3 drag = Vec3::Zero(), rest = Vec3::Zero();
      for (dem::ParticleId id = 0; id < beads; ++id) {
        const dem::ParticleIndex i = p.index(id);
        drag += p.external_force[i], rest += p.force[i] - p.external_force[i];
      }
      ASSERT_GT(drag.x(), 0.1);
      EXPECT_LT(rest.norm(), 1e-9 * drag.norm()) << n;
    }
  }
}

/// Light spheres of a cell to three rise through water at rest, with every weighting. Interior inertia beyond what is
/// entrained made them spin, and then threw them out at hundreds of m/s.
TEST(CoupledStep, SmallLightSpheresRise) {
  for (const auto weighting :
       {lbm::BodyWeighting::solid_fraction, lbm::BodyWeighting::wall_distance, lbm::BodyWeighting::inertial})
    for (const double density : {600.0, 100.0})
      for (const double radius : {0.006, 0.01, 0.02, 0.03}) {
        auto fluid = tank(Vec3(0.32, 0.32, 0.32), 0.02, 2e-4);
        if (lbm::by_wall_distance(weighting)) fluid = by_distance(fluid, weighting);
        CoupledStep<double> step(fluid, grains(fluid, {grain(Vec3(0.2, 0.11, 0.1), radius, density)}),
                                 {.grains = ResolvedGrains{0}, .thin_wires = ThinWires::uncoupled, .substeps = 10});
        step.fill({{Vec3::Zero(), Vec3(0.32, 0.32, 0.24)}});
        for (int s = 0; s < 600; ++s) step.advance();
        const dem::Particles& p = step.solids()->particles();
        EXPECT_GT(p.position.z[0], 0.1) << density << ", " << radius;
        EXPECT_LT(p.position.z[0], 0.2) << density << ", " << radius;
        EXPECT_LT(p.velocity[0].norm(), 1.0) << density << ", " << radius;
        EXPECT_LT(p.angular_velocity[0].norm(), 50) << density << ", " << radius;
      }
}

/// A heap of small grains about as dense as the liquid, or half as heavy again, in liquid that is viscous. What their
/// contacts jolt out of the liquid between them, spared as interior inertia, drove them on, and so did that of their
/// spin: at metres a second. (Of 2 cells and as dense as the liquid they still win some, docs/decisions/0110.)
TEST(CoupledStep, SmallGrainsInViscousLiquidStayCalm) {
  struct Heap {
    double viscosity, radius, density;
    lbm::BodyWeighting weighting;
  };
  using enum lbm::BodyWeighting;
  for (const Heap& h : {Heap{1e-3, 0.015, 1000, wall_distance}, Heap{1e-2, 0.01875, 1000, wall_distance},
                        Heap{1e-1, 0.01875, 1500, wall_distance}, Heap{1e-2, 0.0225, 1000, inertial},
                        Heap{1e-1, 0.01875, 1500, inertial}}) {
    auto fluid = by_distance(tank(Vec3(0.24, 0.24, 0.3), 0.015, 6.5e-4), h.weighting);
    fluid.kinematic_viscosity = h.viscosity, fluid.smagorinsky = 0;
    std::vector<dem::ParticleSpec> heap;
    for (int k = 0; k < 100; ++k)
      heap.push_back(grain(
          Vec3(0.03 + 2.02 * h.radius * (k % 5) + 0.002 * std::sin(7.0 * k),
               0.03 + 2.02 * h.radius * (k / 5 % 5) + 0.002 * std::cos(5.0 * k), h.radius * (1 + 2.01 * (k / 25))),
          h.radius, h.density));
    CoupledStep<float> step(fluid, grains(fluid, heap, true),
                            {.grains = ResolvedGrains{0}, .thin_wires = ThinWires::uncoupled, .substeps = 20});
    step.fill({{Vec3::Zero(), Vec3(0.24, 0.24, 0.27)}});
    for (int s = 0; s < 700; ++s) step.advance();
    const double work = step.solids()->ledger().external_work;
    EXPECT_LT(work, 1e-3) << h.viscosity << ", " << h.radius << ", " << h.density;
  }
}

/// Light spheres of 3 to 4 cells, packed in water, push at each other and come up. What the exchange does not move at
/// once, spared as interior inertia, threw them about in such contacts: at 0.8 of the density at 5 m/s, at 0.3 until
/// the fluid failed.
TEST(CoupledStep, LightSpheresThatTouchStayCalm) {
  for (const double density : {800.0, 300.0})
    for (const double radius : {0.03, 0.04}) {
      const auto fluid = by_distance(tank(Vec3(0.32, 0.32, 0.48), 0.02, 5e-4));
      std::vector<dem::ParticleSpec> bed;
      for (int k = 0; k < 36; ++k)
        bed.push_back(grain(Vec3(0.06 + 0.1 * (k % 3) + 0.01 * std::sin(7.0 * k),
                                 0.06 + 0.1 * (k / 3 % 3) + 0.01 * std::cos(5.0 * k), 0.06 + 2.01 * radius * (k / 9)),
                            radius, density));
      CoupledStep<float> step(fluid, grains(fluid, bed, true),
                              {.grains = ResolvedGrains{0}, .thin_wires = ThinWires::uncoupled, .substeps = 10});
      step.fill({{Vec3::Zero(), Vec3(0.32, 0.32, 0.36)}});
      double fastest = 0;
      for (int s = 0; s < 800; ++s) {
        step.advance();
        const dem::Particles& p = step.solids()->particles();
        for (std::size_t i = 0; i < p.size(); ++i) fastest = std::max(fastest, p.velocity[i].norm());
      }
      EXPECT_LT(fastest, 1) << density << ", " << radius;
    }
}

/// Water falls off a heap of fixed spheres. While it does they bear a part of what is left (by `wall_distance` two
/// thirds, by `inertial` four fifths); in the end nothing clings to them and nothing bears on them: films of less than
/// a cell are not resolved. Cells that they cover open and close by turns meanwhile. Covered cells that turned wet at
/// their neighbours' velocity brought momentum from nowhere, every other step: six times a full cell's. With a soft
/// exchange they win momentum while they are wet; where that was lost as they turned dry, the spheres were lifted by as
/// much. Where those that closed gave their liquid to their neighbours, and all cells of the surface paid for those
/// that opened, 0.4 to 0.8 kg clung to the spheres for ever.
void expect_that_drained_spheres_bear_what_clings(lbm::BodyWeighting weighting) {
  auto fluid = by_distance(tank(Vec3(0.48, 0.48, 0.96), 0.02, 3e-4), weighting);
  fluid.kinematic_viscosity = 1e-6;
  fluid.smagorinsky = 0.16;
  std::vector<dem::ParticleSpec> heap;
  for (int k = 0; k < 27; ++k) {
    const Vec3 jitter(0.012 * std::sin(7.0 * k), 0.012 * std::cos(5.0 * k), 0.012 * std::sin(3.0 * k));
    heap.push_back(
        grain(Vec3(0.17 + 0.07 * (k % 3), 0.17 + 0.07 * (k / 3 % 3), 0.53 + 0.07 * (k / 9)) + jitter, 0.03, 2500));
    heap.back().state = dem::ParticleState::fixed;
  }
  CoupledStep<float> step(fluid, grains(fluid, heap),
                          {.grains = ResolvedGrains{-0.2}, .thin_wires = ThinWires::uncoupled, .substeps = 1});
  step.fill({{Vec3(0.1, 0.1, 0.48), Vec3(0.38, 0.38, 0.72)}});
  Vec3 force = Vec3::Zero();
  double weight = 0;
  const auto advance_to = [&](double time) {
    force = Vec3::Zero(), weight = 0;
    int steps = 0;
    for (; step.time() < time; ++steps) {
      step.advance();
      const dem::Particles& p = step.solids()->particles();
      for (std::size_t i = 0; i < p.size(); ++i) force += p.external_force[i];
      step.fluid()->for_each_wet_cell(
          [&](const auto& c) { weight += c.centre.z() > 0.45 ? c.liquid_volume * 9810 : 0; });
    }
    force /= steps, weight /= steps;
  };
  advance_to(0.2);
  advance_to(0.3);
  std::printf("    as it drains, spheres bear %.2f of what is left\n", -force.z() / weight);
  EXPECT_NEAR(-force.z() / weight, 0.75, 0.45);
  EXPECT_LT(Vec3(force.x(), force.y(), 0).norm(), 0.1 * weight);
  advance_to(0.8);
  advance_to(1.0);
  constexpr double of_their_cells = 20;  // N, the liquid of all cells that the spheres cover in part, if full
  EXPECT_LT(weight, 0.02 * of_their_cells);
  EXPECT_LT(force.norm(), 0.02 * of_their_cells);
  EXPECT_LT(step.audit().relative(), 1e-5);  // in single precision
}

TEST(CoupledStep, DrainedSpheresBearWhatClingsToThem) {
  expect_that_drained_spheres_bear_what_clings(lbm::BodyWeighting::wall_distance);
  expect_that_drained_spheres_bear_what_clings(lbm::BodyWeighting::inertial);
}

/// A body with a flat top, cells of the lattice that it covers whole, under less water than a cell is high: it bears
/// the water's weight and that of the water in its own place, and not that of full cells.
TEST(CoupledStep, AFilmBearsWithItsOwnWeight) {
  constexpr int height = 4;  // of the body, cells
  constexpr double g = 1e-5;
  for (const double depth : {0.2, 0.4, 0.6, 0.8}) {
    auto fluid = by_distance(tank(Vec3(8, 8, 16), 1, 1));
    for (const std::size_t side : {0, 1, 2, 3}) fluid.domain.faces[side] = lbm::FaceKind::periodic;
    fluid.gravity = Vec3(0, 0, -g);
    fluid.kinematic_viscosity = 0.01;
    CoupledStep<double> step(fluid, grains(fluid, {}), {.thin_wires = ThinWires::uncoupled});
    step.fill({{Vec3::Zero(), Vec3(8, 8, height + depth)}});
    step.set_field_writer([&](lbm::Fluid<double>& f, SolidFields<double>& owner) {
      for (const lbm::BlockIndex b : f.grid().owned()) {
        auto& fields = owner.write_over(f.grid(), b);
        for (int n = 0; n < lbm::kBlockCells; ++n) {
          const double z = f.grid().centre(b, n).z() - height;
          fields.exchange_weight[n] = fields.drag[n] = z < 0 ? 1e12 : z < 1 ? 1e-6 : 0;
          fields.covered[static_cast<std::size_t>(n / 8)] |= static_cast<std::uint8_t>((z < 0) << n % 8);
        }
      }
    });
    for (int s = 0; s < 4000; ++s) step.advance();
    // The floor bears what is pressure in the body's lowest cells.
    auto& grid = const_cast<lbm::FluidGrid<double>&>(step.fluid()->grid());
    const int first = lbm::cell_index(0, 0, 1);  // below it is wall
    double on_floor = 0;
    for (int i = 1; i < lbm::D3Q19::q; i += 2)
      if (const int c = lbm::D3Q19::c[i][2]; c != 0) {
        const auto pair = grid.access({grid.owned().front(), first}, i, step.fluid()->parity());
        on_floor += 64 * (c < 0 ? *pair.outgoing_a + *pair.incoming_b : *pair.outgoing_b + *pair.incoming_a);
      }
    step.advance();
    const double on_body = -momentum_given_to_bodies(step.fluid()->grid()).z();
    EXPECT_NEAR((on_body + on_floor) / (64 * g) - height, depth, 0.02);
  }
}

/// A porous body stands in the interface cells of a stream and covers none: it gets what their liquid loses in a step.
TEST(CoupledStep, ABodyInInterfaceCellsGetsWhatTheirLiquidLoses) {
  constexpr double u = 0.02, drag = 50;
  constexpr int depth = 8;
  for (const double level : {0.25, 0.75}) {
    auto fluid = by_distance(tank(Vec3(8, 8, 24), 1, 1));
    for (const std::size_t side : {0, 1, 2, 3}) fluid.domain.faces[side] = lbm::FaceKind::periodic;
    fluid.gravity = Vec3::Zero();
    fluid.kinematic_viscosity = 0.01;
    CoupledStep<double> step(fluid, grains(fluid, {}), {.thin_wires = ThinWires::uncoupled});
    step.fill({{Vec3::Zero(), Vec3(8, 8, depth + level), Vec3(u, 0, 0)}});
    step.set_field_writer([&](lbm::Fluid<double>& f, SolidFields<double>& owner) {
      for (const lbm::BlockIndex b : f.grid().owned()) {
        auto& fields = owner.write_over(f.grid(), b);
        for (int n = 0; n < lbm::kBlockCells; ++n)
          fields.exchange_weight[n] = fields.drag[n] = f.grid().centre(b, n).z() > depth ? drag : 0;
      }
    });
    step.advance();
    double momentum = 0;
    step.fluid()->for_each_wet_cell([&](const lbm::WetCell& c) {
      if (c.centre.z() > depth) momentum += c.fill_level * c.velocity.x();
    });
    const double lost = 64 * level * u - momentum;
    EXPECT_GT(lost, 0.1 * 64 * level * u);
    EXPECT_NEAR(momentum_given_to_bodies(step.fluid()->grid()).x(), lost, 1e-3 * lost) << level;
  }
}

/// A heavy sphere in water starts with (rho_s - rho) / (rho_s + rho/2) g: buoyancy and added mass. At 8 cells a
/// diameter and B = eps it is some 30 % too slow (0.69 of it found after 0.05 s); without buoyancy it would be 1.7
/// times as fast.
TEST(CoupledStep, SphereStartsWithAddedMass) {
  const auto fluid = tank(Vec3(0.64, 0.64, 0.64), 0.02, 2e-4);
  CoupledStep<double> step(fluid, grains(fluid, {grain(Vec3(0.32, 0.32, 0.4), 0.08, 2500)}),
                           {.thin_wires = ThinWires::uncoupled, .substeps = 10});
  step.fill({{Vec3::Zero(), Vec3(0.64, 0.64, 0.6)}});
  for (int s = 0; s < 250; ++s) step.advance();
  const double expected = 9.81 * 1500 / 3000 * step.time();
  EXPECT_NEAR(-step.solids()->particles().velocity.z[0] / expected, 0.7, 0.05);
}

/// Deep in water at rest a sphere of density s, pulled by a s on its own mass, starts with s / (s + 1/2) of that: the
/// liquid in its place is no inertia of its own, and the liquid around answers with half of its volume. With a force
/// that came back a step late a light body would be thrown out with ever growing swings.
TEST(CoupledStep, LightSphereStartsWithAddedMass) {
  for (const double s : {0.1, 0.25, 0.5, 2.0}) {
    lbm::FluidOptions fluid = stream(32, 1, 1);
    fluid.kinematic_viscosity = 1e-4;
    fluid = by_distance(fluid);
    dem::SolidsOptions options;
    options.gravity = Vec3(0, 0, -1e-5);
    options.time_step = 1;
    dem::Particles particles;
    particles.add(grain(Vec3(16.2, 15.9, 16.3), 4, s * fluid.density));
    CoupledStep<double> step(fluid, dem::Solids(std::move(particles), dem::Bonds{}, rock(), Walls{}, options),
                             {.thin_wires = ThinWires::uncoupled});
    step.fluid()->fill_everything([](const Vec3&) { return Vec3(Vec3::Zero()); }, [](const Vec3&) { return 0.0; });
    while (step.steps() < 100) step.advance();
    // Stairs of cells, a boundary layer of a cell and the first steps of the force take their part; a start is a jolt,
    // of which very light bodies get less.
    const double share = -step.solids()->particles().velocity.z[0] / (100 * 1e-5 * s / (s + 0.5));
    EXPECT_NEAR(share, s < 0.3 ? 0.75 : 0.85, 0.1) << s;
    EXPECT_LT(step.solids()->particles().angular_velocity[0].norm(), 1e-4);
  }
}

TEST(CoupledStep, RunsWithFluidAloneAndSolidsAlone) {
  const auto fluid = tank(Vec3(0.32, 0.16, 0.32), 0.02, 2e-4);
  CoupledStep<float> water(fluid, std::nullopt, {});
  water.fill({{Vec3::Zero(), Vec3(0.1, 0.16, 0.2)}});
  for (int s = 0; s < 20; ++s) water.advance();
  EXPECT_NEAR(water.time(), 20 * 2e-4, 1e-12);
  CoupledStep<float> stone(std::nullopt, grains(fluid, {grain(Vec3(0, 0, 10), 0.04, 2500)}), {.substeps = 10});
  for (int s = 0; s < 100; ++s) stone.advance();
  EXPECT_NEAR(stone.solids()->particles().velocity.z[0], -9.81 * stone.time(), 1e-9);
  EXPECT_THROW((CoupledStep<float>(std::nullopt, std::nullopt, {})), std::logic_error);
}

/// Every cell as if a body at rest stood there: the stream comes to rest, and goes on where nothing is written.
TEST(CoupledStep, FieldWriterActsInEveryStep) {
  lbm::FluidOptions fluid = stream(16, 1, 1);
  fluid.kinematic_viscosity = 0.05;
  fluid.gravity = Vec3::Zero();
  for (const bool writes : {true, false}) {
    CoupledStep<double> step(fluid, grains(fluid, {grain(Vec3(8, 8, 8), 0.5, 1000)}),
                             {.thin_wires = ThinWires::uncoupled});
    step.fluid()->fill_everything([](const Vec3&) { return Vec3(0.05, 0, 0); }, [](const Vec3&) { return 0.0; });
    int calls = 0;
    if (writes)
      step.set_field_writer([&](lbm::Fluid<double>& f, SolidFields<double>& owner) {
        ++calls;
        for (const lbm::BlockIndex b : f.grid().owned()) {
          auto& fields = owner.write_over(f.grid(), b);
          std::fill_n(fields.exchange_weight, lbm::kBlockCells, 1.0);
          std::fill_n(fields.drag, lbm::kBlockCells, 0.1);
        }
      });
    for (int s = 0; s < 100; ++s) step.advance();
    EXPECT_EQ(calls, writes ? 100 : 0);
    EXPECT_NEAR(step.fluid()->max_speed_lu(), writes ? 0 : 0.05, 0.01);
  }
}

/// The fluid's step changes under way: the sub-steps stay whole and short, and the stone sinks as without.
TEST(CoupledStep, FollowsTheFluidsTimeStep) {
  const auto end = [](bool changes) {
    const auto fluid = tank(Vec3(0.32, 0.32, 0.48), 0.02, 2e-4);
    CoupledStep<double> step(fluid, grains(fluid, {grain(Vec3(0.15, 0.16, 0.2), 0.04, 2500)}),
                             {.thin_wires = ThinWires::uncoupled, .substeps = 10});
    step.fill({{Vec3::Zero(), Vec3(0.32, 0.32, 0.3)}});
    for (double factor = 1.25; step.time() < 0.1 - 1e-9; step.advance()) {
      if (!changes || step.steps() % 100 != 50) continue;
      step.fluid()->set_time_step(factor * step.fluid()->units().time_step);
      factor = 1 / factor;
    }
    EXPECT_LE(step.solids()->options().time_step, 2e-5 * (1 + 1e-12));
    EXPECT_NEAR(step.solids()->time(), step.time(), 1e-12);
    EXPECT_LT(step.audit().relative(), 1e-10);
    EXPECT_LT(std::abs(step.fluid()->mass_drift()), 1e-10);
    return step.solids()->particles().velocity.z[0];
  };
  const double alone = end(false);
  EXPECT_LT(alone, -0.1);
  EXPECT_NEAR(end(true) / alone, 1, 0.02);
}

TEST(CoupledStep, SameResultWithAnyNumberOfThreads) {
  const auto end = [](int threads, bool inertial) {
    const ThreadLimit limit(threads);
    auto fluid = tank(Vec3(0.32, 0.32, 0.48), 0.02, 2e-4);
    if (inertial) fluid = by_distance(fluid, lbm::BodyWeighting::inertial);
    std::vector<dem::ParticleSpec> specs;
    for (int k = 0; k < 27; ++k)
      specs.push_back(grain(Vec3(0.08 + 0.07 * (k % 3), 0.08 + 0.07 * (k / 3 % 3), 0.1 + 0.08 * (k / 9)), 0.03, 2500));
    CoupledStep<float> step(fluid, grains(fluid, specs), {.thin_wires = ThinWires::uncoupled, .substeps = 10});
    step.fill({{Vec3::Zero(), Vec3(0.32, 0.32, 0.2)}});
    for (int s = 0; s < 200; ++s) step.advance();
    return step.solids()->particles().position.z;
  };
  for (const bool inertial : {false, true}) EXPECT_EQ(end(1, inertial), end(2, inertial));
}

}  // namespace
}  // namespace lahar::coupling
