#pragma once
// Which lanes of a pack (simd.h) something holds for. One bit a lane where the processor has registers for masks
// (AVX-512), else a vector of whole numbers, 0 or -1.
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

#if defined(__AVX512F__) && defined(__AVX512VL__) && defined(__AVX512DQ__) && defined(__AVX512BW__)
#define LAHAR_MASK_REGISTERS 1
#else
#define LAHAR_MASK_REGISTERS 0
#endif

namespace lahar {

/// Bytes of the processor's widest vectors.
#if defined(__AVX512F__)
inline constexpr std::size_t kVectorBytes = 64;
#elif defined(__AVX__)
inline constexpr std::size_t kVectorBytes = 32;
#else
inline constexpr std::size_t kVectorBytes = 16;
#endif

template <class T, int N>
class Mask;

#if !LAHAR_MASK_REGISTERS
namespace detail {

template <class T>
using MaskWord = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;

/// The lanes of a mask: a vector of the processor, or two halves where it has none so wide.
template <class T, int N, bool kHalves>
struct MaskStorage {
  using Type [[gnu::vector_size(N * sizeof(T))]] = MaskWord<T>;
};
template <class T, int N>
struct MaskStorage<T, N, true> {
  struct Type {
    Mask<T, N / 2> low, high;
  };
};

}  // namespace detail
#endif

/// Comparison of lanes of packs of T.
template <class T, int N>
class Mask {
 public:
  static_assert(N <= 16);
#if LAHAR_MASK_REGISTERS
  using Storage = std::conditional_t<(N <= 8), std::uint8_t, std::uint16_t>;
#else
  static constexpr bool kHalves = N * sizeof(T) > kVectorBytes;
  using Word = detail::MaskWord<T>;
  using Storage = typename detail::MaskStorage<T, N, kHalves>::Type;
#endif
  static constexpr unsigned kAll = (1U << N) - 1;  ///< bits of all lanes
  static constexpr std::size_t size() { return N; }

  Mask() = default;
  explicit Mask(const Storage& lanes) : lanes_(lanes) {}
  [[gnu::always_inline]] static Mask from_bits(unsigned bits) {
#if LAHAR_MASK_REGISTERS
    return Mask(static_cast<Storage>(bits));
#else
    if constexpr (kHalves) {
      using Half = Mask<T, N / 2>;
      return Mask(Storage{Half::from_bits(bits & Half::kAll), Half::from_bits(bits >> N / 2)});
    } else {
      const Storage lane = []<int... I>(std::integer_sequence<int, I...>) {
        return Storage{static_cast<Word>(1U << I)...};
      }
      (std::make_integer_sequence<int, N>{});
      return Mask(Storage((lane & static_cast<Word>(bits)) != 0));
    }
#endif
  }
  [[gnu::always_inline]] static Mask all(bool value) { return from_bits(value ? kAll : 0); }

