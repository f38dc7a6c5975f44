#pragma once
// Wires of beads that several tests use.
#include <numbers>

#include "tests/coupling/tanks.h"

namespace lahar::coupling {

/// Beads and the bonds between them.
struct Chains {
  dem::Particles particles;
  dem::Bonds bonds;

  /// A sort of bond with a section of this diameter (m).
  int add_sort(double diameter) {
    dem::BondSort sort;
    sort.axial.stiffness = {1e9, 1e9, 1e9};
    sort.shear_stiffness = 1e9;
    sort.bond_radius = diameter / 2;
    sort.damping_ratio = 0.05;
    return bonds.add_sort(sort);
  }
  dem::ParticleIndex add_bead(const Vec3& place, double diameter, dem::ParticleState state, double density = 7850) {
    auto bead = grain(place, diameter / 2, density);
    bead.kind = dem::ParticleKind::bead;
    bead.state = state;
    return particles.add(bead);
  }
  /// Along the given places; closed if the last is bonded with the first.
  void add(const std::vector<Vec3>& places, double diameter, bool closed,
           dem::ParticleState state = dem::ParticleState::fixed, double density = 7850) {
    const int sort = add_sort(diameter);
    const auto first = static_cast<dem::ParticleIndex>(particles.size());
    for (const Vec3& p : places) add_bead(p, diameter, state, density);
    const auto n = static_cast<dem::ParticleIndex>(places.size());
    for (dem::ParticleIndex k = 0; k + 1 < n; ++k) bonds.add({first + k, first + k + 1, sort}, particles);
    if (closed) bonds.add({first + n - 1, first, sort}, particles);
  }
};

inline std::vector<Vec3> straight_line(const Vec3& start, const Vec3& end, int beads) {
  std::vector<Vec3> places;
  for (int k = 0; k < beads; ++k) places.push_back(start + (end - start) * (static_cast<double>(k) / (beads - 1)));
  return places;
}

/// A ring around `normal` (unit).
inline std::vector<Vec3> circle(const Vec3& centre, const Vec3& normal, double diameter, int beads) {
  const Vec3 one = normal.unitOrthogonal(), other = normal.cross(one);
  std::vector<Vec3> places;
  for (int k = 0; k < beads; ++k) {
    const double angle = 2 * std::numbers::pi * k / beads;
    places.push_back(centre + diameter / 2 * (std::cos(angle) * one + std::sin(angle) * other));
  }
  return places;
}

}  // namespace lahar::coupling
