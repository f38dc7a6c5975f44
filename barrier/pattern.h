#pragma once
// The geometry of a ring net in its own plane: where rings and cables lie so that they hold each other without
// touching. x runs across, y up, z along the normal; the ring of column 0 and row 0 has its centre at 0.
//
// Neighbouring rings of pitch p cross at the angles +-alpha with cos(alpha) = p / (2 r). With z = A sin(4 phi) a ring
// is high at +alpha and low at -alpha, while its neighbour, seen from the other side, is low and high: they interlock.
// Cables are straight. A ring on a cable starts with a lobe over, around and under it, for which it has too little
// wire, and is then settled among its neighbours.
#include <array>
#include <vector>

#include "barrier/ring.h"

namespace lahar::barrier {

/// The four sides of a net, in the order of the polar angle.
enum class Side { right, upper, left, lower };
inline constexpr std::array<Side, 4> all_sides{Side::right, Side::upper, Side::left, Side::lower};

/// What is given.
struct NetLayout {
  double ring_diameter = 0;  ///< m, centre-line
  int beads_per_ring = 0;
  double wire_diameter = 0;  ///< m
  int columns = 0, rows = 0;
  double pitch_across = 0, pitch_up = 0;               ///< m
  std::array<bool, 4> cables{true, true, true, true};  ///< by Side
  double cable_overhang = 0;  ///< m, by which lower and upper cables go on beyond the lateral ones
  bool crossing = false;      ///< lateral cables go on as far; they then pass behind the others, not end at them
};

/// What is found.
struct RingPattern {
  double amplitude = 0;       ///< m, wave of the rings
  double phase = 0;           ///< of the first bead, in bead spacings
  double cable_distance = 1;  ///< of a cable from the centres of its rings, in half pitches
};

/// True if a cable on this side threads the ring of this column and row.
[[nodiscard]] bool is_threaded(const NetLayout& layout, Side side, int column, int row);

/// Ends of the cable on a side, from left to right or from below to above. Lateral cables end a bead short of the
/// others, so that no cable crosses another; or, where they are to cross, lie just behind the others (along -z), each
/// half of that way out of the net's plane.
struct CableEnds {
  Vec3 start, end;
};
[[nodiscard]] CableEnds cable_ends(const NetLayout& layout, const RingPattern& pattern, Side side);

/// Centre-lines of all rings, row by row from below; all neighbouring beads bead_spacing apart (within 0.5 %).
[[nodiscard]] std::vector<Polyline> draw_rings(const NetLayout& layout, const RingPattern& pattern);

/// Smallest distance between the wire surfaces of a ring and those that repeat around it, m; negative infinity if the
/// ring is not linked once with each of the four beside it.
[[nodiscard]] double lattice_gap(const Polyline& ring, const NetLayout& layout);

/// The flattest rings that interlock, and the outermost cables that they go around without a change of their length and
/// can take, with a gap of 5 % of the wire, or 0.5 % where that cannot be had. Throws InputError if rings of this pitch
/// cannot interlock or take a cable, with the range of pitches that would do.
[[nodiscard]] RingPattern find_pattern(const NetLayout& layout);

/// Smallest and largest pitch, m, of a square lattice on which rings interlock, to 1 % of the ring diameter; {0, 0} if
/// the wire is too thick for any.
struct PitchRange {
  double smallest = 0, largest = 0;
};
[[nodiscard]] PitchRange possible_pitches(const NetLayout& layout);

}  // namespace lahar::barrier
