#pragma once
// The drag that a fluid cell next to a body's surface needs so that the fluid comes to rest at the surface, whatever
// the viscosity. All lengths in cells.
//
// Take a plane no-slip wall of normal n, a linear profile u = s d outside and 0 inside, and a fluid cell at distance q.
// Its momentum balance on the lattice is nu L u = k u with L u = 6 sum_i w_i (u(x + c_i) - u(x)) and the drag k. The
// directions that end inside the wall lack the negative part of the profile:
//   h = k / nu = (6 / q) sum_{c_i n < -q} w_i (|c_i n| - q).
// For a wall along the lattice h = (1 - q) / q. Averaged over all normals (|c_i n| is even in 0..|c_i|; D3Q19 has 6 c_i
// of length 1 and weight 1/18 and 12 of length sqrt 2 and weight 1/36):
//   h(q) = ((1 - q)+^2 + (sqrt 2 - q)+^2 / sqrt 2) / (2 q).
// k is proportional to nu: the flow past a body at rest does not depend on tau, as it does with B = eps. Inside the
// body h is so large that the cell takes the body's velocity.
#include <algorithm>

#include "core/simd_math.h"

namespace lahar::coupling {

/// How far from a surface cells feel it.
inline constexpr double kWallDragReach = 1.4142135623730951;
/// h of a cell in a body.
inline constexpr double kInteriorDrag = 1e12;
/// h from which on a grain covers a cell (lbm/free_surface/covered_cells.h): its surface is within a millionth of a
/// cell of the cell's centre, or beyond.
inline constexpr double kCoveredDrag = 1e6;

/// Two surfaces: a cell in the middle of a gap of one cell has q = 1/2 and h = 1 from each, and the parabola between
/// them, u = g / (2 nu) q^2 there, asks for 2 + h = 2 / q^2, so h = 6 = 1 + 1 + 4. With the product
/// 1 + 4 h = (1 + 4 h_1) (1 + 4 h_2) the order of the bodies does not matter and one that is far adds nothing.
inline constexpr double kGapDrag = 4;

/// The drag of two bodies together; gap is kGapDrag, or 0 for a plain sum. For numbers and rows of them
/// (core/simd.h); products and sums are spelled out.
template <class V>
[[gnu::always_inline]] inline V joined_drag(const V& one, const V& other, const V& gap) {
  return min(multiply_add(V(gap * one), other, V(one + other)), number<V>(kInteriorDrag));
}

/// h at distance q from the surface, negative inside: there the quotient is above kInteriorDrag.
template <class V>
[[gnu::always_inline]] inline V wall_drag(const V& q) {
  const V along = max(V(0), V(V(1) - q)), across = max(V(0), V(number<V>(kWallDragReach) - q));
  const V near = along * along, far = V(number<V>(0.70710678118654752) * across) * across, sum = near + far;
  return min(V(sum / max(V(V(2) * q), number<V>(1e-12))), number<V>(kInteriorDrag));
}

}  // namespace lahar::coupling
