// The pass over the surface against its parts, called by hand and in another order of the blocks.
#include "lbm/step/surface_pass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "core/parallel.h"
#include "lbm/boundary/slip_wall.h"
#include "lbm/boundary/wall_reflection.h"
#include "lbm/free_surface/face_sums.h"
#include "lbm/free_surface/surface_exchange.h"
#include "lbm/free_surface/surface_shear.h"
#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

using Level = FluidLevel<double>;

constexpr double kGravity = 1e-3;
/// Liquid cells over the bed, by x.
constexpr std::array<int, 16> kHeights{0, 1, 2, 3, 4, 5, 6, 7, 8, 7, 6, 5, 4, 3, 2, 1};

/// Type of a free cell: no link leads from liquid to gas.
CellType type_at(const Vec3i& place) {
  const auto height = [](int x) { return kHeights[static_cast<std::size_t>((x + 16) % 16)]; };
  const int above = place.z() - height(place.x()), lowest = std::min(height(place.x() - 1), height(place.x() + 1));
  if (above == 1 || (above == 0 && lowest < height(place.x()))) return CellType::interface;
  return above > 1 ? CellType::gas : CellType::liquid;
}

void fill_block(FluidGrid<double>& grid, BlockIndex b, double noise) {
  Block<double>& block = grid.block(b);
  bool surface = false;
  for (int n = 0; n < kBlockCells; ++n) {
    const auto p = cell_position(n);
    const Vec3i place = grid.lowest_cell(b) + Vec3i(p[0], p[1], p[2]);
    CellType& type = block.type[static_cast<std::size_t>(n)];
    if (type == CellType::gas) type = type_at(place);
    surface |= type == CellType::interface;
    for (int i = 0; i < D3Q19::q; ++i)
      block.f(i)[n] = noise * D3Q19::w(i) * std::sin(1.7 * place.x() + 2.9 * place.y() + 4.3 * place.z() + 5.1 * i);
  }
  if (surface) {
    SurfaceFields<double>& fields = grid.require_surface(b);
    for (int n = 0; n < kBlockCells; ++n) {
      fields.density[n] = 3 * kGravity * (5 - grid.lowest_cell(b).z() - cell_position(n)[2]);  // under its own weight
      if (block.type[static_cast<std::size_t>(n)] == CellType::interface)
        fields.fill_level[n] = fields.mass[n] = 0.5 + 0.4 * std::sin(0.7 * n);
    }
  }
  grid.list_cells(b);
}

/// A heap on a slipping bed, periodic along x and y. Interface cells lie at the bed too.
std::unique_ptr<Level> heap(double tau, double noise) {
  FluidOptions o = lattice_options(Vec3i(16, 48, 14), (tau - 0.5) / 3);
  o.domain.faces[4] = FaceKind::closed, o.domain.faces[5] = FaceKind::open;
  o.domain.walls.add({"bed", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}, WallSlip::free_slip});
  o.gravity = Vec3(0.1 * kGravity, 0, -kGravity);
  std::unique_ptr<Level> level(new Level{{o.domain, 1}, units_of(o), parameters_of(o, units_of(o))});
  for (int k = 0; k < 24; ++k) level->grid.require_block(Vec3i(k & 1, k / 4, (k >> 1) & 1));  // several a thread
  for (const BlockIndex b : level->grid.owned()) fill_block(level->grid, b, noise);
  for (const BlockIndex b : level->grid.owned())  // settles which links of the mirror lead to another cell
    if (level->grid.has_walls(b)) reflect_at_walls(level->grid, b, level->parity(), {});
  return level;
}

/// All numbers that the pass may write.
std::vector<double> numbers(const FluidGrid<double>& grid) {
  std::vector<double> all;
  for (const BlockIndex b : grid.owned()) {
    const Block<double>& block = grid.block(b);
    for (int i = 0; i < D3Q19::q; ++i) all.insert(all.end(), block.f(i), block.f(i) + kBlockCells);
    if (!block.surface) continue;
    for (int k = 0; k < block.surface->count; ++k) {
      const auto n = block.surface->cells[static_cast<std::size_t>(k)];
      all.push_back(block.surface->mass[n]);
      all.push_back(block.surface->largest_rate[n]);
    }
  }
  return all;
}

