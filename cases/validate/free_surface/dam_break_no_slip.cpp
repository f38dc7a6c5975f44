// The front of a dam break on a bed that holds the water, on other grids and with other time steps.
#include <vector>

#include "cases/validate/entry.h"
#include "cases/validate/free_surface/dam_break.h"
#include "cases/validate/free_surface/surface_flows.h"

namespace lahar::validate {
namespace {

// The coarse cells, 16 mm, are 28 a column's height: walls that hold the water and 0.1 lu are the defaults of scenes.
constexpr int kCoarse = 14, kMiddle = 23, kFine = 46;  // of the column's width

/// The layer that friction slows until then, sqrt(nu t) = 0.7 mm, is far thinner than a cell: theory asks for the front
/// of a slipping bed. The measured front is late in its experiment (martin_moyce.cpp).
std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    const auto arrival = [](int cells, double lattice_velocity, bool slip) {
      DamBreak dam = column_of_water(cells);
      dam.lattice_velocity = lattice_velocity;
      dam.slip = slip;
      return run_dam_break<Real>(dam).time_at(3.5);
    };
    const double middle = arrival(kMiddle, 0.1, false);
    std::vector<Row> rows{
        relative_row("time to Z = 3.5 against that on a slipping bed, 10 mm", middle, arrival(kMiddle, 0.1, true),
                     0.05),
        relative_row("at a lattice velocity of 0.1 against 0.05", middle, arrival(kMiddle, 0.05, false), 0.01),
        relative_row("at a lattice velocity of 0.2 against 0.1", arrival(kMiddle, 0.2, false), middle, 0.01)};
    if (context.quick) return rows;
    rows.push_back(relative_row("time to Z = 3.5 at 10 mm against 5 mm", middle, arrival(kFine, 0.1, false), 0.03));
    const double measured = measured_arrival(3.5);
    rows.push_back(relative_row("28 cells a column's height: time to Z = 3.5 against that of Martin & Moyce",
                                arrival(kCoarse, 0.1, false), measured, 0.05));
    rows.push_back(relative_row("46 cells a column's height: the same", middle, measured, 0.05));
    return rows;
  });
}

}  // namespace

Entry dam_break_no_slip() {
  return {"free_surface.dam_break_no_slip",
          {"the front on a slipping bed; other grids and time steps; Martin & Moyce 1952", {"martin_moyce1952.csv"}},
          run};
}

}  // namespace lahar::validate
