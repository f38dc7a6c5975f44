// Pressure loss of plane screens of parallel wires and of square mesh.
#include <fmt/format.h>

#include <algorithm>

#include "cases/validate/entry.h"
#include "cases/validate/wires_in_fluid/screen_flow.h"
#include "core/worst.h"

namespace lahar::validate {
namespace {

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  double audit = 0;
  const auto ask = [&](double d, double re, double solidity, bool mesh) {
    const ScreenLoss loss =
        flow_through_screen({.diameter = d, .reynolds = re, .solidity = solidity, .mesh = mesh}, context);
    keep_worst(audit, loss.audit);
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
