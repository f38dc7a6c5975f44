#pragma once
// Packs: a few numbers side by side that are loaded, computed with and stored together. The one type of vectors for all
// rooms: cells of a row, contacts, particles.
//
// A pack is a vector of the compiler (GCC, Clang) in a struct with operators: no calls, it stays in registers, and it
// is cut into pieces where the processor's own vectors are shorter. A product and a sum are contracted as they are for
// plain numbers (-ffp-contract); where two callers must get the same bits write multiply_add (simd_math.h).
// Kernels are written once for numbers and packs: V is either, number<V>(x) a constant, select(mask, a, b) a choice,
// and load<V>, store, min, max, any, none, ... take both.
//
// Vectors of three components are something else: see triple.h.
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include "core/simd_mask.h"

namespace lahar {

/// Numbers that turn into a T without loss; whole constants do.
template <class U, class T>
concept SpreadsAs = std::same_as<U, T> || std::same_as<U, int> ||(std::same_as<U, float>&& std::same_as<T, double>);

template <class T, int N>
class Pack;

namespace detail {

enum Comparison { kEqual = 0x00, kLess = 0x11, kLessEqual = 0x12, kNotEqual = 0x04 };  // numbers of vcmpps, quiet

template <Comparison kIs, class T, int N>
[[gnu::always_inline]] inline Mask<T, N> compare(const Pack<T, N>& a, const Pack<T, N>& b);

}  // namespace detail

/// N numbers of type T.
template <class T, int N>
class Pack {
 public:
  static_assert(std::is_arithmetic_v<T> && (N & (N - 1)) == 0 && N * sizeof(T) >= 16);
  using value_type = T;
  using mask_type = Mask<T, N>;
  using Vector [[gnu::vector_size(N * sizeof(T))]] = T;
  static constexpr std::size_t size() { return N; }

  Pack() = default;
  [[gnu::always_inline]] explicit Pack(const Vector& v) : v_(v) {}
  /// The same number in all lanes.
  template <SpreadsAs<T> U>
  [[gnu::always_inline]] Pack(U x) : v_(static_cast<T>(x) - Vector{}) {}  // NOLINT: numbers are packs of themselves
  /// Lane by lane.
  template <class... More>
  requires(sizeof...(More) == N - 2) [[gnu::always_inline]] Pack(T first, T second, More... more)
      : v_{first, second, static_cast<T>(more)...} {}

  [[nodiscard]] const Vector& vector() const { return v_; }
  [[gnu::always_inline]] T operator[](std::size_t lane) const { return v_[lane]; }
  [[gnu::always_inline]] void set(std::size_t lane, T x) { v_[lane] = x; }

  [[gnu::always_inline]] friend Pack operator+(const Pack& a, const Pack& b) { return Pack(a.v_ + b.v_); }
  [[gnu::always_inline]] friend Pack operator-(const Pack& a, const Pack& b) { return Pack(a.v_ - b.v_); }
  [[gnu::always_inline]] friend Pack operator*(const Pack& a, const Pack& b) { return Pack(a.v_ * b.v_); }
  [[gnu::always_inline]] friend Pack operator/(const Pack& a, const Pack& b) { return Pack(a.v_ / b.v_); }
  [[gnu::always_inline]] friend Pack operator-(const Pack& a) { return Pack(-a.v_); }
  [[gnu::always_inline]] Pack& operator+=(const Pack& b) { return *this = *this + b; }
  [[gnu::always_inline]] Pack& operator-=(const Pack& b) { return *this = *this - b; }
  [[gnu::always_inline]] Pack& operator*=(const Pack& b) { return *this = *this * b; }
  [[gnu::always_inline]] Pack& operator/=(const Pack& b) { return *this = *this / b; }

  /// Of whole numbers.
  [[gnu::always_inline]] friend Pack operator<<(const Pack& a, int bits) { return Pack(a.v_ << bits); }
  [[gnu::always_inline]] friend Pack operator>>(const Pack& a, int bits) { return Pack(a.v_ >> bits); }

