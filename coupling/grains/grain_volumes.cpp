// Volumes of the mapped grains. Compiled without contraction of products and sums, so that the same row gives the same
// numbers wherever it is inlined.
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

/// Of a sphere's centre from the nearest wall, cells; below 0 inside of it.
template <class Real>
double distance_to_walls(const lbm::Domain& domain, const GridSphere<Real>& sphere) {
  const Vec3 centre(static_cast<double>(sphere.centre[0]), static_cast<double>(sphere.centre[1]),
                    static_cast<double>(sphere.centre[2]));
  return domain.wall_distance(domain.origin() + domain.cell_size() * centre) / domain.cell_size();
}

/// What of a sphere's volume lies outside a plane wall; `t`: distance of the centre over the radius, below 0 inside.
double share_outside(double t) {
  t = std::clamp(t, -1.0, 1.0);
  return (1 + t) * (1 + t) * (2 - t) / 4;
}

/// Of a sphere's cells, by eps, at least so many are no wall: in a corner of the lattice an eighth.
constexpr double kLeastOutside = 1.0 / 8;

}  // namespace

/// Scales each sphere so that its cells that are no wall hold the exact volume that it has outside of the walls: what
/// is spread over cells, half of one beyond its surface, stays out of a wall that it lies on. It does not depend on
/// which blocks exist.
template <class Real>
void GrainMap<Real>::normalize(const lbm::Fluid<Real>& fluid) {
  const lbm::Domain& domain = fluid.grid().domain();
  parallel_for(0, grains_.size(), 64, [&](std::size_t k) {
    const MappedGrain& g = grains_[k];
    if (g.change != GrainChange::place) return;
    const Reach& reach = reaches_[k];
    GridSphere<Real>& sphere = spheres_[k];
    const double to_wall = distance_to_walls(domain, sphere);
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
    const double outside = std::max(sum - in_walls, kLeastOutside * sum);
    const double factor = sum > 0 ? share_outside(to_wall / radii_[g.id].cells) * g.volume / outside : 1.0;
    sphere.factor = static_cast<Real>(factor);
    for (std::size_t p = g.first_pair; p < g.first_pair + g.pairs; ++p) pairs_[p].volume *= factor;
  });
}

template void GrainMap<float>::normalize(const lbm::Fluid<float>&);
template void GrainMap<double>::normalize(const lbm::Fluid<double>&);

}  // namespace lahar::coupling
