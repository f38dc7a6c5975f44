#include "cases/pictures/colour.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lahar::cases {
namespace {

TEST(Colour, HexIsRedGreenBlue) { EXPECT_TRUE(from_hex(0xff8000).isApprox(Colour(1, 128.0F / 255, 0))); }

// Values of IEC 61966-2-1: half of the light is displayed as 0.735, and the linear toe ends at 0.04045.
TEST(Colour, DisplayTransferFollowsTheStandard) {
  EXPECT_NEAR(to_display(Colour::Constant(0.5F)).x(), 0.735357F, 1e-5F);
  EXPECT_NEAR(to_display(Colour::Constant(0.002F)).x(), 0.02584F, 1e-6F);
  for (const float v : {0.0F, 0.01F, 0.3F, 1.0F}) EXPECT_NEAR(to_linear(to_display(Colour::Constant(v))).y(), v, 1e-5F);
  EXPECT_EQ(to_display(Colour::Constant(7.0F)).z(), to_display(Colour::Ones()).z());
}

TEST(Colour, RampsAreContinuousAndClamped) {
  for (const ColourRamp ramp : {ColourRamp::stone, ColourRamp::speed, ColourRamp::tension}) {
    for (int n = 0; n < 200; ++n) {
      const auto t = static_cast<float>(n) / 200;
      EXPECT_LT((ramp_colour(ramp, t + 0.005F) - ramp_colour(ramp, t)).norm(), 0.03F);
    }
    EXPECT_EQ(ramp_colour(ramp, -3), ramp_colour(ramp, 0));
    EXPECT_EQ(ramp_colour(ramp, 3), ramp_colour(ramp, 1));
    EXPECT_EQ(ramp_colour(ramp, std::nanf("")), ramp_colour(ramp, 0));
    EXPECT_GT((ramp_colour(ramp, 1) - ramp_colour(ramp, 0)).norm(), 0.4F);
  }
}

}  // namespace
}  // namespace lahar::cases
