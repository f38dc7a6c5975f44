#pragma once
// Packs: a few numbers side by side that are loaded, computed with and stored together. The one type of vectors for all
// rooms: cells of a row, contacts, particles.
//
// A pack is a vector of the compiler (GCC, Clang) in a struct with operators: no calls, it stays in registers. Where
// the processor's own vectors are shorter it is two packs of half its lanes: left to itself, GCC 12 takes the choices
// and shuffles of too wide a vector apart into single numbers. A product and a sum are contracted as they are for plain
// numbers (-ffp-contract); where two callers must get the same bits write multiply_add (simd_math.h). Kernels are
// written once for numbers and packs: V is either, number<V>(x) a constant, select(mask, a, b) a choice, and load<V>,
// store, min, max, any, none, ... take both.
//
// Vectors of three components are something else: see triple.h.
#include <array>
#include <bit>
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

namespace detail {

/// The lanes of a pack: a vector of the processor, or two halves where it has none so wide.
template <class T, int N, bool kHalves>
struct PackStorage {
  using Type [[gnu::vector_size(N * sizeof(T))]] = T;
};
template <class T, int N>
struct PackStorage<T, N, true> {
  struct Type {
    Pack<T, N / 2> low, high;
  };
};

}  // namespace detail

/// N numbers of type T.
template <class T, int N>
class Pack {
 public:
  static_assert(std::is_arithmetic_v<T> && (N & (N - 1)) == 0 && N * sizeof(T) >= 16);
  using value_type = T;
  using mask_type = Mask<T, N>;
  static constexpr bool kHalves = N * sizeof(T) > kVectorBytes;
  using Half = Pack<T, N / 2>;
  using Storage = typename detail::PackStorage<T, N, kHalves>::Type;
  static constexpr std::size_t size() { return N; }

  Pack() = default;
  [[gnu::always_inline]] explicit Pack(const Storage& v) : v_(v) {}
  /// The same number in all lanes.
  template <SpreadsAs<T> U>
  [[gnu::always_inline]] Pack(U x) : v_(spread(static_cast<T>(x))) {}  // NOLINT: numbers are packs of themselves
  /// Lane by lane.
  template <class... More>
  requires(sizeof...(More) == N - 2) [[gnu::always_inline]] Pack(T first, T second, More... more)
      : v_(of_lanes(std::array<T, N>{first, second, static_cast<T>(more)...}, std::make_index_sequence<N>{})) {}

  [[nodiscard]] const Storage& storage() const { return v_; }
  [[gnu::always_inline]] T operator[](std::size_t lane) const {
    if constexpr (kHalves)
      return lane < N / 2 ? v_.low[lane] : v_.high[lane - N / 2];
    else
      return v_[lane];
  }
  [[gnu::always_inline]] void set(std::size_t lane, T x) {
    if constexpr (kHalves)
      lane < N / 2 ? v_.low.set(lane, x) : v_.high.set(lane - N / 2, x);
    else
      v_[lane] = x;
  }

  [[gnu::always_inline]] friend Pack operator+(const Pack& a, const Pack& b) {
    if constexpr (kHalves)
      return Pack(Storage{a.v_.low + b.v_.low, a.v_.high + b.v_.high});
    else
      return Pack(Storage(a.v_ + b.v_));
  }
  [[gnu::always_inline]] friend Pack operator-(const Pack& a, const Pack& b) {
    if constexpr (kHalves)
      return Pack(Storage{a.v_.low - b.v_.low, a.v_.high - b.v_.high});
    else
      return Pack(Storage(a.v_ - b.v_));
  }
  [[gnu::always_inline]] friend Pack operator*(const Pack& a, const Pack& b) {
    if constexpr (kHalves)
      return Pack(Storage{a.v_.low * b.v_.low, a.v_.high * b.v_.high});
    else
      return Pack(Storage(a.v_ * b.v_));
  }
  [[gnu::always_inline]] friend Pack operator/(const Pack& a, const Pack& b) {
    if constexpr (kHalves)
      return Pack(Storage{a.v_.low / b.v_.low, a.v_.high / b.v_.high});
    else
      return Pack(Storage(a.v_ / b.v_));
  }
  [[gnu::always_inline]] friend Pack operator-(const Pack& a) {
    if constexpr (kHalves)
      return Pack(Storage{-a.v_.low, -a.v_.high});
    else
      return Pack(Storage(-a.v_));
  }
  [[gnu::always_inline]] Pack& operator+=(const Pack& b) { return *this = *this + b; }
  [[gnu::always_inline]] Pack& operator-=(const Pack& b) { return *this = *this - b; }
  [[gnu::always_inline]] Pack& operator*=(const Pack& b) { return *this = *this * b; }
  [[gnu::always_inline]] Pack& operator/=(const Pack& b) { return *this = *this / b; }

