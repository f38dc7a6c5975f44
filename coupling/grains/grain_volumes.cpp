// Volumes of the mapped grains. Compiled without contraction of products and sums, so that the same row gives the same
// numbers wherever it is inlined.
#include "coupling/grains/grain_map.h"
#include "coupling/grains/sphere_rows.h"

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

}  // namespace

/// Scales each sphere to its exact volume, which does not depend on which blocks exist.
template <class Real>
void GrainMap<Real>::normalize() {
  parallel_for(0, grains_.size(), 64, [&](std::size_t k) {
    const MappedGrain& g = grains_[k];
    if (g.change != GrainChange::place) return;
    const Reach& reach = reaches_[k];
    GrainInBlock *pair = pairs_.data() + g.first_pair, *const end = pair + g.pairs;
    double sum = 0;
    for (int x = reach.low.x(); x <= reach.high.x(); ++x)
      for (int y = reach.low.y(); y <= reach.high.y(); ++y)
        for (int z = reach.low.z(); z <= reach.high.z(); ++z) {
          const Vec3i lowest = lbm::kBlockWidth * Vec3i(x, y, z);
          const double volume = volume_in<Real>(spheres_[k], lowest);
          sum += volume;
          if (pair != end && pair->lowest == lowest) pair++->volume = volume;
        }
    const double factor = sum > 0 ? g.volume / sum : 1.0;
    spheres_[k].factor = static_cast<Real>(factor);
    for (std::size_t p = g.first_pair; p < g.first_pair + g.pairs; ++p) pairs_[p].volume *= factor;
  });
}

template void GrainMap<float>::normalize();
template void GrainMap<double>::normalize();

}  // namespace lahar::coupling
