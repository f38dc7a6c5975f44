#pragma once
// Rings and cables thinner than a cell: each bead is a piece of a slender cylinder that feels the drag of the local
// flow and gives the opposite impulse to the cells around it.
//
// Drag follows the beads in their own steps (dem/liquid_drag.h): `apply` says before the step of the fluid what it is,
// `collect` takes up afterwards what it gave, and the cells get that at the next `apply`. Of the liquid around a bead
// each wire that is spread over the same cells moves its share. A bead weighs as a sphere and is lifted as one,
// whatever piece of wire it stands for. (Immersed boundaries are blind to such wires: as tau -> 1/2 the weighting of
// Noble & Torczynski lets the water through, B = eps overdrags.)
#include <optional>
#include <vector>

#include "coupling/audit.h"
#include "coupling/grains/grain_coupling.h"
#include "coupling/pairs_by_block.h"
#include "coupling/solid_fields.h"
#include "coupling/wires/wire_crowding.h"
#include "coupling/wires/wire_kernel.h"
#include "dem/bonds/bonds.h"
#include "dem/liquid_drag.h"
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

  /// Looks for bonds that have broken: a loose end has no neighbour.
  void follow_breakage(const dem::Bonds& bonds);

  /// Before the fluid step, after bodies are mapped. Wet beads get buoyancy (added to their external force, SI) and an
  /// entry in `drags`; cells get the opposite of it and of the impulses of the last step. What no cell takes, where a
  /// bead has left the liquid, its bead gives back.
  ExchangedMomentum apply(lbm::Fluid<Real>& fluid, dem::Particles& particles, SolidFields<Real>& fields,
                          std::vector<dem::LiquidDrag>& drags, const GrainCoupling<Real>* grains = nullptr);
  /// After the steps of the solids, with the drags of the last `apply`.
  void collect(std::span<const dem::LiquidDrag> drags);

  /// Momentum that drag gave the beads and the cells have still to give, N s.
  [[nodiscard]] Vec3 owed() const;

  /// Beads that stand for a piece of wire.
  [[nodiscard]] std::size_t beads() const;
  [[nodiscard]] bool acts_on(dem::ParticleId id) const { return place_[id] >= 0 && bead_at(id).length > 0; }
  [[nodiscard]] std::size_t wet_beads() const { return wet_beads_; }
  /// State of a checkpoint: what is not looked up anew in every step.
  void transfer(Archive& archive);

 private:
  struct Bead {
    dem::ParticleId id;
    dem::ParticleId before, after;  ///< neighbours along the wire; itself where there is none
    double diameter, length;        ///< m, of wire that the bead stands for
    double lifted = 1;              ///< share of its sphere: the rest is of pieces that are mapped
    Crowding crowding = {};         ///< the screen that it is part of
    // From step to step:
    bool dragged = false;              ///< in the last step
    Vec3 impulse = Vec3::Zero();       ///< N s, that the cells do not have yet
    Vec3 liquid = Vec3::Zero();        ///< m/s, of the liquid around it at the end of that step
    Vec3 acceleration = Vec3::Zero();  ///< m/s^2, of that liquid but for the drag, smoothed
    // Of this step:
    std::size_t first_pair = 0, pairs = 0;  ///< with the wet blocks in reach; they lie next to each other
    double weight = 0;                      ///< sum of kernel weights over wet cells, by liquid content
    double share = 0;                       ///< that is wet
    Vec3 buoyancy = Vec3::Zero();           ///< N
    Vec3 change = Vec3::Zero();             ///< of the liquid, by what it gives for the drag of the last step, lu
    Vec3 given = Vec3::Zero();              ///< by the cells for that and for buoyancy, lu of the coming step
  };
  /// A bead and a wet block that its kernel reaches; what it finds there and gives.
  struct BeadInBlock {
    lbm::BlockIndex block;
    std::uint32_t bead;            ///< index into beads_
    Vec3i lowest;                  ///< first cell of the block as the bead sees it: past the end of a periodic axis
    double weight = 0;             ///< sum of kernel weights over wet cells, by liquid content
    Vec3 velocity = Vec3::Zero();  ///< the same sum of velocities, lu
    Vec3 change = Vec3::Zero();    ///< and of what drag adds to them in this step
    double claims = 0;             ///< and of the claims of all wires
    Vec3 given = Vec3::Zero();     ///< momentum that the cells give, lu
  };
  /// What all wires do to the cells of a block.
  struct WiresInBlock {
    alignas(64) Real x[lbm::kBlockCells], y[lbm::kBlockCells], z[lbm::kBlockCells];  ///< velocity that drag gives, lu
    alignas(64) Real claims[lbm::kBlockCells];  ///< volume of liquid that they move, over that of the cell
  };

  void join_neighbours(const dem::Bonds& bonds);
  [[nodiscard]] const Bead& bead_at(dem::ParticleId id) const { return beads_[static_cast<std::size_t>(place_[id])]; }
  static std::optional<Vec3> tangent_of(const dem::Particles& particles, const Bead& bead);
  void look_at_neighbours(const lbm::Fluid<Real>& fluid, const dem::Particles& particles);
  void find_pairs(const lbm::Fluid<Real>& fluid, const dem::Particles& particles);
  void look_up_blocks(const lbm::Fluid<Real>& fluid, const dem::Particles& particles, std::size_t bead,
                      std::vector<BeadInBlock>& pairs);
  void allocate_fields(lbm::Fluid<Real>& fluid, SolidFields<Real>& fields);
  void weigh(const lbm::Fluid<Real>& fluid, BeadInBlock& pair) const;
  void choose_given(const lbm::Fluid<Real>& fluid, double time_step, dem::Particles& particles, Bead& bead) const;
  void spread(lbm::Fluid<Real>& fluid, BeadInBlock& pair, WiresInBlock& wires) const;
  void sample(const lbm::Fluid<Real>& fluid, BeadInBlock& pair, const WiresInBlock& wires) const;
  [[nodiscard]] dem::LiquidDrag drag_on(const lbm::Fluid<Real>& fluid, const dem::Particles& particles,
                                        const GrainCoupling<Real>* grains, Bead& bead) const;
  [[nodiscard]] double share_in_walls(const lbm::Fluid<Real>& fluid, const WireKernel& kernel) const;
  [[nodiscard]] double wet_share(const lbm::Fluid<Real>& fluid, const Bead& bead) const;
  [[nodiscard]] double liquid_volume(const lbm::Fluid<Real>& fluid, const Bead& bead) const;

  std::vector<Bead> beads_;          // by id, ascending
  std::vector<WireKernel> kernels_;  // of the beads
  std::vector<BeadInBlock> pairs_;   // by bead, then block
  std::vector<std::vector<BeadInBlock>> chunk_pairs_;
  PairsByBlock by_block_;
  std::vector<std::uint32_t> wires_at_;  // by block: index into wires_, for blocks in reach
  std::vector<WiresInBlock> wires_;
  std::vector<std::uint32_t> wet_;         // of this step: beads with drags, in the order of their ids
  std::vector<std::int32_t> place_;        // by id: index into beads_, -1 for grains
  std::vector<std::uint32_t> wire_bonds_;  // that are pieces of a wire
  std::size_t whole_ = 0;                  // of them, when the neighbours were looked for
  std::size_t wet_beads_ = 0;
  std::int64_t since_look_ = 0;  // fluid steps since neighbours were last looked at
};

extern template class WireDrag<float>;
extern template class WireDrag<double>;

}  // namespace lahar::coupling
