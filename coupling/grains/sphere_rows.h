#pragma once
// The rows of 8 cells of a block that a body can reach. All lengths in cells.
#include "coupling/grains/sphere_fraction.h"
#include "lbm/grid/block.h"

namespace lahar::coupling {

/// Rows are taken a little farther than the reach, for rounding.
inline constexpr double kRowMargin = 1e-3;

/// [low, high) of the cells of a block along an axis with centres nearer to `place` than `reach`, all local to the
/// block.
struct CellRange {
  int low, high;
};

template <class Real>
[[gnu::always_inline]] inline CellRange cells_near(Real place, Real reach) {
  return {std::max(0, static_cast<int>(std::ceil(place - reach - Real(0.5)))),
          std::min(lbm::kBlockWidth, static_cast<int>(std::floor(place + reach - Real(0.5))) + 1)};
}

/// Calls visit(y, z), local to the block, for the rows with a cell nearer to the sphere's centre than `reach`.
template <class Real, class Visit>
[[gnu::always_inline]] inline void for_rows_near(const GridSphere<Real>& s, const Vec3i& lowest, Real reach,
                                                 const Visit& visit) {
  const Real x = s.centre[0] - static_cast<Real>(lowest.x()), y = s.centre[1] - static_cast<Real>(lowest.y()),
             z = s.centre[2] - static_cast<Real>(lowest.z());
  const Real dx = x - std::min(Real(lbm::kBlockWidth - 0.5), std::max(Real(0.5), x)), far = reach + Real(kRowMargin);
  const Real disc = far * far - dx * dx;  // reach within the plane of the row's nearest cells
  if (disc <= 0) return;
  const CellRange layers = cells_near(z, std::sqrt(disc));
  for (int k = layers.low; k < layers.high; ++k) {
    const Real dz = static_cast<Real>(k) + Real(0.5) - z;
    const CellRange rows = cells_near(y, std::sqrt(std::max(Real(0), disc - dz * dz)));
    for (int j = rows.low; j < rows.high; ++j) visit(j, k);
  }
}

/// Calls visit(first cell of the row, eps) for the rows of a block that a sphere covers.
template <class Real, class Visit>
[[gnu::always_inline]] inline void for_covered_rows(const GridSphere<Real>& s, const Vec3i& lowest,
                                                    const Visit& visit) {
  for_rows_near(
      s, lowest, covered_reach(s), [&](int y, int z) __attribute__((always_inline)) {
        visit(lbm::cell_index(0, y, z), fraction_row(s, lowest.x(), lowest.y() + y, lowest.z() + z));
      });
}

}  // namespace lahar::coupling
