#include "cases/validate/fluid/entries.h"

#include "cases/validate/fluid/surface_entries.h"

namespace lahar::validate {

std::vector<Entry> fluid_entries() {
  return {
      {"fluid.gravity_wave", "Prosperetti 1981", gravity_wave},
      {"fluid.hydrostatic", "rest", hydrostatic},
      {"fluid.hydrostatic_tilted", "rest", hydrostatic_tilted},
      {"fluid.martin_moyce", "Martin & Moyce 1952, n^2 = 2", martin_moyce},
      {"fluid.hard_h3", "hard case H3: water at rest", hard_h3},
  };
}

}  // namespace lahar::validate
