#pragma once
// Eight doubles side by side: the unit that contact evaluation loads, turns and stores. Compilers split it on machines
// with shorter vectors.
#include <array>
#include <cstddef>
#include <new>
#include <vector>

namespace lahar::dem {

inline constexpr std::size_t kLine = 8;
using Line = double __attribute__((vector_size(8 * kLine)));
using LineMask = long long __attribute__((vector_size(8 * kLine)));

/// Memory at addresses that suit lines.
template <class T>
struct AlignedAllocator {
  using value_type = T;
  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}  // NOLINT: allocators convert into each other
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{sizeof(Line)})); }
  void deallocate(T* p, std::size_t) { ::operator delete (p, std::align_val_t{sizeof(Line)}); }
  bool operator==(const AlignedAllocator&) const { return true; }
};

/// Lines in memory.
class LineField {
 public:
  void resize(std::size_t lines) { numbers_.resize(lines * kLine); }
  [[nodiscard]] std::size_t size() const { return numbers_.size() / kLine; }
  [[nodiscard]] double* operator[](std::size_t line) { return numbers_.data() + line * kLine; }
  [[nodiscard]] const double* operator[](std::size_t line) const { return numbers_.data() + line * kLine; }

 private:
  std::vector<double, AlignedAllocator<double>> numbers_;
};

inline Line load_line(const double* p) { return *reinterpret_cast<const Line*>(p); }
inline void store_line(double* p, const Line& l) { *reinterpret_cast<Line*>(p) = l; }

/// The same at any address of doubles.
inline Line load_eight(const double* p) {
  Line l;
  __builtin_memcpy(&l, p, sizeof l);
  return l;
}
inline void store_eight(double* p, const Line& l) { __builtin_memcpy(p, &l, sizeof l); }

/// Turns eight lines (one per item) into eight lines (one per quantity), and back.
inline void transpose(std::array<Line, kLine>& m) {
  std::array<Line, kLine> a, b;
  for (std::size_t k = 0; k < 8; k += 2) {
    a[k] = __builtin_shufflevector(m[k], m[k + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    a[k + 1] = __builtin_shufflevector(m[k], m[k + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (std::size_t k = 0; k < 8; k += 4)
    for (std::size_t l = k; l < k + 2; ++l) {
      b[l] = __builtin_shufflevector(a[l], a[l + 2], 0, 1, 8, 9, 4, 5, 12, 13);
      b[l + 2] = __builtin_shufflevector(a[l], a[l + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  for (std::size_t k = 0; k < 4; ++k) {
    m[k] = __builtin_shufflevector(b[k], b[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    m[k + 4] = __builtin_shufflevector(b[k], b[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

}  // namespace lahar::dem
