#pragma once
// Which particles may touch soon: cell lists, one grid per size class, giving a Verlet list with a skin.
#include <array>
#include <cstdint>
#include <vector>

#include "dem/particles.h"
#include "dem/rates.h"

namespace lahar::dem {

/// Pairs of particles that never count as neighbours (directly bonded beads).
class PairSet {
 public:
  /// Pairs (first[k], second[k]) with active[k] != 0, among `particles` particles.
  void assign(std::size_t particles, const std::vector<ParticleIndex>& first, const std::vector<ParticleIndex>& second,
              const std::vector<std::uint8_t>& active);
  [[nodiscard]] bool contains(ParticleIndex a, ParticleIndex b) const;

 private:
  std::vector<std::uint32_t> offset_;   // per particle, CSR
  std::vector<ParticleIndex> partner_;  // both directions
};

/// True if any position is farther from where it was than the root of its limit (m^2), or not a number.
[[nodiscard]] bool any_moved(const Vec3Field& now, const Vec3Field& then, const std::vector<double>& limit2,
                             double share = 1);

/// A particle's skin is relative_skin x its radius, at least minimum_skin. Two particles are neighbours while their gap
/// is below the mean of their skins; the list holds until one has moved half its own skin.
struct NeighbourOptions {
  double relative_skin = 0.25;
  double minimum_skin = 0;  ///< m
};

/// Half Verlet list in CSR form: row i lists its neighbours in the order of their ids, and each pair stands in one row
/// only (that of the smaller size class; of the lower id within a class). The same particles give the same list on any
/// number of threads and in any numbering. Removed particles, pairs of fixed particles and excluded pairs are left out.
class NeighbourList {
 public:
  explicit NeighbourList(NeighbourOptions options = {}) : options_(options) {}

  /// True if the list must be built again: a particle was added or has moved by more than this share of half the skin
  /// (or is not a number).
  [[nodiscard]] bool outdated(const Particles& particles, double share = 1) const;
  /// Lists the pairs of `share`. Positions must be finite.
  void build(const Particles& particles, const PairSet& excluded, const RateShare& share = {});

  [[nodiscard]] const std::vector<std::uint32_t>& offset() const { return offset_; }
  [[nodiscard]] const std::vector<ParticleIndex>& neighbour() const { return neighbour_; }
  /// Skin of particle i, m.
  [[nodiscard]] double skin(const Particles& particles, std::size_t i) const;
  [[nodiscard]] std::int64_t builds() const { return builds_; }
  /// The same list of renumbered particles.
  void renumber(const Renumbering& change);
  /// State of a checkpoint: the list and where the particles were when it was built (solids_transfer.cpp).
  void transfer(Archive& archive, const Particles& particles, const RateShare& share);

 private:
  // A particle as its grid stores it, next to the others of its cell.
  struct Member {
    double x, y, z, reach;  // reach: radius + half skin; neighbours are nearer than the sum of their reaches
    ParticleIndex index;
    bool free, slow;
  };
  // Particles whose reach lies between 2^k and 2^(k+1), sorted by cell. The grid is a torus: cell coordinates wrap at a
  // power of two, so that memory follows the number of particles and not the size of the scene. Particles a period
  // apart share cells; the distance test tells them apart.
  struct Level {
    int exponent = 0;
    double cell_size = 0, largest_reach = 0;
    bool only_slow = false;            // no pair of two of its particles is looked for
    std::array<int, 3> bits{2, 2, 2};  // period of the torus per axis: at least 4 cells, more than a search spans
    std::vector<std::uint32_t> start;  // per cell
    std::vector<Member> members;
    std::vector<ParticleIndex> particles;

    [[nodiscard]] std::int64_t coordinate(double x) const;
    [[nodiscard]] std::size_t row(std::int64_t iy, std::int64_t iz) const;
    [[nodiscard]] std::size_t wrapped_x(std::int64_t ix) const;
    void choose_period(const Particles& particles);
  };

  void sort_into_levels(const Particles& particles, const RateShare& share);
  void fill_level(Level& level, const Particles& particles, const RateShare& share);
  void search(const Particles& particles, const PairSet& excluded, const RateShare& share, std::size_t i,
              std::vector<ParticleIndex>& row) const;
  static void search_level(const Level& level, const Member& me, bool same_level, const Numbering& numbering,
                           const PairSet& excluded, std::vector<ParticleIndex>& row);
  void remember_positions(const Particles& particles, const RateShare& share);
  void set_move_limits(const Particles& particles, const RateShare& share);

  NeighbourOptions options_;
  std::vector<Level> levels_;  // ascending exponent
  std::vector<std::uint32_t> offset_;
  std::vector<ParticleIndex> neighbour_;
  std::vector<std::vector<ParticleIndex>> chunk_rows_;
  Vec3Field built_at_;
  std::vector<double> move_limit2_;
  std::int64_t builds_ = 0;
};

}  // namespace lahar::dem
