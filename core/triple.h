#pragma once
// Three-vectors of kernels. Two types, and why:
// - Vec3 (vector.h) is Eigen's: for geometry, set-up, results, whatever is not in an innermost loop. It has rotations,
//   matrices, expression templates.
// - Triple is three plain numbers, and TripleOf<V> three packs of numbers (simd.h), one pack a component: for kernels
//   that are written once for a number and for a pack. It has no alignment and no expression templates, so that
//   compilers keep it in registers and vectorize loops over it.

namespace lahar {

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
// Where two products meet in a sum they have names: which of them is contracted with the sum must not depend on
// whether V's operators are built in.
template <class V>
[[gnu::always_inline]] inline V dot(const TripleOf<V>& a, const TripleOf<V>& b) {
  const V x = a.x * b.x, y = a.y * b.y, z = a.z * b.z;
  return x + y + z;
}
namespace detail {
template <class V>
[[gnu::always_inline]] inline V determinant(const V& a, const V& b, const V& c, const V& d) {
  const V first = a * d, second = b * c;
  return first - second;
}
}  // namespace detail
template <class V>
[[gnu::always_inline]] inline TripleOf<V> cross(const TripleOf<V>& a, const TripleOf<V>& b) {
  return {detail::determinant(a.y, a.z, b.y, b.z), detail::determinant(a.z, a.x, b.z, b.x),
          detail::determinant(a.x, a.y, b.x, b.y)};
}
inline double length(const Triple& a) { return __builtin_sqrt(dot(a, a)); }
/// The part of a that is normal to the unit vector n.
template <class V>
[[gnu::always_inline]] inline TripleOf<V> normal_part(const TripleOf<V>& a, const TripleOf<V>& n) {
  return a - dot(a, n) * n;
}

}  // namespace lahar
