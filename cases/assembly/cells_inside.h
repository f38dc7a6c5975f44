#pragma once
// How many cells have their centre inside a solid, without a look at each.
#include "core/vector.h"

namespace lahar::scene {

/// Cells of a lattice from `first` up to `end`; cell (0, 0, 0) has its lower corner at `origin`.
struct CellBox {
  Vec3i first, end;
  Vec3 origin;
  double cell_size;

  [[nodiscard]] bool empty() const { return (end - first).minCoeff() <= 0; }
  /// As a number that may be beyond those of integers.
  [[nodiscard]] double cells() const { return empty() ? 0 : (end - first).cast<double>().prod(); }
};

/// How many cells have their centre where `distance(point)` (m, signed) is below 0. Counting ends where there are
/// `enough`. Boxes that lie far inside or outside are taken as a whole; the others are halved along their longest side.
template <class Distance>
double cells_inside(const CellBox& box, double enough, const Distance& distance) {
  if (box.empty()) return 0;
  constexpr double steepest = 1.7320508;  // of a distance that is interpolated between samples
  const Vec3 middle = 0.5 * (box.first + box.end).cast<double>();
  const double reach = 0.5 * steepest * box.cell_size * (box.end - box.first - Vec3i::Ones()).cast<double>().norm();
  const double d = distance(Vec3(box.origin + box.cell_size * middle));
  if (d >= reach) return 0;
  if (d < -reach || box.cells() == 1) return box.cells();  // one cell, of reach 0, is in or out
  Eigen::Index axis = 0;
  (box.end - box.first).maxCoeff(&axis);
  CellBox low = box, high = box;
  low.end[axis] = high.first[axis] = (box.first[axis] + box.end[axis]) / 2;
  const double found = cells_inside(low, enough, distance);
  return found >= enough ? found : found + cells_inside(high, enough - found, distance);
}

}  // namespace lahar::scene
