// Volumes of the mapped grains. Compiled without contraction of products and sums, so that the same row gives the same
// numbers wherever it is inlined.
#include <algorithm>
#include <array>

#include "coupling/grains/grain_map.h"
#include "coupling/grains/sphere_rows.h"
#include "lbm/grid/block_geometry.h"
#include "lbm/grid/row_types.h"

namespace lahar::coupling {

namespace {

/// Volume of a sphere in a block, in cells; by copy, so that it stays in registers.
template <class Real>
double volume_in(const GridSphere<Real> sphere, const Vec3i& lowest) {
  Row<Real> lanes(0);
  for_covered_rows(
      sphere, lowest, [&](int, const Row<Real>& eps) __attribute__((always_inline)) { lanes += eps; });
  return sum_in_double(lanes);
}

/// The part of it in walls; `block`: null where there is none.
template <class Real>
double volume_in_walls(const lbm::Block<Real>* block, const lbm::Domain& domain, const GridSphere<Real>& sphere,
                       const Vec3i& lowest) {
  const auto walls = [&](int row) {
    if (block) return lbm::wall_cells(lbm::types_of_row(*block, row));
    unsigned cells = 0;
    for (int c = 0; c < lbm::kBlockWidth; ++c) {
      const Vec3i cell = lowest + Vec3i(c, row & 7, row >> 3);
      const bool wall = domain.classify(lbm::image_of(domain, cell)) == lbm::CellType::wall;
      cells |= static_cast<unsigned>(wall) << c;
    }
    return cells;
  };
  Row<Real> lanes(0);
  for_covered_rows(sphere, lowest, [&](int first, const Row<Real>& eps) {
    const auto wall = Row<Real>::mask_type::from_bits(walls(first / lbm::kBlockWidth));
    lanes += select(wall, eps, Row<Real>(0));
  });
  return sum_in_double(lanes);
}

/// Of a sphere, m.
template <class Real>
Vec3 centre_of(const lbm::Domain& domain, const GridSphere<Real>& sphere) {
  const Vec3 centre(static_cast<double>(sphere.centre[0]), static_cast<double>(sphere.centre[1]),
                    static_cast<double>(sphere.centre[2]));
  return domain.origin() + domain.cell_size() * centre;
}

/// What of a sphere's volume lies outside a plane wall; `t`: distance of the centre over the radius, below 0 inside.
double share_outside(double t) {
  t = std::clamp(t, -1.0, 1.0);
  return (1 + t) * (1 + t) * (2 - t) / 4;
}

/// Beside the nearest, walls count that are nearer to the centre than this, over the radius: spheres that merely touch
/// walls sink in by less.
constexpr double kSunk = 0.9;
/// Cosine of 45 degrees. What one of two walls that face less apart cuts off is mostly cut off by the other, too.
constexpr double kSameWay = 0.7071;

/// What further walls leave of what lies outside of the nearest one, each taken as plane: exact for walls at right
/// angles. `centre` in m, `to_wall` (of the nearest) and `radius` in cells. Of walls that face the same way, as a face
/// of the domain that lies in the plane of a wall, the nearest counts.
double share_outside_of_further_walls(const lbm::Domain& domain, Vec3 centre, double to_wall, double radius) {
  double share = 1;
  if (to_wall >= kSunk * radius) return share;
  const double dx = domain.cell_size();
  const Vec3i cell = domain.cell_at(centre);  // beyond a periodic face the walls are those of the image inside
  centre += dx * (lbm::image_of(domain, cell) - cell).cast<double>();
  const Walls& walls = domain.walls();
  std::array<Vec3, 6> normals;  // of the walls that count
  normals.fill(Vec3::Zero());
  normals[0] = walls.nearest(centre).normal;
  for (std::size_t n = 1; n < normals.size(); ++n) {
    double nearest = kSunk * radius;
    for (std::size_t w = 0; w < walls.all().size(); ++w) {
      const double distance = walls.distance(w, centre) / dx;
      if (distance >= nearest) continue;
      const Vec3 normal = walls.gradient(w, centre);
      const auto faces_so = [&](const Vec3& other) { return normal.dot(other) > kSameWay; };
      if (std::any_of(normals.begin(), normals.begin() + n, faces_so)) continue;
      nearest = distance, normals[n] = normal;
    }
    if (normals[n].isZero()) return share;
    share *= share_outside(nearest / radius);
  }
  return share;
}

/// Of a sphere's cells, by eps, at least so many are no wall, of what further walls leave: in a corner of the lattice
/// an eighth.
constexpr double kLeastOutside = 1.0 / 8;

}  // namespace

/// Scales each sphere so that its cells that are no wall hold the exact volume that it has outside of the walls: what
/// is spread over cells, half of one beyond its surface, stays out of walls that it lies on. It does not depend on
/// which blocks exist.
template <class Real>
void GrainMap<Real>::normalize(const lbm::Fluid<Real>& fluid) {
  const lbm::Domain& domain = fluid.grid().domain();
  parallel_for(0, grains_.size(), 64, [&](std::size_t k) {
    const MappedGrain& g = grains_[k];
    if (g.change != GrainChange::place) return;
    const Reach& reach = reaches_[k];
    GridSphere<Real>& sphere = spheres_[k];
    const Vec3 centre = centre_of(domain, sphere);
    const double to_wall = domain.wall_distance(centre) / domain.cell_size();  // below 0 inside of it
    const bool meets_wall = to_wall < static_cast<double>(covered_reach(sphere));
    GrainInBlock *pair = pairs_.data() + g.first_pair, *const end = pair + g.pairs;
    double sum = 0, in_walls = 0;
    for (int x = reach.low.x(); x <= reach.high.x(); ++x)
      for (int y = reach.low.y(); y <= reach.high.y(); ++y)
        for (int z = reach.low.z(); z <= reach.high.z(); ++z) {
          const Vec3i lowest = lbm::kBlockWidth * Vec3i(x, y, z);
          const bool known = pair != end && pair->lowest == lowest;
          const double volume = volume_in<Real>(sphere, lowest);
          sum += volume;
          if (meets_wall && volume > 0)
            in_walls += volume_in_walls(known ? &fluid.grid().block(pair->block) : nullptr, domain, sphere, lowest);
          if (known) pair++->volume = volume;
        }
    const double radius = radii_[g.id].cells, left = share_outside_of_further_walls(domain, centre, to_wall, radius);
    const double outside = std::max(sum - in_walls, kLeastOutside * left * sum);
    const double factor = outside > 0 ? share_outside(to_wall / radius) * left * g.volume / outside : 0.0;
    sphere.factor = static_cast<Real>(factor);
    for (std::size_t p = g.first_pair; p < g.first_pair + g.pairs; ++p) pairs_[p].volume *= factor;
  });
}

template void GrainMap<float>::normalize(const lbm::Fluid<float>&);
template void GrainMap<double>::normalize(const lbm::Fluid<double>&);

}  // namespace lahar::coupling