  [[gnu::always_inline]] friend mask_type operator<(const Pack& a, const Pack& b) {
    return detail::compare<detail::kLess>(a, b);
  }
  [[gnu::always_inline]] friend mask_type operator<=(const Pack& a, const Pack& b) {
    return detail::compare<detail::kLessEqual>(a, b);
  }
  [[gnu::always_inline]] friend mask_type operator>(const Pack& a, const Pack& b) {
    return detail::compare<detail::kLess>(b, a);
  }
  [[gnu::always_inline]] friend mask_type operator>=(const Pack& a, const Pack& b) {
    return detail::compare<detail::kLessEqual>(b, a);
  }
  [[gnu::always_inline]] friend mask_type operator==(const Pack& a, const Pack& b) {
    return detail::compare<detail::kEqual>(a, b);
  }
  [[gnu::always_inline]] friend mask_type operator!=(const Pack& a, const Pack& b) {
    return detail::compare<detail::kNotEqual>(a, b);
  }

 private:
  Vector v_;
};

/// Eight numbers: the cells of a block along x, eight contacts, eight particles.
inline constexpr std::size_t kRow = 8;
template <class T>
using Row = Pack<T, kRow>;

/// Bytes of the processor's widest vectors.
#if defined(__AVX512F__)
inline constexpr std::size_t kVectorBytes = 64;
#elif defined(__AVX__)
inline constexpr std::size_t kVectorBytes = 32;
#else
inline constexpr std::size_t kVectorBytes = 16;
#endif
template <class T>
inline constexpr std::size_t kNativeLanes = kVectorBytes / sizeof(T);

/// What V, a number or a pack of them, consists of.
template <class V>
struct LanesOf {
  static_assert(std::is_arithmetic_v<V>);
  using Number = V;
  static constexpr std::size_t count = 1;
  template <class To>
  using With = To;  ///< the same number of lanes of another type
};
template <class T, int N>
struct LanesOf<Pack<T, N>> {
  using Number = T;
  static constexpr std::size_t count = N;
  template <class To>
  using With = Pack<To, N>;
};
template <class V>
using NumberOf = typename LanesOf<V>::Number;

/// x as a V: converted to V's number type, then spread over its lanes.
template <class V>
[[gnu::always_inline]] constexpr V number(double x) {
  return V(static_cast<NumberOf<V>>(x));
}

/// From any address of numbers.
template <class V>
[[gnu::always_inline]] inline V load(const NumberOf<V>* p) {
  if constexpr (LanesOf<V>::count == 1) {
    return *p;
  } else {
    typename V::Vector v;
    std::memcpy(&v, p, sizeof v);
    return V(v);
  }
}
template <class T>
requires std::is_arithmetic_v<T>
[[gnu::always_inline]] inline void store(T* p, T x) { *p = x; }
template <class T, int N>
[[gnu::always_inline]] inline void store(T* p, const Pack<T, N>& x) {
  std::memcpy(p, &x.vector(), sizeof x);
}

/// From an address that is a multiple of the pack's size.
template <class V>
[[gnu::always_inline]] inline V load_aligned(const NumberOf<V>* p) {
  if constexpr (LanesOf<V>::count == 1)
    return *p;
  else
    return V(*reinterpret_cast<const typename V::Vector*>(p));
}
template <class T, int N>
[[gnu::always_inline]] inline void store_aligned(T* p, const Pack<T, N>& x) {
  *reinterpret_cast<typename Pack<T, N>::Vector*>(p) = x.vector();
}

/// base[index[0]], base[index[1]], ...
template <class V, class Index>
[[gnu::always_inline]] inline V gather(const NumberOf<V>* base, const Index* index) {
  return [&]<std::size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
    return V(base[index[I]]...);
  }
  (std::make_index_sequence<LanesOf<V>::count>{});
}

/// 0, 1, 2, ...
template <class V>
[[gnu::always_inline]] inline V lane_index() {
  return []<std::size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
    return V(static_cast<NumberOf<V>>(I)...);
  }
  (std::make_index_sequence<LanesOf<V>::count>{});
}

/// Lanes of a and b in a new order: 0 to N - 1 mean those of a, N to 2 N - 1 those of b.
template <int... kFrom, class T, int N>
[[gnu::always_inline]] inline Pack<T, sizeof...(kFrom)> shuffle(const Pack<T, N>& a, const Pack<T, N>& b) {
  using Answer = Pack<T, sizeof...(kFrom)>;
  return Answer(typename Answer::Vector(__builtin_shufflevector(a.vector(), b.vector(), kFrom...)));
}
template <int... kFrom, class T, int N>
[[gnu::always_inline]] inline Pack<T, sizeof...(kFrom)> shuffle(const Pack<T, N>& a) {
  return shuffle<kFrom...>(a, a);
}

