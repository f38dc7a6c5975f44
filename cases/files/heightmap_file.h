#pragma once
// Terrain from files of heights.
#include <filesystem>
#include <vector>

#include "core/triangle_mesh.h"

namespace lahar::cases {

/// Heights at points in rows along x. All lengths m.
struct Heightmap {
  double x = 0, y = 0;  ///< of the first point of the first row (smallest x and y)
  double spacing = 0;
  std::size_t columns = 0, rows = 0;
  std::vector<double> heights;  ///< row by row, y ascending

  [[nodiscard]] double at(std::size_t column, std::size_t row) const { return heights[row * columns + column]; }
  [[nodiscard]] double lowest() const;
  [[nodiscard]] double highest() const;
};

/// ESRI ASCII grid (a header of ncols, nrows, xllcorner or xllcenter, yllcorner or yllcenter, cellsize and
/// NODATA_value) or rows of numbers alone, which lie `spacing` apart with the first point of the last row at (0, 0). In
/// both, the first row in the file is that with the largest y. Throws ShapeFileError.
Heightmap parse_heightmap(const std::string& bytes, double spacing);

/// The map times `scale` (x, y and height alike) and moved.
Heightmap placed(Heightmap map, double scale, const Vec3& translate);

/// Two triangles between each four points, which look up, over the rectangle (lower, upper); beyond the map the ground
/// goes on level. Parts of the map outside the rectangle are left out.
TriangleMesh terrain(const Heightmap& map, const Vec3& lower, const Vec3& upper);

}  // namespace lahar::cases
