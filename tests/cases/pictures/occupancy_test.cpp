#include "cases/pictures/occupancy.h"

#include <gtest/gtest.h>

#include <array>

namespace lahar::cases {
namespace {

TEST(Occupancy, ASegmentTouchesWhatItCrosses) {
  const PlaneBox box(Point(0, 0), Point(10, 4));
  EXPECT_TRUE(touches(box, Point(-5, 2), Point(15, 2))) << "across";
  EXPECT_TRUE(touches(box, Point(4, 1), Point(5, 2))) << "inside";
  EXPECT_TRUE(touches(box, Point(-1, 3), Point(2, 6))) << "through a corner";
  EXPECT_FALSE(touches(box, Point(-2, 3), Point(1, 6))) << "past the corner, although the boxes overlap";
  EXPECT_FALSE(touches(box, Point(12, -5), Point(12, 9)));
  EXPECT_FALSE(touches(box, Point(-5, 2), Point(-1, 2))) << "ends before";
}

TEST(Occupancy, LinesAndBoxesTakeTheirPlace) {
  Occupancy taken;
  const PlaneBox box(Point(20, 20), Point(30, 30));
  EXPECT_TRUE(taken.is_free(box));
  taken.add_box({Point(31, 20), Point(40, 30)});
  EXPECT_TRUE(taken.is_free(box));
  const std::array<Point, 3> bend{Point(0, 0), Point(10, 25), Point(25, 25)};
  taken.add_line(bend);
  EXPECT_FALSE(taken.is_free(box));
  EXPECT_FALSE(taken.is_free({Point(35, 25), Point(50, 50)}));
  EXPECT_TRUE(taken.is_free({Point(0, 26), Point(19, 40)}));
}

}  // namespace
}  // namespace lahar::cases
