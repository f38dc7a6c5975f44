#pragma once
// Wires that the cells resolve, in the fluid's blocks: the pieces between their beads are bodies as grains are
// (body_map.h), with the same fields, the same exchange and the same books of the liquid. What a piece does is shared
// by its two beads (wire_piece.h): force and torque, the weight and the inertia of the liquid in its place, the volume
// that it displaces.
//
// Written after the grains. A block without grains whose pieces all are, move and turn as before keeps its fields.
#include <array>
#include <span>
#include <vector>

#include "coupling/wires/resolved_wires.h"
#include "coupling/wires/wire_piece.h"
#include "lbm/free_surface/covered_cells.h"
#include "lbm/step/fluid.h"

namespace lahar::coupling {

/// Resistance at most of a cell in which there are wires alone. They hold it, but do not cover it: only spheres keep
/// books of what covered cells hold.
inline constexpr double kWireResistance = 0.1 * lbm::kCoveredResistance;

template <class Real>
class WireMap {
 public:
  /// Bonds of at least `smallest_diameter` (m) are mapped; `radius_shift` as in BodyMap.
  WireMap(const dem::Particles& particles, const dem::Bonds& bonds, double smallest_diameter, double radius_shift)
      : wires_(particles, bonds, smallest_diameter), radius_shift_(radius_shift) {}

  /// Looks for bonds that have broken; true if others are mapped than before.
  bool follow_breakage(const dem::Particles& particles, const dem::Bonds& bonds) {
    return wires_.update(particles, bonds);
  }

  /// Maps all pieces at their present places, after BodyMap::update, and books displaced volume.
  void update(lbm::Fluid<Real>& fluid, const dem::Particles& particles, const dem::Bonds& bonds);

  /// The same before the first step, see BodyMap::embed.
  void embed(lbm::Fluid<Real>& fluid, const dem::Particles& particles, const dem::Bonds& bonds);

  /// After the fluid step: adds force and torque (SI) of the fluid on each bead. Returns the sum of the forces in lu
  /// before the interior correction, for the audit.
  Vec3 add_forces(lbm::Fluid<Real>& fluid, dem::Particles& particles);

  [[nodiscard]] const ResolvedWires& wires() const { return wires_; }
  /// Volume of the pieces inside wet cells, in cells (last update).
  [[nodiscard]] double wet_volume() const;
  /// The part of it that is a bead's, in cells.
  [[nodiscard]] double wet_volume_of(dem::ParticleIndex bead) const {
    return bead < states_.size() ? states_[bead].wet : 0.0;
  }
  /// Blocks whose fields the last update wrote.
  [[nodiscard]] std::size_t written_blocks() const { return written_blocks_; }

  /// State of a checkpoint (coupled_step_transfer.cpp).
  void transfer(Archive& archive);

 private:
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
    double held = 0;  ///< liquid in wet cells that a step brings to the bead's velocity, cells
    double held_inertia = 0;
    double wet = 0;  ///< cells, under the cell types after the step
  };
  /// The last step of a bead.
  struct State {
    Vec3 velocity = Vec3::Zero(), spin = Vec3::Zero();           ///< m/s, rad/s
    Vec3 felt_force = Vec3::Zero(), felt_torque = Vec3::Zero();  ///< N, N m, as the bead follows it
    Vec3 acceleration = Vec3::Zero(), spin_up = Vec3::Zero();    ///< m/s^2, rad/s^2, mean of the last step
    double wet = 0;                                              ///< cells that the bead displaced after the last step
    bool known = false;                                          ///< velocity is set
  };

  void map(lbm::Fluid<Real>& fluid, const dem::Particles& particles, const dem::Bonds& bonds);
  void remember(const lbm::Fluid<Real>& fluid, const dem::Particles& particles);
  void place_pieces(const lbm::Fluid<Real>& fluid, const dem::Particles& particles, const dem::Bonds& bonds);
  void collect_pairs(const lbm::Fluid<Real>& fluid);
  void sort_by_block(const lbm::Fluid<Real>& fluid);
  void write_fields(lbm::Fluid<Real>& fluid);
  [[nodiscard]] bool is_same(const lbm::BodyFields<Real>& fields, std::size_t block) const;
  void write_block(lbm::Fluid<Real>& fluid, std::size_t block, bool write);
  void book_displacement(lbm::Fluid<Real>& fluid);
  void displace(lbm::Fluid<Real>& fluid, std::size_t block) const;
  void add_loads(const lbm::Fluid<Real>& fluid, std::size_t block);
  void hand_over(const lbm::Fluid<Real>& fluid, dem::Particles& particles, std::size_t bead);
  [[nodiscard]] std::span<const std::uint32_t> pairs_in(std::size_t block) const {
    return std::span(by_block_).subspan(block_start_[block], block_start_[block + 1] - block_start_[block]);
  }
  template <class Visit>
  void for_each_block(const Visit& visit) const;
  /// Calls visit(pair, end) for the pairs that a bead has a share in, in a fixed order.
  template <class Visit>
  void for_pairs_of(std::size_t bead, const Visit& visit) const {
    for (const std::uint32_t e : wires_.ends_at(bead))
      for (std::size_t p = first_pair_[e / 2]; p < first_pair_[e / 2 + 1]; ++p) visit(p, e % 2);
  }

  ResolvedWires wires_;
  double radius_shift_;
  std::vector<WireEnd> ends_;
  std::vector<GridPiece<Real>> pieces_, former_pieces_;
  std::vector<std::uint8_t> same_;  // per piece: as in the former mapping
  std::vector<Pair> pairs_;         // by piece, then block
  std::vector<std::size_t> first_pair_;
  std::vector<std::array<Share, 2>> shares_;  // by pair
  std::vector<std::array<Load, 2>> loads_;    // by pair
  std::vector<Vec3> taken_;                   // by pair: share of the exchange, lu
  std::vector<std::uint32_t> by_block_, block_start_, former_count_, next_;
  std::vector<std::uint8_t> write_;  // per block index: 1 keep, 2 write
  std::vector<double> displaced_;    // by bead: volume per covered interface cell
  std::vector<State> states_;        // per particle
  std::size_t written_blocks_ = 0;
};

extern template class WireMap<float>;
extern template class WireMap<double>;

}  // namespace lahar::coupling
