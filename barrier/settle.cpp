#include "barrier/settle.h"

#include <algorithm>
#include <cmath>

#include "barrier/clearance.h"

namespace lahar::barrier {

namespace {

/// Moves two points along the line between them, each by half of `share` of what is missing to `wanted`.
void bring_to_distance(Vec3& a, Vec3& b, double wanted, double share) {
  const Vec3 ab = b - a;
  const double now = ab.norm();
  const Vec3 move = 0.5 * share * (now - wanted) / now * ab;
  a += move;
  b -= move;
}

void smooth(Polyline& wire, double second_spacing) {
  auto& p = wire.points;
  const std::size_t n = p.size(), seconds = wire.closed ? n : n - 2;
  for (std::size_t k = 0; k < seconds; ++k) bring_to_distance(p[k], p[(k + 2) % n], second_spacing, 0.05);
}

void space_beads(Polyline& wire, double spacing) {
  auto& p = wire.points;
  for (std::size_t k = 0; k < wire.segments(); ++k) bring_to_distance(p[k], p[(k + 1) % p.size()], spacing, 1.0);
}

/// Moves the ends of a segment so that its point at s moves by `move`.
void move_segment(Polyline& wire, std::size_t segment, double s, const Vec3& move) {
  Vec3& start = wire.points[segment];
  Vec3& end = wire.points[segment + 1 == wire.points.size() ? 0 : segment + 1];
  const double weight = (1 - s) * (1 - s) + s * s;
  start += (1 - s) / weight * move;
  end += s / weight * move;
}

/// Brings the segments of a pair `apart` m from each other. Segments whose middles are further than `reach` apart do
/// not meet.
void push_apart(std::vector<Polyline>& wires, const std::vector<bool>& movable, const SegmentPair& pair, double apart,
                double reach) {
  Polyline &a = wires[pair.wire_a], &b = wires[pair.wire_b];
  const std::size_t i = pair.segment_a, j = pair.segment_b;
  if (0.25 * (a.start(i) + a.end(i) - b.start(j) - b.end(j)).squaredNorm() > reach * reach) return;
  const Nearest n = nearest_points(a.start(i), a.end(i), b.start(j), b.end(j));
  const double now = n.apart.norm();
  if (now >= apart || now == 0) return;
  const bool both = movable[pair.wire_a] && movable[pair.wire_b];
  const Vec3 move = (both ? 0.5 : 1.0) * (apart - now) / now * n.apart;
  if (movable[pair.wire_a]) move_segment(a, i, n.s, move);
  if (movable[pair.wire_b]) move_segment(b, j, n.t, -move);
}

double mean_spacing(const std::vector<Polyline>& wires, const std::vector<bool>& movable) {
  double sum = 0, segments = 0;
  for (std::size_t w = 0; w < wires.size(); ++w)
    if (movable[w]) sum += length(wires[w]), segments += static_cast<double>(wires[w].segments());
  return sum / std::max(1.0, segments);
}

/// Pairs of which at least one side can move and that may meet before the list is made anew.
std::vector<SegmentPair> pairs_to_watch(const std::vector<Polyline>& wires, const std::vector<bool>& movable,
                                        double reach) {
  std::vector<SegmentPair> pairs = close_segments(wires, reach);
  std::erase_if(pairs, [&](const SegmentPair& p) { return !movable[p.wire_a] && !movable[p.wire_b]; });
  return pairs;
}

}  // namespace

void settle(std::vector<Polyline>& wires, const std::vector<bool>& movable, const SettleOptions& options) {
  constexpr int passes_per_list = 40;
  const double start = mean_spacing(wires, movable), stretch = options.second_spacing / options.spacing;
  std::vector<SegmentPair> pairs;
  for (int pass = 0; pass < options.passes; ++pass) {
    if (pass % passes_per_list == 0) pairs = pairs_to_watch(wires, movable, 1.5 * options.apart);
    const double done = static_cast<double>(pass) / options.passes;
    // Half of either segment, and half of one more for those still stretched.
    const double reach = options.apart + 1.5 * std::max(start, options.spacing);
    const double spacing = start + std::min(1.0, 1.5 * done) * (options.spacing - start);
    for (std::size_t w = 0; w < wires.size(); ++w) {
      if (!movable[w]) continue;
      if (done < 0.8) smooth(wires[w], stretch * spacing);
      space_beads(wires[w], spacing);
    }
    for (const SegmentPair& p : pairs) push_apart(wires, movable, p, options.apart, reach);
  }
}

}  // namespace lahar::barrier
