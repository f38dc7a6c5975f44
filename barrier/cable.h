#pragma once
// A cable: a chain of bonded beads between two end points, straight or with a sine wave (which lets it pass over and
// under the rings that it threads).
#include <vector>

#include "barrier/wire.h"

namespace lahar::barrier {

struct CableShape {
  Vec3 start = Vec3::Zero(), end = Vec3::Zero();  ///< m
  Vec3 wave_direction = Vec3::UnitZ();            ///< unit, across the cable
  double wave_length = 1;                         ///< m
  double amplitude = 0;                           ///< m; 0 for a straight cable
  double wave_origin = 0;                         ///< m from `start`, where the wave passes 0 upwards
};

/// Where a cable is held and braked, as fractions of its length (0 its start, 1 its end).
struct CableSupport {
  std::vector<double> fixed_at{0, 1};
  bool fixed_all = false;                    ///< every bead fixed
  std::vector<double> dissipators_at{0, 1};  ///< the bond nearest to each becomes a dissipator
  bool held_across = false;                  ///< beads move along the cable's line only, as on the bed
};

/// Bead centres, evenly spaced at least a bead diameter apart, and as close to that as the ends allow.
/// Throws InputError if the cable is shorter than two beads.
[[nodiscard]] Polyline cable_line(const CableShape& shape, double bead_diameter);

struct CableSorts {
  int wire = 0, dissipator = 0;
};

/// Adds a cable along `line`. Throws InputError where two dissipators fall on one bond.
Wire add_cable(const Polyline& line, const CableSupport& support, const WireProperties& properties,
               const CableSorts& sorts, std::int32_t body, dem::Particles& particles, dem::Bonds& bonds);

}  // namespace lahar::barrier
