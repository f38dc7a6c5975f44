#pragma once
// Where rings hang on their cables, and ties that keep them there.
#include <optional>
#include <vector>

#include "barrier/net.h"

namespace lahar::barrier {

/// A ring that a cable runs through.
struct Threading {
  std::size_t ring = 0, cable = 0;  ///< numbers in Net::rings and Net::cables
};

/// All of them, cable by cable in the order of the rings, from the layout of the net.
[[nodiscard]] std::vector<Threading> threadings(const Net& net);

/// Where along a cable (in its segments from its start) it passes through the ring: through the fan of triangles from
/// the ring's middle. A linked cable passes at least once; of several the one in the middle is taken. Nothing if it
/// does not pass.
[[nodiscard]] std::optional<double> place_on_cable(const Polyline& ring, const Polyline& cable);

/// Where each ring hangs on its cable, by threading: m from the cable's start along the cable as made. A ring that
/// cable and dissipators carry along while they are drawn out keeps its place. Not a number where the cable does not
/// pass through the ring, or where a bond of either is broken.
[[nodiscard]] std::vector<double> places_on_cables(const Net& net, const std::vector<Threading>& threads,
                                                   const dem::Particles& particles, const dem::Bonds& bonds);

/// How far rings have slid along their cables, m.
struct Travel {
  double mean = 0, furthest = 0;
};

/// From one answer of places_on_cables to a later one. Rings that lack a place in either are left out; 0 if all are.
[[nodiscard]] Travel travel_between(const std::vector<double>& before, const std::vector<double>& now);

/// Bonds every threaded ring to its cable at the two beads nearest to each other, at rest as they lie: rings then
/// cannot slide. `sort` is a bond sort of `bonds`.
void tie_to_cables(const Net& net, const dem::Particles& particles, int sort, dem::Bonds& bonds);

}  // namespace lahar::barrier
