#pragma once
// How much of a cell a sphere covers. All lengths in cells.
//
// Near the surface the covered fraction of a cell is taken as linear in the distance d of the cell's centre from a
// sphere of radius r':  eps = clamp(1/2 - d, 0, 1). Averaged over all offsets of the sphere to the grid this gives the
// volume 4/3 pi (r'^3 + r'/4) for r' >= 1/2 (the sphere convolved with a box of width 1), so r' is chosen to give the
// true volume; what is left for a particular offset is removed by a factor (see BodyMap).
#include <algorithm>
#include <cmath>

#include "coupling/wall_resistance.h"
#include "lbm/cells.h"

namespace lahar::coupling {

/// The radius r' >= 1/2 with r'^3 + r'/4 = r^3 (Newton); 1/2 for smaller spheres, whose factor does the rest.
inline double mapping_radius(double r) {
  const double target = std::max(r * r * r, 0.25);
  double x = std::max(r, 0.5);
  for (int k = 0; k < 20; ++k) x -= (x * x * x + x / 4 - target) / (3 * x * x + 0.25);
  return x;
}

/// A sphere as the grid sees it, lattice units; positions in cells from the corner of cell (0,0,0).
template <class Real>
struct GridSphere {
  Real centre[3];
  Real radius;       ///< mapping radius
  Real surface;      ///< radius at which the fluid comes to rest (wall_resistance.h); below 0: weighting by eps
  Real factor = 1;   ///< scales eps to the exact volume
  Real velocity[3];  ///< lu
  Real spin[3];      ///< rad per step
};

/// How far from the centre eps or the coverage is not 0.
template <class Real>
Real reach_of(const GridSphere<Real>& s) {
  return std::max(s.radius + Real(0.5), s.surface + Real(kResistanceReach));
}

/// eps of the sphere in the row of 8 cells at (x0..x0+7, y, z). Never inlined: contraction of products and sums differs
/// from place to place, and a cell at the edge must be covered for all callers or for none.
template <class Real>
[[gnu::noinline]] void sphere_row(const GridSphere<Real>& s, int x0, int y, int z, Real* __restrict eps) {
  const Real dy = static_cast<Real>(y) + Real(0.5) - s.centre[1], dz = static_cast<Real>(z) + Real(0.5) - s.centre[2];
  const Real base = dy * dy + dz * dz, x = static_cast<Real>(x0) + Real(0.5) - s.centre[0];
  for (int k = 0; k < lbm::kBlockWidth; ++k) {
    const Real dx = x + static_cast<Real>(k);
    const Real cover = Real(0.5) + s.radius - std::sqrt(base + dx * dx);
    eps[k] = s.factor * std::min(Real(1), std::max(Real(0), cover));
  }
}

/// What the sphere writes into the coverage of a row of cells, and its eps there. Never inlined, as above.
template <class Real>
[[gnu::noinline]] void sphere_coverage_row(const GridSphere<Real>& s, int x0, int y, int z, Real* __restrict eps,
                                           Real* __restrict coverage) {
  sphere_row(s, x0, y, z, eps);
  if (s.surface < Real(0)) {
    std::copy(eps, eps + lbm::kBlockWidth, coverage);
    return;
  }
  const Real dy = static_cast<Real>(y) + Real(0.5) - s.centre[1], dz = static_cast<Real>(z) + Real(0.5) - s.centre[2];
  const Real base = dy * dy + dz * dz, x = static_cast<Real>(x0) + Real(0.5) - s.centre[0];
  for (int k = 0; k < lbm::kBlockWidth; ++k) {
    const Real dx = x + static_cast<Real>(k);
    coverage[k] = wall_resistance(std::sqrt(base + dx * dx) - s.surface);
  }
}

/// Rows (y, z) of a block that a sphere can reach: [low, high), local to the block; 0 is y, 1 is z.
struct RowRange {
  int low[2], high[2];
};

template <class Real>
RowRange rows_in_reach(const GridSphere<Real>& s, const Vec3i& lowest, Real reach) {
  RowRange r{};
  for (int a = 0; a < 2; ++a) {
    const int axis = a + 1;
    r.low[a] = std::max(0, static_cast<int>(std::floor(s.centre[axis] - reach)) - lowest[axis]);
    r.high[a] = std::min(lbm::kBlockWidth, static_cast<int>(std::floor(s.centre[axis] + reach)) + 1 - lowest[axis]);
  }
  return r;
}

}  // namespace lahar::coupling
