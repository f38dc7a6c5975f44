// Water at rest with the viscosity of water in a tank 1 m deep: 2e-7 lu at these sizes.
#include "cases/validate/free_surface/water_at_rest.h"

namespace lahar::validate {
namespace {

std::vector<Row> run(const Context& context) {
  WaterAtRest level = level_tank(context), tilted = tilted_tank(context);
  level.viscosity = tilted.viscosity = 2e-7;
  std::vector<Row> rows = rows_at_rest(level, "level, fill 0.5: ", context);
  for (Row& r : rows_at_rest(tilted, "35 degrees: ", context)) rows.push_back(std::move(r));
  return rows;
}

}  // namespace

Entry hydrostatic_low_viscosity() {
  return {"free_surface.hydrostatic_low_viscosity",
          {"case H3 of the hard cases: water at rest, tau - 1/2 = 6e-7", {"hard_cases.csv"}},
          run};
}

}  // namespace lahar::validate
