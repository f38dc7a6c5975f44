// Drag of wires that are mapped as bodies (coupling.resolve_wires_from_cells), at the sizes at which the drag law is
// asked too (wire_drag, ring_net_loss), with the same bars.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/validate/entry.h"
#include "cases/validate/wires_in_fluid/loss_of_screens.h"
#include "cases/validate/wires_in_fluid/wire_flows.h"

namespace lahar::validate {
namespace {

/// A wire along z, a quarter of the box behind its start, 16 diameters from its images on either side.
WireStream across(double diameter, double reynolds, const Vec3& offset) {
  const int width = static_cast<int>(std::lround(16 * diameter));
  WireStream s;
  s.resolved = true;
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

Row coefficient_row(const WireStream& s, const Context& context, Worst& worst, const std::string& note) {
  const WireLoad load = worst.run(s, context);
  const WireCoefficient c = coefficient_of(s, load, 8, s.cells.y());
  return relative_row(
      fmt::format("Cd, d/dx {:g}, Re {:g}, tau - 1/2 {:.1e}{}", s.diameter, s.reynolds, load.tau - 0.5, note), c.found,
      c.law, 0.15);
}

/// (largest - smallest)/mean of Cd over places between the cells.
Row jitter_row(double diameter, double reynolds, const Context& context, Worst& worst) {
  double low = 1e300, high = 0;
  for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(0.5, 0.5, 0), Vec3(0.25, 0.25, 0), Vec3(0, 0.5, 0)}) {
    const WireStream s = across(diameter, reynolds, offset);
    const double found = coefficient_of(s, worst.run(s, context), 8, s.cells.y()).found;
    low = std::min(low, found), high = std::max(high, found);
  }
  return at_most_row(fmt::format("spread of Cd over places, d/dx {:g}, Re {:g}", diameter, reynolds),
                     2 * (high - low) / (high + low), 0.05);
}

/// The closest net of ring_net_loss: pitch 10 d, diameter of the rings 7/6 of it, covered share 0.320.
Row net_row(double diameter, const Context& context, Worst& worst) {
  constexpr double solidity = 0.320;
  const int width = 40, rings = static_cast<int>(std::lround(width / (10 * diameter)));
  const double pitch = static_cast<double>(width) / rings, area = static_cast<double>(width) * width;
  WireStream s;
  s.resolved = true;
  s.diameter = diameter;
  s.cells = Vec3i(64, width, width);
  s.travel = 44;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < rings; ++j)
      s.wires.push_back({.start = Vec3(16.1, (i + 0.5) * pitch, (j + 0.5) * pitch),
                         .end = Vec3::Zero(),
                         .ring_diameter = 7.0 / 6.0 * pitch});
  const double table = loss_of_screen(solidity, 100);
  s.expected_drag = table * 0.5 * s.speed * s.speed * area;
  const WireLoad load = worst.run(s, context);
  return relative_row(fmt::format("K of a ring net, S {:.3f}, Re 100, d/dx {:g}", solidity, diameter),
                      load.drag / (0.5 * load.speed * load.speed * area), table, 0.20);
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  Worst worst;
  const auto ask = [&](double d, double re) {
    rows.push_back(coefficient_row(across(d, re, Vec3(0.1, 0.3, 0)), context, worst, ""));
  };
  ask(4, 100);
  if (!context.quick) {
    for (const double re : {10.0, 1000.0, 1e4}) ask(4, re);
    for (const double re : {100.0, 1000.0, 1e4}) ask(8, re);
    for (const double degrees : {26.565, 45.0}) {
      WireStream s = across(4, 100, Vec3(0.3, 0.1, 0));
      const double angle = degrees * std::numbers::pi / 180;
      s.direction = Vec3(std::cos(angle), std::sin(angle), 0);
      rows.push_back(coefficient_row(s, context, worst, fmt::format(", stream at {:g} degrees", degrees)));
    }
    for (const double d : {4.0, 8.0})
      for (const double re : {100.0, 1000.0}) rows.push_back(jitter_row(d, re, context, worst));
    for (const double d : {2.0, 4.0}) rows.push_back(net_row(d, context, worst));
  }
  rows.push_back(at_most_row("momentum audit", worst.audit, context.precision == Precision::float64 ? 1e-10 : 1e-4));
  return rows;
}

}  // namespace

Entry resolved_wire_drag() {
  return {"wires_in_fluid.resolved_wire_drag",
          {"Sucker & Brauer 1975; Blevins 1984, trusted to 20 %", {"cylinder_cd.csv", "screen_net.csv"}},
          run};
}

}  // namespace lahar::validate