  [[nodiscard]] const Storage& storage() const { return lanes_; }
  /// Lane k as bit k.
  [[nodiscard]] [[gnu::always_inline]] unsigned bits() const {
#if LAHAR_MASK_REGISTERS
    return lanes_;
#else
    return bits_of_vector();
#endif
  }
  [[gnu::always_inline]] bool operator[](std::size_t lane) const {
#if LAHAR_MASK_REGISTERS
    return (lanes_ >> lane & 1U) != 0;
#else
    if constexpr (kHalves)
      return lane < N / 2 ? lanes_.low[lane] : lanes_.high[lane - N / 2];
    else
      return lanes_[lane] != 0;
#endif
  }
  [[gnu::always_inline]] void set(std::size_t lane, bool value) {
#if LAHAR_MASK_REGISTERS
    const unsigned bit = 1U << lane;
    lanes_ = static_cast<Storage>(value ? lanes_ | bit : lanes_ & ~bit);
#else
    if constexpr (kHalves)
      lane < N / 2 ? lanes_.low.set(lane, value) : lanes_.high.set(lane - N / 2, value);
    else
      lanes_[lane] = value ? -1 : 0;
#endif
  }

#if LAHAR_MASK_REGISTERS
  [[gnu::always_inline]] friend Mask operator&&(const Mask& a, const Mask& b) {
    return Mask(static_cast<Storage>(a.lanes_ & b.lanes_));
  }
  [[gnu::always_inline]] friend Mask operator||(const Mask& a, const Mask& b) {
    return Mask(static_cast<Storage>(a.lanes_ | b.lanes_));
  }
  [[gnu::always_inline]] friend Mask operator!(const Mask& a) { return Mask(static_cast<Storage>(a.lanes_ ^ kAll)); }
#else
  [[gnu::always_inline]] friend Mask operator&&(const Mask& a, const Mask& b) {
    if constexpr (kHalves)
      return Mask(Storage{a.lanes_.low && b.lanes_.low, a.lanes_.high && b.lanes_.high});
    else
      return Mask(Storage(a.lanes_ & b.lanes_));
  }
  [[gnu::always_inline]] friend Mask operator||(const Mask& a, const Mask& b) {
    if constexpr (kHalves)
      return Mask(Storage{a.lanes_.low || b.lanes_.low, a.lanes_.high || b.lanes_.high});
    else
      return Mask(Storage(a.lanes_ | b.lanes_));
  }
  [[gnu::always_inline]] friend Mask operator!(const Mask& a) {
    if constexpr (kHalves)
      return Mask(Storage{!a.lanes_.low, !a.lanes_.high});
    else
      return Mask(~a.lanes_);
  }
#endif

 private:
#if !LAHAR_MASK_REGISTERS
  [[gnu::always_inline]] unsigned bits_of_vector() const {
    if constexpr (kHalves) {
      return lanes_.low.bits() | lanes_.high.bits() << N / 2;
    } else {
      unsigned found = 0;
#if defined(__SSE2__)
      // The signs of 16 bytes at a time.
      constexpr int kLanes = 16 / sizeof(Word);
      for (int first = 0; first < N; first += kLanes) {
        const char* part = reinterpret_cast<const char*>(&lanes_) + first * sizeof(Word);
        if constexpr (sizeof(Word) == 4)
          found |= static_cast<unsigned>(_mm_movemask_ps(_mm_load_ps(reinterpret_cast<const float*>(part)))) << first;
        else
          found |= static_cast<unsigned>(_mm_movemask_pd(_mm_load_pd(reinterpret_cast<const double*>(part)))) << first;
      }
#else
      for (int k = 0; k < N; ++k) found |= (lanes_[k] != 0 ? 1U : 0U) << k;
#endif
      return found;
    }
  }
#endif

  Storage lanes_;
};

template <class T, int N>
[[gnu::always_inline]] inline bool any(const Mask<T, N>& m) {
  return m.bits() != 0;
}
template <class T, int N>
[[gnu::always_inline]] inline bool all(const Mask<T, N>& m) {
  return m.bits() == Mask<T, N>::kAll;
}
template <class T, int N>
[[gnu::always_inline]] inline bool none(const Mask<T, N>& m) {
  return m.bits() == 0;
}
template <class T, int N>
[[gnu::always_inline]] inline int count(const Mask<T, N>& m) {
  return std::popcount(m.bits());
}
inline bool any(bool m) { return m; }
inline bool all(bool m) { return m; }
inline bool none(bool m) { return !m; }
inline int count(bool m) { return m ? 1 : 0; }

/// Writes N bytes, 1 or 0.
template <class Byte, class T, int N>
[[gnu::always_inline]] inline void store(Byte* p, const Mask<T, N>& m) {
  static_assert(sizeof(Byte) == 1);
  alignas(16) std::uint8_t bytes[16];
#if LAHAR_MASK_REGISTERS
  _mm_store_si128(reinterpret_cast<__m128i*>(bytes),
                  _mm_maskz_mov_epi8(static_cast<__mmask16>(m.bits()), _mm_set1_epi8(1)));
#else
  for (int k = 0; k < N; ++k) bytes[k] = m[static_cast<std::size_t>(k)] ? 1 : 0;
#endif
  std::memcpy(p, bytes, N);
}

}  // namespace lahar
