#pragma once
// Wires that the cells resolve, in the fluid's blocks: the pieces between their beads are bodies as grains are
// (grains/resolved_exchange.h), with the same fields, the same exchange and the same books of the liquid. What a piece
// does is shared by its two beads (grid_cylinder.h): force and torque, the weight and the inertia of the liquid in its
// place, the volume that it displaces.
//
// The exchange of a step is that of the velocities at its start. Held over the beads' own steps alone it would shake
// stiff bonds, which turn round many times in it (docs/decisions/0105). So in these a bead feels, too, what the
// exchange would change by as its velocity does: the liquid that a step brings to its velocity, M, drags it with 2 M/dt
// towards the velocity of the start (dem/liquid_drag.h). No cell gave that: it is lent, and taken back by a share in
// each step.
//
// Written after the grains. A block without grains whose pieces all are, move and turn as before keeps its fields.
#include <array>
#include <functional>
#include <span>
#include <vector>

#include "coupling/coupling_options.h"
#include "coupling/pairs_by_block.h"
#include "coupling/solid_fields.h"
#include "coupling/wires/grid_cylinder.h"
#include "coupling/wires/resolved_wires.h"
#include "dem/liquid_drag.h"
#include "lbm/step/fluid.h"

namespace lahar::coupling {

template <class Real>
class WireMap {
 public:
  /// `cell_size` in m.
  WireMap(const dem::Particles& particles, const dem::Bonds& bonds, const MappedWires& options, double cell_size)
      : wires_(particles, bonds, options.from_diameter * cell_size * (1 - 1e-9)),
        radius_shift_(options.radius_shift),
        ever_mapped_(wires_.beads().begin(), wires_.beads().end()) {}

  /// Looks for bonds that have broken; true if others are mapped than before.
  bool follow_breakage(const dem::Particles& particles, const dem::Bonds& bonds) {
    return wires_.update(particles, bonds);
  }

  /// Maps all pieces at their present places, after GrainCoupling::update, and books displaced volume.
  void update(lbm::Fluid<Real>& fluid, const dem::Particles& particles, const dem::Bonds& bonds,
              SolidFields<Real>& fields);

  /// The same before the first step, see GrainCoupling::embed.
  void embed(lbm::Fluid<Real>& fluid, const dem::Particles& particles, const dem::Bonds& bonds,
             SolidFields<Real>& fields);

  /// After the fluid step: adds force and torque (SI) of the fluid on each bead. Returns the sum of the forces in lu
  /// before the interior correction, for the audit.
  Vec3 add_forces(const lbm::Fluid<Real>& fluid, dem::Particles& particles);
  /// After that: an entry in `drags` for each bead that moves in liquid, but for those that `is_dragged` says have one.
  void add_drags(double time_step, const dem::Particles& particles,
                 const std::function<bool(dem::ParticleId)>& is_dragged, std::vector<dem::LiquidDrag>& drags);
  /// After the steps of the solids, with the entries of the last `add_drags`.
  void collect(std::span<const dem::LiquidDrag> drags);

  [[nodiscard]] const ResolvedWires& wires() const { return wires_; }
  /// Momentum that drags gave the beads and that is still to be taken back, N s.
  [[nodiscard]] Vec3 lent() const;
  /// Volume of the pieces inside wet cells, in cells (last update).
  [[nodiscard]] double wet_volume() const;
  /// The part of it that is a bead's, in cells.
  [[nodiscard]] double wet_volume_of(dem::ParticleId bead) const {
    return bead < states_.size() ? states_[bead].wet : 0.0;
  }
  /// Blocks whose fields the last update wrote.
  [[nodiscard]] std::size_t written_blocks() const {
    return static_cast<std::size_t>(std::count_if(tasks_.begin(), tasks_.end(), [](Task t) { return t > Task::keep; }));
  }

  /// State of a checkpoint.
  void transfer(Archive& archive);

