#pragma once
// Where and how deep a segment of wire presses into its partner: the patch of a contact.
//
// Each length dl of the wire has the overlap d(l) = R - distance to the partner's centre or centre-line, R the sum of
// the radii. What all of the patch amounts to is the integral I of d^2 dl, and from it the equivalent overlap
//   e = (I / (16/15 sqrt(2 R)))^(2/5),
// which is the overlap of a sphere on a straight wire, or of two straight wires that cross at a right angle, with the
// same I. The contact law gets e. Hertz' energy ~ e^(5/2) is then proportional to I: it adds up over segments, so that
// nothing happens when a patch passes from one segment to the next, and wires that lie along each other press along
// their whole length.
#include <array>
#include <cstdint>
#include <vector>

#include "dem/wires/spline_segment.h"

namespace lahar::dem {

/// A run of segments that follow each other, or one sphere.
struct WirePartner {
  struct Ball {
    Triple centre{};
    double radius = 0;
  };
  Triple centre{};                        ///< of the sphere, m
  std::vector<SplineSegment> segments{};  ///< of the run; empty for a sphere
  /// Bent so sharply that from places within reach there may be several nearest points on it. To be set by find_kinks.
  bool kinked = false;
  std::vector<Ball> balls{};  ///< around the segments, where it is kinked
};

/// Sets `kinked` for places up to `reach` (m) from the run.
void find_kinks(WirePartner& partner, double reach);

/// The point of the partner nearest to a point of the wire.
struct NearestPoint {
  Triple point{};
  std::uint32_t segment = 0;  ///< of the run
  double t = 0;               ///< place on it
};

/// One place of the patch.
struct PatchNode {
  double s = 0;       ///< place on the segment
  double share = 0;   ///< quadrature weight, in s
  double weight = 0;  ///< dl x quadrature weight, m
  double overlap = 0;
  Triple point{};   ///< of the wire's centre-line
  Triple along{};   ///< unit, of the wire
  Triple normal{};  ///< unit, towards the partner
  NearestPoint nearest;
};

struct WirePatch {
  double integral = 0;  ///< I, m^3
  double depth = 0;     ///< m, deepest overlap of a node
  double gap = 0;       ///< m, what lies at least between the segment and its partner if they do not touch
  std::size_t count = 0;
  std::array<PatchNode, 32> nodes;
};

/// Point of the partner nearest to x, going on from `from`.
[[nodiscard]] NearestPoint nearest_point(const WirePartner& partner, const Triple& x, const NearestPoint& from);

/// The patch of `segment` against its partner, `reach` the sum of the radii (m). False if they do not touch; then
/// `patch.gap` holds as far as find_kinks looked. `extent` (m): no point of the segment is farther from its middle.
bool find_patch(const SplineSegment& segment, const WirePartner& partner, double reach, double extent,
                const NearestPoint& hint, WirePatch& patch);

/// The equivalent overlap of a patch, m.
[[nodiscard]] double equivalent_overlap(double integral, double reach);

}  // namespace lahar::dem
