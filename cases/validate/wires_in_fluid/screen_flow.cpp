#include "cases/validate/wires_in_fluid/screen_flow.h"

#include <cmath>

#include "cases/validate/wires_in_fluid/loss_of_screens.h"

namespace lahar::validate {

ScreenLoss flow_through_screen(const Screen& screen, const Context& context) {
  // Periodic boxes are whole blocks of 8 cells.
  const auto scaled = [&](int cells) { return 8 * static_cast<int>(std::lround(screen.scale * cells / 8)); };
  const int width = scaled(40), deep = screen.mesh ? width : 8;
  WireStream s;
  s.diameter = screen.diameter;
  s.reynolds = screen.reynolds;
  s.speed = screen.speed;
  s.resolved = screen.resolved;
  s.cells = Vec3i(scaled(64), width, deep);
  s.travel = screen.scale * 44;
  const double linear = screen.mesh ? 1 - std::sqrt(1 - screen.solidity) : screen.solidity;
  const int wires = static_cast<int>(std::lround(width * linear / screen.diameter));
  const double x = std::round(16 * screen.scale) + 0.1, covered = wires * screen.diameter / width;
  for (int k = 0; k < wires; ++k) {
    const double at = (k + 0.37) * width / wires;
    s.wires.push_back({.start = Vec3(x, at, 0), .end = Vec3(x, at, deep)});
    if (screen.mesh) s.wires.push_back({.start = Vec3(x, 0, at), .end = Vec3(x, width, at)});
  }
  ScreenLoss loss;
  loss.solidity = screen.mesh ? 1 - (1 - covered) * (1 - covered) : covered;
  loss.table = loss_of_screen(loss.solidity, screen.reynolds);
  const double area = static_cast<double>(width) * deep;
  s.expected_drag = loss.table * 0.5 * s.speed * s.speed * area;
  const WireLoad load = run_stream(s, context);
  loss.found = load.drag / (0.5 * load.speed * load.speed * area);
  loss.audit = load.audit;
  return loss;
}

}  // namespace lahar::validate
