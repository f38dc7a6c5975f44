#pragma once
// A straight wire across the stream: what the entries on its drag by the law and as a body share.
#include <span>
#include <string>

#include "cases/validate/wires_in_fluid/wire_flows.h"

namespace lahar::validate {

/// A wire along z, a quarter of the box behind its start; the box is `width` cells long and wide, 8 deep.
WireStream stream_across(double diameter, double reynolds, int width, const Vec3& offset);

/// The same stream at an angle to the lattice, across z.
WireStream turned(WireStream stream, double degrees);

/// Runs streams and keeps the worst of their audits.
struct AuditedStreams {
  double audit = 0;
  WireLoad run(const WireStream& stream, const Context& context);
  /// Row of the worst audit so far.
  [[nodiscard]] Row audit_row(const Context& context) const;
};

/// Drag coefficient of the wire against the law; `note` ends the row's name.
Row coefficient_row(const WireStream& stream, double bar, const Context& context, AuditedStreams& streams,
                    const std::string& note = "");
/// The same of the turned stream.
Row turned_row(const WireStream& stream, double degrees, double bar, const Context& context, AuditedStreams& streams);
/// (largest - smallest)/mean of the drag coefficient, as the wire is moved by each of the offsets (cells).
Row spread_row(double diameter, double reynolds, int width, bool resolved, std::span<const Vec3> offsets, double bar,
               const Context& context, AuditedStreams& streams);

}  // namespace lahar::validate