  /// Of whole numbers.
  [[gnu::always_inline]] friend Pack operator<<(const Pack& a, int bits) {
    if constexpr (kHalves)
      return Pack(Storage{a.v_.low << bits, a.v_.high << bits});
    else
      return Pack(Storage(a.v_ << bits));
  }
  [[gnu::always_inline]] friend Pack operator>>(const Pack& a, int bits) {
    if constexpr (kHalves)
      return Pack(Storage{a.v_.low >> bits, a.v_.high >> bits});
    else
      return Pack(Storage(a.v_ >> bits));
  }
  [[gnu::always_inline]] friend Pack operator&(const Pack& a, const Pack& b) {
    if constexpr (kHalves)
      return Pack(Storage{a.v_.low & b.v_.low, a.v_.high & b.v_.high});
    else
      return Pack(Storage(a.v_ & b.v_));
  }

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
  [[gnu::always_inline]] static Storage spread(T x) {
    if constexpr (kHalves)
      return {Half(x), Half(x)};
    else
      return x - Storage{};
  }
  template <std::size_t... I>
  [[gnu::always_inline]] static Storage of_lanes(const std::array<T, N>& x, std::index_sequence<I...>) {
    if constexpr (kHalves)
      return of_halves(x, std::make_index_sequence<N / 2>{});
    else
      return Storage{x[I]...};
  }
  template <std::size_t... I>
  [[gnu::always_inline]] static Storage of_halves(const std::array<T, N>& x, std::index_sequence<I...>) {
    return {Half(x[I]...), Half(x[N / 2 + I]...)};
  }

  Storage v_;
};

/// Eight numbers: the cells of a block along x, eight contacts, eight particles.
inline constexpr std::size_t kRow = 8;
template <class T>
using Row = Pack<T, kRow>;

/// Of the processor's widest vectors.
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
  } else if constexpr (V::kHalves) {
    return V({load<typename V::Half>(p), load<typename V::Half>(p + V::size() / 2)});
  } else {
    typename V::Storage v;
    std::memcpy(&v, p, sizeof v);
    return V(v);
  }
}
template <class T>
requires std::is_arithmetic_v<T>
[[gnu::always_inline]] inline void store(T* p, T x) { *p = x; }
template <class T, int N>
[[gnu::always_inline]] inline void store(T* p, const Pack<T, N>& x) {
  if constexpr (Pack<T, N>::kHalves)
    store(p, x.storage().low), store(p + N / 2, x.storage().high);
  else
    std::memcpy(p, &x.storage(), sizeof x);
}

