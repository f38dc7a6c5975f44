#pragma once
// Where the grains are in the fluid's blocks: which blocks and cells each reaches, and what it covers of them. Geometry
// alone; the books of the liquid are in displaced_volume.h, forces in grain_exchange.h.
//
// Only what changed is redone: a grain that stands where it stood keeps its blocks and volumes. The results are those
// of a full mapping, to the bit. Grains are known by id and stand in the order of ids, and so do all sums over them:
// particles may be renumbered between two mappings.
#include <array>
#include <functional>
#include <vector>

#include "coupling/grains/grid_sphere.h"
#include "coupling/pairs_by_block.h"
#include "dem/particles.h"
#include "lbm/step/fluid.h"

namespace lahar::coupling {

/// A grain and one block that it reaches.
struct GrainInBlock {
  lbm::BlockIndex block;
  std::uint32_t grain;  ///< index into GrainMap::grains()
  std::uint64_t birth;  ///< of the block
  Vec3i lowest;         ///< first cell of the block as the grain sees it: past the end of a periodic axis
  double volume = 0;    ///< cells, over all cells of the block
};

/// Against the former mapping.
enum class GrainChange : std::uint8_t {
  none,
  motion,  ///< stands where it stood, with another velocity or spin
  place,
};

/// Its pairs lie next to each other, in the order of the blocks along x, y, z.
struct MappedGrain {
  dem::ParticleId id;
  std::size_t first_pair = 0, pairs = 0;
  GrainChange change = GrainChange::place;
  double volume = 0;  ///< exact, cells
};

/// Sets surface and reach of a sphere whose mapping radius is known; `radius`: the true one, cells. From many threads.
template <class Real>
using ShapeSphere = std::function<void(double radius, GridSphere<Real>& sphere)>;

template <class Real>
class GrainMap {
 public:
  /// Maps all free and fixed grains (not beads) at their present places.
  void update(const lbm::Fluid<Real>& fluid, const dem::Particles& particles, const ShapeSphere<Real>& shape);

  /// By id, ascending.
  [[nodiscard]] const std::vector<MappedGrain>& grains() const { return grains_; }
  [[nodiscard]] const std::vector<GrainInBlock>& pairs() const { return pairs_; }
  [[nodiscard]] const GridSphere<Real>& sphere(std::size_t grain) const { return spheres_[grain]; }
  /// Pairs by block, in the order of the grains.
  [[nodiscard]] const PairsByBlock& by_block() const { return by_block_; }
  /// Dry blocks may have been released since the pair was made, and their index used again.
  [[nodiscard]] bool is_alive(const lbm::Fluid<Real>& fluid, const GrainInBlock& pair) const {
    return fluid.grid().exists(pair.block) && fluid.grid().block(pair.block).birth == pair.birth;
  }
  /// Whether the grains of a block are those of the former mapping, and did not move.
  [[nodiscard]] bool is_unchanged(std::size_t block) const;
  /// Prefetches the pairs of a block, which lie by grain and thus apart, before they are looked at one by one.
  void prefetch(std::span<const std::uint32_t> pairs) const;

  /// The next update maps everything again, moved or not.
  void forget() { forgotten_ = true; }
  /// State of a checkpoint: the last mapping, which the next one is compared with.
  void transfer(Archive& archive);

 private:
  /// The blocks in reach of a grain, x slowest.
  struct Reach {
    Vec3i low, high;
    std::array<lbm::BlockIndex, 8> blocks;  ///< where there are no more than that
  };
  struct Radius {
    double cells = -1, mapped = 0;
  };

  void collect(const lbm::Fluid<Real>& fluid, const dem::Particles& particles, const ShapeSphere<Real>& shape);
  void place_grain(const lbm::Fluid<Real>& fluid, const dem::Particles& particles, const ShapeSphere<Real>& shape,
                   std::size_t k);
  void look_up_blocks(const lbm::Fluid<Real>& fluid, std::size_t k, const GrainInBlock* hint);
  template <class Visit>
  void for_blocks(const lbm::Fluid<Real>& fluid, const Reach& reach, const Visit& visit) const;
  [[nodiscard]] GrainChange compare(const lbm::Fluid<Real>& fluid, std::size_t k, std::size_t former) const;
  void write_pairs(const lbm::Fluid<Real>& fluid, std::size_t k);
  void normalize(const lbm::Fluid<Real>& fluid);

  std::vector<MappedGrain> grains_, former_;
  std::vector<GridSphere<Real>> spheres_, former_spheres_;
  std::vector<GrainInBlock> pairs_, former_pairs_;  // by grain, then block
  std::vector<Reach> reaches_;                      // by grain
  std::vector<std::uint32_t> former_grain_;         // by id, index into former_
  std::vector<Radius> radii_;                       // by id
  PairsByBlock by_block_;
  bool forgotten_ = false;
};

template <class Real>
inline void GrainMap<Real>::prefetch(std::span<const std::uint32_t> pairs) const {
  for (const std::uint32_t k : pairs) {
    const auto* const first = reinterpret_cast<const char*>(&pairs_[k]);
    __builtin_prefetch(first), __builtin_prefetch(first + sizeof(GrainInBlock) - 1);
  }
}

extern template class GrainMap<float>;
extern template class GrainMap<double>;

}  // namespace lahar::coupling
