#include "barrier/pattern.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/check.h"

namespace lahar::barrier {
namespace {

NetLayout paper_layout(double pitch) {
  NetLayout layout;
  layout.ring_diameter = 0.07, layout.beads_per_ring = 36, layout.wire_diameter = 0.0061;
  layout.columns = 4, layout.rows = 4;
  layout.pitch_across = layout.pitch_up = pitch;
  return layout;
}

TEST(Pattern, FindsInterlockedRingsForThePitchOfThePaper) {
  const NetLayout layout = paper_layout(0.06);
  const RingPattern pattern = find_pattern(layout);
  const Polyline ring = ring_line({0.07, 36, pattern.amplitude, pattern.phase});
  EXPECT_GE(lattice_gap(ring, layout), 0.05 * 0.0061);
  EXPECT_LT(pattern.amplitude, 0.8 * 0.0061);
  EXPECT_GT(pattern.cable_distance, 0.9);
}

TEST(Pattern, FlatRingsOverlapAndRingsApartAreNotLinked) {
  const Polyline flat = ring_line({0.07, 36, 0, 0});
  EXPECT_LT(lattice_gap(flat, paper_layout(0.06)), -0.99 * 0.0061);
  EXPECT_LT(lattice_gap(flat, paper_layout(0.08)), -1e300);
}

TEST(Pattern, RefusesAnImpossiblePitchAndNamesTheRangeThatWorks) {
  for (const double pitch : {0.035, 0.068}) {
    try {
      (void)find_pattern(paper_layout(pitch));
      FAIL() << "a pitch of " << pitch << " m was accepted";
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("interlock at a pitch between 0.0"), std::string::npos) << e.what();
    }
  }
  const PitchRange range = possible_pitches(paper_layout(0.06));
  // Above 2 R - d the rings' planes do not overlap by a wire, whatever their shape.
  EXPECT_LT(range.largest, 0.07 - 0.0061);
  EXPECT_GT(range.largest, 0.058);
  EXPECT_LT(range.smallest, 0.05);
  NetLayout thick = paper_layout(0.05);
  thick.wire_diameter = 0.02, thick.beads_per_ring = 11;
  EXPECT_EQ(possible_pitches(thick).largest, 0);
}

/// Lateral cables end outside of the rings of the corners, which then lie around them. With cables at most at the half
/// pitch they ended up to a wire within, at pitches below 0.82 diameters.
TEST(Pattern, CornerRingsLieAroundTheCablesBeside) {
  for (int percent = 68; percent <= 86; percent += 2) {
    const NetLayout layout = paper_layout(0.07 * 0.01 * percent);
    const RingPattern pattern = find_pattern(layout);
    const std::vector<Polyline> rings = draw_rings(layout, pattern);
    for (const Side side : {Side::left, Side::right})
      for (const std::size_t row : {0U, 3U}) {
        const auto [start, end] = cable_ends(layout, pattern, side);
        const Polyline& ring = rings[4 * row + (side == Side::left ? 0 : 3)];
        for (std::size_t s = 0; s < ring.segments(); ++s) {
          const Vec3 a = ring.start(s), b = ring.end(s);
          if ((a.x() - start.x()) * (b.x() - start.x()) > 0) continue;
          const double y = a.y() + (start.x() - a.x()) / (b.x() - a.x()) * (b.y() - a.y());
          EXPECT_GT(y, start.y()) << percent;
          EXPECT_LT(y, end.y()) << percent;
        }
      }
  }
}

TEST(Pattern, OtherPitchesInTheRangeTakeCables) {
  for (const double pitch : {0.05, 0.056}) {
    RingPattern pattern;
    ASSERT_NO_THROW(pattern = find_pattern(paper_layout(pitch))) << pitch;
    EXPECT_LT(pattern.cable_distance, 1.2);
  }
}

}  // namespace
}  // namespace lahar::barrier
