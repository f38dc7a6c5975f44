// A sphere that settles from rest in a closed box of oil: its highest speed against ten Cate et al. 2002.
#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "cases/pictures/chart.h"
#include "cases/validate/entry.h"
#include "cases/validate/grains_in_fluid/settling.h"

namespace lahar::validate {

namespace {

void draw(const Context& context, const std::vector<Oil>& all, const std::vector<Fall>& falls) {
  if (context.plots.empty() || falls.size() != all.size()) return;
  cases::Chart chart{
      .title = "Sphere settling in a box of oil, 12 cells a diameter", .x = {"time", "s"}, .y = {"speed", "m/s"}};
  for (std::size_t k = 0; k < falls.size(); ++k) {
    const auto colour = static_cast<cases::ChartColour>(k);
    chart.series.push_back({.name = all[k].name, .x = falls[k].time, .y = falls[k].speed, .colour = colour});
    chart.series.push_back({.name = k == 0 ? "highest speed measured, ten Cate et al. 2002" : "",
                            .x = {0, falls[k].time.back()},
                            .y = {all[k].fastest, all[k].fastest},
                            .dash = cases::Dash::dashed,
                            .colour = colour});
  }
  chart.write_all(context.plots / "settling_sphere.png");
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  std::vector<Fall> falls;
  const std::vector<Oil> all = oils();
  for (const Oil& oil : all) {
    if (context.quick && oil.name != "E4") continue;
    const int cells = context.quick ? 6 : 12;
    falls.push_back(fall_in<double>(oil, {.cells_per_diameter = cells}, !context.plots.empty()));
    rows.push_back(relative_row(fmt::format("{}: highest speed, m/s, {} cells, tau - 1/2 = {:.2g}", oil.name, cells,
                                            falls.back().shifted_viscosity),
                                falls.back().fastest, oil.fastest, context.quick ? 0.10 : 0.03));
    rows.push_back(audit_row(oil.name, falls.back().audit));
  }
  draw(context, all, falls);
  return rows;
}

}  // namespace

Entry settling_sphere() {
  return {"grains_in_fluid.settling_sphere", {"ten Cate et al. 2002, Phys. Fluids 14:4012", {"tencate2002.csv"}}, run};
}

}  // namespace lahar::validate
