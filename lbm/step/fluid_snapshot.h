#pragma once
// What an observer sees of the fluid: a copy of the fields of the wet blocks in SI units, made only when output is due.
#include <array>
#include <vector>

#include "core/vector.h"

namespace lahar::lbm {

struct FluidSnapshot {
  static constexpr int block_width = 8;  ///< cells along a block edge

  struct Block {
    Vec3i origin;                       ///< cell index of the block's lowest cell
    std::array<float, 512> fill_level;  ///< 0 gas .. 1 liquid; cell (x,y,z) at 64 x + 8 y + z, as in an OpenVDB leaf
    std::array<float, 512> velocity_x, velocity_y, velocity_z;  ///< m/s, zero in gas
  };

  double cell_size = 0;        ///< m
  Vec3 origin = Vec3::Zero();  ///< position of the lower corner of cell (0,0,0), m; centres lie half a cell further
  std::vector<Block> blocks;   ///< sorted by origin (x, then y, then z)
};

}  // namespace lahar::lbm
