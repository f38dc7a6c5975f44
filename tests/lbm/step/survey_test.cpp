#include "lbm/step/survey.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lbm/step/cell_moments.h"
#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

FluidOptions box() {
  FluidOptions o;
  o.domain.cell_size = 0.01;
  o.domain.upper = Vec3(0.24, 0.16, 0.16);
  o.domain.faces.fill(FaceKind::periodic);
  o.time_step = 1e-3;
  return o;
}

void stir(Fluid<double>& fluid) {
  fluid.fill_everything(
      [](const Vec3& p) { return Vec3(0.05 * std::sin(40 * p.y()), 0.03 * std::cos(30 * p.x()), 0.01); },
      [](const Vec3& p) { return 0.01 * std::sin(26 * p.x()); });
  for (int s = 0; s < 20; ++s) fluid.step();
}

TEST(Survey, FindsWhatAPlainLoopFinds) {
  Fluid<double> fluid(box());
  stir(fluid);
  double speed = 0;
  std::size_t wet = 0;
  CellPlace place;
  for (const BlockIndex b : fluid.grid().owned())
    for (int n = 0; n < kBlockCells; ++n) {
      const auto m = outgoing_moments(fluid.grid(), {b, n}, fluid.parity());
      ++wet;
      const double here = std::sqrt(m.u[0] * m.u[0] + m.u[1] * m.u[1] + m.u[2] * m.u[2]);
      if (here > speed) speed = here, place = {b, n};
    }
  const Survey& found = fluid.survey();
  EXPECT_GT(speed, 0.02);
  EXPECT_NEAR(found.speed, speed, 1e-12);
  EXPECT_EQ(found.wet, wet);
  EXPECT_EQ(found.held_back, 0u);
  EXPECT_EQ(found.fastest, place.block);
  EXPECT_EQ(fastest_cell(fluid.grid(), found.fastest, fluid.parity()).cell, place.cell);
}

TEST(Survey, SeesWhatIsNotANumber) {
  Fluid<double> fluid(box());
  stir(fluid);
  const BlockIndex b = fluid.grid().owned()[2];
  fluid.grid().block(b).f(0)[100] = std::numeric_limits<double>::quiet_NaN();
  fluid.step();
  EXPECT_EQ(fluid.survey().speed, kNotFinite);
  EXPECT_EQ(fluid.survey().fastest, b);
  EXPECT_EQ(fastest_cell(fluid.grid(), b, fluid.parity()).cell, 100);
}

}  // namespace
}  // namespace lahar::lbm
