#include "coupling/wires/wire_drag.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "coupling/coupled_step.h"
#include "coupling/wires/drag_law.h"
#include "tests/coupling/chains.h"

namespace lahar::coupling {
namespace {

/// A straight wire of touching beads along an axis, through the middle of a box.
struct StraightWire {
  dem::Particles particles;
  dem::Bonds bonds;
  StraightWire(int beads, double diameter, const Vec3& start, const Vec3& along,
               dem::ParticleState state = dem::ParticleState::fixed) {
    dem::BondSort sort;
    sort.axial.stiffness = {1e9, 1e9, 1e9};
    sort.bond_radius = diameter / 2;
    bonds.add_sort(sort);
    for (int k = 0; k < beads; ++k) {
      auto bead = grain(start + k * diameter * along, diameter / 2, 7800);
      bead.kind = dem::ParticleKind::bead;
      bead.state = state;
      particles.add(bead);
      if (k > 0) bonds.add({static_cast<dem::ParticleIndex>(k - 1), static_cast<dem::ParticleIndex>(k), 0}, particles);
    }
  }
};

constexpr int kKicks = 20;  // of the wire in a step of the fluid

/// As in a step of the coupling: nothing else is written into the fields. `move` is called after each kick of the wire,
/// with its length in s. `held`: what holds a wire that could move bears its drag.
template <class Real, class Move>
ExchangedMomentum apply(WireDrag<Real>& drag, lbm::Fluid<Real>& fluid, StraightWire& wire, SolidFields<Real>& fields,
                        bool held, const Move& move) {
  fields.open(fluid.grid());
  wire.particles.external_force.fill(Vec3::Zero());
  std::vector<dem::LiquidDrag> drags;
  const ExchangedMomentum given = drag.apply(fluid, wire.particles, fields, drags);
  fields.close(fluid.grid());
  dem::begin_drags(drags, wire.particles);
  const double kick = fluid.units().time_step / kKicks;
  for (int n = 0; n < kKicks; ++n) {
    wire.particles.force.fill(Vec3::Zero());
    for (const dem::LiquidDrag& d : drags)
      if (held) wire.particles.force.add(d.particle, -d.force);  // what holds it
    dem::add_drags(drags, wire.particles, kick);
    move(kick);
  }
  dem::note_mean_drags(drags, wire.particles, fluid.units().time_step);
  drag.collect(drags);
  return given;
}

/// Of a wire that is held.
template <class Real>
ExchangedMomentum apply(WireDrag<Real>& drag, lbm::Fluid<Real>& fluid, StraightWire& wire, SolidFields<Real>& fields) {
  return apply(drag, fluid, wire, fields, true, [](double) {});
}

Vec3 sum_of_forces(const StraightWire& wire) {
  Vec3 sum = Vec3::Zero();
  for (dem::ParticleIndex i = 0; i < wire.particles.size(); ++i) sum += wire.particles.external_force[i];
  return sum;
}

/// Force per length of a wire across and along a uniform stream, right after the start: the law itself.
TEST(WireDrag, FollowsTheLaw) {
  const double d = 0.006, u = 2.0, nu = 1e-6, length = 20 * d;
  for (const bool across : {true, false}) {
    lbm::Fluid<double> fluid(stream(16, 0.02, 1e-4));
    fluid.fill_everything([&](const Vec3&) { return Vec3(u * 1e-4 / 0.02, 0, 0); }, [](const Vec3&) { return 0.0; });
    StraightWire wire(21, d, Vec3(0.1, 0.161, 0.1), across ? Vec3(0, 0, 1) : Vec3(1, 0, 0));
    WireDrag<double> drag(wire.particles, wire.bonds);
    SolidFields<double> fields;
    apply(drag, fluid, wire, fields);
    Vec3 force = Vec3::Zero();
    for (std::size_t i = 0; i < wire.particles.size(); ++i) force += wire.particles.external_force[i];
    const double speed = across ? undisturbed_speed(u, {.diameter = d, .diameter_cells = d / 0.02, .fluid = {nu}}) : u,
                 re = across ? speed * d / nu : 0.0;
    const double coefficient = across ? normal_drag_coefficient(re) : tangential_drag_coefficient(re, u * d / nu);
    EXPECT_NEAR(force.x() / (0.5 * 1000 * d * length * coefficient * speed * speed), 1, 0.02);
    EXPECT_NEAR(force.y() / force.x(), 0, 1e-9);
  }
}

/// Slower than the creep speed mud flows at its limit viscosity: both parts of the drag fade with the speed.
TEST(WireDrag, FollowsTheLawWhereMudCreeps) {
  const double d = 0.006, cell = 0.02, dt = 1e-6, length = 20 * d;
  lbm::FluidOptions options = stream(16, cell, dt);
  options.density = 2000;
  options.kinematic_viscosity = 0.05;
  options.rheology.law = lbm::FlowLaw::bingham;
  options.rheology.yield_stress = 500, options.rheology.limit_viscosity = 1;
  const WireInCells mud{.diameter = d,
                        .diameter_cells = d / cell,
                        .fluid = lbm::shear_law(options.rheology, options.kinematic_viscosity, options.density)};
  const double creep = yield_drag(mud, 1e-3).creep_speed;
  for (const double share : {0.02, 0.1, 0.5, 3.0}) {
    const double sampled = share * creep;
    lbm::Fluid<double> fluid(options);
    fluid.fill_everything([&](const Vec3&) { return Vec3(sampled * dt / cell, 0, 0); },
                          [](const Vec3&) { return 0.0; });
    StraightWire wire(21, d, Vec3(0.1, 0.161, 0.1), Vec3(0, 0, 1));
    WireDrag<double> drag(wire.particles, wire.bonds);
    SolidFields<double> fields;
    apply(drag, fluid, wire, fields);
    const double u = undisturbed_speed(sampled, mud);
    const double law =
        viscous_drag(mud, u * Vec3::UnitX(), Vec3::Zero()).x() + yield_drag(mud, u).across * u / (u + creep);
    EXPECT_NEAR(sum_of_forces(wire).x() / (options.density * length * law), 1, 0.05) << share;
  }
}

/// Thick liquid at rest leaves its collisions with half a step of gravity, which drags at no wire: each bead, at the
/// ends too, is lifted by the weight of the liquid in the place of its sphere alone.
TEST(WireDrag, LiquidAtRestLiftsAlone) {
  const double d = 0.006;
  lbm::FluidOptions options = tank(Vec3(0.32, 0.32, 0.32), 0.02, 2e-4);
  options.kinematic_viscosity = 1e-3;
  lbm::Fluid<double> fluid(options);
  fluid.fill({{Vec3::Zero(), Vec3(0.32, 0.32, 0.3)}});
  StraightWire wire(11, d, Vec3(0.13, 0.161, 0.15), Vec3::UnitX());
  WireDrag<double> drag(wire.particles, wire.bonds);
  SolidFields<double> fields;
  const double weight = 1000 * 9.81 * std::numbers::pi / 6 * d * d * d;
  for (int n = 0; n < 2; ++n) {  // before and after a sweep has left its velocities
    if (n > 0) fluid.step();
    apply(drag, fluid, wire, fields);
    for (const dem::ParticleIndex i : {0U, 5U, 10U})
      EXPECT_NEAR(wire.particles.external_force[i].z(), weight, 2e-3 * weight) << n << ' ' << i;
  }
  std::vector<std::uint8_t> mapped(10, 0);
  mapped[4] = 1;  // the piece lifts half of each of its beads
  drag.leave_out(wire.bonds, mapped);
  fluid.step();
  apply(drag, fluid, wire, fields);
  for (const dem::ParticleIndex i : {3U, 4U, 5U, 6U})
    EXPECT_NEAR(wire.particles.external_force[i].z(), i == 4 || i == 5 ? weight / 2 : weight, 0.01 * weight) << i;
}

/// Beads weigh as spheres and are lifted as such: a free wire of 1.3 times the water's density sinks in still water, by
/// 0.23 g at first, as torn ends of it do. By the volume of a cylinder it would rise.
TEST(WireDrag, AWireThatIsDenserThanTheWaterSinks) {
  lbm::FluidOptions fluid = tank(Vec3(0.32, 0.32, 0.32), 0.02, 2e-4);
  fluid.kinematic_viscosity = 1e-6;
  Chains c;
  c.add(straight_line(Vec3(0.1, 0.161, 0.2), Vec3(0.1 + 19 * 0.006, 0.161, 0.2), 20), 0.006, false,
        dem::ParticleState::free, 1300);
  c.bonds.intact[1] = 0;
  dem::SolidsOptions options;
  options.gravity = fluid.gravity;
  options.time_step = fluid.time_step / 40;
  CoupledStep<double> step(fluid, dem::Solids(c.particles, c.bonds, rock(), {}, options), {.substeps = 40});
  step.fill({{Vec3::Zero(), Vec3(0.32, 0.32, 0.3)}});
  while (step.time() < 0.03) step.advance();
  const double free_of_drag = 0.3 / 1.3 * 9.81 * step.time();
  for (const std::size_t i : {0U, 1U, 10U, 19U}) {
    EXPECT_LT(step.solids()->particles().velocity.z[i], -0.5 * free_of_drag) << i;
    EXPECT_GT(step.solids()->particles().velocity.z[i], -1.05 * free_of_drag) << i;
  }
}

/// What a wire takes its liquid to do is the same when the step of the fluid changes: the cells give the same impulse.
TEST(WireDrag, KnowsItsLiquidWhenTheStepChanges) {
  const double d = 0.006, dt = 2e-4;
  const auto liquid_of = [&](double factor) {
    lbm::FluidOptions options = tank(Vec3(0.32, 0.32, 0.32), 0.02, dt);
    options.kinematic_viscosity = 1e-3;
    options.gravity = Vec3::Zero();
    lbm::Fluid<double> fluid(options);
    fluid.fill_everything([](const Vec3&) { return Vec3(Vec3::Zero()); }, [](const Vec3&) { return 0.0; });
    StraightWire wire(11, d, Vec3(0.13, 0.161, 0.15), Vec3::UnitX());
    wire.particles.velocity.fill(Vec3(0, 1, 0));
    WireDrag<double> drag(wire.particles, wire.bonds);
    SolidFields<double> fields;
    apply(drag, fluid, wire, fields);
    fluid.step();
    fluid.set_time_step(factor * dt);
    fields.open(fluid.grid());
    std::vector<dem::LiquidDrag> drags;
    drag.apply(fluid, wire.particles, fields, drags);
    fields.close(fluid.grid());
    return drags[5].liquid.y();
  };
  const double same = liquid_of(1);
  EXPECT_GT(same, 1e-4);
  for (const double factor : {0.5, 1.1}) EXPECT_NEAR(liquid_of(factor) / same, 1, 1e-9) << factor;
}

/// Where a wire has torn, its ends lie as the piece that they are on: the rest may be anywhere.
TEST(WireDrag, TornEndsLieAlongTheirOwnPiece) {
  const double d = 0.006;
  const auto force_at_end = [&](const Vec3& rest) {
    lbm::Fluid<double> fluid(stream(16, 0.02, 1e-4));
    fluid.fill_everything([](const Vec3&) { return Vec3(0.01, 0, 0); }, [](const Vec3&) { return 0.0; });
    StraightWire wire(3, d, Vec3(0.1, 0.161, 0.1), Vec3::UnitZ());
    WireDrag<double> drag(wire.particles, wire.bonds);
    wire.bonds.intact[1] = 0;
    wire.particles.position.set(2, wire.particles.position[2] + rest);
    SolidFields<double> fields;
    drag.follow_breakage(wire.bonds);
    apply(drag, fluid, wire, fields);
    return Vec3(wire.particles.external_force[1]);
  };
  const Vec3 whole = force_at_end(Vec3::Zero()), torn = force_at_end(Vec3(0.15, 0, 0));
  EXPECT_GT(whole.x(), 1e-3);
  EXPECT_NEAR(torn.x() / whole.x(), 1, 0.01);
}

/// A bead that nothing holds has no axis: streams along x and along y drag it alike.
TEST(WireDrag, ALooseBeadHasNoAxis) {
  const auto force_in = [](const Vec3& stream_velocity) {
    lbm::Fluid<double> fluid(stream(16, 0.02, 1e-4));
    fluid.fill_everything([&](const Vec3&) { return stream_velocity; }, [](const Vec3&) { return 0.0; });
    StraightWire wire(3, 0.006, Vec3(0.1, 0.161, 0.1), Vec3::UnitX());
    WireDrag<double> drag(wire.particles, wire.bonds);
    wire.bonds.intact[0] = wire.bonds.intact[1] = 0;
    SolidFields<double> fields;
    drag.follow_breakage(wire.bonds);
    apply(drag, fluid, wire, fields);
    return Vec3(wire.particles.external_force[1]);
  };
  const double along_x = force_in(Vec3(0.01, 0, 0)).x(), along_y = force_in(Vec3(0, 0.01, 0)).y();
  EXPECT_GT(along_x, 1e-3);
  EXPECT_NEAR(along_y / along_x, 1, 0.01);
}

// Beside a bed that slips there is as much water around the wire as far from it, whichever blocks exist.
TEST(WireDrag, AWireOnTheBedIsAllInTheWater) {
  const double d = 0.006, u = 1.0, dt = 1e-4;
  const auto force = [&](double height) {
    lbm::FluidOptions options = stream(16, 0.02, dt);
    options.domain.faces[4] = options.domain.faces[5] = lbm::FaceKind::closed;
    options.domain.slip = WallSlip::free_slip;
    lbm::Fluid<double> fluid(options);
    fluid.fill_everything([&](const Vec3&) { return Vec3(u * dt / 0.02, 0, 0); }, [](const Vec3&) { return 0.0; });
    StraightWire wire(21, d, Vec3(0.161, 0.1, height), Vec3::UnitY());
    WireDrag<double> drag(wire.particles, wire.bonds);
    SolidFields<double> fields;
    apply(drag, fluid, wire, fields);
    double sum = 0;
    for (std::size_t i = 0; i < wire.particles.size(); ++i) sum += wire.particles.external_force.x[i];
    return sum;
  };
  const double middle = force(0.161);
  for (const double height : {0.003, 0.006, 0.01, 0.014, 0.02, 0.03})
    EXPECT_NEAR(force(height) / middle, 1, 0.03) << height;
}

// 6 mm of wire in water at 1 m/s: force along it per metre, at angles to the stream, by Choo & Casarella's law; along
// the stream the friction of the surface is left.
TEST(WireDrag, AlongTheWireIsLinearInTheSpeedAlong) {
  constexpr double d = 0.006, nu = 1e-6, rho = 1000;
  const auto along = [&](double degrees) {
    const double ut = std::cos(degrees * std::numbers::pi / 180), un = std::sin(degrees * std::numbers::pi / 180);
    return 0.5 * rho * d * tangential_drag_coefficient(un * d / nu, ut * d / nu) * ut * ut;
  };
  for (const double degrees : {30.0, 45.0, 60.0}) {
    const double ut = std::cos(degrees * std::numbers::pi / 180),
                 re = std::sin(degrees * std::numbers::pi / 180) * d / nu;
    EXPECT_NEAR(along(degrees),
                std::numbers::pi * rho * nu * (0.55 * std::sqrt(re) + 0.084 * std::pow(re, 2.0 / 3)) * ut, 1e-12);
  }
  EXPECT_LT(along(10), along(30));
  EXPECT_NEAR(along(0), 0.5 * rho * std::numbers::pi * d * 0.005, 0.1 * along(0));
  // Creeping: half of what it bears across.
  EXPECT_NEAR(tangential_drag_coefficient(0, 1e-3) / normal_drag_coefficient(1e-3), 0.5, 0.02);
}

TEST(WireDrag, GivesTheFluidWhatItTakes) {
  lbm::Fluid<double> fluid(stream(16, 0.02, 1e-4));
  fluid.fill_everything([&](const Vec3&) { return Vec3(0.01, 0.002, 0); }, [](const Vec3&) { return 0.0; });
  StraightWire wire(21, 0.006, Vec3(0.1, 0.16, 0.1), Vec3(0.6, 0, 0.8));
  WireDrag<double> drag(wire.particles, wire.bonds);
  SolidFields<double> fields;
  const auto momentum = [&] {
    Vec3 p = Vec3::Zero();
    fluid.for_each_wet_cell(
        [&](const lbm::WetCell& c) { p += c.velocity * (1 + c.pressure / fluid.units().pressure_to_si(1.0 / 3)); });
    return Vec3(p * 1000 * 8e-6);
  };
  Vec3 on_wire = Vec3::Zero();  // N, in the step before: the fluid gets the opposite
  for (int s = 0; s < 20; ++s) {
    const Vec3 before = momentum();
    const ExchangedMomentum given = apply(drag, fluid, wire, fields);
    EXPECT_LT((given.to_solids - given.from_fluid).norm(), 1e-12 * given.to_solids.norm() + 1e-18);
    EXPECT_LT((fluid.units().force_to_si(1.0) * given.to_solids - on_wire).norm(), 1e-12 * on_wire.norm() + 1e-18);
    fluid.step();
    EXPECT_LT((momentum() - before + on_wire * 1e-4).norm(), 1e-9 * (on_wire.norm() * 1e-4) + 1e-14 * before.norm());
    on_wire = sum_of_forces(wire);
    EXPECT_GT(on_wire.norm(), 0.01);
  }
  EXPECT_EQ(drag.wet_beads(), 21U);
}

/// A wire moves in cells that are a quarter full: their liquid gains what the wire loses.
TEST(WireDrag, MomentumIsKeptAtTheSurface) {
  lbm::FluidOptions options = tank(Vec3(0.32, 0.32, 0.32), 0.02, 2e-4);
  options.gravity = Vec3::Zero();
  lbm::Fluid<double> fluid(options);
  fluid.fill({{Vec3::Zero(), Vec3(0.32, 0.32, 0.165)}});
  StraightWire wire(10, 0.006, Vec3(0.13, 0.16, 0.17), Vec3(1, 0, 0));
  for (dem::ParticleIndex i = 0; i < wire.particles.size(); ++i) wire.particles.velocity.set(i, Vec3(0, 0.5, 0));
  WireDrag<double> drag(wire.particles, wire.bonds);
  SolidFields<double> fields;
  fluid.step();
  apply(drag, fluid, wire, fields);
  const Vec3 on_wire = 2e-4 * sum_of_forces(wire);
  fluid.step();
  apply(drag, fluid, wire, fields);
  fluid.step();
  Vec3 of_water = Vec3::Zero();
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) { of_water += 1000 * 8e-6 * c.fill_level * c.velocity; });
  EXPECT_LT(on_wire.y(), 0);
  EXPECT_LT((of_water + on_wire).norm(), 0.01 * on_wire.norm());
}

