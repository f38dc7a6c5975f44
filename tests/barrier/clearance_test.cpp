#include "barrier/clearance.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "barrier/settle.h"

namespace lahar::barrier {
namespace {

Polyline bar(const Vec3& start, const Vec3& step, int points) {
  Polyline line;
  for (int k = 0; k < points; ++k) line.points.push_back(start + k * step);
  return line;
}

TEST(Clearance, TheGapIsThatOfWiresNotOfBeads) {
  // Two crossing bars whose beads stand in each other's gaps.
  const std::vector<Polyline> wires{bar({-0.5, 0, 0}, Vec3::UnitX(), 2), bar({0, -0.5, 0.4}, Vec3::UnitY(), 2)};
  EXPECT_NEAR(smallest_wire_gap(wires, 1), -0.6, 1e-12);
}

TEST(Clearance, FindsThePairsThatBruteForceFinds) {
  std::vector<Polyline> wires;
  for (int w = 0; w < 6; ++w)
    wires.push_back(bar({0.37 * w, -0.9 * w, 0.21 * w * w - 2}, {0.3, 0.11 * w - 0.2, 0.05 * w}, 12));
  const std::vector<SegmentPair> found = close_segments(wires, 0.6);
  for (std::uint32_t a = 0; a < 6; ++a)
    for (std::uint32_t b = a + 1; b < 6; ++b)
      for (std::uint32_t i = 0; i < 11; ++i)
        for (std::uint32_t j = 0; j < 11; ++j) {
          const Nearest n = nearest_points(wires[a].start(i), wires[a].end(i), wires[b].start(j), wires[b].end(j));
          if (n.apart.norm() > 0.6) continue;
          EXPECT_EQ(std::ranges::count_if(found,
                                          [&](const SegmentPair& p) {
                                            return p.wire_a == a && p.segment_a == i && p.wire_b == b &&
                                                   p.segment_b == j;
                                          }),
                    1);
        }
}

TEST(Settle, PushesAWireOffAFixedOneAndKeepsItsSpacing) {
  std::vector<Polyline> wires{bar({-1, 0, 0}, {0.1, 0, 0}, 21), bar({0, -1, 0.02}, {0, 0.1, 0}, 21)};
  settle(wires, {true, false}, {.spacing = 0.1, .second_spacing = 0.2, .apart = 0.11});
  EXPECT_GT(smallest_wire_gap(wires, 0.1), 0.009);
  EXPECT_LT(wires[0].points[10].z(), 0);  // away from the other, not through it
  for (std::size_t s = 0; s < 20; ++s) EXPECT_NEAR((wires[0].end(s) - wires[0].start(s)).norm(), 0.1, 2e-4);
  EXPECT_EQ(wires[1].points[5], Vec3(0, -0.5, 0.02));
}

}  // namespace
}  // namespace lahar::barrier
