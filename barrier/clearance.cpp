#include "barrier/clearance.h"

#include <algorithm>
#include <cmath>

namespace lahar::barrier {

namespace {

/// A segment's midpoint in a grid of cubes.
struct Item {
  std::int64_t x, y, z;
  std::uint32_t wire, segment;
  [[nodiscard]] auto key() const { return std::tuple(x, y, z, wire, segment); }
};

std::vector<Item> sorted_items(const std::vector<Polyline>& wires, double cube) {
  std::vector<Item> items;
  const auto cell = [&](double v) { return static_cast<std::int64_t>(std::floor(v / cube)); };
  for (std::uint32_t w = 0; w < wires.size(); ++w)
    for (std::uint32_t s = 0; s < wires[w].segments(); ++s) {
      const Vec3 middle = 0.5 * (wires[w].start(s) + wires[w].end(s));
      items.push_back({cell(middle.x()), cell(middle.y()), cell(middle.z()), w, s});
    }
  std::ranges::sort(items, {}, &Item::key);
  return items;
}

double longest_segment(const std::vector<Polyline>& wires) {
  double longest = 0;
  for (const Polyline& w : wires)
    for (std::size_t s = 0; s < w.segments(); ++s) longest = std::max(longest, (w.end(s) - w.start(s)).norm());
  return longest;
}

}  // namespace

std::vector<SegmentPair> close_segments(const std::vector<Polyline>& wires, double reach) {
  const double cube = reach + longest_segment(wires);  // midpoints of touching segments are no further apart
  const std::vector<Item> items = sorted_items(wires, cube);
  std::vector<SegmentPair> pairs;
  for (const Item& a : items)
    for (std::int64_t dx = -1; dx <= 1; ++dx)
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        // The three cubes along z lie one after the other.
        auto b = std::ranges::lower_bound(items, std::tuple(a.x + dx, a.y + dy, a.z - 1, 0u, 0u), {}, &Item::key);
        for (; b != items.end() && b->x == a.x + dx && b->y == a.y + dy && b->z <= a.z + 1; ++b)
          if (a.wire < b->wire) pairs.push_back({a.wire, a.segment, b->wire, b->segment});
      }
  const auto key = [](const SegmentPair& p) { return std::tuple(p.wire_a, p.segment_a, p.wire_b, p.segment_b); };
  std::ranges::sort(pairs, {}, key);
  return pairs;
}

double smallest_wire_gap(const std::vector<Polyline>& wires, double diameter) {
  double nearest = 2 * diameter;
  for (const SegmentPair& p : close_segments(wires, nearest)) {
    const Polyline &a = wires[p.wire_a], &b = wires[p.wire_b];
    const Nearest n =
        nearest_points(a.start(p.segment_a), a.end(p.segment_a), b.start(p.segment_b), b.end(p.segment_b));
    nearest = std::min(nearest, n.apart.norm());
  }
  return nearest - diameter;
}

}  // namespace lahar::barrier
