// The pass over the walls against what each link must get, and what the walls' account says.
#include "lbm/step/wall_pass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "core/parallel.h"
#include "lbm/boundary/slip_wall.h"
#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

using Level = FluidLevel<double>;

/// A closed box of 12 x 44 x 14 cells that does not begin at the origin, full of liquid with noise in every population.
std::unique_ptr<Level> full_box(bool sliding_steps) {
  FluidOptions o = lattice_options(Vec3i(12, 44, 14), 0.1);
  o.domain.cell_size = 0.02, o.time_step = 1e-3, o.density = 900;
  o.domain.lower = Vec3(0.3, -0.2, 0.1);
  o.domain.upper = o.domain.lower + 0.02 * Vec3(12, 44, 14);
  o.domain.faces.fill(FaceKind::closed);
  o.kinematic_viscosity = 0.1 * 0.02 * 0.02 / 1e-3;
  if (sliding_steps)
    o.domain.walls.add(
        {"slope", HalfSpace{o.domain.lower + Vec3(0, 0, 0.05), Vec3(-0.4, 0, 1).normalized()}, WallSlip::free_slip});
  const LatticeUnits units = units_of(o);
  std::unique_ptr<Level> level(new Level{{o.domain, units.velocity_to_lu(1)}, units, parameters_of(o, units)});
  FluidGrid<double>& grid = level->grid;
  for (int k = 0; k < 24; ++k) grid.require_block(Vec3i(k & 1, k / 4, (k >> 1) & 1));  // several a thread
  for (const BlockIndex b : grid.owned()) {
    Block<double>& block = grid.block(b);
    for (int n = 0; n < kBlockCells; ++n) {
      const auto p = cell_position(n);
      const Vec3i place = grid.lowest_cell(b) + Vec3i(p[0], p[1], p[2]);
      CellType& type = block.type[static_cast<std::size_t>(n)];
      if (type == CellType::gas) type = CellType::liquid;
      for (int i = 0; i < D3Q19::q; ++i)
        block.f(i)[n] = 1e-3 * D3Q19::w(i) * std::sin(1.7 * place.x() + 2.9 * place.y() + 4.3 * place.z() + 5.1 * i);
    }
    grid.list_cells(b);
  }
  return level;
}

/// Visits each link of a wet cell into a wall: visit(cell, wall, velocity).
template <class Visit>
void for_each_link(const FluidGrid<double>& grid, const Visit& visit) {
  for (const BlockIndex b : grid.owned()) {
    const Block<double>& block = grid.block(b);
    for (const WallCell& wall : block.walls.cells)
      for (int k = 0; k < wall.links; ++k)
        visit(CellPlace{b, wall.cell}, wall.wall,
              block.walls.directions[static_cast<std::size_t>(wall.first_link + k)]);
  }
}

TEST(WallPass, WallsAtRestSendBackWhatTheyGot) {
  const auto level = full_box(false), before = full_box(false);
  WallPass<double> pass;
  WallAccount account;
  pass.reflect(*level, account);
  int links = 0;
  for_each_link(level->grid, [&](CellPlace place, int, int i) {
    const double sent = *link_populations(before->grid, place, i, level->parity()).sent;
    EXPECT_EQ(*link_populations(level->grid, place, i, level->parity()).back, sent);
    EXPECT_NE(sent, 0);
    ++links;
  });
  EXPECT_GT(links, 3000);
  EXPECT_TRUE(pass.loads().empty());  // nobody asked
  EXPECT_EQ(account.returned, 0);     // nothing to give back
}

/// Two passes book twice what one does: (f_i + f_opposite(i)) c_i at the middle of each link, in SI; of a link into an
/// edge each wall gets the component that leads to it.
TEST(WallPass, BooksWhatEachWallGets) {
  const auto level = full_box(false), measured = full_box(false);
  const Domain& domain = level->grid.domain();
  const double impulse_of_one = 900 * 0.02 * 0.02 * 0.02 * (0.02 / 1e-3);
  std::vector<WallLoad> expected(domain.walls().all().size());
  for_each_link(level->grid, [&](CellPlace place, int wall, int i) {
    const Vec3 way(D3Q19::c[i][0], D3Q19::c[i][1], D3Q19::c[i][2]);
    const Vec3 impulse = 2 * impulse_of_one * *link_populations(level->grid, place, i, level->parity()).sent * way;
    const Vec3 middle = level->grid.centre(place.block, place.cell) + 0.5 * 0.02 * way;
    bool into_edge = true;
    for (int a = 0; a < 3; ++a)
      if (way[a] != 0)
        into_edge =
            into_edge && level->grid.type(level->grid.neighbour(place, 2 * a + (way[a] > 0 ? 1 : 2))) == CellType::wall;
    for (int a = 0; a < 3; ++a) {
      const int face = into_edge ? 2 * a + (way[a] > 0 ? 1 : 0) : wall;
      const Vec3 part = impulse[a] * Vec3::Unit(a);
      WallLoad& load = expected[static_cast<std::size_t>(face)];
      load.impulse += 2 * part;
      load.angular_impulse += 2 * middle.cross(part);
    }
  });
  WallPass<double> pass;
  WallAccount account;
  pass.measure(domain);
  for (int k = 0; k < 2; ++k) pass.reflect(*measured, account);
  ASSERT_EQ(pass.loads().size(), 6U);
  for (std::size_t w = 0; w < 6; ++w) {
    EXPECT_GT(expected[w].impulse.norm(), 1e-9);
    EXPECT_LT((pass.loads()[w].impulse - expected[w].impulse).norm(), 1e-12 * expected[w].impulse.norm()) << w;
    EXPECT_LT((pass.loads()[w].angular_impulse - expected[w].angular_impulse).norm(),
              1e-12 * expected[w].angular_impulse.norm())
        << w;
  }
  pass.measure(domain);
  EXPECT_EQ(pass.loads()[0].impulse, Vec3(0, 0, 0));
}

std::vector<double> populations(const FluidGrid<double>& grid) {
  std::vector<double> all;
  for (const BlockIndex b : grid.owned())
    for (int i = 0; i < D3Q19::q; ++i) all.insert(all.end(), grid.block(b).f(i), grid.block(b).f(i) + kBlockCells);
  return all;
}

/// Loads and what is given back are sums over blocks: the same bits on any number of threads.
TEST(WallPass, DoesNotDependOnThreads) {
  std::vector<double> first;
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    const auto level = full_box(true);
    WallPass<double> pass;
    WallAccount account;
    pass.measure(level->grid.domain());
    for (int k = 0; k < 3; ++k) pass.reflect(*level, account);
    EXPECT_GT(account.returned, 0);
    std::vector<double> now = populations(level->grid);
    now.push_back(account.returned), now.push_back(account.owed);
    for (const WallLoad& load : pass.loads())
      for (int a = 0; a < 3; ++a) now.push_back(load.impulse[a]), now.push_back(load.angular_impulse[a]);
    if (threads == 1) first = now;
    EXPECT_EQ(now, first) << threads;
  }
}

}  // namespace
}  // namespace lahar::lbm
