#pragma once
// fluid_NNNNNN.vdb: the fluid as sparse volumes for Blender, Houdini and OpenVDB tools.
#include <cstdint>
#include <filesystem>

#include "lbm/step/fluid_snapshot.h"

namespace lahar::cases {

/// Writes the grids `density` (fill level, 0 gas .. 1 liquid and what is submerged in it) and `velocity` (m/s) of a
/// snapshot. Voxels are active
/// where the fill level is not 0; world coordinates are metres, voxel (i,j,k) lies at the centre of its cell. File
/// metadata: time_s; grid metadata: unit. The file appears in one stroke. Throws FileError, and std::logic_error if a
/// block does not start at a multiple of the block width or the cell size is not positive.
void write_vdb(const std::filesystem::path& path, const lbm::FluidSnapshot& fluid, double time_s);

/// Writes fluid_000000.vdb, fluid_000001.vdb, ... into a directory.
class VdbWriter {
 public:
  explicit VdbWriter(std::filesystem::path directory, std::uint64_t first_frame = 0)
      : directory_(std::move(directory)), frames_(first_frame) {}
  /// Writes the next file and returns its path. Throws FileError.
  std::filesystem::path write(double time_s, const lbm::FluidSnapshot& fluid);

 private:
  std::filesystem::path directory_;
  std::uint64_t frames_;
};

}  // namespace lahar::cases
