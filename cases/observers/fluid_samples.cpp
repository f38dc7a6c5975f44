#include "cases/observers/fluid_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lbm/grid/block_geometry.h"

namespace lahar::cases {

double depth_over(const FluidView& fluid, const Vec3& point, double top) {
  const lbm::Domain& domain = fluid.domain();
  const double dx = fluid.units().cell_size;
  constexpr int longest_gap = 1;     // cells: a bubble
  constexpr double rounding = 1e-6;  // of a cell: a point on a face is at the foot of the cell above
  Vec3i cell = domain.cell_at(point);
  for (const int a : {0, 1})  // a point on the face at the end of the domain is over the last cell
    if (domain.period()[a] == 0) cell[a] = std::clamp(cell[a], domain.first()[a], domain.last_within()[a]);
  cell.z() = static_cast<int>(std::floor((point.z() - domain.origin().z()) / dx + 0.5 + rounding));
  const auto below_top = [&] { return domain.centre(cell).z() < top; };
  const auto in_wall = [&] { return domain.classify(lbm::image_of(domain, cell)) == lbm::CellType::wall; };
  while (below_top() && in_wall()) ++cell.z();  // below the ground
  double depth = 0;
  for (int gap = 0; below_top() && gap <= longest_gap; ++cell.z())
    if (const auto found = fluid.cell_at(domain.centre(cell))) {
      depth += found->fill_level * dx;
      gap = 0;
    } else {
      ++gap;
    }
  return depth;
}

namespace {

/// Calls visit(centre, weight) for the eight cells whose centres are around a point; the weights of linear
/// interpolation.
template <class Visit>
void for_cells_around(const lbm::Domain& domain, const Vec3& point, const Visit& visit) {
  const double dx = domain.cell_size();
  const Vec3 place = (point - domain.origin()) / dx - Vec3::Constant(0.5);  // in cells, centres at whole numbers
  const Vec3 low = place.array().floor();
  for (int k = 0; k < 8; ++k) {
    const Vec3 corner = low + Vec3(k & 1, (k >> 1) & 1, k >> 2);
    const double weight = (Vec3::Ones() - (place - corner).cwiseAbs()).prod();
    if (weight >= 1e-9) visit(Vec3(domain.origin() + dx * (corner + Vec3::Constant(0.5))), weight);
  }
}

}  // namespace

double pressure_at(const FluidView& fluid, const Vec3& point) {
  const lbm::Domain& domain = fluid.domain();
  const double dx = fluid.units().cell_size;
  Vec3 p = point;
  const WallPoint wall = domain.walls().nearest(p);
  if (wall.wall >= 0 && wall.distance < dx / 2) p += (dx / 2 - wall.distance) * wall.normal;
  double sum = 0, weights = 0;
  for_cells_around(domain, p, [&](const Vec3& centre, double weight) {
    if (domain.classify(lbm::image_of(domain, domain.cell_at(centre))) == lbm::CellType::wall) return;
    if (const auto cell = fluid.cell_at(centre)) sum += weight * cell->pressure;
    weights += weight;
  });
  return weights > 0 ? sum / weights : 0.0;
}

namespace {

/// Normal of what is nearest of the walls and the faces of the domain.
Vec3 normal_near(const lbm::Domain& domain, const Vec3& point) {
  const WallPoint wall = domain.walls().nearest(point);
  double nearest = wall.wall >= 0 ? std::abs(wall.distance) : std::numeric_limits<double>::infinity();
  Vec3 normal = wall.wall >= 0 ? wall.normal : Vec3(Vec3::UnitZ());
  const Vec3 lower = domain.origin() + domain.cell_size() * domain.first().cast<double>();
  const Vec3 upper = lower + domain.cell_size() * domain.cells().cast<double>();
  for (int a = 0; a < 3; ++a)
    for (const double face : {lower[a], upper[a]})
      if (std::abs(point[a] - face) < nearest) nearest = std::abs(point[a] - face), normal = Vec3::Unit(a);
  return normal;
}

}  // namespace

double pressure_on_disc(const FluidView& fluid, const Vec3& point, double diameter) {
  const Vec3 normal = normal_near(fluid.domain(), point);
  int least = 0;
  normal.cwiseAbs().minCoeff(&least);
  const Vec3 along = normal.cross(Vec3::Unit(least)).normalized(), across = normal.cross(along);
  const int n = static_cast<int>(std::ceil(diameter / fluid.units().cell_size));  // places along a radius
  double sum = 0;
  int places = 0;
  for (int i = -n; i <= n; ++i)
    for (int k = -n; k <= n; ++k) {
      if (i * i + k * k > n * n) continue;
      const double step = n > 0 ? 0.5 * diameter / n : 0;
      sum += pressure_at(fluid, point + step * (i * along + k * across));
      ++places;
    }
  return sum / places;
}

Vec3 velocity_at(const FluidView& fluid, const LiquidVelocity& velocity, const Vec3& point) {
  Vec3 sum = Vec3::Zero();
  double weights = 0;
  // Beyond it a cell has the velocity of the grain. Inside one fractions may be a little below 1: they add up to its
  // volume.
  constexpr double covered = 0.95;
  for_cells_around(fluid.domain(), point, [&](const Vec3& centre, double weight) {
    const auto cell = fluid.cell_at(centre);
    if (cell && cell->solid_fraction < covered) sum += weight * velocity(*cell), weights += weight;
  });
  return weights > 0 ? Vec3(sum / weights) : Vec3(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
}

}  // namespace lahar::cases
