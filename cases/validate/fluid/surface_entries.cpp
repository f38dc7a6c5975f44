#include "cases/validate/fluid/surface_entries.h"

namespace lahar::validate {

std::vector<Entry> surface_entries() {
  return {
      {"fluid.gravity_wave", "Prosperetti 1981", gravity_wave},
      {"fluid.nusselt_film", "Nusselt 1916", nusselt_film},
      {"fluid.hydrostatic", "water at rest", hydrostatic},
      {"fluid.hydrostatic_tilted", "water at rest, tank at 35 degrees to the lattice", hydrostatic_tilted},
      {"fluid.martin_moyce", "Martin & Moyce 1952, n^2 = 2", martin_moyce},
      {"fluid.adaptive_time_step", "the same flows with the right step throughout", adaptive_time_step},
      {"fluid.laplace_drop", "Laplace; Lamb 1932, art. 275", laplace_drop},
      {"fluid.mass_ledger", "conservation of mass", mass_ledger},
      {"fluid.hard_h1", "dam break of water, 10 mm; front of Martin & Moyce 1952", hard_h1},
      {"fluid.hard_h2", "dam break on other grids and time steps", hard_h2},
      {"fluid.hard_h3", "water at rest, tau - 1/2 = 6e-7", hard_h3},
      {"fluid.hard_h4", "thin films on a dry slope", hard_h4},
      {"fluid.hard_h6", "jet through a slot of 3 cells, Torricelli", hard_h6},
      {"fluid.hard_h8", "gas trapped under a lid", hard_h8},
      {"fluid.hard_h13", "overtopping, draining, wetting again", hard_h13},
      {"fluid.hard_h14", "water into a closed corner at 10 m/s", hard_h14},
      {"fluid.hard_h18", "an almost empty box", hard_h18},
      {"fluid.hard_h19_splash", "case H19 of the hard cases in a dam break", hard_h19_splash},
      {"fluid.hard_h20", "slope of 35 degrees, gravity or lattice tilted", hard_h20},
  };
}

}  // namespace lahar::validate
