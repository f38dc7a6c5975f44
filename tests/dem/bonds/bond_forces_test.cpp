#include "dem/bonds/bond_forces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/parallel.h"

namespace lahar::dem {
namespace {

constexpr double kPi = std::numbers::pi;

/// Wire of the paper's rings: 6.1 mm beads in touch, 3e11 N/m^3 (Li, Zhao & Kwan 2020, Table 4).
constexpr double kBead = 6.1e-3, kRadius = kBead / 2, kStiffness = 3e11, kDensity = 7800;
const double kArea = kPi * kRadius * kRadius, kInertia = kArea * kRadius * kRadius / 4;
const double kEI = kStiffness * kBead * kInertia, kEA = kStiffness * kBead * kArea;

BondSort wire() {
  BondSort s;
  s.axial.stiffness = {kStiffness, kStiffness, kStiffness};
  s.shear_stiffness = kStiffness;
  s.bond_radius = kRadius;
  return s;
}

/// Beads, bonds and a velocity-Verlet loop with optional loads and drag (per unit mass, for static answers).
struct Rig {
  Particles particles;
  Bonds bonds;
  BondForces forces;
  std::function<void(Particles&)> load = [](Particles&) {};
  double drag = 0, drag_of_rotation = 0;

  ParticleIndex add(const Vec3& at, ParticleState state = ParticleState::free) {
    ParticleSpec s;
    s.position = at;
    s.radius = kRadius;
    s.density = kDensity;
    s.state = state;
    return particles.add(s);
  }
  void evaluate(double dt) {
    for (Vec3Field* f : {&particles.force, &particles.torque}) f->fill(Vec3::Zero());
    load(particles);
    forces.add_forces(bonds, particles, dt);
  }
  void kick(double dt) {
    for (std::size_t i = 0; i < particles.size(); ++i) {
      if (particles.inverse_mass[i] == 0) continue;
      particles.velocity.add(i, dt * particles.inverse_mass[i] * particles.force[i]);
      particles.angular_velocity.add(i, dt / particles.inertia[i] * particles.torque[i]);
      particles.velocity.set(i, (1 - drag * dt) * particles.velocity[i]);
      particles.angular_velocity.set(i, (1 - drag_of_rotation * dt) * particles.angular_velocity[i]);
    }
  }
  void start() {
    forces.build(bonds, particles);
    evaluate(0);
  }
  void step(double dt) {
    kick(dt / 2);
    for (std::size_t i = 0; i < particles.size(); ++i) particles.position.add(i, dt * particles.velocity[i]);
    evaluate(dt);
    kick(dt / 2);
  }
  void run(double seconds, double dt) {
    for (double t = 0; t < seconds; t += dt) step(dt);
  }
  [[nodiscard]] double kinetic_energy() const {
    double e = 0;
    for (std::size_t i = 0; i < particles.size(); ++i)
      e += 0.5 * particles.mass[i] * particles.velocity[i].squaredNorm() +
           0.5 * particles.inertia[i] * particles.angular_velocity[i].squaredNorm();
    return e;
  }
  [[nodiscard]] double energy() const { return kinetic_energy() + forces.energy(bonds).elastic(); }
  [[nodiscard]] Vec3 angular_momentum() const {
    Vec3 l = Vec3::Zero();
    for (std::size_t i = 0; i < particles.size(); ++i)
      l += particles.mass[i] * particles.position[i].cross(particles.velocity[i]) +
           particles.inertia[i] * particles.angular_velocity[i];
    return l;
  }
};

/// A straight chain along x of n bonds; the first bead is fixed if asked.
Rig chain(std::uint32_t n, ParticleState root, const BondSort& sort = wire()) {
  Rig rig;
  rig.bonds.add_sort(sort);
  for (std::uint32_t k = 0; k <= n; ++k) rig.add({k * kBead, 0, 0}, k == 0 ? root : ParticleState::free);
  for (std::uint32_t k = 0; k < n; ++k) rig.bonds.add({k, k + 1, 0}, rig.particles);
  return rig;
}

/// Rings of beads in a plane spanned by u and v.
void add_ring(Rig& rig, const Vec3& centre, const Vec3& u, const Vec3& v, std::uint32_t beads) {
  const double radius = kBead / 2 / std::sin(kPi / beads);
  const auto base = static_cast<ParticleIndex>(rig.particles.size());
  for (std::uint32_t k = 0; k < beads; ++k) {
    const double a = 2 * kPi * k / beads;
    rig.add(centre + radius * (std::cos(a) * u + std::sin(a) * v));
  }
  for (std::uint32_t k = 0; k < beads; ++k) rig.bonds.add({base + k, base + (k + 1) % beads, 0}, rig.particles);
}

/// Runs with strong drag until the answer no longer moves.
void settle(Rig& rig, double slowest_rate, double seconds, double dt = 4e-6) {
  rig.drag = 2 * slowest_rate;
  rig.drag_of_rotation = 2 * slowest_rate;
  rig.run(seconds, dt);
}

constexpr std::uint32_t kBonds = 10;
constexpr double kLength = kBonds * kBead;
/// First bending frequency (rad/s) of the cantilever, for drag: 1.8751^2 sqrt(EI / (mu L^4)).
const double kBendingRate =
    3.516 * std::sqrt(kEI / (4.0 / 3 * kPi * std::pow(kRadius, 3) * kDensity / kBead)) / (kLength * kLength);

TEST(BondForces, CantileverTipStiffnessIsThatOfABeam) {
  Rig rig = chain(kBonds, ParticleState::fixed);
  const double force = 0.1;
  rig.load = [=](Particles& p) { p.force.add(kBonds, {0, 0, force}); };
  rig.start();
  settle(rig, kBendingRate, 0.12);
  const double stiffness = force / rig.particles.position[kBonds].z();
  EXPECT_NEAR(stiffness / 1643.887, 1, 0.002);  // 3 EI / L^3, bonded_beam.csv
  // With Timoshenko's shear, and each bond's bend in its middle, exactly:
  double compliance = kBonds / (kStiffness * kArea);
  for (std::uint32_t b = 0; b < kBonds; ++b)
    compliance += std::pow((kBonds - b - 0.5) * kBead, 2) / (kStiffness * kInertia);
  EXPECT_NEAR(stiffness * compliance, 1, 1e-5);
  EXPECT_NEAR(rig.particles.force[0].z(), force, 1e-4 * force);  // reaction at the root
  EXPECT_NEAR(rig.particles.torque[0].y(), -force * kLength, 1e-4 * force * kLength);
}

TEST(BondForces, LowShearStiffnessMakesATimoshenkoBeam) {
  BondSort sort = wire();
  sort.shear_stiffness = 1e-3 * kStiffness;
  Rig rig = chain(kBonds, ParticleState::fixed, sort);
  const double force = 0.1;
  rig.load = [=](Particles& p) { p.force.add(kBonds, {0, force, 0}); };
  rig.start();
  settle(rig, 0.5 * kBendingRate, 0.2);
  const double deflection = rig.particles.position[kBonds].y();
  const double bending = force * std::pow(kLength, 3) / (3 * kEI),
               shear = force * kBonds / (sort.shear_stiffness * kArea);
  EXPECT_GT(shear, 0.5 * bending);  // the case is worth its name
  EXPECT_NEAR(deflection / (bending + shear), 1, 0.005);
}

TEST(BondForces, BarStretchesByEAAndTwistsByGJ) {
  Rig rig = chain(kBonds, ParticleState::fixed);
  double twist = 0;
  rig.load = [&](Particles& p) {
    p.force.add(kBonds, {50, 0, 0});
    p.torque.add(kBonds, {0.02, 0, 0});
    twist += 4e-6 * p.angular_velocity[kBonds].x();  // of mid-step
  };
  rig.start();
  rig.drag = rig.drag_of_rotation = 8e3;
  rig.run(0.04, 4e-6);
  EXPECT_NEAR((rig.particles.position[kBonds].x() - kLength) / (50 * kLength / kEA), 1, 1e-6);
  const double polar = 2 * kInertia;
  EXPECT_NEAR(twist / (0.02 * kBonds / (kStiffness * polar)), 1, 1e-6);
  EXPECT_NEAR(rig.bonds.axial_force[3], 50, 1e-4);
  EXPECT_NEAR(rig.bonds.torsion_moment[3], 0.02, 1e-7);
}

TEST(BondForces, EndMomentOf2PiEIOverLRollsAChainIntoARing) {
  const std::uint32_t n = 24;
  Rig rig = chain(n, ParticleState::fixed);
  const double full = kStiffness * kInertia * 2 * kPi / n, ramp = 0.3;
  double t = 0;
  rig.load = [&](Particles& p) { p.torque.add(n, {0, -full * std::min(1.0, t / ramp), 0}); };
  rig.start();
  rig.drag = rig.drag_of_rotation = 60;
  for (; t < 0.75; t += 4e-6) rig.step(4e-6);
  // Each bond turns by 2 pi / n: the beads are the corners of a regular polygon and the last one is the first.
  EXPECT_LT((rig.particles.position[n] - rig.particles.position[0]).norm(), 1e-6 * n * kBead);
  const double across = kBead / std::sin(kPi / n);
  EXPECT_NEAR((rig.particles.position[n / 2] - rig.particles.position[0]).norm() / across, 1, 1e-5);
  for (std::uint32_t b = 0; b < n; ++b) EXPECT_NEAR(rig.bonds.moment[b].norm() / full, 1, 1e-5);
}

TEST(BondForces, RigidRotationAboutAnyAxisLeavesNoForce) {
  Rig rig;
  rig.bonds.add_sort(wire());
  add_ring(rig, {0.1, 0, 0}, Vec3::UnitX(), Vec3::UnitY(), 36);
  rig.forces.build(rig.bonds, rig.particles);
  const Vec3Field rest = rig.particles.position;
  const Vec3 axis = Vec3(0.3, -0.5, 0.8).normalized();
  const double angle = 2e-3;  // per step; 40 turns
  for (int step = 1; step <= 125664; ++step) {
    const Mat3 turn = Eigen::AngleAxisd(angle * step, axis).toRotationMatrix();
    for (std::size_t i = 0; i < rest.size(); ++i) {
      rig.particles.position.set(i, turn * rest[i]);
      rig.particles.angular_velocity.set(i, angle * axis);
    }
    rig.evaluate(1.0);
  }
  for (std::size_t i = 0; i < rest.size(); ++i) {
    EXPECT_LT(rig.particles.force[i].norm(), 1e-12 * kEA);
    EXPECT_LT(rig.particles.torque[i].norm(), 1e-11 * kEI / kBead);
  }
}

TEST(BondForces, SpinningRingKeepsItsHoopForceAndNothingElse) {
  Rig rig;
  rig.bonds.add_sort(wire());
  const Vec3 u = Vec3(1, 2, 2) / 3, v = Vec3(2, 1, -2) / 3;
  add_ring(rig, Vec3::Zero(), u, v, 36);
  const Vec3 spin = 200 * u.cross(v);
  const double radius = rig.particles.position[0].norm(), mass = rig.particles.mass[0];
  const double hoop = mass * spin.squaredNorm() * radius / (2 * std::sin(kPi / 36));
  for (std::size_t i = 0; i < 36; ++i) {
    rig.particles.position.set(i, (1 + hoop / (kStiffness * kArea) / kBead) * rig.particles.position[i]);
    rig.particles.velocity.set(i, spin.cross(rig.particles.position[i]));
    rig.particles.angular_velocity.set(i, spin);
  }
  rig.forces.build(rig.bonds, rig.particles);
  rig.evaluate(0);
  const double energy = rig.energy();
  const Vec3 momentum = rig.angular_momentum();
  rig.run(0.6, 4e-6);  // 19 turns
  for (std::size_t b = 0; b < 36; ++b) {
    EXPECT_NEAR(rig.bonds.axial_force[b] / hoop, 1, 1e-3);
    EXPECT_LT(rig.bonds.shear_force[b].norm(), 1e-5 * hoop);
    EXPECT_LT(rig.bonds.moment[b].norm(), 1e-8 * hoop * kBead);
    EXPECT_LT(std::abs(rig.bonds.torsion_moment[b]), 1e-8 * hoop * kBead);
  }
  EXPECT_NEAR(rig.energy() / energy, 1, 1e-11);
  EXPECT_LT((rig.angular_momentum() - momentum).norm(), 1e-11 * momentum.norm());
}

/// A free chain that bends, stretches, shears and twists at large amplitude while it tumbles.
Rig tumbling_chain(BondSort sort = wire()) {
  Rig rig = chain(20, ParticleState::free, sort);
  for (std::uint32_t k = 0; k <= 20; ++k) {
    const double a = 0.7 * k;
    rig.particles.velocity.set(k, {0.3 * std::sin(3 * a), 3 * std::cos(a / 4), 2 * std::sin(a / 3)});
    rig.particles.angular_velocity.set(k, {40 * std::cos(a), 30 * std::sin(a), 20});
  }
  rig.start();
  return rig;
}

TEST(BondForces, FreeChainKeepsMomentumAndAngularMomentum) {
  Rig rig = tumbling_chain();
  const Vec3 before = rig.angular_momentum();
  rig.run(0.1, 4e-6);
  EXPECT_LT((rig.angular_momentum() - before).norm(), 1e-11 * before.norm());
  EXPECT_GT(rig.forces.energy(rig.bonds).bending, 0.05 * rig.energy());  // it does vibrate
}

/// Largest deviation of the energy in a run, relative.
double energy_error(double dt) {
  Rig rig = tumbling_chain();
  const double before = rig.energy();
  double worst = 0;
  for (double t = 0; t < 0.05; t += dt) {
    rig.step(dt);
    worst = std::max(worst, std::abs(rig.energy() / before - 1));
  }
  return worst;
}

TEST(BondForces, UndampedChainKeepsEnergyToSecondOrder) {
  const double coarse = energy_error(4e-6), fine = energy_error(2e-6);
  EXPECT_LT(coarse, 5e-3);
  EXPECT_GT(coarse / fine, 3.0);
}

TEST(BondForces, EnergyDoesNotDriftInALongRun) {
  Rig rig = tumbling_chain();
  const auto mean_energy = [&] {
    double sum = 0;
    for (int k = 0; k < 2500; ++k) {
      rig.step(4e-6);
      sum += rig.energy() / 2500;
    }
    return sum;
  };
  const double before = mean_energy();
  rig.run(0.5, 4e-6);
  EXPECT_NEAR(mean_energy() / before, 1, 1e-5);
}

TEST(BondForces, FirstFrequencyOfACantilever) {
  const std::uint32_t n = 20;
  Rig rig = chain(n, ParticleState::fixed);
  // The last bead stands for half a cell of the continuous beam.
  rig.particles.mass[n] /= 2, rig.particles.inverse_mass[n] *= 2, rig.particles.inertia[n] /= 2;
  for (std::uint32_t k = 1; k <= n; ++k) {
    const double s = static_cast<double>(k) / n;
    rig.particles.velocity.set(k, {0, 0, 0.05 * s * s * (3 - s) / 2});
    rig.particles.angular_velocity.set(k, {0, -0.05 * (6 * s - 3 * s * s) / 2 / (n * kBead), 0});
  }
  rig.start();
  std::vector<double> crossings;
  double last = 0;
  for (double t = 0; crossings.size() < 5; t += 4e-6) {
    rig.step(4e-6);
    const double z = rig.particles.position[n].z();
    if (last * z < 0) crossings.push_back(t);
    last = z;
  }
  const double frequency = 0.5 * 4 / (crossings[4] - crossings[0]);
  EXPECT_NEAR(frequency / 34.012852, 1, 0.005);  // bonded_beam.csv
}

/// Two beads with the dissipator of Li, Zhao & Kwan (2020), Table 2.
Rig dissipator(bool plastic) {
  BondSort sort = wire();
  sort.axial = {{3.7e10, 1.2e8, 1.9e9}, {78.0e3, 98.2e3}, plastic};
  sort.bond_radius = 0.01;
  Rig rig = chain(1, ParticleState::fixed, sort);
  rig.start();
  return rig;
}

/// A wire that only pulls: its damper brakes ends that close on each other, but never so that it pushes.
TEST(BondForces, WhatOnlyPullsIsNotMadeToPushByItsDamper) {
  BondSort sort = wire();
  sort.axial.tension_only = true;
  sort.damping_ratio = 0.05;
  Rig rig = chain(1, ParticleState::fixed, sort);
  rig.start();
  const double taut = 8e-6, step = 1e-6;
  rig.particles.position.set(1, {kBead + taut, 0, 0});
  rig.evaluate(step);
  rig.particles.position.set(1, {kBead + taut - 2 * step, 0, 0});  // 2 m/s
  rig.evaluate(step);
  EXPECT_GT(rig.bonds.axial_force[0], 0);
  EXPECT_LE(rig.particles.force.x[1], 0);
}

/// Moves the second bead to an elongation in n steps; gives the work done on the bond.
double pull(Rig& rig, double elongation, int n) {
  double work = 0, force = rig.bonds.axial_force[0];
  const double start = rig.particles.position[1].x(), end = kBead + elongation;
  for (int k = 1; k <= n; ++k) {
    rig.particles.position.set(1, {start + (end - start) * k / n, 0, 0});
    rig.evaluate(1e-5);
    work += 0.5 * (force + rig.bonds.axial_force[0]) * (end - start) / n;
    force = rig.bonds.axial_force[0];
  }
  return work;
}

TEST(BondForces, DissipatorFollowsTable2AndElasticallyBack) {
  Rig rig = dissipator(false);
  const double area = kPi * 1e-4, e1 = 78e3 / (3.7e10 * area), e2 = e1 + 20.2e3 / (1.2e8 * area);
  const double e3 = e2 + 162.8e3 / (1.9e9 * area);
  double work = 0;
  const std::pair<double, double> points[] = {{e1 / 2, 39e3}, {e1, 78e3}, {e2, 98.2e3},
                                              {e3, 261e3},    {e1, 78e3}, {0, 0}};
  for (const auto& [elongation, force] : points) {
    work += pull(rig, elongation, 1000);
    EXPECT_NEAR(rig.bonds.axial_force[0], force, 1e-8 * 261e3);
    EXPECT_NEAR(rig.particles.force[1].x(), -rig.bonds.axial_force[0], 1e-9);
    EXPECT_NEAR(rig.forces.energy(rig.bonds).axial, work, 1e-6 * 261e3);
  }
  EXPECT_EQ(rig.forces.energy(rig.bonds).plastic, 0);
}

TEST(BondForces, PlasticDissipatorKeepsTheLoopArea) {
  Rig rig = dissipator(true);
  const double k1 = 3.7e10 * kPi * 1e-4;
  double work = pull(rig, 0.3, 3000);
  const double force = rig.bonds.axial_force[0], plastic = rig.bonds.plastic_elongation[0];
  EXPECT_NEAR(plastic, 0.3 - force / k1, 1e-9);
  EXPECT_NEAR(rig.forces.energy(rig.bonds).axial, force * force / (2 * k1), 1e-6);
  EXPECT_NEAR(rig.forces.energy(rig.bonds).axial + rig.forces.energy(rig.bonds).plastic, work, 1e-6 * work);
  work += pull(rig, plastic, 100);
  EXPECT_NEAR(rig.bonds.axial_force[0], 0, 1e-5);
  EXPECT_NEAR(rig.forces.energy(rig.bonds).plastic, work, 1e-6 * work);
  EXPECT_GT(work, 0.2 * 78e3);
}

TEST(BondForces, BreaksAtTheStrengthAndNotBefore) {
  BondSort sort = wire();
  sort.tensile_strength = 1e8;
  Rig rig = chain(1, ParticleState::fixed, sort);
  rig.start();
  const double limit = 1e8 / kStiffness;  // elongation
  pull(rig, -10 * limit, 5);              // compression breaks nothing
  pull(rig, 0.999 * limit, 5);
  EXPECT_EQ(rig.bonds.intact[0], 1);
  const double stored = rig.forces.energy(rig.bonds).elastic();
  EXPECT_NEAR(stored, 0.5 * std::pow(0.999 * limit, 2) * kStiffness * kArea, 1e-9 * stored);
  pull(rig, 1.001 * limit, 1);
  EXPECT_EQ(rig.bonds.intact[0], 0);
  // Half of the last force stays for the kick that ends the step, so that the ends have given what is booked.
  EXPECT_NEAR(rig.particles.force[1].norm() / (0.5 * 1.001 * limit * kStiffness * kArea), 1, 1e-9);
  EXPECT_EQ(rig.forces.energy(rig.bonds).elastic(), 0);
  EXPECT_NEAR(rig.forces.energy(rig.bonds).breakage / (0.5 * std::pow(1.001 * limit, 2) * kStiffness * kArea), 1, 1e-9);
  pull(rig, 0, 5);  // stays broken, books nothing more
  EXPECT_EQ(rig.particles.force[1].norm(), 0);
  EXPECT_NEAR(rig.forces.energy(rig.bonds).breakage / stored, std::pow(1.001 / 0.999, 2), 1e-9);
}

TEST(BondForces, BrokenPlasticDissipatorBooksAllWorkAndNothingMore) {
  BondSort sort = wire();
  sort.axial = {{3.7e10, 1.2e8, 1.9e9}, {78.0e3, 98.2e3}, true};
  sort.bond_radius = 0.01;
  sort.tensile_strength = 90e3 / (kPi * 1e-4);  // breaks on the second branch
  Rig rig = chain(1, ParticleState::fixed, sort);
  rig.start();
  const double end = 12e3 / (1.2e8 * kPi * 1e-4) + 78e3 / (3.7e10 * kPi * 1e-4);  // elongation at 90 kN
  const double work = pull(rig, 0.9999 * end, 2000);
  EXPECT_EQ(rig.bonds.intact[0], 1);
  pull(rig, 1.0001 * end, 1);
  EXPECT_EQ(rig.bonds.intact[0], 0);
  const double dissipated = rig.forces.energy(rig.bonds).dissipated();
  EXPECT_NEAR(dissipated / work, 1, 1e-3);
  pull(rig, 2 * end, 10);
  EXPECT_EQ(rig.forces.energy(rig.bonds).dissipated(), dissipated);
}

/// Moves the second bead by `shift`, then rotates it by small steps about `axis` until its bond breaks; gives the
/// angle.
double angle_at_break(const BondSort& sort, const Vec3& axis, const Vec3& shift = Vec3::Zero()) {
  Rig rig = chain(1, ParticleState::fixed, sort);
  rig.start();
  rig.particles.position.add(1, shift);
  rig.particles.velocity.set(1, shift);
  rig.evaluate(1.0);
  rig.particles.velocity.set(1, Vec3::Zero());
  const double step = 1e-6;
  rig.particles.angular_velocity.set(1, step * axis);
  double angle = 0;
  while (rig.bonds.intact[0] != 0 && angle < 0.1) {
    rig.evaluate(1.0);
    angle += step;
  }
  return angle;
}

TEST(BondForces, BendingAndTorsionBreakAtTheRim) {
  BondSort sort = wire();
  sort.tensile_strength = 2e6;
  // |M| R / I = k_n theta R
  EXPECT_NEAR(angle_at_break(sort, Vec3::UnitY()), 2e6 / (kStiffness * kRadius), 2e-6);
  sort.tensile_strength = std::numeric_limits<double>::infinity();
  sort.shear_strength = 2e6;
  // |M_t| R / J = k_s theta R; bending also shears: |F_s| / A = k_s theta l / 2 = k_s theta R for touching beads
  EXPECT_NEAR(angle_at_break(sort, Vec3::UnitX()), 2e6 / (kStiffness * kRadius), 2e-6);
  EXPECT_NEAR(angle_at_break(sort, Vec3::UnitZ()), 2e6 / (kStiffness * kRadius), 2e-6);
}

/// Tension adds to what bending pulls at the rim, shear to what torsion does; compression relieves nothing (theory.md).
TEST(BondForces, StressesAtTheRimAddUp) {
  const double strength = 2e6, angle = strength / (kStiffness * kRadius), half = 0.5 * strength / kStiffness;
  BondSort sort = wire();
  sort.tensile_strength = strength;
  EXPECT_NEAR(angle_at_break(sort, Vec3::UnitY(), Vec3(half, 0, 0)), angle / 2, 2e-6);
  EXPECT_NEAR(angle_at_break(sort, Vec3::UnitY(), Vec3(-half, 0, 0)), angle, 2e-6);
  sort.tensile_strength = std::numeric_limits<double>::infinity();
  sort.shear_strength = strength;
  EXPECT_NEAR(angle_at_break(sort, Vec3::UnitX(), Vec3(0, half, 0)), angle / 2, 2e-6);
}

/// A pair of free beads set swinging in one mode: ratio of the amplitudes of the motion one period apart.
struct Mode {
  const char* name;
  Vec3 velocity, spin_i, spin_j;  // of bead 1 (bead 0 opposite); of each bead
  double stiffness, mass;         // of the mode
};

void expect_decay(const Mode& mode) {
  const double ratio = 0.05;
  BondSort sort = wire();
  sort.damping_ratio = ratio;
  Rig rig = chain(1, ParticleState::free, sort);
  rig.particles.velocity.set(0, -mode.velocity), rig.particles.velocity.set(1, mode.velocity);
  rig.particles.angular_velocity.set(0, mode.spin_i), rig.particles.angular_velocity.set(1, mode.spin_j);
  rig.start();
  const double before = rig.energy();
  const double period = 2 * kPi / std::sqrt(mode.stiffness / mode.mass * (1 - ratio * ratio));
  const int steps = 2000;
  for (int k = 0; k < steps; ++k) rig.step(period / steps);
  const double expected = std::exp(-4 * kPi * ratio / std::sqrt(1 - ratio * ratio));
  EXPECT_NEAR(rig.energy() / before / expected, 1, 0.01) << mode.name;
  EXPECT_NEAR((rig.energy() + rig.forces.energy(rig.bonds).damping) / before, 1, 0.002) << mode.name;
}

TEST(BondForces, DampingRatioHoldsInEveryMode) {
  const double mass = 4.0 / 3 * kPi * std::pow(kRadius, 3) * kDensity, inertia = 0.4 * mass * kRadius * kRadius;
  const double shear_mass = 1 / (2 / mass + 2 * kRadius * kRadius / inertia);
  const double v = 1e-3, spin = v * mass * kRadius / inertia;  // shear: forces and their levers swing together
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ(), none = Vec3::Zero();
  expect_decay({"axial", v * x, none, none, kStiffness * kArea, mass / 2});
  expect_decay({"bending", none, -0.1 * z, 0.1 * z, kStiffness * kInertia, inertia / 2});
  expect_decay({"torsion", none, -0.1 * x, 0.1 * x, kStiffness * 2 * kInertia, inertia / 2});
  expect_decay({"shear", v * y, -spin * z, -spin * z, kStiffness * kArea, shear_mass});
}

/// Many rings, or one long chain that no cut between chunks can leave whole; bits must not depend on the threads.
Rig crowd(bool rings) {
  Rig rig;
  rig.bonds.add_sort(wire());
  rig.bonds.sorts[0].damping_ratio = 0.02;
  if (rings)
    for (int k = 0; k < 90; ++k) add_ring(rig, {0.1 * k, 0, 0}, Vec3::UnitX(), Vec3::UnitY(), 36);
  else
    for (std::uint32_t k = 0; k <= 3500; ++k) rig.add({k * kBead, 0.3 * kBead * std::sin(0.1 * k), 0});
  if (!rings)
    for (std::uint32_t k = 0; k < 3500; ++k) rig.bonds.add({k, k + 1, 0}, rig.particles);
  for (std::uint32_t k = 0; k < rig.particles.size(); ++k)
    rig.particles.velocity.set(k, {std::sin(0.3 * k), std::cos(0.7 * k), std::sin(1.1 * k)});
  rig.start();
  return rig;
}

TEST(BondForces, SameBitsForAnyNumberOfThreads) {
  for (const bool rings : {true, false}) {
    Rig one = crowd(rings), two = crowd(rings);
    {
      const ThreadLimit limit(1);
      for (int k = 0; k < 50; ++k) one.step(2e-6);
    }
    const ThreadLimit limit(4);
    for (int k = 0; k < 50; ++k) two.step(2e-6);
    EXPECT_EQ(one.particles.position.x, two.particles.position.x);
    EXPECT_EQ(one.particles.force.y, two.particles.force.y);
    EXPECT_EQ(one.particles.torque.z, two.particles.torque.z);
    EXPECT_EQ(one.forces.energy(one.bonds).damping, two.forces.energy(two.bonds).damping);
    EXPECT_GT(one.forces.energy(one.bonds).elastic(), 0);
  }
}

TEST(BondForces, OrderOfBondsAndEndsDoesNotMatter) {
  Rig plain = chain(300, ParticleState::free), mixed = chain(300, ParticleState::free);
  Bonds shuffled;
  shuffled.add_sort(wire());
  for (std::uint32_t k = 0; k < 300; ++k) {
    const std::uint32_t b = 7 * k % 300;  // 7 and 300 have no common factor
    shuffled.add(b % 2 == 0 ? BondSpec{b, b + 1, 0} : BondSpec{b + 1, b, 0}, mixed.particles);
  }
  mixed.bonds = shuffled;
  for (Rig* rig : {&plain, &mixed}) {
    for (std::uint32_t k = 0; k <= 300; ++k) rig->particles.velocity.set(k, {0, std::sin(0.2 * k), std::cos(0.3 * k)});
    rig->start();
    rig->run(1e-3, 2e-6);
  }
  for (std::uint32_t k = 0; k <= 300; k += 50)
    EXPECT_LT((plain.particles.position[k] - mixed.particles.position[k]).norm(), 1e-11);
}

TEST(BondForces, RestartGoesOnWithTheSameBits) {
  Rig rig = tumbling_chain();
  rig.run(2e-3, 4e-6);
  Rig other;  // all that a checkpoint holds: particles and bonds
  other.particles = rig.particles;
  other.bonds = rig.bonds;
  other.forces.build(other.bonds, other.particles);
  rig.run(2e-3, 4e-6);
  other.run(2e-3, 4e-6);
  EXPECT_EQ(rig.particles.position.x, other.particles.position.x);
  EXPECT_EQ(rig.particles.torque.y, other.particles.torque.y);
}

TEST(BondForces, RefusesSortsAndEndsThatMakeNoSense) {
  const auto build = [](const std::function<void(Rig&)>& spoil) {
    Rig rig = chain(2, ParticleState::free);
    spoil(rig);
    rig.forces.build(rig.bonds, rig.particles);
  };
  EXPECT_NO_THROW(build([](Rig&) {}));
  EXPECT_THROW(build([](Rig& r) { r.bonds.sorts[0].bond_radius = 0; }), std::logic_error);
  EXPECT_THROW(build([](Rig& r) { r.bonds.sorts[0].shear_stiffness = -1; }), std::logic_error);
  EXPECT_THROW(build([](Rig& r) { r.bonds.sorts[0].damping_ratio = -0.1; }), std::logic_error);
  EXPECT_THROW(build([](Rig& r) { r.bonds.sorts[0].tensile_strength = 0; }), std::logic_error);
  EXPECT_THROW(build([](Rig& r) { r.bonds.i[0] = 3; }), std::logic_error);
  EXPECT_THROW(build([](Rig& r) { r.bonds.sort[0] = 1; }), std::logic_error);
  Rig rig = chain(2, ParticleState::free);
  rig.forces.build(rig.bonds, rig.particles);
  rig.bonds.add({0, 2, 0}, rig.particles);
  EXPECT_THROW(rig.evaluate(0), std::logic_error);
}

}  // namespace
}  // namespace lahar::dem