 private:
  /// What is to be done with the fields of a block.
  enum class Task : std::uint8_t {
    none,   ///< no wire reaches it
    keep,   ///< they hold what would be written again
    add,    ///< to what grains wrote
    write,  ///< into emptied ones
  };
  /// A piece and one block that it reaches.
  struct Pair {
    lbm::BlockIndex block;
    std::uint32_t piece;
    std::uint64_t birth;  ///< of the block
    Vec3i lowest;         ///< first cell of the block as the piece sees it: past the end of a periodic axis
  };
  /// Of a pair, for each of the two beads, by their shares of each cell.
  struct Share {
    double wet = 0;      ///< cells, over wet cells
    double surface = 0;  ///< sum of eps over interface cells
  };
  /// What the cells of a pair do to a bead, lu.
  struct Load {
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    double entrained = 0;  ///< liquid in wet cells that a step brings to the bead's velocity, cells
    double entrained_inertia = 0;
    double wet = 0;  ///< cells, under the cell types after the step
  };
  /// The last step of a bead.
  struct State {
    Vec3 velocity = Vec3::Zero(), spin = Vec3::Zero();           ///< m/s, rad/s
    Vec3 felt_force = Vec3::Zero(), felt_torque = Vec3::Zero();  ///< N, N m, under-relaxed
    Vec3 acceleration = Vec3::Zero(), spin_up = Vec3::Zero();    ///< m/s^2, rad/s^2, mean of the last step
    Vec3 lent_impulse = Vec3::Zero(), lent_spin = Vec3::Zero();  ///< N s, N m s, by drags: no cell gave it
    double wet = 0;                                              ///< cells that the bead displaced after the last step
    bool known = false;                                          ///< velocity is set
    // Of the step under way:
    double entrained = 0, entrained_inertia = 0;  ///< kg, kg m^2: see Load
  };

  void map(lbm::Fluid<Real>& fluid, const dem::Particles& particles, const dem::Bonds& bonds,
           SolidFields<Real>& fields);
  void remember(const lbm::Fluid<Real>& fluid, const dem::Particles& particles);
  void place_pieces(const lbm::Fluid<Real>& fluid, const dem::Particles& particles, const dem::Bonds& bonds);
  void collect_pairs(const lbm::Fluid<Real>& fluid);
  void choose_blocks(lbm::FluidGrid<Real>& grid, SolidFields<Real>& fields);
  [[nodiscard]] bool is_unchanged(std::size_t block) const;
  void write_block(lbm::Fluid<Real>& fluid, std::size_t block);
  void book_displacement(lbm::Fluid<Real>& fluid);
  void displace(lbm::Fluid<Real>& fluid, std::size_t block) const;
  void add_loads(const lbm::Fluid<Real>& fluid, std::size_t block);
  void hand_over(const lbm::Fluid<Real>& fluid, dem::Particles& particles, std::size_t bead);
  void take_back(double time_step, dem::Particles& particles);
  /// Calls visit(pair, end) for the pairs that a bead has a share in, in a fixed order.
  template <class Visit>
  void for_pairs_of(std::size_t bead, const Visit& visit) const {
    for (const std::uint32_t e : wires_.ends_at(bead))
      for (std::size_t p = first_pair_[e / 2]; p < first_pair_[e / 2 + 1]; ++p) visit(p, e % 2);
  }

  ResolvedWires wires_;
  double radius_shift_;
  double time_step_ = 0;  // s, that the solids advanced before the last mapping
  std::vector<WireEnd> ends_;
  std::vector<GridCylinder<Real>> pieces_, former_pieces_;
  std::vector<std::uint8_t> same_;  // per piece: as in the former mapping
  std::vector<Pair> pairs_;         // by piece, then block
  std::vector<std::size_t> first_pair_;
  std::vector<std::array<Share, 2>> shares_;  // by pair
  std::vector<std::array<Load, 2>> loads_;    // by pair
  std::vector<Vec3> taken_;                   // by pair: share of the exchange, lu
  PairsByBlock by_block_;
  std::vector<Task> tasks_;                   // per block index
  std::vector<double> displaced_;             // by bead: volume per covered interface cell
  std::vector<double> isolated_;              // volume for which beads cover no interface cell, lu by block index
  std::vector<State> states_;                 // by id
  std::vector<dem::ParticleId> ever_mapped_;  // beads, by id
  std::vector<dem::ParticleId> dragged_;      // those of the drags of this step
};

extern template class WireMap<float>;
extern template class WireMap<double>;

}  // namespace lahar::coupling
