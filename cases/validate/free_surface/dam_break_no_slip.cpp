// The front of a dam break on a bed that holds the water, on other grids and with other time steps.
#include <vector>

#include "cases/validate/entry.h"
#include "cases/validate/free_surface/dam_break.h"
#include "cases/validate/free_surface/surface_flows.h"

namespace lahar::validate {
namespace {

/// The layer that friction slows until then, sqrt(nu t) = 0.7 mm, is far thinner than a cell: theory asks for the front
/// of a slipping bed.
std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    const auto arrival = [](int cells, double lattice_velocity, bool slip) {
      DamBreak dam = column_of_water(cells);
      dam.lattice_velocity = lattice_velocity;
      dam.slip = slip;
      return run_dam_break<Real>(dam).time_at(3.5);
    };
    const double middle = arrival(23, 0.1, false);
    std::vector<Row> rows{
        relative_row("time to Z = 3.5 against that on a slipping bed, 10 mm", middle, arrival(23, 0.1, true), 0.05),
        relative_row("at a lattice velocity of 0.1 against 0.05", middle, arrival(23, 0.05, false), 0.03),
        relative_row("at a lattice velocity of 0.2 against 0.1", arrival(23, 0.2, false), middle, 0.03)};
    if (!context.quick)
      rows.push_back(relative_row("time to Z = 3.5 at 10 mm against 5 mm", middle, arrival(46, 0.1, false), 0.03));
    return rows;
  });
}

}  // namespace

Entry dam_break_no_slip() {
  return {"free_surface.dam_break_no_slip", {"the front on a slipping bed; other grids and time steps"}, run};
}

}  // namespace lahar::validate