/// A free wire of steel that a stream of mud takes along: its speed grows up to the stream's, whatever the step. Were
/// the drag at the start of a step held over it, wires of 1 mm would be thrown about from 0.3 ms on.
TEST(WireDrag, AFreeWireInMudGoesWithTheStream) {
  const double cell = 0.005, speed = 1.0;
  for (const double diameter : {0.003, 0.001})
    for (const double dt : {7.5e-5, 3e-4, 6e-4}) {
      lbm::FluidOptions options = stream(16, cell, dt);
      options.kinematic_viscosity = 0.005;
      lbm::Fluid<double> fluid(options);
      fluid.fill_everything([&](const Vec3&) { return Vec3(speed * dt / cell, 0, 0); },
                            [](const Vec3&) { return 0.0; });
      constexpr int beads = 27;
      StraightWire wire(beads, diameter, Vec3(0.04, 0.041, 0.001), Vec3(0, 0, 1), dem::ParticleState::free);
      SolidFields<double> fields;
      WireDrag<double> drag(wire.particles, wire.bonds);
      double fastest = 0;
      for (double time = 0; time < 0.04; time += dt) {
        apply(drag, fluid, wire, fields, false, [&](double kick) {  // as one piece
          Vec3 force = Vec3::Zero();
          for (dem::ParticleIndex i = 0; i < beads; ++i) force += wire.particles.force[i];
          const Vec3 velocity = wire.particles.velocity[0] + force * kick / (beads * wire.particles.mass[0]);
          for (dem::ParticleIndex i = 0; i < beads; ++i) wire.particles.velocity.set(i, velocity);
          fastest = std::max(fastest, velocity.x());
        });
        fluid.step();
      }
      EXPECT_LT(fastest, 1.01 * speed) << diameter << " " << dt;
      EXPECT_GT(wire.particles.velocity[0].x(), 0.98 * speed) << diameter << " " << dt;
    }
}

