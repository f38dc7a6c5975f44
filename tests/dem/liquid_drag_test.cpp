#include "dem/liquid_drag.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "dem/time_step.h"
#include "tests/dem/small_scenes.h"

namespace lahar::dem {
namespace {

using namespace testing;

constexpr double kStep = 1e-4;  // s

/// A sphere of about 1 kg in a liquid of `liquid_mass` (kg), under a force (N), for `steps` of kStep.
struct Dragged {
  Solids solids;
  std::array<LiquidDrag, 1> drags;

  Dragged(const LiquidDrag& drag, const Vec3& velocity, const ParticleSpec& base = sphere({0, 0, 0}, 0.05, 1910))
      : solids(
            [&] {
              Particles p;
              ParticleSpec s = base;
              s.velocity = velocity;
              p.add(s);
              return p;
            }(),
            {}, one_material(1e7, 0.2, 0, 1), {}, options(kStep)),
        drags{drag} {}
  [[nodiscard]] double mass() const { return solids.particles().mass[0]; }
  [[nodiscard]] Vec3 velocity() const { return solids.particles().velocity[0]; }
  void advance(int steps, const Vec3& force) {
    solids.particles().external_force.set(0, force);
    solids.advance(steps, drags);
  }
};

/// The slip decays at its own rate along the axis and across it, whatever the step; both momenta together stay.
TEST(LiquidDrag, a_free_particle_and_its_liquid_meet) {
  const Vec3 velocity(1, -2, 0.5), liquid(-0.5, 0.2, 3), axis = Vec3(2, 1, -2) / 3;
  constexpr int steps = 7;
  for (const double x : {1e-3, 0.3, 4.0}) {
    LiquidDrag drag = {.axis = axis, .liquid_mass = 3, .liquid = liquid};
    drag.coefficient = {.along = 0.5 * x / kStep, .across = x / kStep};
    Dragged d(drag, velocity);
    d.advance(steps, Vec3::Zero());
    const LiquidDrag& after = d.drags[0];
    const double rate = x * (1 / d.mass() + 1 / 3.0) * steps;
    const Vec3 slip = liquid - velocity, along = slip.dot(axis) * axis;
    const Vec3 expected = std::exp(-0.5 * rate) * along + std::exp(-rate) * (slip - along);
    EXPECT_LT((after.liquid - d.velocity() - expected).norm(), 1e-12) << x;
    EXPECT_LT((d.mass() * (d.velocity() - velocity) - after.impulse).norm(), 1e-12) << x;
    EXPECT_LT((3 * (after.liquid - liquid) + after.impulse).norm(), 1e-12) << x;
    const double gained = 0.5 * d.mass() * (d.velocity().squaredNorm() - velocity.squaredNorm());
    EXPECT_NEAR(d.solids.ledger().external_work, gained, 1e-12) << x;
    const Vec3 mean = after.impulse / (steps * kStep);
    EXPECT_LT((d.solids.particles().external_force[0] - mean).norm(), 1e-9 * mean.norm()) << x;
    EXPECT_LT((d.solids.particles().force[0] - mean).norm(), 1e-9 * mean.norm()) << x;
  }
}

/// The spin of a particle decays towards that of its liquid, under a torque to T/k off it, exactly in steps of any
/// length; what it got is told.
TEST(LiquidDrag, a_spin_decays_and_is_balanced) {
  const Vec3 liquid(3, 0, -1), torque(0.02, -0.01, 0.03);
  constexpr int steps = 7;
  for (const double x : {1e-6, 0.3, 40.0}) {
    LiquidDrag drag = {.liquid_mass = kMovesOn};
    Dragged d(drag, Vec3::Zero());
    const double inertia = d.solids.particles().inertia[0], k = x * inertia / kStep;
    d.drags[0].spin_coefficient = k, d.drags[0].liquid_spin = liquid;
    d.solids.particles().external_torque.set(0, torque);
    d.advance(4, Vec3::Zero());
    d.solids.particles().external_torque.set(0, torque);  // without the mean of the drags
    d.advance(steps - 4, Vec3::Zero());
    const Vec3 spin = d.solids.particles().angular_velocity[0], settled = liquid + torque / k;
    const double left = std::exp(-x * steps), time = steps * kStep;
    EXPECT_LT((spin - settled + left * settled).norm(), 1e-9 * settled.norm()) << x;
    EXPECT_LT((inertia * spin - time * torque - d.drags[0].angular_impulse).norm(), 1e-12) << x;
    EXPECT_EQ(d.velocity(), Vec3(Vec3::Zero())) << x;
  }
}

/// What is driven by a constant force reaches F/K; what is held in a liquid that something drives bears all of that.
TEST(LiquidDrag, what_drives_the_slip_is_balanced) {
  for (const double x : {1e-3, 0.3, 40.0}) {
    LiquidDrag drag = {.liquid_mass = 1e18};
    drag.coefficient = {.along = x / kStep, .across = x / kStep};
    Dragged falling(drag, Vec3::Zero());
    falling.advance(static_cast<int>(50 / x) + 10, Vec3(0, 0, -9.81));
    EXPECT_NEAR(falling.velocity().z() * x / kStep / -9.81, 1, 1e-9) << x;
    drag.liquid_mass = 2, drag.acceleration = Vec3(0, 5, 0);
    ParticleSpec fixed = sphere({0, 0, 0}, 0.05, 1910);
    fixed.state = ParticleState::fixed;
    Dragged held(drag, Vec3::Zero(), fixed);
    held.advance(static_cast<int>(100 / x) + 10, Vec3::Zero());
    EXPECT_NEAR(held.drags[0].liquid.y() * x / kStep / 10, 1, 1e-9) << x;
  }
}

/// Friction stops a slide after m v/Y, holds what is pushed by less, and gives way to more.
TEST(LiquidDrag, friction_stops_and_holds) {
  LiquidDrag drag = {.liquid_mass = 1e18};
  drag.friction = {.along = 20, .across = 20};
  Dragged slides(drag, Vec3(0, 0.02, 0));
  const double to_stop = slides.mass() * 0.02 / 20;
  const int before = static_cast<int>(0.99 * to_stop / kStep);
  slides.advance(before, Vec3::Zero());
  EXPECT_NEAR(slides.velocity().y(), 0.02 - before * kStep * 20 / slides.mass(), 1e-12);
  slides.advance(3, Vec3::Zero());
  EXPECT_LT(slides.velocity().norm(), 1e-15);
  slides.advance(100, Vec3(0, 19.9, 0));
  EXPECT_LT(slides.velocity().norm(), 1e-12);
  slides.advance(100, Vec3(0, 30, 0));
  EXPECT_NEAR(slides.velocity().y(), 100 * kStep * 10 / slides.mass(), 1e-9);
  // Slower than the creep speed it is a viscous drag, Y/c.
  drag.creep_speed = 1;
  Dragged creeps(drag, Vec3::Zero());
  creeps.advance(20000, Vec3(0, 0.2, 0));
  EXPECT_NEAR(creeps.velocity().y(), 0.01, 2e-4);
}

/// Where a kick takes much of the slip the friction stays what it is: a force of Y/2 moves nothing, one of 30 N against
/// 20 N of friction and K moves by 10 N/K. (By up to x/(1 - e^-x) too much of it acted.)
TEST(LiquidDrag, friction_is_the_same_for_any_viscosity) {
  LiquidDrag drag = {.liquid_mass = 1e18};
  drag.friction = {.along = 20, .across = 20};
  const double mass = Dragged(drag, Vec3::Zero()).mass();
  for (const double x : {0.1, 1.0, 10.0}) {
    const double viscous = x * mass / kStep;
    drag.coefficient = {.along = viscous, .across = viscous};
    Dragged slides(drag, Vec3::Zero());
    slides.advance(2000, Vec3(0, 30, 0));
    EXPECT_NEAR(slides.velocity().y() * viscous / 10, 1, 1e-9) << x;
    Dragged stands(drag, Vec3::Zero());
    stands.advance(100, Vec3(0, 10, 0));
    EXPECT_LT(stands.velocity().norm(), 1e-12) << x;
  }
  // Fading below the creep speed c, and so strong that a kick could stop half of c: Y s/(s + c) = Y/2 at s = c.
  LiquidDrag fades = {.creep_speed = 1, .liquid_mass = 1e18};
  fades.friction = {.along = 0.5 * mass / kStep, .across = 0.5 * mass / kStep};
  Dragged creeps(fades, Vec3::Zero());
  creeps.advance(2000, Vec3(0, 0.25 * mass / kStep, 0));
  EXPECT_NEAR(creeps.velocity().y(), 1, 1e-6);
}

TEST(LiquidDrag, rails_take_up_what_is_across) {
  LiquidDrag drag = {.liquid_mass = 1e18, .liquid = Vec3(1, 2, 0)};
  drag.coefficient = {.along = 30, .across = 30};
  ParticleSpec bead = sphere({0, 0, 0}, 0.05, 1910);
  bead.rail = Vec3::UnitX();
  Dragged d(drag, Vec3::Zero(), bead);
  d.advance(500, Vec3::Zero());
  EXPECT_EQ(d.velocity().y(), 0);
  EXPECT_NEAR(d.velocity().x(), 1 - std::exp(-30 * 500 * kStep / d.mass()), 1e-9);
  EXPECT_NEAR(d.solids.particles().rails[0].taken_up.y(), 60, 1e-6);
}

/// A chain of beads between fixed ends that vibrates in a liquid at rest, of any thickness: in the step of the fluid
/// bonds turn round many times, or once, or hardly. Neither ever wins energy, and the ledger closes.
TEST(LiquidDrag, soft_and_stiff_wires_come_to_rest_in_any_liquid) {
  for (const double stiffness : {1e6, 1e8, 1e10})
    for (const double x : {0.02, 1.0, 50.0}) {  // K times the step of the fluid over the mass
      constexpr int beads = 9, substeps = 60;
      constexpr double r = 0.004;
      Particles p;
      Bonds bonds;
      BondSort sort;
      sort.axial.stiffness = {stiffness, stiffness, stiffness};
      sort.shear_stiffness = stiffness;
      sort.bond_radius = r;
      bonds.add_sort(sort);
      for (int k = 0; k < beads; ++k) {
        ParticleSpec bead = sphere({2.5 * r * k, 0, 0}, r, 7800);
        bead.kind = ParticleKind::bead;
        if (k == 0 || k + 1 == beads)
          bead.state = ParticleState::fixed;
        else
          bead.velocity = Vec3(0, 0.1 * std::sin(1.7 * k), 0.1 * std::cos(2.9 * k));
        p.add(bead);
        if (k > 0) bonds.add({static_cast<ParticleIndex>(k - 1), static_cast<ParticleIndex>(k), 0}, p);
      }
      const double dt = 0.5 * bond_time_step(bonds, p);
      Solids solids(p, bonds, one_material(1e9, 0.3, 0, 1), {}, options(dt));
      std::vector<LiquidDrag> drags(beads - 2);
      for (std::size_t k = 0; k < drags.size(); ++k) {
        drags[k].particle = static_cast<ParticleIndex>(k + 1);
        const double coefficient = x * p.mass[k + 1] / (substeps * dt);
        drags[k].coefficient = {.along = 0.5 * coefficient, .across = coefficient};
        drags[k].liquid_mass = 1e18;
      }
      const auto held = [&] {
        const EnergyLedger e = solids.ledger();
        return e.kinetic + e.rotational + e.bonds.elastic();
      };
      const double start = held();
      double highest = 0;
      for (int n = 0; n < 100; ++n) {
        solids.particles().external_force.fill(Vec3::Zero());
        solids.advance(substeps, drags);
        highest = std::max(highest, held());
      }
      EXPECT_LT(highest, 1.02 * start) << stiffness << " " << x;
      EXPECT_LT(held(), (x < 0.1 ? 0.5 : 0.1) * start) << stiffness << " " << x;
      EXPECT_NEAR(solids.ledger().external_work, held() - start, 0.03 * start) << stiffness << " " << x;
    }
}

/// Long steps of grains among themselves leave a bead its impulse to the last sub-step.
TEST(LiquidDrag, two_rates_keep_the_impulse) {
  Particles p;
  Bonds bonds;
  BondSort sort;
  sort.axial.stiffness = {1e8, 1e8, 1e8};
  sort.bond_radius = 0.004;
  bonds.add_sort(sort);
  for (int k = 0; k < 2; ++k) {
    ParticleSpec bead = sphere({0.01 * k, 0, 0}, 0.004, 7800, {0.5, 1, 0});
    bead.kind = ParticleKind::bead;
    p.add(bead);
  }
  bonds.add({0, 1, 0}, p);
  p.add(sphere({1, 0, 0}, 0.02, 2650));
  SolidsOptions o = options(1e-6);
  o.long_step = 3;
  Solids solids(p, bonds, one_material(1e9, 0.3, 0, 1), {}, o);
  std::array<LiquidDrag, 2> drags{LiquidDrag{.particle = 0}, LiquidDrag{.particle = 1}};
  for (LiquidDrag& d : drags) d.coefficient = {.along = 100, .across = 100}, d.liquid_mass = 0.05;
  solids.advance(7, drags);
  const Vec3 before = p.mass[0] * Vec3(1, 2, 0), given = drags[0].impulse + drags[1].impulse;
  EXPECT_LT((momentum(solids.particles()) - before - given).norm(), 1e-12 * before.norm());
  EXPECT_GT(given.norm(), 0.1 * before.norm());
}

}  // namespace
}  // namespace lahar::dem
