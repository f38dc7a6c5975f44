// The geometry of a block against the domain, cell by cell and link by link.
#include "lbm/grid/block_geometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "lbm/boundary/slip_wall.h"

namespace lahar::lbm {
namespace {

constexpr double kToLu = 0.01;  // lattice velocity of 1 m/s

/// Eight cells each way with an open end, a lid that moves, and a ball. The lid lies 0.2 cells above the centres of the
/// uppermost cells, which end the first block.
DomainSpec box(WallPlacement placement) {
  DomainSpec spec;
  spec.upper = Vec3(0.8, 0.8, 0.8);
  spec.cell_size = 0.1;
  spec.faces[1] = FaceKind::open;
  spec.placement = placement;
  spec.walls.add({"lid", HalfSpace{Vec3(0, 0, 0.67), -Vec3::UnitZ()}, WallSlip::no_slip, 0, Vec3(2, 0.5, 0)});
  spec.walls.add({"ball", SolidSphere{Vec3(0.41, 0.38, 0.2), 0.17}, WallSlip::free_slip});
  return spec;
}

struct Cut {
  explicit Cut(const DomainSpec& spec, const Vec3i& lowest_cell = Vec3i::Zero())
      : domain(spec), lowest(lowest_cell), block(std::make_unique<Block<double>>()) {
    cut_geometry(*block, domain, lowest, kToLu);
  }
  [[nodiscard]] Vec3i place(int cell) const {
    const auto p = cell_position(cell);
    return lowest + Vec3i(p[0], p[1], p[2]);
  }
  [[nodiscard]] static Vec3i way(int i) { return {D3Q19::c[i][0], D3Q19::c[i][1], D3Q19::c[i][2]}; }

