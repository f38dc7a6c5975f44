#pragma once
// How close wires come to each other.
#include <cstdint>
#include <vector>

#include "barrier/polyline.h"

namespace lahar::barrier {

/// Segments of two different wires.
struct SegmentPair {
  std::uint32_t wire_a = 0, segment_a = 0, wire_b = 0, segment_b = 0;
};

/// All pairs of segments of different wires whose nearest points may lie within `reach` m of each other, in a fixed
/// order (ascending by the first, then the second). Fast for many wires.
[[nodiscard]] std::vector<SegmentPair> close_segments(const std::vector<Polyline>& wires, double reach);

/// Smallest distance between the surfaces of two different wires of this diameter, m: negative where they overlap, at
/// most one diameter. As bodies swept along the centre-line, which no bead surface exceeds.
[[nodiscard]] double smallest_wire_gap(const std::vector<Polyline>& wires, double diameter);

}  // namespace lahar::barrier
