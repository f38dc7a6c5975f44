#include "lbm/grid/domain.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"

namespace lahar::lbm {

double covering_cells(double length, double cell_size) { return std::ceil(length / cell_size - 1e-6); }

Domain::Domain(DomainSpec spec) : spec_(std::move(spec)) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto low = static_cast<std::size_t>(2 * axis), high = low + 1;
    const bool periodic = spec_.faces[low] == FaceKind::periodic;
    require(periodic == (spec_.faces[high] == FaceKind::periodic), "Domain: an axis is periodic on one side only");
    cells_[axis] = static_cast<int>(covering_cells(spec_.upper[axis] - spec_.lower[axis], spec_.cell_size));
    first_[axis] = periodic ? 0 : 1;
    origin_[axis] = spec_.lower[axis] - first_[axis] * spec_.cell_size;
    if (!periodic) continue;
    require(cells_[axis] % kBlockWidth == 0, "Domain: a periodic axis needs a multiple of 8 cells");
    period_[axis] = cells_[axis] / kBlockWidth;
  }
  for (int face = 0; face < 6; ++face) {
    if (spec_.faces[static_cast<std::size_t>(face)] != FaceKind::closed) continue;
    const int axis = face / 2;
    Vec3 normal = Vec3::Zero();
    normal[axis] = face % 2 == 0 ? 1 : -1;
    spec_.walls.add({"domain face", HalfSpace{face % 2 == 0 ? spec_.lower : spec_.upper, normal}, spec_.slip});
  }
}

Vec3i Domain::last_within() const {
  constexpr double rounding = 1e-6;
  return ((spec_.upper - origin_) / spec_.cell_size)
      .array()
      .unaryExpr([](double end) { return std::floor(end - 0.5 + rounding); })
      .matrix()
      .cast<int>();
}

bool Domain::outside_open_face(const Vec3i& cell) const {
  for (int axis = 0; axis < 3; ++axis) {
    const auto low = static_cast<std::size_t>(2 * axis);
    if (cell[axis] < first_[axis] && spec_.faces[low] == FaceKind::open) return true;
    if (cell[axis] >= first_[axis] + cells_[axis] && spec_.faces[low + 1] == FaceKind::open) return true;
  }
  return false;
}

double Domain::wall_distance(const Vec3& p) const {
  Vec3 within = p;  // beyond a periodic face there is what is at the other end, as cells are classified
  for (int axis = 0; axis < 3; ++axis) {
    const double width = kBlockWidth * spec_.cell_size * period_[axis];
    if (width > 0) within[axis] -= width * std::floor((p[axis] - spec_.lower[axis]) / width);
  }
  return spec_.walls.nearest(within).distance;
}

double Domain::wall_share(const Vec3& from, const Vec3& into) const {
  double low = 0, high = 1, f_low = wall_distance(from), f_high = wall_distance(into);
  // Regula falsi with the Illinois rule: exact at once on a plane.
  int side = 0;
  double t = 0.5;
  for (int k = 0; k < 30 && high - low > 1e-12; ++k) {
    t = (low * f_high - high * f_low) / (f_high - f_low);
    const double f = wall_distance(from + t * (into - from));
    if (std::abs(f) < 1e-12 * spec_.cell_size) break;
    if (f > 0) {
      low = t, f_low = f;
      if (side == 1) f_high /= 2;
      side = 1;
    } else {
      high = t, f_high = f;
      if (side == -1) f_low /= 2;
      side = -1;
    }
  }
  return std::clamp(t, 1e-6, 1.0);
}

namespace {

/// Whether there is wall on all sides of a point: it lies on the seam of walls that touch. The ways are uneven, so that
/// none of them runs along a seam.
bool is_in_seam(const Walls& walls, const Vec3& p, double cell_size) {
  for (int k = 0; k < 8; ++k) {
    const Vec3 way((k & 1) ? 1 : -1, (k & 2) ? 0.6 : -0.6, (k & 4) ? 0.3 : -0.3);
    if (!(walls.nearest(p + 1e-3 * cell_size * way).distance < -1e-6 * cell_size)) return false;
  }
  return true;
}

}  // namespace

CellType Domain::classify(const Vec3i& cell) const {
  const Vec3 p = centre(cell);
  // A cell whose centre lies on a wall is liquid, however its distance is rounded, but where walls touch.
  const double on_wall = 1e-6 * spec_.cell_size;
  bool touches = false;
  for (std::size_t w = 0; w < spec_.walls.all().size(); ++w) {
    const double distance = spec_.walls.distance(w, p);
    if (distance < -on_wall) return CellType::wall;
    touches = touches || distance <= 1e-4 * spec_.cell_size;  // sampled surfaces are lifted by some 1e-5
  }
  if (touches && is_in_seam(spec_.walls, p, spec_.cell_size)) return CellType::wall;
  return outside_open_face(cell) ? CellType::sink : CellType::gas;
}

}  // namespace lahar::lbm
