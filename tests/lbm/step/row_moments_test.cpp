#include "lbm/step/row_moments.h"

#include <gtest/gtest.h>

#include "lbm/grid/row_types.h"
#include "lbm/step/cell_moments.h"
#include "lbm/step/fluid.h"

namespace lahar::lbm {
namespace {

/// A column that collapses: rows that are dry, whole and in part, blocks without neighbours, both parities.
template <class Real>
void expect_the_moments_of_the_cells() {
  FluidOptions o;
  o.domain.cell_size = 0.01;
  o.domain.upper = Vec3(0.3, 0.13, 0.24);
  o.domain.faces[5] = FaceKind::open;
  o.gravity = Vec3(0, 0, -9.81);
  o.time_step = 3e-4;
  Fluid<Real> fluid(o);
  fluid.fill({{Vec3::Zero(), Vec3(0.15, 0.13, 0.2)}});
  for (int s = 0; s < 41; ++s) {
    if (s >= 39) {
      std::size_t seen = 0;
      for (const BlockIndex b : fluid.grid().owned()) {
        BlockMoments<Real> m;
        find_moments(fluid.grid(), b, fluid.parity(), m);
        for (int n = 0; n < kBlockCells; ++n) {
          if (!is_wet(fluid.grid().type({b, n}))) continue;
          ++seen;
          const auto cell = outgoing_moments(fluid.grid(), {b, n}, fluid.parity());
          ASSERT_EQ(m.drho[n], cell.drho);
          for (int a = 0; a < 3; ++a) ASSERT_EQ(m.u[a][n], cell.u[a]);
        }
      }
      EXPECT_EQ(seen, fluid.wet_cells());
    }
    fluid.step();
  }
}

TEST(RowMoments, AreThoseOfTheCells) {
  expect_the_moments_of_the_cells<float>();
  expect_the_moments_of_the_cells<double>();
}

/// Water at rest leaves its collisions with half a step of gravity and enters them with as much against it.
TEST(RowMoments, HalfAStepOnWaterAtRestIsAtRest) {
  FluidOptions o;
  o.domain.cell_size = 0.01;
  o.domain.upper = Vec3(0.16, 0.13, 0.24);
  o.domain.faces[5] = FaceKind::open;
  o.gravity = Vec3(0, 0, -9.81);
  o.time_step = 3e-4;
  Fluid<double> fluid(o);
  fluid.fill({{Vec3::Zero(), Vec3(0.16, 0.13, 0.205)}});
  for (int s = 0; s < 3; ++s) fluid.step();
  const double half = 0.5 * 9.81 * o.time_step * o.time_step / o.domain.cell_size;
  int seen = 0;
  for (const BlockIndex b : fluid.grid().owned())
    for (int row = 0; row < kBlockCells / kBlockWidth; ++row) {
      const unsigned liquid = liquid_cells(types_of_row(fluid.grid().block(b), row));
      if (liquid == 0) continue;
      const auto out = outgoing_moments_of_row(fluid.grid().around(b), kBlockWidth * row, fluid.parity());
      const auto half_way = moments_half_a_step_on(fluid.grid().around(b), kBlockWidth * row, fluid.parity());
      for (std::size_t c = 0; c < kBlockWidth; ++c)
        if (liquid >> c & 1) {
          ++seen;
          EXPECT_NEAR(static_cast<double>(out.u[2][c]), -half, 1e-3 * half);
          for (const auto& u : half_way.u) EXPECT_NEAR(static_cast<double>(u[c]), 0, 1e-3 * half);
        }
    }
  EXPECT_GT(seen, 3000);
}

}  // namespace
}  // namespace lahar::lbm
