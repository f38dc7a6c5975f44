#include "barrier/pattern.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "barrier/clearance.h"
#include "barrier/linking.h"
#include "barrier/settle.h"
#include "core/check.h"
#include "core/number_text.h"

namespace lahar::barrier {

namespace {

using std::numbers::pi;

constexpr double wanted_gap = 0.05;     // of the wire diameter
constexpr double accepted_gap = 0.005;  // where the wanted one cannot be had
constexpr double not_linked = -std::numeric_limits<double>::infinity();

std::size_t index(Side side) { return static_cast<std::size_t>(side); }

Polyline moved(Polyline line, const Vec3& shift) {
  for (Vec3& p : line.points) p += shift;
  return line;
}

RingShape shape_of(const NetLayout& layout, const RingPattern& pattern) {
  return {layout.ring_diameter, layout.beads_per_ring, pattern.amplitude, pattern.phase};
}

/// Walks the wave's height up in steps of `step` wire diameters, with a bead or a bond at phi = 0, until the gap is as
/// wide as wanted; or else the one with the best gap that is accepted.
std::optional<RingPattern> flattest_rings(const NetLayout& layout, double step) {
  std::optional<RingPattern> best;
  double best_gap = accepted_gap * layout.wire_diameter;
  for (double height = 0.4; height < 1.4; height += step)
    for (const double phase : {0.0, 0.5}) {
      const RingPattern pattern{height * layout.wire_diameter, phase, 1};
      if (2 * pi * pattern.amplitude > layout.ring_diameter) return best;  // hardly a ring any more
      const double gap = lattice_gap(ring_line(shape_of(layout, pattern)), layout);
      if (gap >= best_gap) best = pattern, best_gap = gap;
      if (best_gap >= wanted_gap * layout.wire_diameter) return best;
    }
  return best;
}

/// Carries the beads on one side of a ring over, around and under a cable there. The lobe ends 60 degrees from the
/// middle of the side, short of where the neighbours on the next sides cross.
void add_lobe(Polyline& ring, Side side, double wire_diameter) {
  constexpr double half_width = pi / 3;
  const double middle = 0.5 * pi * static_cast<double>(side);
  for (Vec3& p : ring.points) {
    const double phi = std::atan2(p.y(), p.x()), theta = std::remainder(phi - middle, 2 * pi);
    if (std::abs(theta) > half_width) continue;
    const double bulge = wire_diameter * std::pow(std::cos(0.5 * pi * theta / half_width), 2);
    p += Vec3(bulge * std::cos(phi), bulge * std::sin(phi), wire_diameter * std::sin(pi * theta / half_width));
  }
}

std::vector<Polyline> cable_lines(const NetLayout& layout, const RingPattern& pattern) {
  std::vector<Polyline> lines;
  for (const Side side : all_sides) {
    if (!layout.cables[index(side)]) continue;
    const auto [start, end] = cable_ends(layout, pattern, side);
    const int pieces = static_cast<int>(std::ceil((end - start).norm() / layout.wire_diameter));
    Polyline line;
    for (int k = 0; k <= pieces; ++k) line.points.push_back(start + (end - start) * (double(k) / pieces));
    lines.push_back(line);
  }
  return lines;
}

/// Rings on the lattice, with lobes where there are cables. Marks those in `threaded`.
std::vector<Polyline> rings_with_lobes(const NetLayout& layout, const RingPattern& pattern,
                                       std::vector<bool>& threaded) {
  const Polyline plain = ring_line(shape_of(layout, pattern));
  std::vector<Polyline> rings;
  for (int row = 0; row < layout.rows; ++row)
    for (int column = 0; column < layout.columns; ++column) {
      Polyline ring = plain;
      threaded.push_back(false);
      for (const Side side : all_sides)
        if (is_threaded(layout, side, column, row)) add_lobe(ring, side, layout.wire_diameter), threaded.back() = true;
      rings.push_back(moved(ring, {column * layout.pitch_across, row * layout.pitch_up, 0}));
    }
  return rings;
}

/// Settles the threaded rings among the cables and the rings next to them; those further inside cannot touch them.
void settle_at_edge(const NetLayout& layout, const std::vector<Polyline>& cables, const std::vector<bool>& threaded,
                    const SettleOptions& options, std::vector<Polyline>& rings) {
  std::vector<std::size_t> at_edge;
  std::vector<Polyline> wires;
  std::vector<bool> movable;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const int column = static_cast<int>(r) % layout.columns, row = static_cast<int>(r) / layout.columns;
    const int inside = std::min({column, row, layout.columns - 1 - column, layout.rows - 1 - row});
    if (inside > 1) continue;
    at_edge.push_back(r), wires.push_back(rings[r]), movable.push_back(threaded[r]);
  }
  for (const Polyline& cable : cables) wires.push_back(cable), movable.push_back(false);
  settle(wires, movable, options);
  for (std::size_t k = 0; k < at_edge.size(); ++k) rings[at_edge[k]] = wires[k];
}

double largest_spacing_error(const std::vector<Polyline>& rings, double spacing) {
  double worst = 0;
  for (const Polyline& r : rings)
    for (std::size_t s = 0; s < r.segments(); ++s)
      worst = std::max(worst, std::abs((r.end(s) - r.start(s)).norm() / spacing - 1));
  return worst;
}

bool all_threaded(const NetLayout& layout, const std::vector<Polyline>& rings, const std::vector<Polyline>& cables) {
  std::size_t cable = 0;
  for (const Side side : all_sides) {
    if (!layout.cables[index(side)]) continue;
    for (std::size_t r = 0; r < rings.size(); ++r) {
      const int column = static_cast<int>(r) % layout.columns, row = static_cast<int>(r) / layout.columns;
      const int wanted = is_threaded(layout, side, column, row) ? 1 : 0;
      if (std::abs(links_with_thread(rings[r], cables[cable])) != wanted) return false;
    }
    ++cable;
  }
  return true;
}

/// True if the rings that a lateral cable threads cross its line between its ends: beyond them they would not lie
/// around it.
bool cables_reach(const NetLayout& layout, const RingPattern& pattern, const std::vector<Polyline>& rings) {
  for (const Side side : {Side::left, Side::right}) {
    const auto [start, end] = cable_ends(layout, pattern, side);
    for (std::size_t r = 0; r < rings.size(); ++r) {
      const int column = static_cast<int>(r) % layout.columns, row = static_cast<int>(r) / layout.columns;
      if (!is_threaded(layout, side, column, row)) continue;
      for (std::size_t s = 0; s < rings[r].segments(); ++s) {
        const Vec3 a = rings[r].start(s) - start, b = rings[r].end(s) - start;
        if (a.x() * b.x() > 0) continue;
        const double y = (a.y() * b.x() - b.y() * a.x()) / (b.x() - a.x());
        if (!(y > 0 && y < end.y() - start.y())) return false;
      }
    }
  }
  return true;
}

/// True if a net of up to 4 x 4 rings of this pattern has room everywhere and hangs on its cables.
bool works(NetLayout layout, const RingPattern& pattern) {
  layout.columns = std::min(4, layout.columns);
  layout.rows = std::min(4, layout.rows);
  const std::vector<Polyline> rings = draw_rings(layout, pattern), cables = cable_lines(layout, pattern);
  const double spacing = bead_spacing(shape_of(layout, pattern));
  if (largest_spacing_error(rings, spacing) > 0.005) return false;
  std::vector<Polyline> all = rings;
  all.insert(all.end(), cables.begin(), cables.end());
  return smallest_wire_gap(all, layout.wire_diameter) >= accepted_gap * layout.wire_diameter &&
         all_threaded(layout, rings, cables) && cables_reach(layout, pattern, rings);
}

std::string metres(double value) { return number_text(value) + " m"; }

[[noreturn]] void refuse(const NetLayout& layout, const std::string& what) {
  const PitchRange range = possible_pitches(layout);
  std::string text = "rings of " + metres(layout.ring_diameter) + " made of " + metres(layout.wire_diameter) +
                     " wire cannot " + what + " at a pitch of " + metres(layout.pitch_across) + " across and " +
                     metres(layout.pitch_up) + " up; ";
  text += range.largest > 0
              ? "rings alone interlock at a pitch between " + metres(range.smallest) + " and " + metres(range.largest) +
                    ", by the pattern that is built here, whose wires weave out of the plane"
              : "no pitch would work: take thinner wire or larger rings";
  throw InputError(text);
}

}  // namespace