  Domain domain;
  Vec3i lowest;
  std::unique_ptr<Block<double>> block;
};

/// Every block of the box: types of its cells, cells that have a neighbour beyond the open end.
TEST(BlockGeometry, TypesAndRimAreThoseOfTheDomain) {
  int walls = 0, rims = 0;
  for (int k = 0; k < 8; ++k) {
    const Cut cut(box(WallPlacement::half_way), 8 * Vec3i(k & 1, (k >> 1) & 1, k >> 2));
    for (int n = 0; n < kBlockCells; ++n) {
      const auto cell = static_cast<std::size_t>(n);
      const CellType type = cut.domain.classify(cut.place(n));
      EXPECT_EQ(cut.block->type[cell], type);
      bool rim = false;
      for (int i = 1; i < D3Q19::q; ++i) rim |= cut.domain.classify(cut.place(n) + Cut::way(i)) == CellType::sink;
      EXPECT_EQ(cut.block->at_rim[cell], rim && type == CellType::gas);
      walls += type == CellType::wall, rims += cut.block->at_rim[cell];
    }
  }
  EXPECT_GT(walls, 500);
  EXPECT_GT(rims, 40);
}

/// Each link of a free cell into a wall cell stands once, under one wall; nothing else does.
TEST(BlockGeometry, EveryLinkIntoAWallIsListedOnce) {
  const Cut cut(box(WallPlacement::half_way));
  std::map<std::pair<int, int>, int> listed;
  for (const WallCell& wall : cut.block->walls.cells)
    for (int k = 0; k < wall.links; ++k)
      ++listed[{wall.cell, cut.block->walls.directions[static_cast<std::size_t>(wall.first_link + k)]}];
  for (int n = 0; n < kBlockCells; ++n)
    for (int i = 1; i < D3Q19::q; ++i) {
      const bool solid = cut.domain.classify(cut.place(n)) == CellType::gas &&
                         cut.domain.classify(cut.place(n) + Cut::way(i)) == CellType::wall;
      const auto found = listed.find({n, i});
      EXPECT_EQ(found == listed.end() ? 0 : found->second, solid ? 1 : 0) << n << ' ' << i;
    }
  EXPECT_GT(listed.size(), 500U);
  EXPECT_TRUE(cut.block->walls.hits.empty());
}

TEST(BlockGeometry, WallCellsKnowTheirWall) {
  const Cut cut(box(WallPlacement::half_way));
  int lid = 0, ball = 0, seams = 0;
  for (const WallCell& cell : cut.block->walls.cells) {
    const auto wall = static_cast<std::size_t>(cell.wall);
    const Vec3 centre = cut.domain.centre(cut.place(cell.cell));
    EXPECT_NEAR(cell.distance, cut.domain.walls().distance(wall, centre) / 0.1, 1e-6);
    EXPECT_NEAR(
        (Vec3(cell.normal[0], cell.normal[1], cell.normal[2]) - cut.domain.walls().gradient(wall, centre)).norm(), 0,
        1e-6);
    const auto slip = [&](int w) { return cut.domain.walls().all()[static_cast<std::size_t>(w)].slip; };
    const bool in_seam = std::ranges::any_of(cut.block->walls.cells, [&](const WallCell& other) {
      return other.cell == cell.cell && slip(other.wall) == WallSlip::no_slip;
    });
    const bool held = in_seam && is_in_steps(cell) && !cell.even;
    EXPECT_EQ(cell.slip, held ? WallSlip::no_slip : slip(cell.wall));
    seams += held && slip(cell.wall) != WallSlip::no_slip;
    EXPECT_NEAR(cell.wall_velocity[0], wall == 0 ? 2 * kToLu : 0, 1e-8);
    EXPECT_NEAR(cell.wall_velocity[1], wall == 0 ? 0.5 * kToLu : 0, 1e-8);
    lid += wall == 0, ball += wall == 1;
  }
  EXPECT_GT(lid, 30);
  EXPECT_GT(ball, 30);
  EXPECT_GT(seams, 0);
}

/// Interpolated: where each link meets its wall, and what the wall's motion pushes there.
TEST(BlockGeometry, LinksKnowWhereTheyHit) {
  const Cut cut(box(WallPlacement::interpolated));
  ASSERT_EQ(cut.block->walls.hits.size(), cut.block->walls.directions.size());
  int lid = 0, ball = 0;
  for (const WallCell& cell : cut.block->walls.cells)
    for (int k = 0; k < cell.links; ++k) {
      const auto link = static_cast<std::size_t>(cell.first_link + k);
      const WallHit hit = cut.block->walls.hits[link];
      const Vec3 way = Cut::way(cut.block->walls.directions[link]).cast<double>();
      const Vec3 point = cut.domain.centre(cut.place(cell.cell)) + 0.1 * hit.share * way;
      EXPECT_NEAR(cut.domain.walls().nearest(point).distance, 0, 1e-8);
      EXPECT_NEAR(hit.push, cell.wall == 0 ? kToLu * way.dot(Vec3(2, 0.5, 0)) : 0, 1e-8);
      if (cell.wall == 0 && cut.domain.walls().nearest(point).wall == 0) {
        EXPECT_NEAR(hit.share, 0.2, 1e-6);
        ++lid;
      }
      ball += cell.wall == 1;
    }
  EXPECT_GT(lid, 100);
  EXPECT_GT(ball, 100);
}

/// A wall that is drawn beyond a periodic face, as a level bed is around its map, is no wall where the period puts it.
TEST(BlockGeometry, WhatLiesBeyondAPeriodicFaceStaysThere) {
  DomainSpec spec;
  spec.upper = Vec3::Constant(0.8);
  spec.cell_size = 0.1;
  spec.placement = WallPlacement::interpolated;
  spec.faces[0] = spec.faces[1] = FaceKind::periodic;
  spec.walls.add({"sill", SolidBox{Vec3(-1, -1, -1), Vec3(0.2, 2, 0.23)}});
  const Domain domain(spec);
  EXPECT_NEAR(domain.wall_share(Vec3(0.45, 0.35, 0.03), Vec3(0.45, 0.35, -0.07)), 0.3, 1e-9) << "the floor";
  EXPECT_NEAR(domain.wall_share(Vec3(0.25, 0.35, 0.05), Vec3(0.15, 0.35, 0.05)), 0.5, 1e-9) << "the end of the sill";
  EXPECT_NEAR(domain.wall_share(Vec3(0.77, 0.35, 0.05), Vec3(0.87, 0.35, 0.05)), 0.3, 1e-6) << "the sill in the seam";
}

/// The link into the edge of a moving lid with a side wall is the side wall's (docs/decisions/0038).
TEST(BlockGeometry, CornersBelongToTheWallThatMovesLess) {
  DomainSpec spec;
  spec.upper = Vec3::Constant(0.6);
  spec.cell_size = 0.1;
  spec.faces = {FaceKind::closed,   FaceKind::closed, FaceKind::periodic,
                FaceKind::periodic, FaceKind::closed, FaceKind::open};
  spec.upper.y() = 0.8;
  spec.walls.add({"lid", HalfSpace{Vec3(0, 0, 0.6), -Vec3::UnitZ()}, WallSlip::no_slip, 0, Vec3(1, 0, 0)});
  const Cut cut(spec);
  const auto wall_of = [&](const Vec3i& place, const Vec3i& way) {
    for (const WallCell& cell : cut.block->walls.cells)
      for (int k = 0; k < cell.links; ++k)
        if (cut.place(cell.cell) == place &&
            Cut::way(cut.block->walls.directions[static_cast<std::size_t>(cell.first_link + k)]) == way)
          return cut.domain.walls().all()[static_cast<std::size_t>(cell.wall)].name;
    return std::string("none");
  };
  const int top = 6, left = 1, right = 6;  // cells of the domain begin at 1 along bounded axes
  EXPECT_EQ(wall_of({left, 4, top}, {0, 0, 1}), "lid");
  EXPECT_EQ(wall_of({left, 4, top}, {1, 0, 1}), "lid");
  EXPECT_EQ(wall_of({left, 4, top}, {0, 1, 1}), "lid");
  EXPECT_EQ(wall_of({left, 4, top}, {-1, 0, 1}), "domain face");
  EXPECT_EQ(wall_of({right, 4, top}, {1, 0, 1}), "domain face");
  EXPECT_EQ(wall_of({right, 4, top}, {-1, 0, 1}), "lid");
}

}  // namespace
}  // namespace lahar::lbm
