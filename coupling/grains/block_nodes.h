#pragma once
// The cells of a block among the nodes of averaging_grid.h: sums of what they hold, and what the nodes give them.
#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "coupling/grains/averaging_grid.h"
#include "coupling/rows.h"
#include "lbm/grid/row_types.h"
#include "lbm/step/row_moments.h"

namespace lahar::coupling {

/// Where the cells of a block stand between the nodes.
template <class Real>
struct BlockNodes {
  Vec3i lowest, count;                  ///< first node, and how many along each axis
  int below[3][lbm::kBlockWidth];       ///< by cell, from `lowest` on
  Real weight[3][2][lbm::kBlockWidth];  ///< of the node below and of the one above

  BlockNodes(const AveragingGrid& grid, const Vec3i& lowest_cell) {
    for (int a = 0; a < 3; ++a) {
      for (int c = 0; c < lbm::kBlockWidth; ++c) {
        const AveragingGrid::Between b = grid.between(a, lowest_cell[a] + c + 0.5);
        if (c == 0) lowest[a] = b.below;
        below[a][c] = b.below - lowest[a];
        weight[a][0][c] = static_cast<Real>(1 - b.above_weight), weight[a][1][c] = static_cast<Real>(b.above_weight);
      }
      count[a] = below[a][lbm::kBlockWidth - 1] + 2;
    }
  }
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(count.prod()); }
  [[nodiscard]] std::size_t at(int x, int y, int z) const {
    return static_cast<std::size_t>((x * count.y() + y) * count.z() + z);
  }
  /// visit(x, y, z) from `lowest` on.
  template <class Visit>
  void for_nodes(const Visit& visit) const {
    for (int x = 0; x < count.x(); ++x)
      for (int y = 0; y < count.y(); ++y)
        for (int z = 0; z < count.z(); ++z) visit(x, y, z);
  }
  /// visit(y node, z node, weight) for the rows of nodes around a row of cells.
  template <class Visit>
  void around_row(int y, int z, const Visit& visit) const {
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k < 2; ++k) visit(below[1][y] + j, below[2][z] + k, weight[1][j][y] * weight[2][k][z]);
  }
};

/// Water and its momentum around nodes.
struct WaterSum {
  double sum[4] = {};  ///< volume, momentum along x, y, z
};

/// Velocity of the water in a row of cells, between what a step's pressure and forces do to it; of interface cells,
/// where what comes in is not known yet, after the last step's.
template <class Real>
std::array<Row<Real>, 3> water_velocity(const lbm::FluidGrid<Real>& grid, lbm::BlockIndex b, int row,
                                        lbm::Parity parity) {
  const std::uint64_t types = lbm::types_of_row(grid.block(b), row);
  const unsigned liquid = lbm::liquid_cells(types), interface = lbm::interface_cells(types);
  const int first = lbm::kBlockWidth * row;
  std::array<Row<Real>, 3> u{Row<Real>(0), Row<Real>(0), Row<Real>(0)};
  const auto take = [&](unsigned cells, const lbm::RowMoments<Real>& m) {
    const auto some = Row<Real>::mask_type::from_bits(cells);
    for (std::size_t a = 0; a < 3; ++a) u[a] = select(some, m.u[a], u[a]);
  };
  if (liquid != 0) take(liquid, lbm::moments_half_a_step_on(grid.around(b), first, parity));
  if (interface != 0) take(interface, lbm::outgoing_moments_of_row(grid.around(b), first, parity));
  return u;
}

/// What the cells of a block have, by node, lu. `parity` is that of the coming step.
template <class Real>
std::vector<WaterSum> sum_water(const lbm::FluidGrid<Real>& grid, lbm::BlockIndex b, lbm::Parity parity,
                                const BlockNodes<Real>& nodes) {
  const lbm::Block<Real>& block = grid.block(b);
  std::vector<std::array<Row<Real>, 4>> rows(static_cast<std::size_t>(nodes.count.y() * nodes.count.z()),
                                             {Row<Real>(0), Row<Real>(0), Row<Real>(0), Row<Real>(0)});
  for (std::uint64_t left = block.wet_rows; left != 0; left &= left - 1) {
    const int row = std::countr_zero(left);
    const Row<Real> water = water_in(block, row);
    const auto u = water_velocity(grid, b, row, parity);
    const Row<Real> carried[4] = {water, water * u[0], water * u[1], water * u[2]};
    nodes.around_row(row & 7, row >> 3, [&](int j, int k, Real weight) {
      auto& sums = rows[static_cast<std::size_t>(j * nodes.count.z() + k)];
      for (std::size_t q = 0; q < 4; ++q) sums[q] += weight * carried[q];
    });
  }
  std::vector<WaterSum> sums(nodes.size());
  for (int j = 0; j < nodes.count.y(); ++j)
    for (int k = 0; k < nodes.count.z(); ++k)
      for (std::size_t q = 0; q < 4; ++q)
        for (int c = 0; c < lbm::kBlockWidth; ++c) {
          const double x = rows[static_cast<std::size_t>(j * nodes.count.z() + k)][q][static_cast<std::size_t>(c)];
          for (int i = 0; i < 2; ++i)
            sums[nodes.at(nodes.below[0][c] + i, j, k)].sum[q] += static_cast<double>(nodes.weight[0][i][c]) * x;
        }
  return sums;
}

/// Adds to the cells of a block what the nodes around accelerate them by, lu, full or not; returns the momentum that
/// their water gets.
template <class Real>
Vec3 add_impulses(lbm::Block<Real>& block, const BlockNodes<Real>& nodes, const std::vector<Vec3>& acceleration) {
  Real* const field[3] = {block.impulse->x, block.impulse->y, block.impulse->z};
  Vec3 given = Vec3::Zero();
  std::vector<Vec3> along(static_cast<std::size_t>(nodes.count.x()));
  for (std::uint64_t left = block.wet_rows; left != 0; left &= left - 1) {
    const int row = std::countr_zero(left), n = lbm::kBlockWidth * row;
    std::fill(along.begin(), along.end(), Vec3(Vec3::Zero()));
    nodes.around_row(row & 7, row >> 3, [&](int j, int k, Real weight) {
      for (int i = 0; i < nodes.count.x(); ++i)
        along[static_cast<std::size_t>(i)] += static_cast<double>(weight) * acceleration[nodes.at(i, j, k)];
    });
    const Row<Real> water = water_in(block, row);
    for (int a = 0; a < 3; ++a)
      for (int c = 0; c < lbm::kBlockWidth; ++c) {
        const auto below = static_cast<std::size_t>(nodes.below[0][c]);
        const Real more = nodes.weight[0][0][c] * static_cast<Real>(along[below][a]) +
                          nodes.weight[0][1][c] * static_cast<Real>(along[below + 1][a]);
        field[a][n + c] += more;
        given[a] += static_cast<double>(static_cast<Real>(water[static_cast<std::size_t>(c)]) * more);
      }
  }
  return given;
}

}  // namespace lahar::coupling
