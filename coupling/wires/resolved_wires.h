#pragma once
// Which pieces of wire the cells resolve, and how they are joined.
#include <cstdint>
#include <span>
#include <vector>

#include "coupling/wires/wire_bonds.h"

namespace lahar::coupling {

/// Where a piece ends: see WireCut.
struct WireEnd {
  Vec3 normal = Vec3::Zero();
  int side = 0;
};

/// The bonds of a scene that are mapped: wires of at least a given diameter, as long as they are whole. What a broken
/// bond held goes back to the drag law of its beads: a bead does not know which way the stump points.
class ResolvedWires {
 public:
  /// `smallest_diameter` in m.
  ResolvedWires(const dem::Particles& particles, const dem::Bonds& bonds, double smallest_diameter);

  /// Looks for bonds that have broken; true if the pieces are others than before.
  bool update(const dem::Particles& particles, const dem::Bonds& bonds);

  /// The bonds that are mapped, ascending: the pieces.
  [[nodiscard]] std::span<const std::uint32_t> bonds() const { return pieces_; }
  /// State of a checkpoint: a bond that broke in the last step is a piece until the next look.
  void transfer(Archive& archive);
  /// Per bond: whether it is mapped.
  [[nodiscard]] const std::vector<std::uint8_t>& is_mapped() const { return mapped_; }
  /// The beads of the pieces by id, ascending.
  [[nodiscard]] std::span<const dem::ParticleId> beads() const { return beads_; }
  /// Index into beads() of the first (0) or second (1) bead of a piece.
  [[nodiscard]] std::uint32_t bead_of(std::size_t piece, int end) const { return bead_of_[2 * piece + end_index(end)]; }
  /// Ends that meet at a bead: 2 piece + end.
  [[nodiscard]] std::span<const std::uint32_t> ends_at(std::size_t bead) const {
    return std::span(ends_).subspan(first_end_[bead], first_end_[bead + 1] - first_end_[bead]);
  }

  /// The ends of all pieces at present, in the order 2 piece + end. Where two pieces meet at less than a right angle
  /// from straight they share a plane, all others are flat. A wire that ends where its image or another wire's begins,
  /// whole periods (m, 0 for none) away, goes on there.
  void find_ends(const dem::Particles& particles, const dem::Bonds& bonds, const Vec3& period,
                 std::vector<WireEnd>& ends) const;

 private:
  static std::size_t end_index(int end) { return static_cast<std::size_t>(end); }
  void find_pieces();
  void link();

  std::vector<std::uint8_t> thick_, mapped_;
  std::vector<dem::ParticleId> id_i_, id_j_;  // ends of all bonds
  std::vector<std::uint32_t> pieces_, bead_of_, first_end_, ends_;
  std::vector<dem::ParticleId> beads_, first_, second_;  // beads of all pieces; of each piece
};

}  // namespace lahar::coupling
