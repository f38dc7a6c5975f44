#pragma once
// How much of a cell a sphere covers. All lengths in cells.
//
// Near the surface the covered fraction of a cell is taken as linear in the distance d of the cell's centre from a
// sphere of radius r':  eps = clamp(1/2 - d, 0, 1). Averaged over all offsets of the sphere to the grid this gives the
// volume 4/3 pi (r'^3 + r'/4) for r' >= 1/2 (the sphere convolved with a box of width 1), so r' is chosen to give the
// true volume; what is left for a particular offset is removed by a factor (see GrainMap).
#include <algorithm>
#include <cmath>

#include "coupling/grains/grid_sphere.h"
#include "coupling/grains/wall_drag.h"
#include "coupling/rows.h"

namespace lahar::coupling {

/// The radius r' >= 1/2 with r'^3 + r'/4 = r^3 (Newton); 1/2 for smaller spheres, whose factor does the rest.
inline double mapping_radius(double r) {
  const double target = std::max(r * r * r, 0.25);
  double x = std::max(r, 0.5);
  for (int k = 0; k < 20; ++k) x -= (x * x * x + x / 4 - target) / (3 * x * x + 0.25);
  return x;
}

/// Distances of the cells of a row, (x0..x0+7, y, z), from the centre. A cell at the edge must be covered for all
/// callers or for none: contraction of products and sums is spelled out (core/simd_math.h).
template <class Real>
[[gnu::always_inline]] inline Row<Real> distance_row(const GridSphere<Real>& s, int x0, int y, int z) {
  const Real dy = static_cast<Real>(y) + Real(0.5) - s.centre[1], dz = static_cast<Real>(z) + Real(0.5) - s.centre[2];
  const Row<Real> base(multiply_add(dy, dy, dz * dz));
  const Row<Real> dx = (static_cast<Real>(x0) + Real(0.5) - s.centre[0]) + lane_index<Row<Real>>();
  return sqrt(multiply_add(dx, dx, base));
}

/// eps at given distances.
template <class Real>
[[gnu::always_inline]] inline Row<Real> fraction_at(const GridSphere<Real>& s, const Row<Real>& distance) {
  const Row<Real> cover = (Real(0.5) + s.radius) - distance;
  return s.factor * min(Row<Real>(1), max(Row<Real>(0), cover));
}

/// eps of the sphere in a row of 8 cells, and its weight in their exchange: eps too, or its drag.
template <class Real>
struct RowCover {
  Row<Real> fraction, weight;
};

template <class Real>
[[gnu::always_inline]] inline Row<Real> fraction_row(const GridSphere<Real>& s, int x0, int y, int z) {
  return fraction_at(s, distance_row(s, x0, y, z));
}

/// `kByDistance`: s.surface is given.
template <bool kByDistance, class Real>
[[gnu::always_inline]] inline RowCover<Real> cover_row(const GridSphere<Real>& s, int x0, int y, int z) {
  const Row<Real> distance = distance_row(s, x0, y, z), eps = fraction_at(s, distance);
  if constexpr (kByDistance)
    return {eps, wall_drag<Row<Real>>(distance - s.surface)};
  else
    return {eps, eps};
}

}  // namespace lahar::coupling
