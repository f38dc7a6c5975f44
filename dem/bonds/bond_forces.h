#pragma once
// Forces and moments of parallel bonds (Potyondy & Cundall 2004, section 2.3; Li, Zhao & Kwan 2020, section 2.1).
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/vector.h"
#include "dem/bonds/axial_law.h"
#include "dem/bonds/bonds.h"
#include "dem/particles.h"

namespace lahar::dem {

/// Energy in J. The first four are stored, the rest is lost.
struct BondEnergy {
  double axial = 0, shear = 0, bending = 0, torsion = 0;
  double damping = 0;   ///< dissipated by bond damping
  double plastic = 0;   ///< dissipated by plastic elongation
  double breakage = 0;  ///< held by bonds at the moment they broke

  [[nodiscard]] double elastic() const { return axial + shear + bending + torsion; }
  [[nodiscard]] double dissipated() const { return damping + plastic + breakage; }
  BondEnergy& operator+=(const BondEnergy& o);
};

/// Computes what the bonds do to their particles. Holds constants and scratch space only: all that a restart needs lies
/// in `Bonds`.
class BondForces {
 public:
  /// Prepares for these bonds. Call again after bonds were added or masses changed. Throws std::logic_error for a bond
  /// sort that makes no sense (see axial_curve) or an end that does not exist.
  void build(const Bonds& bonds, const Particles& particles);

  /// Carries the bonds over a time step of dt seconds that has brought the particles to their present positions, and
  /// adds forces and torques. Angular velocities must be those of the middle of that step, as in a
  /// half-kick-drift-half-kick scheme between the kicks. With dt = 0 the ends count as not having turned (first
  /// evaluation). The critical time step is the caller's business, and so is cutting (`intact` = 0) the bonds of a
  /// particle that is taken out. Deterministic for any number of threads.
  void add_forces(Bonds& bonds, Particles& particles, double dt);

  /// The particles were renumbered, and the bonds know where their ends stand.
  void find_ends(const Bonds& bonds);

  /// Energies of these bonds, which must be those that were built, after the last call of add_forces. Summed when asked
  /// for, in an order that does not depend on the number of threads.
  [[nodiscard]] BondEnergy energy(const Bonds& bonds) const;

  /// What all bonds of a sort share, from BondSort.
  struct Constants {
    AxialCurve axial;
    double shear_stiffness = 0, bending_stiffness = 0, torsion_stiffness = 0;  // N/m, N m/rad, N m/rad
    double tension_limit = 0, bending_to_tension = 0;                          // |F_n| + b |M_b| > limit breaks
    double shear_limit = 0, torsion_to_shear = 0;                              // |F_s| + t |M_t| > limit breaks
    double axial_damping = 0, shear_damping = 0;                               // times sqrt(effective mass): N s/m
    double bending_damping = 0, torsion_damping = 0;  // times sqrt(effective inertia): N m s/rad
    bool plastic = false, damped = false, breakable = false;
  };

  /// Consecutive bonds of one sort whose ends have consecutive ids too, as beads have along their ring or cable. Nearly
  /// all bonds lie in long links. Where the ends also stand next to each other in the arrays, which is so unless
  /// particles were renumbered, bond first + k joins what stands at i + k and j + k, and needs no indices.
  struct Link {
    std::uint32_t first, last;
    ParticleIndex i, j;  // of the first bond
    bool chain;          // the second end of a bond is the first one of the next
    bool in_line;        // the ends stand next to each other
  };
  /// Links of one sort, few enough bonds for the first-level cache.
  struct Tile {
    std::uint32_t first, last;            // bonds
    std::uint32_t first_link, last_link;  // of links_
    std::int32_t sort;
  };
  /// Square roots of the effective mass (kg^1/2) and inertia (kg^1/2 m) of each bond's modes, for damping.
  struct EffectiveMasses {
    std::vector<double> axial, shear, inertia;
  };

 private:
  /// What one thread does at a time: all tiles of a stretch of bonds, adding to its particles as it goes. Chunks of one
  /// colour have no particle in common.
  struct Chunk {
    std::uint32_t first, last;            // bonds
    std::uint32_t first_tile, last_tile;  // of tiles_
    double damping_loss, breakage_loss;   // J, of this step
  };

  void build_effective_masses(const Bonds& bonds, const Particles& particles);
  void build_chunks(const Bonds& bonds, std::size_t particles);
  void build_tiles(const Bonds& bonds);
  void build_colours(const Bonds& bonds, std::size_t particles);
  void advance_chunk(Chunk& chunk, Bonds& bonds, Particles& particles, double dt) const;

  std::vector<Constants> constants_;
  EffectiveMasses masses_;
  std::vector<Link> links_;
  std::vector<Tile> tiles_;
  std::vector<Chunk> chunks_;
  std::vector<std::vector<std::uint32_t>> colours_;  // chunks of each colour
  std::size_t size_ = 0;
};

}  // namespace lahar::dem
