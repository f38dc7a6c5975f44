#pragma once
// Parallel bonds (Potyondy & Cundall 2004): elastic links that carry force and moment between two particles.
// Stiffness is per unit area (N/m^3). A dissipator is a bond with a piecewise linear axial law (Li, Zhao & Kwan 2020,
// Eq. 1).
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/archive.h"
#include "core/check.h"
#include "core/vector.h"
#include "dem/particles.h"

namespace lahar::dem {

/// Axial law of a bond: stiffness per area k[0] up to force_limit[0], k[1] up to force_limit[1], then k[2]. An
/// ordinary bond has infinite limits. Compression uses k[0], or nothing where the bond is a wire that only pulls.
struct AxialLaw {
  std::array<double, 3> stiffness{0, 0, 0};  ///< N/m^3
  std::array<double, 2> force_limit{std::numeric_limits<double>::infinity(),
                                    std::numeric_limits<double>::infinity()};  ///< N
  bool plastic_unloading = false;  ///< unload with stiffness[0] instead of back along the curve
  bool tension_only = false;       ///< slack wherever it would push
};

/// What bonds of one sort share: ring wire, cable wire, dissipator.
struct BondSort {
  AxialLaw axial;
  double shear_stiffness = 0;                                         ///< N/m^3, for shear and torsion
  double bond_radius = 0;                                             ///< m
  double tensile_strength = std::numeric_limits<double>::infinity();  ///< Pa
  double shear_strength = std::numeric_limits<double>::infinity();    ///< Pa
  double damping_ratio = 0;                                           ///< of critical, in every mode
};

struct BondSpec {
  ParticleId i = 0, j = 0;
  int sort = 0;
};

/// All bonds, structure of arrays. Rest length and rest orientation are taken from the positions when a bond is added.
struct Bonds {
  std::vector<BondSort> sorts;
  std::vector<ParticleId> id_i, id_j;  ///< the ends
  std::vector<ParticleIndex> i, j;     ///< where they stand now
  std::vector<std::int32_t> sort;
  std::vector<std::uint8_t> intact;        ///< 0 once broken
  std::vector<double> rest_length;         ///< m
  std::vector<double> elongation;          ///< m, current length - rest length
  std::vector<double> plastic_elongation;  ///< m, only with plastic unloading
  std::vector<double> axial_force;         ///< N, tension positive
  Vec3Field shear_force;                   ///< N, on i
  Vec3Field moment;                        ///< N m, on i: bending part (normal to the bond)
  std::vector<double> torsion_moment;      ///< N m, about the bond
  Vec3Field direction;                     ///< unit, from i to j, that shear_force and moment are normal to
  double damping_loss = 0;                 ///< J, dissipated by bond damping so far
  double breakage_loss = 0;                ///< J, elastic energy that bonds held when they broke

  [[nodiscard]] std::size_t size() const { return i.size(); }
  /// State of a checkpoint, broken bonds included (solids_transfer.cpp). The sorts are the scene's.
  void transfer(Archive& archive);
  int add_sort(const BondSort& s) {
    sorts.push_back(s);
    return static_cast<int>(sorts.size() - 1);
  }
  /// Finds the ends again after the particles were renumbered.
  void find_ends(const Particles& particles) {
    for (std::size_t b = 0; b < size(); ++b) i[b] = particles.index(id_i[b]), j[b] = particles.index(id_j[b]);
  }
  /// Bonds from `first` on get the load of all of another's: the same bonds elsewhere.
  void take_load(std::size_t first, const Bonds& other) {
    for (std::size_t b = 0; b < other.size(); ++b) {
      const std::size_t to = first + b;
      intact[to] = other.intact[b];
      elongation[to] = other.elongation[b], plastic_elongation[to] = other.plastic_elongation[b];
      axial_force[to] = other.axial_force[b], torsion_moment[to] = other.torsion_moment[b];
      shear_force.set(to, other.shear_force[b]), moment.set(to, other.moment[b]);
      direction.set(to, other.direction[b]);
    }
  }
  /// Adds a bond at rest in the present configuration.
  void add(const BondSpec& spec, const Particles& particles) {
    const ParticleIndex at_i = particles.index(spec.i), at_j = particles.index(spec.j);
    const Vec3 arm = particles.position[at_j] - particles.position[at_i];
    require(arm.norm() > 0, "a bond needs two particles at different places");
    id_i.push_back(spec.i);
    id_j.push_back(spec.j);
    i.push_back(at_i);
    j.push_back(at_j);
    sort.push_back(spec.sort);
    intact.push_back(1);
    rest_length.push_back(arm.norm());
    direction.push_back(arm.normalized());
    for (auto* v : {&elongation, &plastic_elongation, &axial_force, &torsion_moment}) v->push_back(0.0);
    shear_force.push_back(Vec3::Zero());
    moment.push_back(Vec3::Zero());
  }
};

}  // namespace lahar::dem
