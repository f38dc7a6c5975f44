#include "cases/validate/wires_in_fluid/straight_wire.h"
#include "core/worst.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lahar::validate {

namespace {

constexpr int kDepth = 8;  // cells along the wire

}  // namespace

WireStream stream_across(double diameter, double reynolds, int width, const Vec3& offset) {
  WireStream s;
  s.diameter = diameter;
  s.reynolds = reynolds;
  s.cells = Vec3i(width, width, kDepth);
  s.travel = 0.69 * width;
  const Vec3 start = Vec3(0.25 * width, 0.5 * width, 0) + offset;
  s.wires = {{.start = start, .end = start + Vec3(0, 0, kDepth)}};
  s.expected_drag = 0.5 * kDepth * diameter * s.speed * s.speed * cylinder_law(reynolds);
  return s;
}

WireStream turned(WireStream stream, double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  stream.direction = Vec3(std::cos(angle), std::sin(angle), 0);
  return stream;
}

WireLoad AuditedStreams::run(const WireStream& stream, const Context& context) {
  const WireLoad load = run_stream(stream, context);
  keep_worst(audit, load.audit);
  return load;
}

Row AuditedStreams::audit_row(const Context& context) const {
  return at_most_row("momentum audit", audit, context.precision == Precision::float64 ? 1e-10 : 1e-4);
}

Row coefficient_row(const WireStream& stream, double bar, const Context& context, AuditedStreams& streams,
                    const std::string& note) {
  const WireLoad load = streams.run(stream, context);
  const WireCoefficient c = coefficient_of(stream, load, kDepth, stream.cells.y());
  return relative_row(
      fmt::format("Cd, d/dx {:g}, Re {:g}, tau - 1/2 {:.1e}{}", stream.diameter, stream.reynolds, load.tau - 0.5, note),
      c.found, c.law, bar);
}

Row turned_row(const WireStream& stream, double degrees, double bar, const Context& context, AuditedStreams& streams) {
  return coefficient_row(turned(stream, degrees), bar, context, streams,
                         fmt::format(", stream at {:g} degrees", degrees));
}

Row spread_row(double diameter, double reynolds, int width, bool resolved, std::span<const Vec3> offsets, double bar,
               const Context& context, AuditedStreams& streams) {
  double low = 1e300, high = 0;
  for (const Vec3& offset : offsets) {
    WireStream s = stream_across(diameter, reynolds, width, offset);
    s.resolved = resolved;
    const double found = coefficient_of(s, streams.run(s, context), kDepth, width).found;
    low = std::min(low, found), high = std::max(high, found);
  }
  return at_most_row(fmt::format("spread of Cd over places, d/dx {:g}, Re {:g}", diameter, reynolds),
                     2 * (high - low) / (high + low), bar);
}

}  // namespace lahar::validate
