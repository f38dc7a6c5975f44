// The ledger of the liquid's momentum: exact for water that slides, walls and all.
#include "cases/observers/liquid_momentum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/cases/observers/sampled.h"

namespace lahar::cases {
namespace {

/// Water and two stones that slide down a chute.
const std::string chute = R"([scene]
name = "chute"
[run]
duration_s = 1.0
precision = "double"
[domain]
lower_m = [0, 0, 0]
upper_m = [1.2, 0.16, 0.32]
slip = "free_slip"
open_faces = ["x+", "z+"]
[gravity]
slope_deg = 30
[fluid]
enabled = true
cell_size_m = 0.02
max_speed_m_s = 4.0
kinematic_viscosity_m2_s = 1e-5
[[fluid.region]]
lower_m = [0.2, 0, 0]
upper_m = [0.6, 0.16, 0.16]
velocity_m_s = [1.0, 0, 0]
[materials.rock]
youngs_modulus_Pa = 1e8
poisson_ratio = 0.3
[[contact]]
materials = ["rock", "rock"]
restitution = 0.3
friction = 0.3
[[grains.sphere]]
position_m = [0.3, 0.08, 0.06]
diameter_m = 0.08
density_kg_m3 = 2600
material = "rock"
velocity_m_s = [1.0, 0, 0]
[[grains.sphere]]
position_m = [0.45, 0.08, 0.06]
diameter_m = 0.08
density_kg_m3 = 2600
material = "rock"
velocity_m_s = [1.0, 0, 0]
[coupling]
enabled = true
body_weighting = "inertial"
radius_shift_cells = -0.2
)";

/// A block of water that flies through a box without faces, past a stone that is held.
const std::string open_box = R"([scene]
name = "open_box"
[run]
duration_s = 1.0
precision = "double"
[domain]
lower_m = [0, 0, 0]
upper_m = [1, 0.5, 0.4]
open_faces = ["x-", "x+", "y-", "y+", "z-", "z+"]
[gravity]
magnitude_m_s2 = 0
[fluid]
enabled = true
cell_size_m = 0.02
max_speed_m_s = 2.0
[[fluid.region]]
lower_m = [0.1, 0.1, 0.1]
upper_m = [0.3, 0.3, 0.3]
velocity_m_s = [1, 1, 0]
[materials.rock]
youngs_modulus_Pa = 1e7
poisson_ratio = 0.3
[[grains.sphere]]
position_m = [0.9, 0.1, 0.3]
diameter_m = 0.08
density_kg_m3 = 2600
material = "rock"
fixed = true
[coupling]
enabled = true
)";

struct Ledger {
  double start = 0, momentum = 0, gap = 0;  ///< Ns
  double left = 0;                          ///< kg
  double walls = 0;                         ///< Ns, what the walls got
  double time = 0;                          ///< s
};

Ledger after(int rows, const std::vector<std::string>& set, const std::string& text = chute, int steps_per_row = 5) {
  Sampled run(scene::load_text(text, set));
  const FluidView& fluid = *run.simulation->fluid();
  run.simulation->fluid()->measure_walls();
  run.take_row();
  for (int row = 0; row < rows; ++row) run.take_row(steps_per_row);
  Ledger ledger;
  ledger.start = run.column("fluid_momentum_x_Ns").front();
  ledger.momentum = run.column("fluid_momentum_x_Ns").back();
  ledger.gap = run.column("fluid_momentum_gap_x_Ns").back();
  ledger.left = fluid.transfers().left;
  for (const lbm::WallLoad& load : fluid.wall_loads()) ledger.walls += load.impulse.x();
  ledger.time = run.simulation->time();
  return ledger;
}

const double kPull = 9.81 * 0.5;  // m/s^2, along the chute

/// 40 x 16 x 16 cm of water less two stones, at 1 m/s.
const double kWater = 1000 * (0.4 * 0.16 * 0.16 - 2 * M_PI / 6 * 0.08 * 0.08 * 0.08);

class SlidingWater : public testing::TestWithParam<const char*> {};

TEST_P(SlidingWater, HasWhatWeightGaveIt) {
  const Ledger ledger = after(12, {GetParam(), "domain.upper_m=[2.4, 0.16, 0.32]"});
  EXPECT_NEAR(ledger.start, kWater * 1.0, 0.01 * kWater);
  EXPECT_EQ(ledger.left, 0);
  EXPECT_NEAR(ledger.momentum, kWater * (1.0 + kPull * ledger.time), 0.03 * ledger.momentum);
  EXPECT_LT(std::abs(ledger.gap), 0.01 * ledger.momentum);
}

TEST_P(SlidingWater, TakesAlongWhatLeaves) {
  const Ledger ledger = after(60, {GetParam(), "domain.upper_m=[0.62, 0.16, 0.32]"});
  EXPECT_GT(ledger.left, 0.3 * kWater);
  EXPECT_LT(std::abs(ledger.gap), 0.04 * kWater * (1.0 + kPull * ledger.time));
}

/// Water that comes through a box, at the chute's speed, into what slides there.
TEST_P(SlidingWater, BringsWhatItCameInWith) {
  const Ledger ledger =
      after(12, {GetParam(), "domain.upper_m=[2.4, 0.16, 0.32]", "gravity.slope_deg=0",
                 "fluid.inflow=[{name = \"above\", lower_m = [0.3, 0, 0], upper_m = [0.5, 0.16, 0.2], "
                 "velocity_m_s = [1.5, 0, 0], discharge_m3_s = [[0, 0.02], [1, 0.02]]}]"});
  const double brought = 1000 * 0.02 * ledger.time * 1.5;
  EXPECT_GT(brought, 0.05 * kWater);
  EXPECT_NEAR(ledger.momentum - ledger.start, brought, 0.5 * brought);  // bodies take some
  EXPECT_LT(std::abs(ledger.gap), 0.05 * brought + 0.01 * kWater);
}

INSTANTIATE_TEST_SUITE_P(EitherWay, SlidingWater,
                         testing::Values("coupling.grains=\"resolved\"", "coupling.grains=\"averaged\""));

/// Water that leans against the closed end: what is missing is what the walls say that they got.
TEST(LiquidMomentum, LeavesWhatWallsGive) {
  const Ledger ledger =
      after(12, {"domain.open_faces=[\"z+\"]", "domain.upper_m=[0.6, 0.16, 0.32]", "gravity.slope_deg=10",
                 "fluid.region[0].velocity_m_s=[0, 0, 0]", "grains.sphere[0].velocity_m_s=[0, 0, 0]",
                 "grains.sphere[1].velocity_m_s=[0, 0, 0]"});
  EXPECT_LT(ledger.gap, -0.1) << "the end holds the water up";
  EXPECT_NEAR(ledger.gap, -ledger.walls, 0.02 * ledger.walls);
}

/// Each way out, and with one row for all that happens: 8 kg that nothing pushes.
TEST(LiquidMomentum, LeavesThroughAnyFace) {
  for (const char* velocity : {"[1, 1, 0]", "[-1, 0.3, 0]", "[1, 0.2, -0.5]"})
    for (const int rows : {80, 1}) {
      const Ledger ledger =
          after(rows, {std::string("fluid.region[0].velocity_m_s=") + velocity}, open_box, 400 / rows);
      EXPECT_NEAR(std::abs(ledger.start), 8, 0.1);
      EXPECT_GT(ledger.left, 3.5) << velocity;
      EXPECT_LT(std::abs(ledger.gap), 0.01 * 8) << velocity << ", " << rows << " rows";
    }
}

}  // namespace
}  // namespace lahar::cases
