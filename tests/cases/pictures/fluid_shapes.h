#pragma once
// Snapshots of simple bodies of water for the tests.
#include <functional>

#include "lbm/step/fluid_snapshot.h"

namespace lahar::cases {

/// Fills all blocks with first <= block < last (block numbers) from a function of the position of the cell centre.
inline lbm::FluidSnapshot fluid_of(double cell_size, const Vec3i& first, const Vec3i& last,
                                   const std::function<double(const Vec3&)>& fill_level) {
  lbm::FluidSnapshot fluid{cell_size, Vec3::Zero(), {}};
  for (int bx = first.x(); bx < last.x(); ++bx)
    for (int by = first.y(); by < last.y(); ++by)
      for (int bz = first.z(); bz < last.z(); ++bz) {
        lbm::FluidSnapshot::Block block{};
        block.origin = 8 * Vec3i(bx, by, bz);
        for (int n = 0; n < 512; ++n) {
          const Vec3 centre = (block.origin + Vec3i(n / 64, n / 8 % 8, n % 8)).cast<double>() + Vec3::Constant(0.5);
          block.fill_level[static_cast<std::size_t>(n)] = static_cast<float>(fill_level(cell_size * centre));
        }
        fluid.blocks.push_back(block);
      }
  return fluid;
}

/// Still water up to a height.
inline std::function<double(const Vec3&)> level_water(double height, double cell_size) {
  return [=](const Vec3& p) { return std::clamp((height - p.z()) / cell_size + 0.5, 0.0, 1.0); };
}

}  // namespace lahar::cases