bool is_threaded(const NetLayout& layout, Side side, int column, int row) {
  const std::array<bool, 4> outermost{column + 1 == layout.columns, row + 1 == layout.rows, column == 0, row == 0};
  return layout.cables[index(side)] && outermost[index(side)];
}

CableEnds cable_ends(const NetLayout& layout, const RingPattern& pattern, Side side) {
  const double dx = 0.5 * layout.pitch_across * pattern.cable_distance;
  const double dy = 0.5 * layout.pitch_up * pattern.cable_distance;
  const double right = (layout.columns - 1) * layout.pitch_across + dx;
  const double top = (layout.rows - 1) * layout.pitch_up + dy;
  const double over = layout.cable_overhang,
               aside = layout.crossing ? 0.5 * (1 + wanted_gap) * layout.wire_diameter : 0;
  const double beyond = layout.crossing ? over : -1.05 * layout.wire_diameter;  // of lateral cables
  switch (side) {
    case Side::lower:
      return {{-dx - over, -dy, aside}, {right + over, -dy, aside}};
    case Side::upper:
      return {{-dx - over, top, aside}, {right + over, top, aside}};
    case Side::left:
      return {{-dx, -dy - beyond, -aside}, {-dx, top + beyond, -aside}};
    case Side::right:
      break;
  }
  return {{right, -dy - beyond, -aside}, {right, top + beyond, -aside}};
}

