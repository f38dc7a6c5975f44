#include "lbm/survey.h"

#include <gtest/gtest.h>

#include <limits>

#include "lbm/cell_moments.h"
#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

/// A small dam break under way: liquid, interface and blocks of all kinds.
void run_dam_break(Fluid<double>& fluid) {
  fluid.fill({{Vec3::Zero(), Vec3(0.15, 0.12, 0.22)}});
  for (int s = 0; s < 200; ++s) fluid.step();
}

FluidOptions options() { return tank_options(Vec3(0.4, 0.12, 0.3), 0.01, 2.0); }

TEST(Survey, FindsWhatAPlainLoopFinds) {
  Fluid<double> fluid(options());
  run_dam_break(fluid);
  const Survey found = survey_cells(fluid.grid(), fluid.parity());
  double speed = 0, compression = 0;
  std::size_t wet = 0;
  for (const BlockIndex b : fluid.grid().active())
    for (int n = 0; n < kBlockCells; ++n) {
      if (!is_wet(fluid.grid().type({b, n}))) continue;
      const auto m = outgoing_moments(fluid.grid(), {b, n}, fluid.parity());
      speed = std::max(speed, std::sqrt(m.u[0] * m.u[0] + m.u[1] * m.u[1] + m.u[2] * m.u[2]));
      compression = std::max(compression, std::abs(m.drho));
      ++wet;
    }
  EXPECT_GT(speed, 0.02);
  EXPECT_NEAR(found.speed, speed, 1e-12);
  EXPECT_NEAR(found.compression, compression, 1e-12);
  EXPECT_EQ(found.wet, wet);
  const auto m = outgoing_moments(fluid.grid(), found.fastest, fluid.parity());
  EXPECT_NEAR(std::sqrt(m.u[0] * m.u[0] + m.u[1] * m.u[1] + m.u[2] * m.u[2]), speed, 1e-12);
}

TEST(Survey, SeesWhatIsNotANumber) {
  Fluid<double> fluid(options());
  run_dam_break(fluid);
  const CellPlace place = survey_cells(fluid.grid(), fluid.parity()).fastest;
  fluid.grid().block(place.block).f(0)[place.cell] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(survey_cells(fluid.grid(), fluid.parity()).speed, kNotFinite);
}

}  // namespace
}  // namespace lahar::lbm
