#include "lbm/free_surface/curvature.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lbm/grid/block_geometry.h"

namespace lahar::lbm {

template <class Real>
FillAround<Real>::FillAround(const FluidGrid<Real>& grid, BlockIndex b) {
  const auto& around = grid.around(b);
  const auto side = [](int k) { return k < 0 ? -1 : (k > 7 ? 1 : 0); };
  for (int z = -rim; z < width - rim; ++z)
    for (int y = -rim; y < width - rim; ++y)
      for (int x = -rim; x < width - rim; ++x) {
        const Block<Real>* block = around[static_cast<std::size_t>(neighbour_slot(side(x), side(y), side(z)))];
        const int cell = cell_index(x & 7, y & 7, z & 7);
        Real& level = fill[at(x, y, z)];
        level = 0;
        if (!block) {  // beyond the outermost walls
          const Vec3i place = image_of(grid.domain(), grid.lowest_cell(b) + Vec3i(x, y, z));
          if (grid.domain().classify(place) == CellType::wall) level = wall;
          continue;
        }
        const CellType type = block->type[static_cast<std::size_t>(cell)];
        if (type == CellType::liquid) level = 1;
        if (type == CellType::interface) level = block->surface->fill_level[cell];
        if (type == CellType::wall) level = wall;
      }
}

namespace {

constexpr int kReach = FillAround<double>::rim;

/// A view of the fill levels from one cell.
template <class Real>
class View {
 public:
  View(const FillAround<Real>& around, int x, int y, int z) : centre_(around.fill + FillAround<Real>::at(x, y, z)) {}

  [[nodiscard]] static int step(int axis) {
    return axis == 0 ? 1 : (axis == 1 ? FillAround<Real>::width : FillAround<Real>::width * FillAround<Real>::width);
  }
  [[nodiscard]] Real raw(int offset) const { return centre_[offset]; }
  /// A wall counts as the cell itself.
  [[nodiscard]] Real level(int offset) const {
    return centre_[offset] < 0 ? std::max(centre_[0], Real(0)) : centre_[offset];
  }
  [[nodiscard]] View at(int offset) const { return View(centre_ + offset); }

 private:
  explicit View(const Real* centre) : centre_(centre) {}
  const Real* centre_;
};

template <class Real>
struct Vector {
  Real c[3] = {0, 0, 0};
};

/// Gradient of the fill level over 27 cells, weights 1, 2, 4 (Youngs 1984): out of the gas.
template <class Real>
Vector<Real> gradient(const View<Real>& v) {
  Vector<Real> g;
  for (int axis = 0; axis < 3; ++axis) {
    const int s = View<Real>::step(axis), p = View<Real>::step((axis + 1) % 3), q = View<Real>::step((axis + 2) % 3);
    for (int i = -1; i <= 1; ++i)
      for (int k = -1; k <= 1; ++k) {
        const int weight = (2 - std::abs(i)) * (2 - std::abs(k)), there = i * p + k * q;
        g.c[axis] += static_cast<Real>(weight) * (v.level(there + s) - v.level(there - s)) / Real(32);
      }
  }
  return g;
}

/// Height of the liquid in a column along an axis, `up` away from the liquid; none where the column does not begin in
/// liquid and end in gas.
template <class Real>
std::optional<Real> height(const View<Real>& v, int column, int up) {
  Real sum = v.raw(column), last = v.raw(column);
  for (int k = 1; k <= kReach; ++k) {
    const Real here = v.raw(column + k * up);
    if (here >= 0) last = here;
    sum += last;
  }
  if (last > Real(0.001)) return std::nullopt;
  last = v.raw(column);
  for (int k = 1; k <= kReach; ++k) {
    const Real here = v.raw(column - k * up);
    if (here < 0 && last <= Real(0.001)) return std::nullopt;  // a dry column on a wall: a contact line
    last = here >= 0 ? here : Real(1);                         // liquid that stands on a wall
    sum += last;
  }
  if (last < Real(0.999)) return std::nullopt;
  return sum;
}

template <class Real>
std::optional<Real> from_heights(const View<Real>& v, int axis, Real along) {
  const int up = along > 0 ? -View<Real>::step(axis) : View<Real>::step(axis);
  const int p = View<Real>::step((axis + 1) % 3), q = View<Real>::step((axis + 2) % 3);
  Real h[3][3];
  const std::optional<Real> middle = height(v, 0, up);
  if (!middle) return std::nullopt;
  for (int i = -1; i <= 1; ++i)
    for (int k = -1; k <= 1; ++k) {
      // Beside a wall the surface is mirrored: the height of the cell that is not in the wall.
      int column = i * p + k * q;
      if (v.raw(column) < 0) column = v.raw(i * p) >= 0 ? i * p : (v.raw(k * q) >= 0 ? k * q : 0);
      const std::optional<Real> found = column == 0 ? middle : height(v, column, up);
      if (!found) return std::nullopt;
      h[i + 1][k + 1] = *found;
    }
  const Real hx = (h[2][1] - h[0][1]) / 2, hy = (h[1][2] - h[1][0]) / 2;
  const Real hxx = h[2][1] - 2 * h[1][1] + h[0][1], hyy = h[1][2] - 2 * h[1][1] + h[1][0];
  const Real hxy = (h[2][2] - h[2][0] - h[0][2] + h[0][0]) / 4;
  const Real s = 1 + hx * hx + hy * hy;
  return -(hxx * (1 + hy * hy) + hyy * (1 + hx * hx) - 2 * hxy * hx * hy) / (s * std::sqrt(s));
}

/// Divergence of the normals, over the six cells around.
template <class Real>
Real from_normals(const View<Real>& v) {
  Real sum = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1}) {
      const Vector<Real> g = gradient(v.at(side * View<Real>::step(axis)));
      const Real size = std::sqrt(g.c[0] * g.c[0] + g.c[1] * g.c[1] + g.c[2] * g.c[2]);
      if (size > Real(1e-6)) sum -= static_cast<Real>(side) * g.c[axis] / size / 2;
    }
  return sum;
}

}  // namespace

template <class Real>
Real curvature(const FillAround<Real>& around, int x, int y, int z) {
  const View<Real> v(around, x, y, z);
  const Vector<Real> g = gradient(v);
  int order[3] = {0, 1, 2};
  std::stable_sort(order, order + 3, [&](int a, int b) { return std::abs(g.c[a]) > std::abs(g.c[b]); });
  Real found = 0;
  bool known = false;
  for (int k = 0; k < 3 && !known; ++k)
    if (const auto value = from_heights(v, order[k], g.c[order[k]])) found = *value, known = true;
  if (!known) found = from_normals(v);
  return std::clamp(found, Real(-1), Real(1));
}

template struct FillAround<float>;
template struct FillAround<double>;
template float curvature<float>(const FillAround<float>&, int, int, int);
template double curvature<double>(const FillAround<double>&, int, int, int);

}  // namespace lahar::lbm
