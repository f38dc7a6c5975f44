#include "core/distance_grid.h"

#include <algorithm>
#include <cmath>

namespace lahar {

DistanceGrid::DistanceGrid(const Vec3& lower, const Vec3& upper, double spacing) : lower_(lower), spacing_(spacing) {
  bricks_ = ((upper - lower) / (brick_cells * spacing)).array().ceil().max(1).cast<int>();
  coarse_.assign(coarse_index(bricks_) + 1, 0);
  brick_.assign(brick_index(bricks_ - Vec3i::Ones()) + 1, -1);
}

void DistanceGrid::refine(const std::vector<Vec3i>& bricks) {
  for (std::size_t k = 0; k < bricks.size(); ++k) brick_[brick_index(bricks[k])] = static_cast<std::int32_t>(k);
  fine_.assign(bricks.size() * brick_nodes, 0);
}

std::size_t DistanceGrid::bytes() const {
  return (coarse_.size() + fine_.size()) * sizeof(float) + brick_.size() * sizeof(std::int32_t);
}

namespace {

/// Between the corners of a cell; `at` gives the value at (x, y, z), each 0 or 1; t is the place in the cell.
template <class At>
double trilinear(const Vec3& t, const At& at) {
  const auto along_z = [&](int x, int y) { return at(x, y, 0) + t.z() * (at(x, y, 1) - at(x, y, 0)); };
  const double low = along_z(0, 0) + t.y() * (along_z(0, 1) - along_z(0, 0));
  const double high = along_z(1, 0) + t.y() * (along_z(1, 1) - along_z(1, 0));
  return low + t.x() * (high - low);
}

/// Its derivatives by t.
template <class At>
Vec3 trilinear_slope(const Vec3& t, const At& at) {
  Vec3 slope;
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    const auto step = [&](int at_b, int at_c) {
      Vec3i from;
      from[a] = 0, from[b] = at_b, from[c] = at_c;
      const double low = at(from.x(), from.y(), from.z());
      from[a] = 1;
      return at(from.x(), from.y(), from.z()) - low;
    };
    slope[a] = (1 - t[b]) * ((1 - t[c]) * step(0, 0) + t[c] * step(0, 1)) +
               t[b] * ((1 - t[c]) * step(1, 0) + t[c] * step(1, 1));
  }
  return slope;
}

}  // namespace

template <class Use>
auto DistanceGrid::in_cell(const Vec3& place, const Use& use) const {
  const Vec3i brick = (place / brick_cells).cast<int>().cwiseMin(bricks_ - Vec3i::Ones());
  const Vec3 inside = place - (brick_cells * brick).cast<double>();
  if (const std::int32_t fine = brick_[brick_index(brick)]; fine >= 0) {
    const Vec3i cell = inside.cast<int>().cwiseMin(brick_cells - 1);
    const float* base =
        fine_.data() + static_cast<std::size_t>(fine) * brick_nodes + 81 * cell.x() + 9 * cell.y() + cell.z();
    return use(Vec3(inside - cell.cast<double>()), 1.0,
               [&](int x, int y, int z) { return static_cast<double>(base[81 * x + 9 * y + z]); });
  }
  return use(Vec3(inside / brick_cells), static_cast<double>(brick_cells),
             [&](int x, int y, int z) { return static_cast<double>(coarse_[coarse_index(brick + Vec3i(x, y, z))]); });
}

double DistanceGrid::distance(const Vec3& p) const {
  const Vec3 most = (brick_cells * bricks_).cast<double>();
  const Vec3 wanted = (p - lower_) / spacing_;
  const Vec3 place = wanted.cwiseMax(0).cwiseMin(most);  // in spacings
  const double d = in_cell(place, [](const Vec3& t, double, const auto& at) { return trilinear(t, at); });
  const double beyond = (wanted - place).norm() * spacing_;
  return d < 0 ? d - beyond : d + beyond;
}

Vec3 DistanceGrid::slope(const Vec3& p) const {
  const Vec3 place = (p - lower_) / spacing_;
  if (!(place.array() >= 0).all() || !(place.array() <= (brick_cells * bricks_).cast<double>().array()).all())
    return gradient(p);
  return in_cell(place, [&](const Vec3& t, double cell, const auto& at) -> Vec3 {
    return trilinear_slope(t, at) / (cell * spacing_);
  });
}

Vec3 DistanceGrid::gradient(const Vec3& p) const {
  Vec3 g;
  for (int a = 0; a < 3; ++a) {
    Vec3 step = Vec3::Zero();
    step[a] = spacing_ / 2;
    g[a] = distance(p + step) - distance(p - step);
  }
  const double n = g.norm();
  return n > 0 ? Vec3(g / n) : Vec3(Vec3::UnitZ());
}

}  // namespace lahar