/// Half 0 or 1 of the lanes.
template <int kHalf, class T, int N>
[[gnu::always_inline]] inline Pack<T, N / 2> half_of(const Pack<T, N>& a) {
  return [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) {
    return shuffle<(I + kHalf * N / 2)...>(a);
  }
  (std::make_integer_sequence<int, N / 2>{});
}
/// The lanes of a, then those of b.
template <class T, int N>
[[gnu::always_inline]] inline Pack<T, 2 * N> join(const Pack<T, N>& a, const Pack<T, N>& b) {
  return [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) { return shuffle<I...>(a, b); }
  (std::make_integer_sequence<int, 2 * N>{});
}

namespace detail {

/// Swaps the upper right and lower left blocks of kStep x kStep numbers of every block of twice that size.
template <int kStep, class Packs, int... I>
[[gnu::always_inline]] inline void swap_blocks(Packs& m, std::integer_sequence<int, I...>) {
  constexpr int n = sizeof...(I);
  const auto swap = [&]<int K>() __attribute__((always_inline)) {
    if constexpr ((K & kStep) == 0) {
      const auto a = m[K], b = m[K + kStep];
      m[K] = shuffle<((I & kStep) == 0 ? I : n + I - kStep)...>(a, b);
      m[K + kStep] = shuffle<((I & kStep) == 0 ? I + kStep : n + I)...>(a, b);
    }
  };
  (swap.template operator()<I>(), ...);
}

}  // namespace detail

/// Turns N packs (one per item) into N packs (one per quantity), and back.
template <class T, int N, std::size_t kPacks>
requires(kPacks == N) [[gnu::always_inline]] inline void transpose(std::array<Pack<T, N>, kPacks>& m) {
  constexpr std::make_integer_sequence<int, N> lanes;
  if constexpr (N >= 2) detail::swap_blocks<1>(m, lanes);
  if constexpr (N >= 4) detail::swap_blocks<2>(m, lanes);
  if constexpr (N >= 8) detail::swap_blocks<4>(m, lanes);
  if constexpr (N >= 16) detail::swap_blocks<8>(m, lanes);
}

namespace detail {

template <Comparison kIs, class T, int N>
[[gnu::always_inline]] inline Mask<T, N> compare(const Pack<T, N>& a, const Pack<T, N>& b) {
  static_assert(std::is_floating_point_v<T>);
  using M = Mask<T, N>;
#if LAHAR_MASK_REGISTERS
  if constexpr (sizeof a > 64) {
    const unsigned low = compare<kIs>(half_of<0>(a), half_of<0>(b)).bits();
    return M::from_bits(low | compare<kIs>(half_of<1>(a), half_of<1>(b)).bits() << N / 2);
  } else if constexpr (std::is_same_v<T, float>) {
    if constexpr (N == 16) return M(_mm512_cmp_ps_mask(a.vector(), b.vector(), kIs));
    if constexpr (N == 8) return M(_mm256_cmp_ps_mask(a.vector(), b.vector(), kIs));
    if constexpr (N == 4) return M(_mm_cmp_ps_mask(a.vector(), b.vector(), kIs));
  } else {
    if constexpr (N == 8) return M(_mm512_cmp_pd_mask(a.vector(), b.vector(), kIs));
    if constexpr (N == 4) return M(_mm256_cmp_pd_mask(a.vector(), b.vector(), kIs));
    if constexpr (N == 2) return M(_mm_cmp_pd_mask(a.vector(), b.vector(), kIs));
  }
#else
  using Lanes = typename M::Storage;
  if constexpr (kIs == kEqual) return M(Lanes(a.vector() == b.vector()));
  if constexpr (kIs == kLess) return M(Lanes(a.vector() < b.vector()));
  if constexpr (kIs == kLessEqual) return M(Lanes(a.vector() <= b.vector()));
  if constexpr (kIs == kNotEqual) return M(Lanes(a.vector() != b.vector()));
#endif
}

}  // namespace detail