/// From an address that is a multiple of the pack's size.
template <class V>
[[gnu::always_inline]] inline V load_aligned(const NumberOf<V>* p) {
  if constexpr (LanesOf<V>::count == 1)
    return *p;
  else if constexpr (V::kHalves)
    return V({load_aligned<typename V::Half>(p), load_aligned<typename V::Half>(p + V::size() / 2)});
  else
    return V(*reinterpret_cast<const typename V::Storage*>(p));
}
template <class T, int N>
[[gnu::always_inline]] inline void store_aligned(T* p, const Pack<T, N>& x) {
  if constexpr (Pack<T, N>::kHalves)
    store_aligned(p, x.storage().low), store_aligned(p + N / 2, x.storage().high);
  else
    *reinterpret_cast<typename Pack<T, N>::Storage*>(p) = x.storage();
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

/// Half 0 or 1 of the lanes.
template <int kHalf, class T, int N>
[[gnu::always_inline]] inline Pack<T, N / 2> half_of(const Pack<T, N>& a) {
  if constexpr (Pack<T, N>::kHalves)
    return kHalf == 0 ? a.storage().low : a.storage().high;
  else
    return [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) {
      using Answer = Pack<T, N / 2>;
      return Answer(
          typename Answer::Storage(__builtin_shufflevector(a.storage(), a.storage(), (I + kHalf * N / 2)...)));
    }
  (std::make_integer_sequence<int, N / 2>{});
}
/// The lanes of a, then those of b.
template <class T, int N>
[[gnu::always_inline]] inline Pack<T, 2 * N> join(const Pack<T, N>& a, const Pack<T, N>& b) {
  using Answer = Pack<T, 2 * N>;
  if constexpr (Answer::kHalves)
    return Answer({a, b});
  else
    return [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) {
      return Answer(typename Answer::Storage(__builtin_shufflevector(a.storage(), b.storage(), I...)));
    }
  (std::make_integer_sequence<int, 2 * N>{});
}

/// Lanes of a and b in a new order: 0 to N - 1 mean those of a, N to 2 N - 1 those of b.
template <int... kFrom, class T, int N>
[[gnu::always_inline]] inline Pack<T, sizeof...(kFrom)> shuffle(const Pack<T, N>& a, const Pack<T, N>& b) {
  using Answer = Pack<T, sizeof...(kFrom)>;
  if constexpr (Answer::kHalves || Pack<T, N>::kHalves)
    return Answer((kFrom < N ? a[kFrom % N] : b[kFrom % N])...);
  else
    return Answer(typename Answer::Storage(__builtin_shufflevector(a.storage(), b.storage(), kFrom...)));
}
template <int... kFrom, class T, int N>
[[gnu::always_inline]] inline Pack<T, sizeof...(kFrom)> shuffle(const Pack<T, N>& a) {
  return shuffle<kFrom...>(a, a);
}

namespace detail {

/// Swaps the upper right and lower left blocks of kStep x kStep numbers of every block of twice that size, of which a
/// and b are rows that lie kStep apart.
template <int kStep, class T, int N>
[[gnu::always_inline]] inline void swap_in_rows(Pack<T, N>& a, Pack<T, N>& b) {
  using P = Pack<T, N>;
  if constexpr (P::kHalves) {
    auto a_low = a.storage().low, a_high = a.storage().high, b_low = b.storage().low, b_high = b.storage().high;
    if constexpr (kStep == N / 2) {
      a = P({a_low, b_low}), b = P({a_high, b_high});
    } else {
      swap_in_rows<kStep>(a_low, b_low);
      swap_in_rows<kStep>(a_high, b_high);
      a = P({a_low, a_high}), b = P({b_low, b_high});
    }
  } else {
    [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) {
      const P swapped = shuffle<((I & kStep) == 0 ? I : N + I - kStep)...>(a, b);
      b = shuffle<((I & kStep) == 0 ? I + kStep : N + I)...>(a, b);
      a = swapped;
    }
    (std::make_integer_sequence<int, N>{});
  }
}

template <int kStep, class Packs, int... I>
[[gnu::always_inline]] inline void swap_blocks(Packs& m, std::integer_sequence<int, I...>) {
  const auto swap = [&]<int K>() __attribute__((always_inline)) {
    if constexpr ((K & kStep) == 0) swap_in_rows<kStep>(m[K], m[K + kStep]);
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
  if constexpr (Pack<T, N>::kHalves) {
    const unsigned low = compare<kIs>(half_of<0>(a), half_of<0>(b)).bits();
    return M::from_bits(low | compare<kIs>(half_of<1>(a), half_of<1>(b)).bits() << N / 2);
  } else if constexpr (std::is_same_v<T, float>) {
    if constexpr (N == 16) return M(_mm512_cmp_ps_mask(a.storage(), b.storage(), kIs));
    if constexpr (N == 8) return M(_mm256_cmp_ps_mask(a.storage(), b.storage(), kIs));
    if constexpr (N == 4) return M(_mm_cmp_ps_mask(a.storage(), b.storage(), kIs));
  } else {
    if constexpr (N == 8) return M(_mm512_cmp_pd_mask(a.storage(), b.storage(), kIs));
    if constexpr (N == 4) return M(_mm256_cmp_pd_mask(a.storage(), b.storage(), kIs));
    if constexpr (N == 2) return M(_mm_cmp_pd_mask(a.storage(), b.storage(), kIs));
  }
#else
  using Lanes = typename M::Storage;
  if constexpr (Pack<T, N>::kHalves)
    return M(Lanes{compare<kIs>(half_of<0>(a), half_of<0>(b)), compare<kIs>(half_of<1>(a), half_of<1>(b))});
  else if constexpr (kIs == kEqual)
    return M(Lanes(a.storage() == b.storage()));
  else if constexpr (kIs == kLess)
    return M(Lanes(a.storage() < b.storage()));
  else if constexpr (kIs == kLessEqual)
    return M(Lanes(a.storage() <= b.storage()));
  else
    return M(Lanes(a.storage() != b.storage()));
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
  if constexpr (P::kHalves) {
    using M = Mask<T, N / 2>;
    return join(select(M::from_bits(m.bits() & M::kAll), half_of<0>(a), half_of<0>(b)),
                select(M::from_bits(m.bits() >> N / 2), half_of<1>(a), half_of<1>(b)));
  } else if constexpr (std::is_same_v<T, float>) {
    if constexpr (N == 16) return P(_mm512_mask_blend_ps(m.storage(), b.storage(), a.storage()));
    if constexpr (N == 8) return P(_mm256_mask_blend_ps(m.storage(), b.storage(), a.storage()));
    if constexpr (N == 4) return P(_mm_mask_blend_ps(m.storage(), b.storage(), a.storage()));
  } else {
    static_assert(std::is_same_v<T, double>);
    if constexpr (N == 8) return P(_mm512_mask_blend_pd(m.storage(), b.storage(), a.storage()));
    if constexpr (N == 4) return P(_mm256_mask_blend_pd(m.storage(), b.storage(), a.storage()));
    if constexpr (N == 2) return P(_mm_mask_blend_pd(m.storage(), b.storage(), a.storage()));
  }
#else
  if constexpr (P::kHalves)
    return P({select(m.storage().low, half_of<0>(a), half_of<0>(b)),
              select(m.storage().high, half_of<1>(a), half_of<1>(b))});
  else
    return P(typename P::Storage(m.storage() ? a.storage() : b.storage()));
#endif
}

/// Writes the chosen lanes and touches no others, which may be in use by another thread.
template <class T, int N>
[[gnu::always_inline]] inline void store_if(const Mask<T, N>& m, T* p, const Pack<T, N>& x) {
#if LAHAR_MASK_REGISTERS
  if constexpr (sizeof x <= 64) {
    if constexpr (std::is_same_v<T, float>) {
      if constexpr (N == 16) _mm512_mask_storeu_ps(p, m.storage(), x.storage());
      if constexpr (N == 8) _mm256_mask_storeu_ps(p, m.storage(), x.storage());
      if constexpr (N == 4) _mm_mask_storeu_ps(p, m.storage(), x.storage());
    } else {
      if constexpr (N == 8) _mm512_mask_storeu_pd(p, m.storage(), x.storage());
      if constexpr (N == 4) _mm256_mask_storeu_pd(p, m.storage(), x.storage());
      if constexpr (N == 2) _mm_mask_storeu_pd(p, m.storage(), x.storage());
    }
    return;
  }
#elif defined(__AVX__)
  if constexpr (Pack<T, N>::kHalves) {
    store_if(m.storage().low, p, half_of<0>(x)), store_if(m.storage().high, p + N / 2, half_of<1>(x));
    return;
  } else if constexpr (sizeof x == 32) {
    const auto chosen = std::bit_cast<__m256i>(m.storage());
    if constexpr (std::is_same_v<T, float>)
      _mm256_maskstore_ps(p, chosen, x.storage());
    else
      _mm256_maskstore_pd(p, chosen, x.storage());
    return;
  }
#endif
  for (std::size_t k = 0; k < N; ++k)  // narrow vectors store with masks around the cache
    if (m[k]) p[k] = x[k];
}

/// Each lane as another type of number.
template <class To, class T, int N>
[[gnu::always_inline]] inline Pack<To, N> convert(const Pack<T, N>& a) {
  using Answer = Pack<To, N>;
  if constexpr (!Answer::kHalves && !Pack<T, N>::kHalves)
    return Answer(__builtin_convertvector(a.storage(), typename Answer::Storage));
  else if constexpr (N / 2 * sizeof(To) >= 16 && N / 2 * sizeof(T) >= 16)
    return join(convert<To>(half_of<0>(a)), convert<To>(half_of<1>(a)));
  else
    return [&]<std::size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
      return Answer(static_cast<To>(a[I])...);
    }
  (std::make_index_sequence<N>{});
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
