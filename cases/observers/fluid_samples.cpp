#include "cases/observers/fluid_samples.h"

#include <cmath>
#include <limits>

namespace lahar::cases {

double depth_over(const FluidView& fluid, const Vec3& point, double top) {
  const double dx = fluid.units().cell_size;
  double depth = 0;
  for (double z = point.z() + dx / 2; z < top; z += dx)
    if (const auto cell = fluid.cell_at({point.x(), point.y(), z})) depth += cell->fill_level * dx;
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
    if (domain.classify(domain.cell_at(centre)) == lbm::CellType::wall) return;
    if (const auto cell = fluid.cell_at(centre)) sum += weight * cell->pressure;
    weights += weight;
  });
  return weights > 0 ? sum / weights : 0.0;
}

Vec3 velocity_at(const FluidView& fluid, const Vec3& point) {
  Vec3 sum = Vec3::Zero();
  double weights = 0;
  for_cells_around(fluid.domain(), point, [&](const Vec3& centre, double weight) {
    if (const auto cell = fluid.cell_at(centre)) sum += weight * cell->velocity, weights += weight;
  });
  return weights > 0 ? Vec3(sum / weights) : Vec3(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
}

}  // namespace lahar::cases
