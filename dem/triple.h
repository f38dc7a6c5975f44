#pragma once
// Plain three-vectors for vectorized kernels.

namespace lahar::dem {

/// A three-vector of numbers, or of lines of eight numbers (lanes.h), that compilers keep in registers.
template <class V>
struct TripleOf {
  V x, y, z;
};
using Triple = TripleOf<double>;

template <class V>
[[gnu::always_inline]] inline TripleOf<V> operator+(const TripleOf<V>& a, const TripleOf<V>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class V>
[[gnu::always_inline]] inline TripleOf<V> operator-(const TripleOf<V>& a, const TripleOf<V>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class S, class V>
[[gnu::always_inline]] inline TripleOf<V> operator*(const S& s, const TripleOf<V>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class V>
[[gnu::always_inline]] inline V dot(const TripleOf<V>& a, const TripleOf<V>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class V>
[[gnu::always_inline]] inline TripleOf<V> cross(const TripleOf<V>& a, const TripleOf<V>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Triple& a) { return __builtin_sqrt(dot(a, a)); }
/// The part of a that is normal to the unit vector n.
template <class V>
[[gnu::always_inline]] inline TripleOf<V> normal_part(const TripleOf<V>& a, const TripleOf<V>& n) {
  return a - dot(a, n) * n;
}

}  // namespace lahar::dem
