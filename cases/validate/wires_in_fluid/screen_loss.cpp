// Pressure loss of plane screens of parallel wires and of square mesh. What the liquid loses is the drag of the wires
// per area (momentum balance of the audit), with no gradient left in a periodic box.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/validate/entry.h"
#include "cases/validate/wires_in_fluid/loss_of_screens.h"
#include "cases/validate/wires_in_fluid/wire_flows.h"

namespace lahar::validate {
namespace {

struct Loss {
  double solidity = 0, found = 0, table = 0, audit = 0;
};

Loss screen_of(double diameter, double reynolds, double solidity, bool mesh, const Context& context) {
  const int width = 40, deep = mesh ? width : 8;
  WireStream s;
  s.diameter = diameter;
  s.reynolds = reynolds;
  s.cells = Vec3i(64, width, deep);
  s.travel = 44;
  const double linear = mesh ? 1 - std::sqrt(1 - solidity) : solidity;
  const int wires = static_cast<int>(std::lround(width * linear / diameter));
  const double x = 16.1, covered = wires * diameter / width;
  for (int k = 0; k < wires; ++k) {
    const double at = (k + 0.37) * width / wires;
    s.wires.push_back({.start = Vec3(x, at, 0), .end = Vec3(x, at, deep)});
    if (mesh) s.wires.push_back({.start = Vec3(x, 0, at), .end = Vec3(x, width, at)});
  }
  Loss loss;
  loss.solidity = mesh ? 1 - (1 - covered) * (1 - covered) : covered;
  loss.table = loss_of_screen(loss.solidity, reynolds);
  const double area = static_cast<double>(width) * deep;
  s.expected_drag = loss.table * 0.5 * s.speed * s.speed * area;
  const WireLoad load = run_stream(s, context);
  loss.found = load.drag / (0.5 * load.speed * load.speed * area);
  loss.audit = load.audit;
  return loss;
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  double audit = 0;
  const auto ask = [&](double d, double re, double solidity, bool mesh) {
    const Loss loss = screen_of(d, re, solidity, mesh, context);
    audit = std::max(audit, loss.audit);
    rows.push_back(relative_row(fmt::format("K, {}, S {:.3f}, Re {:g}, d/dx {:g}",
                                            mesh ? "square mesh" : "parallel wires", loss.solidity, re, d),
                                loss.found, loss.table, 0.20));
    return loss.found / loss.table;
  };
  const auto compare = [&](double solidity, bool mesh) {
    double low = 1e300, high = 0;
    for (const double d : {0.5, 1.0, 2.0}) {
      const double ratio = ask(d, 100, solidity, mesh);
      low = std::min(low, ratio), high = std::max(high, ratio);
    }
    rows.push_back(at_most_row(fmt::format("K over the table, {}, S about {:g}: spread over d/dx 0.5, 1, 2",
                                           mesh ? "square mesh" : "parallel wires", solidity),
                               2 * (high - low) / (high + low), 0.10));
  };
  if (context.quick) {
    ask(1, 100, 0.3, false);
  } else {
    for (const double solidity : {0.1, 0.2, 0.3, 0.4}) compare(solidity, false);
    for (const double solidity : {0.1, 0.2, 0.3, 0.4}) compare(solidity, true);
    for (const double re : {20.0, 60.0, 400.0})
      for (const double solidity : {0.1, 0.2, 0.3, 0.4}) ask(1, re, solidity, false);
  }
  rows.push_back(at_most_row("momentum audit", audit, context.precision == Precision::float64 ? 1e-10 : 1e-4));
  return rows;
}

}  // namespace

Entry screen_loss() {
  return {"wires_in_fluid.screen_loss", {"Blevins 1984, round wire screens, trusted to 20 %", {"screen_net.csv"}}, run};
}

}  // namespace lahar::validate