/// Held in a stream a wire bears what the law says, however stiff its drag would be were it free.
TEST(WireDrag, AHeldWireInMudBearsTheLaw) {
  const double cell = 0.005, d = 0.001, u = 1.0;
  const auto force = [&](dem::ParticleState state) {
    lbm::FluidOptions options = stream(16, cell, 3e-4);
    options.kinematic_viscosity = 0.005;
    lbm::Fluid<double> fluid(options);
    fluid.fill_everything([&](const Vec3&) { return Vec3(u * 3e-4 / cell, 0, 0); }, [](const Vec3&) { return 0.0; });
    StraightWire wire(27, d, Vec3(0.04, 0.041, 0.001), Vec3(0, 0, 1), state);
    WireDrag<double> drag(wire.particles, wire.bonds);
    SolidFields<double> fields;
    for (int n = 0; n < 60; ++n) {  // free ones are held by hand: their mass says what a step could do to them
      apply(drag, fluid, wire, fields);
      fluid.step();
    }
    return wire.particles.external_force[13].x();
  };
  EXPECT_NEAR(force(dem::ParticleState::free) / force(dem::ParticleState::fixed), 1, 0.01);
}

/// A ring and a wire across it, held at two beads, in still liquid as thick as mud at rest: their bonds turn round
/// about once in a step of the fluid. Drag that is held over the step throws them about at 200 m/s.
TEST(WireDrag, ANetInThickLiquidComesToRest) {
  for (const double viscosity : {0.01, 1.0}) {
    lbm::FluidOptions fluid = tank(Vec3(0.32, 0.16, 0.32), 0.02, 7e-4);
    fluid.kinematic_viscosity = viscosity;
    fluid.gravity = Vec3::Zero();
    Chains net;
    net.add(circle(Vec3(0.16, 0.08, 0.16), Vec3::UnitY(), 0.1, 48), 0.006, true, dem::ParticleState::free);
    net.add(straight_line(Vec3(0.06, 0.087, 0.16), Vec3(0.26, 0.087, 0.16), 31), 0.006, false,
            dem::ParticleState::free);
    for (dem::BondSort& sort : net.bonds.sorts) sort.axial.stiffness = {4e9, 4e9, 4e9}, sort.shear_stiffness = 4e9;
    for (const dem::ParticleIndex i : {0U, 24U, 48U, 78U}) {
      net.particles.state[i] = dem::ParticleState::fixed;
      net.particles.inverse_mass[i] = 0;
    }
    for (dem::ParticleIndex i = 0; i < net.particles.size(); ++i)
      if (net.particles.inverse_mass[i] > 0) net.particles.velocity.set(i, Vec3(0, 0.01 * std::sin(3.0 * i), 0));
    dem::SolidsOptions options;
    options.gravity = fluid.gravity;
    options.time_step = fluid.time_step / 60;
    CoupledStep<double> step(fluid, dem::Solids(net.particles, net.bonds, rock(), {}, options), {.substeps = 60});
    step.fill({{Vec3::Zero(), Vec3(0.32, 0.16, 0.28)}});
    double fastest = 0;
    for (int n = 0; n < 150; ++n) {
      step.advance();
      fastest = 0;
      for (const dem::ParticleIndex i : {6U, 30U, 60U})
        fastest = std::max(fastest, Vec3(step.solids()->particles().velocity[i]).norm());
    }
    EXPECT_LT(fastest, 1e-3) << viscosity;
    EXPECT_LT(step.audit().relative(), 1e-9) << viscosity;
    EXPECT_EQ(step.wet_beads(), 79U);
  }
}