/// By hand, from the last block to the first. The gradient of pressure is at most twice the weight.
void run_by_hand(Level& level, bool viscous) {
  FluidGrid<double>& grid = level.grid;
  const auto& g = level.parameters.gravity;
  const double weight = std::sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
  const std::vector<BlockIndex> owned = grid.owned();
  std::vector<std::vector<ShearRow<double>>> shear(owned.size());
  for (std::size_t k = owned.size(); viscous && k-- > 0;)
    if (grid.has_surface(owned[k])) measure_shear(grid, owned[k], level.parameters, shear[k]);
  for (std::size_t k = owned.size(); k-- > 0;)
    if (grid.has_surface(owned[k])) sum_over_faces(grid, owned[k], level.parity());
  for (std::size_t k = owned.size(); k-- > 0;) {
    if (!grid.has_surface(owned[k])) continue;
    exchange_over_mirrors(grid, owned[k], level.parity());
    exchange_surface(grid, owned[k], level.parity(),
                     {.largest_gradient = 2 * weight, .gravity = {g[0], g[1], g[2]}, .weight = weight},
                     viscous ? shear[k].data() : nullptr);
  }
}

TEST(SurfacePass, IsItsPartsInAnyOrderOfBlocks) {
  for (const double tau : {0.8, 0.5 + 1e-5}) {
    const bool viscous = tau > 0.6;
    const auto expected = heap(tau, 1e-3);
    run_by_hand(*expected, viscous);
    for (const int threads : {1, 2, 4}) {
      const ThreadLimit limit(threads);
      const auto level = heap(tau, 1e-3);
      SurfacePass<double> pass;
      pass.run(*level, 0);
      EXPECT_TRUE(numbers(level->grid) == numbers(expected->grid)) << tau << ", " << threads << " threads";
    }
    if (!viscous) continue;
    const auto other = heap(tau, 1e-3);
    run_by_hand(*other, false);
    EXPECT_TRUE(numbers(other->grid) != numbers(expected->grid));  // the stress counts
  }
}

TEST(SurfacePass, WithoutWeightLiquidAtRestStaysAtRest) {
  const auto level = heap(0.8, 0), before = heap(0.8, 0);
  level->parameters.gravity = {0, 0, 0};
  SurfacePass<double> pass;
  pass.run(*level, 0);
  for (const BlockIndex b : level->grid.owned()) {
    const Block<double>& block = level->grid.block(b);
    for (int i = 0; i < D3Q19::q; ++i)
      for (int n = 0; n < kBlockCells; ++n) ASSERT_EQ(block.f(i)[n], 0);
    for (int k = 0; block.surface && k < block.surface->count; ++k) {
      const auto n = block.surface->cells[static_cast<std::size_t>(k)];
      EXPECT_EQ(block.surface->mass[n], before->grid.block(b).surface->mass[n]);
    }
  }
}

/// Surface tension presses on a bump: populations from the gas are those of a higher pressure there.
TEST(SurfacePass, TensionIsFelt) {
  const auto level = heap(0.8, 0), slack = heap(0.8, 0);
  SurfacePass<double> pass;
  pass.run(*level, 1e-3);
  pass.run(*slack, 0);
  const auto populations = [](const FluidGrid<double>& grid) {
    double sum = 0;
    for (const BlockIndex b : grid.owned())
      for (int i = 0; i < D3Q19::q; ++i)
        for (int n = 0; n < kBlockCells; ++n) sum += grid.block(b).f(i)[n];
    return sum;
  };
  EXPECT_GT(populations(level->grid), populations(slack->grid) + 1e-6);
}

}  // namespace
}  // namespace lahar::lbm
