// Drag of wires that are mapped as bodies (coupling.resolve_wires_from_cells), at the sizes at which the drag law is
// asked too (wire_drag, ring_net_loss), with the same bars.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "cases/validate/entry.h"
#include "cases/validate/wires_in_fluid/loss_of_screens.h"
#include "cases/validate/wires_in_fluid/straight_wire.h"

namespace lahar::validate {
namespace {

constexpr double kBar = 0.15;

/// 16 diameters from its images on either side.
int width_of_box(double diameter) { return static_cast<int>(std::lround(16 * diameter)); }

WireStream resolved_across(double diameter, double reynolds, const Vec3& offset) {
  WireStream s = stream_across(diameter, reynolds, width_of_box(diameter), offset);
  s.resolved = true;
  return s;
}

/// The closest net of ring_net_loss: pitch 10 d, diameter of the rings 7/6 of it, covered share 0.320.
Row net_row(double diameter, const Context& context, AuditedStreams& streams) {
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
  const WireLoad load = streams.run(s, context);
  return relative_row(fmt::format("K of a ring net, S {:.3f}, Re 100, d/dx {:g}", solidity, diameter),
                      load.drag / (0.5 * load.speed * load.speed * area), table, 0.20);
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  AuditedStreams streams;
  const auto ask = [&](double d, double re) {
    rows.push_back(coefficient_row(resolved_across(d, re, Vec3(0.1, 0.3, 0)), kBar, context, streams));
  };
  ask(4, 100);
  if (!context.quick) {
    for (const double re : {10.0, 1000.0, 1e4}) ask(4, re);
    for (const double re : {100.0, 1000.0, 1e4}) ask(8, re);
    for (const double degrees : {26.565, 45.0})
      rows.push_back(turned_row(resolved_across(4, 100, Vec3(0.3, 0.1, 0)), degrees, kBar, context, streams));
    const std::array<Vec3, 4> offsets{Vec3(0, 0, 0), Vec3(0.5, 0.5, 0), Vec3(0.25, 0.25, 0), Vec3(0, 0.5, 0)};
    for (const double d : {4.0, 8.0})
      for (const double re : {100.0, 1000.0})
        rows.push_back(spread_row(d, re, width_of_box(d), true, offsets, 0.05, context, streams));
    for (const double d : {2.0, 4.0}) rows.push_back(net_row(d, context, streams));
  }
  rows.push_back(streams.audit_row(context));
  return rows;
}

}  // namespace

Entry resolved_wire_drag() {
  return {"wires_in_fluid.resolved_wire_drag",
          {"Sucker & Brauer 1975; Blevins 1984, trusted to 20 %", {"cylinder_cd.csv", "screen_net.csv"}},
          run};
}

}  // namespace lahar::validate
