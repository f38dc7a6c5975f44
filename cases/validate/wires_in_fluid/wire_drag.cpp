// Drag of a single straight wire against the law, over its size in cells, Reynolds number, relaxation time, angle and
// place between the cells.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/validate/entry.h"
#include "cases/validate/wires_in_fluid/wire_flows.h"
#include "coupling/wires/drag_law.h"

namespace lahar::validate {
namespace {

/// A wire along z, a quarter of the box behind its start.
WireStream across(double diameter, double reynolds, int width, const Vec3& offset) {
  WireStream s;
  s.diameter = diameter;
  s.reynolds = reynolds;
  s.cells = Vec3i(width, width, 8);
  s.travel = 0.69 * width;
  const Vec3 foot = Vec3(0.25 * width, 0.5 * width, 0) + offset;
  s.wires = {{.start = foot, .end = foot + Vec3(0, 0, 8)}};
  s.expected_drag = 4 * diameter * s.speed * s.speed * cylinder_law(reynolds);
  return s;
}

struct Worst {
  double audit = 0;
  WireLoad run(const WireStream& s, const Context& context) {
    const WireLoad load = run_stream(s, context);
    audit = std::max(audit, load.audit);
    return load;
  }
};

Row coefficient_row(const WireStream& s, const WireLoad& load, double bar, const std::string& note) {
  const WireCoefficient c = coefficient_of(s, load, 8, s.cells.y());
  return relative_row(
      fmt::format("Cd, d/dx {:g}, Re {:g}, tau - 1/2 {:.1e}{}", s.diameter, s.reynolds, load.tau - 0.5, note), c.found,
      c.law, bar);
}

/// The stream at an angle to the lattice.
Row turned_row(double diameter, double degrees, const Context& context, Worst& worst) {
  WireStream s = across(diameter, 1000, 64, Vec3(0.3, 0.1, 0));
  const double angle = degrees * std::numbers::pi / 180;
  s.direction = Vec3(std::cos(angle), std::sin(angle), 0);
  return coefficient_row(s, worst.run(s, context), 0.10, fmt::format(", stream at {:g} degrees", degrees));
}

/// A wire along a diagonal of the lattice: across the stream, or half along it.
Row diagonal_row(bool yawed, const Context& context, Worst& worst) {
  WireStream s = across(1, 1000, 64, Vec3::Zero());
  s.cells = Vec3i(64, 64, 64);
  const double length = 64 * std::numbers::sqrt2, u = s.speed;
  s.wires = yawed ? std::vector<HeldWire>{{Vec3(0.2, 32.3, 0), Vec3(64.2, 32.3, 64)}}
                  : std::vector<HeldWire>{{Vec3(16.2, 0, 0.3), Vec3(16.2, 64, 64.3)}};
  if (!yawed) {
    s.expected_drag = 0.5 * length * u * u * cylinder_law(s.reynolds);
    const WireLoad load = worst.run(s, context);
    const WireCoefficient c = coefficient_of(s, load, length, 64 / std::numbers::sqrt2);
    return relative_row("Cd, d/dx 1, Re 1000, wire along a diagonal of the lattice", c.found, c.law, 0.10);
  }
  // The normal part by the law at the normal speed (independence principle), the tangential part by its own.
  const double un = u / std::numbers::sqrt2, re = s.reynolds / std::numbers::sqrt2;
  s.expected_drag =
      0.5 * length * un * un * (cylinder_law(re) + coupling::tangential_drag_coefficient(re)) / std::numbers::sqrt2;
  return relative_row("drag, d/dx 1, Re 1000, wire at 45 degrees to the stream", worst.run(s, context).drag,
                      s.expected_drag, 0.10);
}

/// (largest - smallest)/mean of Cd over places between the cells.
Row jitter_row(double diameter, const Context& context, Worst& worst) {
  double low = 1e300, high = 0;
  for (const Vec3& offset :
       {Vec3(0, 0, 0), Vec3(0.5, 0.5, 0), Vec3(0.25, 0.25, 0), Vec3(0, 0.5, 0), Vec3(0.4, 0.1, 0)}) {
    const WireStream s = across(diameter, 1000, 64, offset);
    const double found = coefficient_of(s, worst.run(s, context), 8, 64).found;
    low = std::min(low, found), high = std::max(high, found);
  }
  return at_most_row(fmt::format("spread of Cd over places, d/dx {:g}, Re 1000", diameter),
                     2 * (high - low) / (high + low), 0.05);
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  Worst worst;
  const std::vector<double> sizes =
      context.quick ? std::vector<double>{0.5, 2} : std::vector<double>{0.25, 0.5, 1, 2, 4, 8};
  for (const double d : sizes)
    for (const double re : context.quick ? std::vector<double>{100} : std::vector<double>{1, 10, 100, 1000, 1e4}) {
      if (d == 8 && re < 100) continue;  // the wake at rest is wider than an affordable box
      const WireStream s = across(d, re, d == 8 ? 128 : 64, Vec3(0.1, 0.3, 0));
      rows.push_back(coefficient_row(s, worst.run(s, context), d > 2 ? 0.15 : 0.10, ""));
    }
  if (!context.quick) {
    WireStream slow = across(0.25, 1e4, 64, Vec3(0.2, 0.3, 0));
    slow.speed = 0.0133;
    slow.expected_drag *= 0.0133 * 0.0133 / 0.01;
    rows.push_back(coefficient_row(slow, worst.run(slow, context), 0.10, ""));
    for (const double degrees : {26.565, 45.0}) rows.push_back(turned_row(1, degrees, context, worst));
    rows.push_back(diagonal_row(false, context, worst));
    rows.push_back(diagonal_row(true, context, worst));
    for (const double d : {0.25, 0.5, 1.0, 2.0, 4.0}) rows.push_back(jitter_row(d, context, worst));
  }
  rows.push_back(at_most_row("momentum audit", worst.audit, context.precision == Precision::float64 ? 1e-10 : 1e-4));
  return rows;
}

}  // namespace

Entry wire_drag() {
  return {"wires_in_fluid.wire_drag",
          {"Sucker & Brauer 1975, normal drag of a circular cylinder", {"cylinder_cd.csv"}},
          run};
}

}  // namespace lahar::validate
