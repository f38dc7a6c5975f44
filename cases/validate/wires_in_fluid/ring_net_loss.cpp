// Pressure loss of a net of rings across a stream: rings in the proportions of the paper's net (diameter 7/6 of the
// pitch), of several solidities, at several sizes of the cells.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/validate/entry.h"
#include "cases/validate/wires_in_fluid/loss_of_screens.h"
#include "cases/validate/wires_in_fluid/wire_flows.h"

namespace lahar::validate {
namespace {

constexpr double kRingOverPitch = 7.0 / 6.0;

/// Covered share of a net of rings of wire diameter d, pitch 1, seen from the stream.
double ring_net_solidity(double d) {
  constexpr int n = 400;
  int covered = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      bool hit = false;
      for (int a = -1; a <= 1; ++a)
        for (int b = -1; b <= 1; ++b)
          hit = hit ||
                std::abs(std::hypot((i + 0.5) / n - 0.5 - a, (j + 0.5) / n - 0.5 - b) - kRingOverPitch / 2) < d / 2;
      covered += hit;
    }
  return static_cast<double>(covered) / (n * n);
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  double audit = 0;
  struct Net {
    int width;
    double pitch_over_diameter;
  };
  const auto nets =
      context.quick ? std::vector<Net>{{40, 20}} : std::vector<Net>{{64, 32}, {40, 20}, {64, 16}, {40, 10}};
  for (const auto& [width, ratio] : nets) {
    const double solidity = ring_net_solidity(1 / ratio), table = loss_of_screen(solidity, 100);
    double low = 1e300, high = 0;
    for (const double d : context.quick ? std::vector<double>{1} : std::vector<double>{0.5, 1, 2}) {
      WireStream s;
      s.diameter = d;
      s.cells = Vec3i(64, width, width);
      s.travel = 44;
      const int rings = static_cast<int>(std::lround(width / (ratio * d)));
      const double pitch = static_cast<double>(width) / rings, area = static_cast<double>(width) * width;
      for (int i = 0; i < rings; ++i)
        for (int j = 0; j < rings; ++j)
          s.wires.push_back({.start = Vec3(16.1, (i + 0.5) * pitch, (j + 0.5) * pitch),
                             .end = Vec3::Zero(),
                             .ring_diameter = kRingOverPitch * pitch});
      s.expected_drag = table * 0.5 * s.speed * s.speed * area;
      const WireLoad load = run_stream(s, context);
      const double found = load.drag / (0.5 * load.speed * load.speed * area);
      low = std::min(low, found), high = std::max(high, found);
      audit = std::max(audit, load.audit);
      rows.push_back(
          relative_row(fmt::format("K of a ring net, S {:.3f}, Re 100, d/dx {:g}", solidity, d), found, table, 0.20));
    }
    if (!context.quick)
      rows.push_back(at_most_row(fmt::format("K of a ring net, S {:.3f}: spread over d/dx 0.5, 1, 2", solidity),
                                 2 * (high - low) / (high + low), 0.10));
  }
  rows.push_back(at_most_row("momentum audit", audit, context.precision == Precision::float64 ? 1e-10 : 1e-4));
  return rows;
}

}  // namespace

Entry ring_net_loss() {
  return {
      "wires_in_fluid.ring_net_loss", {"Blevins 1984 at the net's solidity, trusted to 20 %", {"screen_net.csv"}}, run};
}

}  // namespace lahar::validate
