// Does an impact return the restitution that was asked for, at any speed, at the time step that
// a scene takes by default?
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/validate/dem/impact.h"
#include "cases/validate/dem/ledger_watch.h"
#include "cases/validate/entry.h"

namespace lahar::validate {

namespace {

struct Ball {
  const char* name;
  double radius, density, youngs_modulus, poisson_ratio;
};
constexpr Ball kBoulder{"rock, 80 mm", 0.04, 2500, 70e9, 0.3}, kBead{"steel, 6.1 mm", 0.00305, 7800, 200e9, 0.3};

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  const std::vector<double> speeds = context.quick ? std::vector{1.0} : std::vector{0.01, 1.0, 10.0};
  ImpactLedger ledger;
  for (const Ball& ball : {kBoulder, kBead})
    for (const bool pair : {false, true})
      for (const double e : {0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0}) {
        double worst = 0;
        for (const double speed : speeds) {
          const ImpactSpec spec{.radius = ball.radius,
                                .density = ball.density,
                                .youngs_modulus = ball.youngs_modulus,
                                .poisson_ratio = ball.poisson_ratio,
                                .speed = speed,
                                .pair = pair,
                                .restitution = e};
          const Impact i = run_impact(spec);
          if (std::abs(i.restitution - e) >= std::abs(worst - e) || worst == 0) worst = i.restitution;
          ledger.add(spec, i);
        }
        rows.push_back(
            relative_row(fmt::format("{}, {}: restitution", ball.name, pair ? "pair" : "plate"), worst, e, 0.01));
      }
  ledger.rows(rows);
  return rows;
}

}  // namespace

Entry restitution() { return {"dem.restitution", {"the restitution that was asked for"}, run}; }

}  // namespace lahar::validate
