#pragma once
// Wires of beads that the tests of wire contacts share.
#include <utility>
#include <vector>

#include "dem/solids.h"
#include "tests/dem/small_scenes.h"

namespace lahar::dem::testing {

constexpr double kWireRadius = 0.003, kSpacing = 0.006;  // m

inline BondSort wire_sort() {
  BondSort s;
  s.axial.stiffness = {1e11, 1e11, 1e11};
  s.shear_stiffness = 1e11;
  s.bond_radius = kWireRadius;
  return s;
}

struct WireScene {
  Particles particles;
  Bonds bonds;
  int bodies = 0;

  WireScene() { bonds.add_sort(wire_sort()); }

  /// Beads at these points, bonded in turn; returns the first.
  ParticleIndex add_wire(const std::vector<Vec3>& points, bool closed = false,
                         ParticleState state = ParticleState::free) {
    const auto first = static_cast<ParticleIndex>(particles.size());
    for (const Vec3& x : points) {
      ParticleSpec bead = sphere(x, kWireRadius, 7850);
      bead.kind = ParticleKind::bead, bead.body = bodies, bead.state = state;
      particles.add(bead);
    }
    const auto n = static_cast<ParticleIndex>(points.size());
    for (ParticleIndex k = 0; k + 1 < n; ++k) bonds.add({first + k, first + k + 1, 0}, particles);
    if (closed) bonds.add({first + n - 1, first, 0}, particles);
    ++bodies;
    return first;
  }
  ParticleIndex add_grain(const Vec3& x, double radius, const Vec3& velocity = Vec3::Zero()) {
    return particles.add(sphere(x, radius, 2650, velocity));
  }
};

/// n beads, the middle of the row at `middle`.
inline std::vector<Vec3> straight(int n, const Vec3& middle, const Vec3& direction) {
  std::vector<Vec3> points;
  for (int k = 0; k < n; ++k) points.push_back(middle + (k - 0.5 * (n - 1)) * kSpacing * direction.normalized());
  return points;
}

/// A ring in the plane of two unit vectors.
inline std::vector<Vec3> circle(int n, double radius, const Vec3& centre, const Vec3& a, const Vec3& b) {
  std::vector<Vec3> points;
  for (int k = 0; k < n; ++k) {
    const double turn = 2 * std::numbers::pi * k / n;
    points.push_back(centre + radius * (std::cos(turn) * a + std::sin(turn) * b));
  }
  return points;
}

inline Materials steel(double friction = 0, double restitution = 1) {
  return one_material(1e9, 0.3, friction, restitution);
}

/// Forces of the wires' contacts alone on everything, as it lies and moves.
inline WireForces evaluate(Particles& p, const Bonds& bonds, const Materials& materials, double dt = 0) {
  WireForces forces(materials, HertzMindlin{}, {});
  forces.rebuild(p, bonds);
  std::vector<double> damping(p.size());
  forces.evaluate(p, damping, dt);
  p.force.fill(Vec3::Zero());
  p.torque.fill(Vec3::Zero());
  forces.add_forces(p, damping);
  return forces;
}

inline SolidsOptions smooth(double time_step) {
  SolidsOptions o = options(time_step);
  o.wire_contacts = WireContacts::capsules;
  return o;
}

}  // namespace lahar::dem::testing
