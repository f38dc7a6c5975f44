#pragma once
// Storage that grows in slabs, never moves, and is used again: no allocation in a step once a run has warmed up.
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

#include "lbm/grid/velocity_set.h"

namespace lahar::lbm {

/// Memory on large pages where the system has them: with small ones a pass over many blocks waits for page tables.
template <class T>
class LargePages {
 public:
  static constexpr std::size_t page = std::size_t{2} << 20;

  /// Uninitialized room for `count` objects.
  explicit LargePages(std::size_t count) : bytes_((count * sizeof(T) + page - 1) / page * page) {
    memory_.reset(static_cast<T*>(std::aligned_alloc(page, bytes_)));
    if (!memory_) throw std::bad_alloc();
#ifdef __linux__
    madvise(memory_.get(), bytes_, MADV_HUGEPAGE);
#endif
  }
  [[nodiscard]] T* data() const { return memory_.get(); }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  struct Free {
    void operator()(T* p) const { std::free(p); }
  };
  std::size_t bytes_;
  std::unique_ptr<T, Free> memory_;
};

/// Objects handed out and taken back; addresses are stable.
template <class T>
class ObjectPool {
 public:
  T* acquire() {
    if (free_.empty()) grow();
    T* p = free_.back();
    free_.pop_back();
    return p;
  }
  void release(T* p) { free_.push_back(p); }
  [[nodiscard]] std::size_t bytes() const { return slabs_.size() * LargePages<T>::page; }

 private:
  /// As many objects as a page holds.
  class Slab {
   public:
    static constexpr std::size_t size = LargePages<T>::page / sizeof(T);
    static_assert(size > 8);
    Slab() { std::uninitialized_value_construct_n(first(), size); }
    ~Slab() {
      if (first()) std::destroy_n(first(), size);
    }
    Slab(Slab&&) = default;
    Slab& operator=(Slab&&) = delete;
    [[nodiscard]] T* first() const { return pages_.data(); }

   private:
    LargePages<T> pages_{size};
  };

  void grow() {
    T* const first = slabs_.emplace_back().first();
    for (std::size_t k = Slab::size; k-- > 0;) free_.push_back(first + k);
  }

  std::vector<Slab> slabs_;
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
  [[nodiscard]] std::size_t bytes() const { return slabs_.empty() ? 0 : slabs_.size() * slabs_.front().bytes(); }

 private:
  void grow() {
    Real* const slab = slabs_.emplace_back(groups_per_slab * group_size).data();
    for (std::size_t g = groups_per_slab; g-- > 0;)
      for (std::size_t b = blocks_per_group; b-- > 0;) free_.push_back(slab + g * group_size + b * 512);
  }

  std::vector<LargePages<Real>> slabs_;
  std::vector<Real*> free_;
};

}  // namespace lahar::lbm
