#pragma once
// Where the surface lies in an interface cell: the plane of given normal that cuts off the cell's fill level (piecewise
// linear interface, Scardovelli & Zaleski 2000, J. Comput. Phys. 164, 228).
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/simd_math.h"

namespace lahar::lbm {

/// alpha of the plane m.x = alpha that cuts the volume V <= 1/2 off the unit cube at its origin; 0 <= m1 <= m2 <= m3,
/// m1 + m2 + m3 = 1. Inverse of the cut volume, by the five cases of the paper's section 3.
template <class Real>
Real plane_offset_of_half(Real m1, Real m2, Real m3, Real volume) {
  const Real m12 = m1 + m2, product = Real(6) * m1 * m2 * m3;
  const Real v1 = m1 > 0 ? m1 * m1 / std::max(Real(6) * m2 * m3, Real(1e-20)) : Real(0);
  if (volume < v1) return std::cbrt(product * volume);
  const Real v2 = v1 + (m2 - m1) / (Real(2) * m3);
  if (volume < v2) return (m1 + std::sqrt(m1 * m1 + Real(8) * m2 * m3 * (volume - v1))) / Real(2);
  const auto root = [](Real a2, Real a1, Real a0) {  // middle root of x^3 + a2 x^2 + a1 x + a0
    const Real p = std::sqrt(std::max(Real(0), a2 * a2 / Real(9) - a1 / Real(3)));
    const Real q = (a1 * a2 - Real(3) * a0) / Real(6) - a2 * a2 * a2 / Real(27);
    const Real angle = std::acos(std::clamp(q / std::max(p * p * p, Real(1e-30)), Real(-1), Real(1))) / Real(3);
    return p * (std::sqrt(Real(3)) * std::sin(angle) - std::cos(angle)) - a2 / Real(3);
  };
  if (m3 >= m12) {
    const Real v3 = m12 / (Real(2) * m3);
    if (volume >= v3) return m3 * volume + m12 / Real(2);
    return root(-Real(3) * m12, Real(3) * (m1 * m1 + m2 * m2), product * volume - m1 * m1 * m1 - m2 * m2 * m2);
  }
  const Real cubes = m1 * m1 * m1 + m2 * m2 * m2;
  const Real v3 =
      (m3 * m3 * (Real(3) * m12 - m3) + m1 * m1 * (m1 - Real(3) * m3) + m2 * m2 * (m2 - Real(3) * m3)) / product;
  if (volume < v3) return root(-Real(3) * m12, Real(3) * (m1 * m1 + m2 * m2), product * volume - cubes);
  // x^3 - 3/2 x^2 + 3/2 (m1^2+m2^2+m3^2) x - (cubes + m3^3 - product V)/2
  return root(Real(-1.5), Real(1.5) * (m1 * m1 + m2 * m2 + m3 * m3),
              (product * volume - cubes - m3 * m3 * m3) / Real(2));
}

/// a . (centre of the cell - a point of the surface), for a vector a along the surface's normal into the liquid: the
/// signed distance from the surface to the centre, times |a|. Positive when the cell is more than half full.
template <class Real>
Real depth_of_centre(const Real (&a)[3], Real fill) {
  Real m1 = std::abs(a[0]), m2 = std::abs(a[1]), m3 = std::abs(a[2]);
  const Real sum = m1 + m2 + m3;
  if (sum <= 0) return 0;
  m1 /= sum, m2 /= sum, m3 /= sum;
  if (m1 > m2) std::swap(m1, m2);
  if (m2 > m3) std::swap(m2, m3);
  if (m1 > m2) std::swap(m1, m2);
  const bool more = fill > Real(0.5);
  const Real offset = plane_offset_of_half(m1, m2, m3, more ? Real(1) - fill : fill) - Real(0.5);
  return sum * (more ? -offset : offset);
}

/// The same for the wanted cells of a vector, 0 in the others; multiply_add stands where the compiler fuses the lines
/// above. The ranges of volumes that a root or a product settles are taken together; those that need cube roots or
/// angles cell by cell.
template <class V, class Mask>
[[gnu::always_inline]] inline V depths_of_centres(const V (&a)[3], const V& fill, const Mask& wanted) {
  using Real = typename V::value_type;
  const auto real = [](double x) { return V(static_cast<Real>(x)); };
  V m1 = abs(a[0]), m2 = abs(a[1]), m3 = abs(a[2]);
  const V sum = m1 + m2 + m3;
  const auto inclined = wanted && sum > real(0);
  m1 /= sum, m2 /= sum, m3 /= sum;
  const auto sort = [](V & low, V & high) __attribute__((always_inline)) {
    const V least = min(low, high);
    high = max(low, high), low = least;
  };
  sort(m1, m2), sort(m2, m3), sort(m1, m2);
  const auto more = fill > real(0.5);
  V volume = fill, v1(0);
  volume = select(more, real(1) - fill, volume);
  v1 = select(m1 > real(0), m1 * m1 / max(real(6) * m2 * m3, real(1e-20)), v1);
  const V m12 = m1 + m2, v2 = v1 + (m2 - m1) / (real(2) * m3), v3 = m12 / (real(2) * m3);
  const auto edge = volume >= v1 && volume < v2, face = volume >= v2 && m3 >= m12 && volume >= v3;
  V offset = multiply_add(m3, volume, V(m12 / real(2)));
  offset = select(edge, (m1 + sqrt(multiply_add(m1, m1, V(real(8) * m2 * m3 * (volume - v1))))) / real(2), offset);
  if (const auto others = inclined && !(edge || face); any(others))
    for (std::size_t k = 0; k < V::size(); ++k)
      if (others[k]) offset.set(k, plane_offset_of_half(m1[k], m2[k], m3[k], volume[k]));
  offset -= real(0.5);
  offset = select(more, -offset, offset);
  V depth(0);
  depth = select(inclined, sum * offset, depth);
  return depth;
}

}  // namespace lahar::lbm
