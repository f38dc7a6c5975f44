// The front of a dam break on other grids and with other time steps.
#include <string>
#include <vector>

#include "cases/validate/entry.h"
#include "cases/validate/free_surface/dam_break.h"
#include "cases/validate/free_surface/surface_flows.h"

namespace lahar::validate {
namespace {

template <class Real>
double arrival(int cells, double lattice_velocity, bool slip) {
  DamBreak dam = column_of_water(cells);
  dam.lattice_velocity = lattice_velocity;
  dam.slip = slip;
  return run_dam_break<Real>(dam).time_at(3.5);
}

/// Changes with the cells and with the time step; the bed that holds the water also against the one that slips.
std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    std::vector<Row> rows;
    double of_slip = 0;
    for (const bool slip : {true, false}) {
      const std::string bed = slip ? "" : "no-slip bed: ";
      const auto at = [&](int cells, double lattice_velocity) { return arrival<Real>(cells, lattice_velocity, slip); };
      const double coarse = at(12, 0.1), middle = at(23, 0.1);
      rows.push_back(relative_row(bed + "time to Z = 3.5 at 20 mm against 10 mm (no bar)", coarse, middle, 1.0));
      if (!context.quick)
        rows.push_back(relative_row(bed + "time to Z = 3.5 at 10 mm against 5 mm", middle, at(46, 0.1), 0.03));
      rows.push_back(relative_row(bed + "at a lattice velocity of 0.1 against 0.05", middle, at(23, 0.05), 0.03));
      rows.push_back(relative_row(bed + "at a lattice velocity of 0.2 against 0.1", at(23, 0.2), middle, 0.03));
      if (slip)
        of_slip = middle;
      else
        rows.push_back(relative_row(bed + "time to Z = 3.5 against a slipping one (no bar)", middle, of_slip, 1.0));
    }
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
