#pragma once
// A closed ring of bonded beads. Its centre-line is a circle with a wave of four periods out of its plane,
// (r cos phi, r sin phi, A sin 4 phi), so that it passes over and under four neighbours. The wave takes wire: r shrinks
// until the wire is as long as that of the flat ring.
#include "barrier/wire.h"

namespace lahar::barrier {

struct RingShape {
  double diameter = 0;  ///< m, of the centre-line when laid flat
  int beads = 0;
  double amplitude = 0;  ///< m, A
  double phase = 0;      ///< angle of the first bead, in bead spacings
};

/// A ring's place: its plane is spanned by the unit vectors u and v, its wave stands along w.
struct RingPose {
  Vec3 centre = Vec3::Zero();
  Vec3 u = Vec3::UnitX(), v = Vec3::UnitY(), w = Vec3::UnitZ();
};

/// Distance of neighbouring bead centres: the chord 2 R sin(pi / N) of the flat ring, m.
[[nodiscard]] double bead_spacing(const RingShape& shape);

/// Bead centres in the ring's own frame (centre 0, plane xy, wave along z), all bead_spacing apart.
/// Throws InputError if the wave needs more wire than the ring has.
[[nodiscard]] Polyline ring_line(const RingShape& shape);

/// The same in a pose.
[[nodiscard]] Polyline placed(const Polyline& line, const RingPose& pose);

/// Adds a ring with bonds of one sort.
Wire add_ring(const RingShape& shape, const RingPose& pose, const WireProperties& properties, int sort,
              std::int32_t body, dem::Particles& particles, dem::Bonds& bonds);

}  // namespace lahar::barrier
