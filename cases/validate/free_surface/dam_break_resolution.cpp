// The front of a dam break on other grids and with other time steps.
#include <vector>

#include "cases/validate/entry.h"
#include "cases/validate/free_surface/dam_break.h"
#include "cases/validate/free_surface/surface_flows.h"

namespace lahar::validate {
namespace {

std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    const auto arrival = [](int cells, double lattice_velocity) {
      DamBreak dam = column_of_water(cells);
      dam.lattice_velocity = lattice_velocity;
      return run_dam_break<Real>(dam).time_at(3.5);
    };
    const double coarse = arrival(12, 0.1), middle = arrival(23, 0.1);
    // Twice the bar between cells of half the size: what is left is of first order.
    std::vector<Row> rows{relative_row("time to Z = 3.5 at 20 mm against 10 mm", coarse, middle, 0.06),
                          relative_row("time to Z = 3.5 at 10 mm against that of Martin & Moyce (ours are ahead)",
                                       middle, measured_arrival(3.5), 0.05)};
    if (!context.quick)
      rows.push_back(relative_row("time to Z = 3.5 at 10 mm against 5 mm", middle, arrival(46, 0.1), 0.03));
    rows.push_back(relative_row("at a lattice velocity of 0.1 against 0.05", middle, arrival(23, 0.05), 0.01));
    rows.push_back(relative_row("at a lattice velocity of 0.2 against 0.1", arrival(23, 0.2), middle, 0.01));
    return rows;
  });
}

}  // namespace

Entry dam_break_resolution() {
  return {"free_surface.dam_break_resolution",
          {"case H2 of the hard cases: dam break on other grids and time steps", {"hard_cases.csv"}},
          run};
}

}  // namespace lahar::validate
