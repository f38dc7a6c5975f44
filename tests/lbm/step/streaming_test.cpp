#include "lbm/step/streaming.h"

#include <gtest/gtest.h>

#include "lbm/grid/fluid_grid.h"

namespace lahar::lbm {
namespace {

/// A marked population must arrive at the next cell in its direction, step after step, across blocks and round the box.
TEST(Streaming, MovesEachPopulationOneCellPerStep) {
  DomainSpec spec;
  spec.upper = Vec3(16, 16, 16);
  spec.cell_size = 1;
  spec.faces.fill(FaceKind::periodic);
  FluidGrid<double> grid(spec, 1.0);
  for (int x = 0; x < 2; ++x)
    for (int y = 0; y < 2; ++y)
      for (int z = 0; z < 2; ++z) grid.require_block({x, y, z});
  for (int i = 1; i < D3Q19::q; ++i) {
    const int a = i % 2 == 1 ? i : i - 1;
    CellPlace place{grid.topology().find({0, 1, 0}), cell_index(7, 0, 3)};
    Parity parity;
    *(i == a ? grid.access(place, a, parity).outgoing_a : grid.access(place, a, parity).outgoing_b) = i;
    for (int step = 0; step < 20; ++step) {
      place = grid.neighbour(place, i);
      const auto pair = grid.access(place, a, parity);
      EXPECT_EQ(i == a ? *pair.incoming_a : *pair.incoming_b, i);
      // What a cell does in a step: the pair's values change places with those of opposite direction.
      std::swap(*pair.incoming_a, *pair.incoming_b);
      parity = parity.next();
    }
    const auto last = grid.access(place, a, parity);
    *(i == a ? last.outgoing_a : last.outgoing_b) = 0;
  }
}

TEST(Streaming, LocationsOfACellAreItsOwn) {
  DomainSpec spec;
  spec.upper = Vec3(8, 8, 8);
  spec.cell_size = 1;
  spec.faces.fill(FaceKind::periodic);
  FluidGrid<double> grid(spec, 1.0);
  const BlockIndex b = grid.require_block({0, 0, 0});
  for (const bool odd : {false, true}) {
    std::vector<const double*> seen;
    for (int n = 0; n < kBlockCells; ++n)
      for (int a = 1; a < D3Q19::q; a += 2) {
        const auto pair = grid.access({b, n}, a, {odd});
        seen.push_back(pair.incoming_a);
        seen.push_back(pair.incoming_b);
      }
    std::sort(seen.begin(), seen.end());
    EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
  }
}

}  // namespace
}  // namespace lahar::lbm