std::vector<Polyline> draw_rings(const NetLayout& layout, const RingPattern& pattern) {
  std::vector<bool> threaded;
  std::vector<Polyline> rings = rings_with_lobes(layout, pattern, threaded);
  if (std::ranges::count(threaded, true) == 0) return rings;
  SettleOptions options;
  options.spacing = bead_spacing(shape_of(layout, pattern));
  options.second_spacing = layout.ring_diameter * std::sin(2 * pi / layout.beads_per_ring);
  options.apart = (1 + wanted_gap) * layout.wire_diameter;
  settle_at_edge(layout, cable_lines(layout, pattern), threaded, options, rings);
  return rings;
}

double lattice_gap(const Polyline& ring, const NetLayout& layout) {
  const double px = layout.pitch_across, py = layout.pitch_up;
  double apart = layout.ring_diameter;
  for (const Vec3& shift :
       {Vec3(px, 0, 0), Vec3(0, py, 0), Vec3(px, py, 0), Vec3(px, -py, 0), Vec3(2 * px, 0, 0), Vec3(0, 2 * py, 0)})
    apart = std::min(apart, distance(ring, ring, shift, apart));
  const double gap = apart - layout.wire_diameter;
  if (gap < 0) return gap;
  for (const Vec3& shift : {Vec3(px, 0, 0), Vec3(0, py, 0)})
    if (std::abs(links(ring, moved(ring, shift))) != 1) return not_linked;
  return gap;
}

RingPattern find_pattern(const NetLayout& layout) {
  const auto rings = flattest_rings(layout, 0.02);
  if (!rings) refuse(layout, "interlock");
  RingPattern pattern = *rings;
  if (std::ranges::count(layout.cables, true) == 0) return pattern;
  // Where a ring goes around the cable without a change of its length, or a little inside the half pitch if that is
  // farther out: the wire that goes around the cable is then missing least elsewhere.
  const double step = 0.02, around = layout.ring_diameter - 2 * layout.wire_diameter,
               farthest = std::max(0.96, around / std::max(layout.pitch_across, layout.pitch_up));
  for (double steps = std::floor(farthest / step + 1e-9); steps > 0.7 / step; --steps) {
    pattern.cable_distance = step * steps;
    if (works(layout, pattern)) return pattern;
  }
  refuse(layout, "take a cable");
}

PitchRange possible_pitches(const NetLayout& layout) {
  PitchRange range;
  for (int percent = 60; percent < 100; ++percent) {
    NetLayout square = layout;
    square.pitch_across = square.pitch_up = 0.01 * percent * layout.ring_diameter;
    if (!flattest_rings(square, 0.1)) continue;
    if (range.largest == 0) range.smallest = square.pitch_across;
    range.largest = square.pitch_across;
  }
  return range;
}

}  // namespace lahar::barrier
