// Drag of a single straight wire against the law, over its size in cells, Reynolds number, relaxation time, angle and
// place between the cells.
#include <array>
#include <cmath>
#include <numbers>

#include "cases/validate/entry.h"
#include "cases/validate/wires_in_fluid/straight_wire.h"
#include "coupling/wires/drag_law.h"

namespace lahar::validate {
namespace {

/// A wire along a diagonal of the lattice: across the stream, or half along it.
Row diagonal_row(bool yawed, const Context& context, AuditedStreams& streams) {
  WireStream s = stream_across(1, 1000, 64, Vec3::Zero());
  s.cells = Vec3i(64, 64, 64);
  const double length = 64 * std::numbers::sqrt2, u = s.speed;
  s.wires = yawed ? std::vector<HeldWire>{{Vec3(0.2, 32.3, 0), Vec3(64.2, 32.3, 64)}}
                  : std::vector<HeldWire>{{Vec3(16.2, 0, 0.3), Vec3(16.2, 64, 64.3)}};
  if (!yawed) {
    s.expected_drag = 0.5 * length * u * u * cylinder_law(s.reynolds);
    const WireLoad load = streams.run(s, context);
    const WireCoefficient c = coefficient_of(s, load, length, 64 / std::numbers::sqrt2);
    return relative_row("Cd, d/dx 1, Re 1000, wire along a diagonal of the lattice", c.found, c.law, 0.02);
  }
  // The normal part by the law at the normal speed (independence principle), the tangential part by its own.
  const double un = u / std::numbers::sqrt2, re = s.reynolds / std::numbers::sqrt2;
  const double tangential = 2 * std::numbers::pi * (0.55 / std::sqrt(re) + 0.084 / std::cbrt(re));  // Choo & Casarella
  s.expected_drag = 0.5 * length * un * un * (cylinder_law(re) + tangential) / std::numbers::sqrt2;
  return relative_row("drag, d/dx 1, Re 1000, wire at 45 degrees to the stream", streams.run(s, context).drag,
                      s.expected_drag, 0.02);
}

/// Without what the wire takes off its own stream 6 to 10 % are missing. Slow streams feel the box, and a wire of 8
/// cells is wider than what is spread over the cells.
double bar_of(double diameter, double reynolds) {
  if (diameter > 4) return 0.1;
  return reynolds < 100 ? 0.1 : 0.02;
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  AuditedStreams streams;
  const std::vector<double> sizes =
      context.quick ? std::vector<double>{0.5, 2} : std::vector<double>{0.25, 0.5, 1, 2, 4, 8};
  for (const double d : sizes)
    for (const double re : context.quick ? std::vector<double>{100} : std::vector<double>{1, 10, 100, 1000, 1e4}) {
      if (d == 8 && re < 100) continue;  // the wake at rest is wider than an affordable box
      const WireStream s = stream_across(d, re, d == 8 ? 128 : 64, Vec3(0.1, 0.3, 0));
      rows.push_back(coefficient_row(s, bar_of(d, re), context, streams));
    }
  if (!context.quick) {
    WireStream slow = stream_across(0.25, 1e4, 64, Vec3(0.2, 0.3, 0));
    slow.speed = 0.0133;
    slow.expected_drag *= 0.0133 * 0.0133 / 0.01;
    rows.push_back(coefficient_row(slow, 0.02, context, streams));
    for (const double degrees : {26.565, 45.0})
      rows.push_back(turned_row(stream_across(1, 1000, 64, Vec3(0.3, 0.1, 0)), degrees, 0.02, context, streams));
    rows.push_back(diagonal_row(false, context, streams));
    rows.push_back(diagonal_row(true, context, streams));
    const std::array<Vec3, 5> offsets{Vec3(0, 0, 0), Vec3(0.5, 0.5, 0), Vec3(0.25, 0.25, 0), Vec3(0, 0.5, 0),
                                      Vec3(0.4, 0.1, 0)};
    for (const double d : {0.25, 0.5, 1.0, 2.0, 4.0})
      rows.push_back(spread_row(d, 1000, 64, false, offsets, 0.01, context, streams));
  }
  rows.push_back(streams.audit_row(context));
  return rows;
}

}  // namespace

Entry wire_drag() {
  return {"wires_in_fluid.wire_drag",
          {"Sucker & Brauer 1975, normal drag of a circular cylinder", {"cylinder_cd.csv"}},
          run};
}

}  // namespace lahar::validate
