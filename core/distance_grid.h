#pragma once
// A signed distance sampled on a grid, for walls that come from files: fine near the surface, coarse elsewhere.
#include <cstdint>
#include <vector>

#include "core/vector.h"

namespace lahar {

/// Nodes lie `spacing` apart in bricks of 8^3 cells near the surface. Elsewhere only the corners of the bricks hold a
/// distance. Values between are trilinear.
class DistanceGrid {
 public:
  static constexpr int brick_cells = 8;
  static constexpr int brick_nodes = 9 * 9 * 9;  ///< a brick holds its far faces as well, and so needs no neighbour

  /// Covers a box, rounded up to whole bricks; all distances are 0 and no brick is fine.
  DistanceGrid(const Vec3& lower, const Vec3& upper, double spacing);

  [[nodiscard]] double spacing() const { return spacing_; }
  [[nodiscard]] const Vec3& lower() const { return lower_; }
  [[nodiscard]] Vec3 upper() const { return lower_ + spacing_ * brick_cells * bricks_.cast<double>(); }
  [[nodiscard]] const Vec3i& bricks() const { return bricks_; }
  /// Position of a node; bricks share theirs.
  [[nodiscard]] Vec3 node(const Vec3i& place) const { return lower_ + spacing_ * place.cast<double>(); }

  /// Corner of bricks, each component 0 .. bricks().
  float& coarse(const Vec3i& corner) { return coarse_[coarse_index(corner)]; }
  /// Makes bricks fine; their nodes are 0.
  void refine(const std::vector<Vec3i>& bricks);
  /// Nodes of the fine brick number `k` in the order of refine: (x, y, z) at 81 x + 9 y + z.
  float* fine(std::size_t k) { return fine_.data() + k * brick_nodes; }
  [[nodiscard]] std::size_t bytes() const;

  /// m; a point outside the grid gets the value at the nearest point of the grid and its distance from there.
  [[nodiscard]] double distance(const Vec3& p) const;
  /// Unit vector along which the distance grows: central differences over one spacing.
  [[nodiscard]] Vec3 gradient(const Vec3& p) const;
  /// Derivatives of `distance` itself, not of unit length: a force along it that depends on the distance alone does the
  /// same work on every way. In concave edges, where the distance has a crease, it is shorter than 1. Beyond the grid
  /// the gradient.
  [[nodiscard]] Vec3 slope(const Vec3& p) const;

 private:
  /// Calls `use` with the place in the cell (0 to 1), the size of the cell in spacings and the values at its corners.
  template <class Use>
  auto in_cell(const Vec3& place, const Use& use) const;
  [[nodiscard]] std::size_t coarse_index(const Vec3i& c) const {
    return (static_cast<std::size_t>(c.x()) * static_cast<std::size_t>(bricks_.y() + 1) +
            static_cast<std::size_t>(c.y())) *
               static_cast<std::size_t>(bricks_.z() + 1) +
           static_cast<std::size_t>(c.z());
  }
  [[nodiscard]] std::size_t brick_index(const Vec3i& b) const {
    return (static_cast<std::size_t>(b.x()) * static_cast<std::size_t>(bricks_.y()) + static_cast<std::size_t>(b.y())) *
               static_cast<std::size_t>(bricks_.z()) +
           static_cast<std::size_t>(b.z());
  }

  Vec3 lower_;
  double spacing_;
  Vec3i bricks_;
  std::vector<float> coarse_, fine_;
  std::vector<std::int32_t> brick_;  ///< index of a fine brick, -1 for a coarse one
};

}  // namespace lahar
