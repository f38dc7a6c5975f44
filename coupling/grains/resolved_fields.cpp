// What resolved grains write into the blocks. Compiled without contraction of products and sums, as grain_volumes.cpp
// is.
#include "coupling/grains/resolved_exchange.h"
#include "coupling/grains/sphere_rows.h"

namespace lahar::coupling {

namespace {

/// Adds a sphere to the fields of a block. By copy: what is written could otherwise be part of it. Weighted by eps the
/// exchange weight and the drag are the solid fraction itself.
template <bool kByDistance, class Real>
[[gnu::noinline]] void write_sphere(const GridSphere<Real> s, const Vec3i lowest, lbm::BodyFields<Real>& f) {
  const Row<Real> rx = (static_cast<Real>(lowest.x()) + lane_index<Row<Real>>()) + Real(0.5) - s.centre[0];
  const Row<Real> along_y = multiply_add(Row<Real>(s.spin[2]), rx, Row<Real>(s.velocity[1])), minus_y(-s.spin[1]);
  for_rows_near(
      s, lowest, s.reach, [&](int y, int z) __attribute__((always_inline)) {
        const RowCover<Real> cover = cover_row<kByDistance>(s, lowest.x(), lowest.y() + y, lowest.z() + z);
        const Real ry = static_cast<Real>(lowest.y() + y) + Real(0.5) - s.centre[1];
        const Real rz = static_cast<Real>(lowest.z() + z) + Real(0.5) - s.centre[2];
        const Real u = multiply_add(-s.spin[2], ry, multiply_add(s.spin[1], rz, s.velocity[0]));
        const Real w = multiply_add(s.spin[0], ry, s.velocity[2]), turn = s.spin[0] * rz;
        const int row = lbm::cell_index(0, y, z);
        const auto carry = [&](const Row<Real>& velocity) __attribute__((always_inline)) {
          return [&cover, velocity ](const Row<Real>& momentum) __attribute__((always_inline)) {
            return multiply_add(cover.weight, velocity, momentum);
          };
        };
        const Row<Real> fraction = load_aligned<Row<Real>>(f.solid_fraction + row) + cover.fraction;
        store_aligned(f.solid_fraction + row, fraction);
        if constexpr (kByDistance) {
          update_row(
              f.exchange_weight + row, [&](const Row<Real>& sum)
                                           __attribute__((always_inline)) { return sum + cover.weight; });
          update_row(
              f.drag + row, [&](const Row<Real>& sum) __attribute__((always_inline)) {
                return joined_drag<Row<Real>>(sum, cover.weight, number<Row<Real>>(kGapDrag));
              });
        } else {
          store_aligned(f.exchange_weight + row, fraction);
          store_aligned(f.drag + row, fraction);
        }
        const Row<Real> velocity[3] = {Row<Real>(u), along_y - turn, multiply_add(minus_y, rx, Row<Real>(w))};
        update_row(f.weighted_velocity_x + row, carry(velocity[0]));
        update_row(f.weighted_velocity_y + row, carry(velocity[1]));
        update_row(f.weighted_velocity_z + row, carry(velocity[2]));
      });
}

/// One bit for each place of a row.
template <class Real>
void mark_covered(lbm::BodyFields<Real>& f) {
  for (std::size_t row = 0; row < f.covered.size(); ++row) {
    const auto drag = load_aligned<Row<Real>>(f.drag + lbm::kBlockWidth * row);
    const auto covered = (drag >= static_cast<Real>(kCoveredDrag)).bits();
    if (covered != 0) f.covered[row] = static_cast<std::uint8_t>(covered);
  }
}

}  // namespace

template <class Real>
void ResolvedExchange<Real>::write_block(lbm::Fluid<Real>& fluid, const GrainMap<Real>& map, std::size_t block) const {
  lbm::BodyFields<Real>& fields = *fluid.grid().block(static_cast<lbm::BlockIndex>(block)).body;
  const bool by_distance = lbm::by_wall_distance(weighting_);
  const auto add = by_distance ? &write_sphere<true, Real> : &write_sphere<false, Real>;
  for (const std::uint32_t k : map.by_block().in(block)) {
    const GrainInBlock& pair = map.pairs()[k];
    add(map.sphere(pair.grain), pair.lowest, fields);
  }
  if (by_distance) mark_covered(fields);
}

template void ResolvedExchange<float>::write_block(lbm::Fluid<float>&, const GrainMap<float>&, std::size_t) const;
template void ResolvedExchange<double>::write_block(lbm::Fluid<double>&, const GrainMap<double>&, std::size_t) const;

}  // namespace lahar::coupling
