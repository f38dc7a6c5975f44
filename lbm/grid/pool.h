#pragma once
// Storage that grows in slabs, never moves, and is used again: no allocation in a step once a run has warmed up.
#include <cstdlib>
#include <deque>
#include <memory>
#include <new>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

#include "lbm/grid/velocity_set.h"

namespace lahar::lbm {

/// Objects handed out and taken back; addresses are stable.
template <class T>
class ObjectPool {
 public:
  T* acquire() {
    if (free_.empty()) return &objects_.emplace_back();
    T* p = free_.back();
    free_.pop_back();
    return p;
  }
  void release(T* p) { free_.push_back(p); }
  [[nodiscard]] std::size_t bytes() const { return objects_.size() * sizeof(T); }

 private:
  std::deque<T> objects_;
  std::vector<T*> free_;
};

/// Populations of blocks, structure of arrays: groups of 8 blocks, [19][8 x 512 + 64], so that each velocity is one
/// long stream over 8 blocks and no two streams lie a power of two apart (docs/decisions/0001).
template <class Real>
class PopulationPool {
 public:
  static constexpr std::size_t blocks_per_group = 8;
  static constexpr std::size_t stride = blocks_per_group * 512 + 64;  ///< between velocities
  static constexpr std::size_t group_size = D3Q19::q * stride;
  static constexpr std::size_t groups_per_slab = 13;  ///< fills two huge pages (float) or four to 98 %

  /// First population of block storage place `p`; velocity i is at + i * stride.
  Real* acquire() {
    if (free_.empty()) grow();
    Real* p = free_.back();
    free_.pop_back();
    return p;
  }
  void release(Real* p) { free_.push_back(p); }
  [[nodiscard]] std::size_t bytes() const { return slabs_.size() * slab_bytes(); }

 private:
  struct Free {
    void operator()(Real* p) const { std::free(p); }
  };
  static constexpr std::size_t huge_page = std::size_t{2} << 20;
  static constexpr std::size_t slab_bytes() {
    return (groups_per_slab * group_size * sizeof(Real) + huge_page - 1) / huge_page * huge_page;
  }

  void grow() {
    auto* slab = static_cast<Real*>(std::aligned_alloc(huge_page, slab_bytes()));
    if (slab == nullptr) throw std::bad_alloc();
#ifdef __linux__
    madvise(slab, slab_bytes(), MADV_HUGEPAGE);
#endif
    slabs_.emplace_back(slab);
    for (std::size_t g = groups_per_slab; g-- > 0;)
      for (std::size_t b = blocks_per_group; b-- > 0;) free_.push_back(slab + g * group_size + b * 512);
  }

  std::vector<std::unique_ptr<Real, Free>> slabs_;
  std::vector<Real*> free_;
};

}  // namespace lahar::lbm