/// a where the mask holds, b elsewhere.
template <class T>
requires std::is_arithmetic_v<T>
[[gnu::always_inline]] inline T select(bool m, T a, T b) { return m ? a : b; }
template <class T, int N>
[[gnu::always_inline]] inline Pack<T, N> select(const Mask<T, N>& m, const Pack<T, N>& a, const Pack<T, N>& b) {
  using P = Pack<T, N>;
#if LAHAR_MASK_REGISTERS
  if constexpr (sizeof(P) > 64) {
    using M = Mask<T, N / 2>;
    return join(select(M::from_bits(m.bits() & M::kAll), half_of<0>(a), half_of<0>(b)),
                select(M::from_bits(m.bits() >> N / 2), half_of<1>(a), half_of<1>(b)));
  } else if constexpr (std::is_same_v<T, float>) {
    if constexpr (N == 16) return P(_mm512_mask_blend_ps(m.storage(), b.vector(), a.vector()));
    if constexpr (N == 8) return P(_mm256_mask_blend_ps(m.storage(), b.vector(), a.vector()));
    if constexpr (N == 4) return P(_mm_mask_blend_ps(m.storage(), b.vector(), a.vector()));
  } else {
    static_assert(std::is_same_v<T, double>);
    if constexpr (N == 8) return P(_mm512_mask_blend_pd(m.storage(), b.vector(), a.vector()));
    if constexpr (N == 4) return P(_mm256_mask_blend_pd(m.storage(), b.vector(), a.vector()));
    if constexpr (N == 2) return P(_mm_mask_blend_pd(m.storage(), b.vector(), a.vector()));
  }
#else
  return P(m.storage() ? a.vector() : b.vector());
#endif
}

/// Writes the chosen lanes and touches no others, which may be in use by another thread.
template <class T, int N>
[[gnu::always_inline]] inline void store_if(const Mask<T, N>& m, T* p, const Pack<T, N>& x) {
#if LAHAR_MASK_REGISTERS
  if constexpr (sizeof x <= 64) {
    if constexpr (std::is_same_v<T, float>) {
      if constexpr (N == 16) _mm512_mask_storeu_ps(p, m.storage(), x.vector());
      if constexpr (N == 8) _mm256_mask_storeu_ps(p, m.storage(), x.vector());
      if constexpr (N == 4) _mm_mask_storeu_ps(p, m.storage(), x.vector());
    } else {
      if constexpr (N == 8) _mm512_mask_storeu_pd(p, m.storage(), x.vector());
      if constexpr (N == 4) _mm256_mask_storeu_pd(p, m.storage(), x.vector());
      if constexpr (N == 2) _mm_mask_storeu_pd(p, m.storage(), x.vector());
    }
    return;
  }
#elif defined(__AVX__)
  if constexpr (sizeof x % 32 == 0) {
    constexpr int kLanes = 32 / sizeof(T);
    for (int first = 0; first < N; first += kLanes) {
      __m256i chosen;
      std::memcpy(&chosen, reinterpret_cast<const char*>(&m) + first * sizeof(T), sizeof chosen);
      const T* part = reinterpret_cast<const T*>(&x) + first;
      if constexpr (std::is_same_v<T, float>)
        _mm256_maskstore_ps(p + first, chosen, _mm256_load_ps(part));
      else
        _mm256_maskstore_pd(p + first, chosen, _mm256_load_pd(part));
    }
    return;
  }
#endif
  for (std::size_t k = 0; k < N; ++k)  // narrow vectors store with masks around the cache
    if (m[k]) p[k] = x[k];
}

/// Each lane as another type of number.
template <class To, class T, int N>
[[gnu::always_inline]] inline Pack<To, N> convert(const Pack<T, N>& a) {
  return Pack<To, N>(__builtin_convertvector(a.vector(), typename Pack<To, N>::Vector));
}

namespace detail {

template <class P, class Function>
[[gnu::always_inline]] inline auto fold_pair(const P& a, const Function& function) {
  return function(a[0], a[1]);
}

/// The lanes joined by a function of two: the upper half onto the lower one until 16 bytes are left, of which the outer
/// pair and the inner pair.
template <class T, int N, class Function>
[[gnu::always_inline]] inline T fold(const Pack<T, N>& a, const Function& function) {
  if constexpr (sizeof a > 16)
    return fold(function(half_of<0>(a), half_of<1>(a)), function);
  else if constexpr (N == 4)
    return fold_pair(function(a, shuffle<3, 2, 1, 0>(a)), function);
  else
    return fold_pair(a, function);
}

}  // namespace detail

/// Sum over the lanes in a fixed order (detail::fold).
template <class T, int N>
[[gnu::always_inline]] inline T sum_of_lanes(const Pack<T, N>& a) {
  return detail::fold(
      a, [](const auto& x, const auto& y) __attribute__((always_inline)) { return x + y; });
}

}  // namespace lahar
