#include "barrier/ring.h"

#include <cmath>
#include <numbers>

#include "core/check.h"
#include "core/number_text.h"

namespace lahar::barrier {

namespace {

using std::numbers::pi;

/// Evenly spaced beads on the wave of plane radius r.
Polyline wave_on_circle(const RingShape& shape, double r) {
  const double first = 2 * pi * shape.phase / shape.beads;
  const Curve curve = [&](double t) {
    const double phi = first + 2 * pi * t;
    return Vec3(r * std::cos(phi), r * std::sin(phi), shape.amplitude * std::sin(4 * phi));
  };
  return even_polyline(curve, shape.beads, true);
}

}  // namespace

double bead_spacing(const RingShape& shape) { return shape.diameter * std::sin(pi / shape.beads); }

Polyline ring_line(const RingShape& shape) {
  if (shape.beads < 8 || !(shape.diameter > 0)) throw InputError("a ring needs a diameter and at least 8 beads");
  const double wanted = shape.beads * bead_spacing(shape);
  double radius = 0.5 * shape.diameter;
  Polyline line = wave_on_circle(shape, radius);
  for (int pass = 0; pass < 60; ++pass) {
    const double excess = length(line) - wanted;
    if (std::abs(excess) < 1e-9 * wanted) return line;
    radius -= excess / (2 * pi);  // a flat ring's slope: converges, since the true slope is no steeper
    if (radius < 0.25 * shape.diameter) break;
    line = wave_on_circle(shape, radius);
  }
  throw InputError("ring wave: an amplitude of " + number_text(shape.amplitude) + " m is too high for a ring of " +
                   number_text(shape.diameter) + " m");
}

Polyline placed(const Polyline& line, const RingPose& pose) {
  Polyline result{{}, line.closed};
  for (const Vec3& p : line.points)
    result.points.push_back(pose.centre + p.x() * pose.u + p.y() * pose.v + p.z() * pose.w);
  return result;
}

Wire add_ring(const RingShape& shape, const RingPose& pose, const WireProperties& properties, int sort,
              std::int32_t body, dem::Particles& particles, dem::Bonds& bonds) {
  WireSpec spec;
  spec.line = placed(ring_line(shape), pose);
  spec.properties = properties;
  spec.sort = sort;
  spec.body = body;
  return add_wire(spec, particles, bonds);
}

}  // namespace lahar::barrier
