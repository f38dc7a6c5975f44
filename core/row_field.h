#pragma once
// Rows of eight doubles (simd.h) in memory.
#include <cstddef>
#include <new>
#include <vector>

#include "core/simd.h"

namespace lahar {

/// Memory at addresses that suit packs.
template <class T>
struct AlignedAllocator {
  static constexpr std::align_val_t kAlignment{64};
  using value_type = T;
  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}  // NOLINT: allocators convert into each other
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), kAlignment)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, kAlignment); }
  bool operator==(const AlignedAllocator&) const { return true; }
};

class RowField {
 public:
  void resize(std::size_t rows) { numbers_.resize(rows * kRow); }
  void assign(std::size_t rows, double number) { numbers_.assign(rows * kRow, number); }
  [[nodiscard]] std::size_t size() const { return numbers_.size() / kRow; }
  [[nodiscard]] double* operator[](std::size_t row) { return numbers_.data() + row * kRow; }
  [[nodiscard]] const double* operator[](std::size_t row) const { return numbers_.data() + row * kRow; }

 private:
  std::vector<double, AlignedAllocator<double>> numbers_;
};

}  // namespace lahar
