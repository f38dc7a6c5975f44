#include "barrier/cable.h"

#include <cmath>
#include <numbers>
#include <string>

#include "barrier/anchors.h"
#include "core/check.h"

namespace lahar::barrier {

Polyline cable_line(const CableShape& shape, double bead_diameter) {
  const Vec3 span = shape.end - shape.start;
  if (!(span.norm() > 2 * bead_diameter)) throw InputError("a cable must be longer than two of its beads");
  const Curve curve = [&](double t) {
    const double angle = 2 * std::numbers::pi * (t * span.norm() - shape.wave_origin) / shape.wave_length;
    return Vec3(shape.start + t * span + shape.amplitude * std::sin(angle) * shape.wave_direction);
  };
  const int samples = static_cast<int>(std::ceil(8 * span.norm() / bead_diameter));
  double arc = 0;
  for (int k = 0; k < samples; ++k) arc += (curve((k + 1.0) / samples) - curve(double(k) / samples)).norm();
  int beads = 1 + static_cast<int>(arc / bead_diameter);
  Polyline line = even_polyline(curve, beads, false);
  while ((line.end(0) - line.start(0)).norm() < bead_diameter) line = even_polyline(curve, --beads, false);
  return line;
}

Wire add_cable(const Polyline& line, const CableSupport& support, const WireProperties& properties,
               const CableSorts& sorts, std::int32_t body, dem::Particles& particles, dem::Bonds& bonds) {
  WireSpec spec;
  spec.line = line;
  spec.properties = properties;
  spec.sort = sorts.wire;
  spec.dissipator_sort = sorts.dissipator;
  spec.dissipator_bonds = items_at(support.dissipators_at, line.segments());
  if (spec.dissipator_bonds.size() < support.dissipators_at.size())
    throw InputError("two dissipators of a cable of " + std::to_string(line.segments()) +
                     " bonds fall on one of them, expected places farther apart");
  spec.fixed_beads = support.fixed_all ? all_items(line.points.size()) : items_at(support.fixed_at, line.points.size());
  spec.body = body;
  if (support.held_across) spec.rail = (line.points.back() - line.points.front()).normalized();
  return add_wire(spec, particles, bonds);
}

}  // namespace lahar::barrier
