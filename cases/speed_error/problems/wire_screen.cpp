// A stream through a screen of parallel round wires of solidity 0.3 at Reynolds number 100: its pressure loss.
#include <fmt/format.h>

#include <cmath>

#include "cases/speed_error/problems/problems.h"
#include "cases/validate/wires_in_fluid/screen_flow.h"

namespace lahar::validate {

namespace {

Trial trial(std::vector<Knob> turned, const Screen& screen, Precision precision = Precision::float32) {
  return {std::move(turned), [screen, precision] {
            return timed([&] {
              Context context;
              context.precision = precision;
              const ScreenLoss loss = flow_through_screen(screen, context);
              return std::abs(loss.found / loss.table - 1);
            });
          }};
}

}  // namespace

Problem wire_screen_problem(bool quick) {
  Problem p{"wire_screen",
            "pressure loss of the screen",
            "measured (Blevins 1984, +-20 %)",
            "wires of 1 cell by the drag law, 0.1 lu, float",
            {}};
  const Screen standard;
  p.trials.push_back(trial({}, standard));
  for (const double cells : {0.5, 2.0, 4.0}) {
    if (quick && cells > 2) continue;
    Screen s = standard;
    s.diameter = s.scale = cells;
    p.trials.push_back(trial({{"cells a wire", fmt::to_string(cells)}}, s));
  }
  for (const double cells : {2.0, 4.0, 6.0}) {
    if (quick && cells > 2) continue;
    Screen s = standard;
    s.diameter = s.scale = cells, s.resolved = true;
    p.trials.push_back(trial({{"cells a wire", fmt::to_string(cells)}, {"wires", "mapped"}}, s));
  }
  for (const double speed : {0.2, 0.05}) {
    Screen s = standard;
    s.speed = speed;
    p.trials.push_back(trial({{"lattice_velocity", fmt::to_string(speed)}}, s));
  }
  p.trials.push_back(trial({{"precision", "double"}}, standard, Precision::float64));
  return p;
}

}  // namespace lahar::validate