/// The cells give what drag gave a wire a step later. One that has left the liquid by then gives it back.
TEST(WireDrag, AWireThatHasLeftTheLiquidGivesBackWhatNoCellGave) {
  lbm::Fluid<double> fluid(tank(Vec3(0.32, 0.32, 0.64), 0.02, 2e-4));
  fluid.fill({{Vec3::Zero(), Vec3(0.32, 0.32, 0.2)}});
  StraightWire wire(10, 0.006, Vec3(0.1, 0.16, 0.1), Vec3::UnitX());
  for (dem::ParticleIndex i = 0; i < 10; ++i) wire.particles.velocity.set(i, Vec3(0, 0, 3));
  WireDrag<double> drag(wire.particles, wire.bonds);
  SolidFields<double> fields;
  apply(drag, fluid, wire, fields);
  const Vec3 owed = drag.owed();
  EXPECT_LT(owed.z(), -1e-6);
  EXPECT_NEAR(sum_of_forces(wire).z() / (owed.z() / 2e-4), 1, 0.05) << "the rest is buoyancy";
  for (dem::ParticleIndex i = 0; i < 10; ++i)
    wire.particles.position.set(i, wire.particles.position[i] + Vec3(0, 0, 0.4));
  const ExchangedMomentum given = apply(drag, fluid, wire, fields);
  EXPECT_EQ(given.to_solids, Vec3::Zero());
  EXPECT_EQ(given.from_fluid, Vec3::Zero());
  EXPECT_LT((sum_of_forces(wire) + owed / 2e-4).norm(), 1e-12 * owed.norm() / 2e-4);
  EXPECT_EQ(drag.owed(), Vec3::Zero());
}

TEST(WireDrag, DryWireFeelsNothing) {
  lbm::Fluid<float> fluid(tank(Vec3(0.32, 0.32, 0.64), 0.02, 2e-4));
  fluid.fill({{Vec3::Zero(), Vec3(0.32, 0.32, 0.1)}});
  StraightWire wire(10, 0.006, Vec3(0.1, 0.16, 0.5), Vec3(1, 0, 0));
  WireDrag<float> drag(wire.particles, wire.bonds);
  SolidFields<float> fields;
  EXPECT_EQ(apply(drag, fluid, wire, fields).to_solids, Vec3::Zero());
  EXPECT_EQ(sum_of_forces(wire), Vec3::Zero());
  EXPECT_EQ(drag.wet_beads(), 0U);
}

}  // namespace
}  // namespace lahar::coupling
