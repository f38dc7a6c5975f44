#pragma once
// Rings and cables thinner than a cell: each bead is a piece of a slender cylinder that feels the drag of the local
// flow and gives the opposite force to the cells around it. (Immersed boundaries are blind to such wires: as tau -> 1/2
// the weighting of Noble & Torczynski lets the water through, B = eps overdrags; DESIGN figures in docs/coupling.md.)
#include <array>
#include <vector>

#include "coupling/audit.h"
#include "coupling/solid_fields.h"
#include "coupling/wires/wire_crowding.h"
#include "coupling/wires/wire_kernel.h"
#include "dem/bonds/bonds.h"
#include "dem/particles.h"
#include "lbm/step/fluid.h"

namespace lahar::coupling {

template <class Real>
class WireDrag {
 public:
  /// Reads from the bonds which beads are neighbours along a wire and how long a piece each bead stands for.
  WireDrag(const dem::Particles& particles, const dem::Bonds& bonds);

  /// Leaves out what is mapped (wire_map.h): `is_mapped` per bond. Half of each other bond is its bead's, whole or
  /// broken.
  void leave_out(const dem::Bonds& bonds, const std::vector<std::uint8_t>& is_mapped);

  /// Before the fluid step, after bodies are mapped: drag and buoyancy on every wet bead (added to its external force,
  /// SI) and the opposite impulses into the cells.
  ExchangedMomentum apply(lbm::Fluid<Real>& fluid, dem::Particles& particles, SolidFields<Real>& fields);

  /// Beads that stand for a piece of wire.
  [[nodiscard]] std::size_t beads() const;
  [[nodiscard]] bool acts_on(dem::ParticleId id) const { return place_[id] >= 0 && bead_at(id).length > 0; }
  [[nodiscard]] std::size_t wet_beads() const { return wet_beads_; }
  /// State of a checkpoint: what is not looked up anew in every step.
  void transfer(Archive& archive);

 private:
  struct Bead {
    dem::ParticleId id;
    dem::ParticleId before, after;             ///< neighbours along the wire; itself where there is none
    double length;                             ///< m, of wire that the bead stands for
    bool near = false;                         ///< a wet block is in reach in this step
    Vec3i lowest = Vec3i::Zero();              ///< block coordinate of the lowest cell in reach
    Crowding crowding = {};                    ///< the screen that it is part of
    std::array<lbm::BlockIndex, 27> blocks{};  ///< wet blocks in reach, from `lowest` on, (x, y, z) at 9x + 3y + z
  };
  /// What a bead samples and gives, filled in parallel.
  struct Sample {
    Vec3 force = Vec3::Zero();  ///< on the bead, lu
    double weight = 0;          ///< sum of kernel weights over wet cells, by liquid content
  };

  /// The block in reach of a bead that holds a cell; kNoBlock if it is missing or dry.
  static lbm::BlockIndex block_at(const Bead& bead, const Vec3i& cell);
  [[nodiscard]] const Bead& bead_at(dem::ParticleId id) const { return beads_[static_cast<std::size_t>(place_[id])]; }
  static WireKernel kernel_at(const lbm::Fluid<Real>& fluid, const dem::Particles& particles, dem::ParticleIndex i);
  static Vec3 tangent_of(const dem::Particles& particles, const Bead& bead);
  void look_at_neighbours(const lbm::Fluid<Real>& fluid, const dem::Particles& particles);
  void allocate_fields(lbm::Fluid<Real>& fluid, const dem::Particles& particles, SolidFields<Real>& fields);
  static void look_up_blocks(const lbm::Fluid<Real>& fluid, const dem::Particles& particles, Bead& bead);
  [[nodiscard]] Sample sample(const lbm::Fluid<Real>& fluid, const dem::Particles& particles, const Bead& bead) const;

  std::vector<Bead> beads_;                // by id, ascending
  std::vector<std::int32_t> place_;        // by id: index into beads_, -1 for grains
  std::vector<std::uint32_t> wire_bonds_;  // that are pieces of a wire
  std::vector<Sample> samples_;
  std::size_t wet_beads_ = 0;
  std::int64_t applied_ = 0;
};

extern template class WireDrag<float>;
extern template class WireDrag<double>;

}  // namespace lahar::coupling
