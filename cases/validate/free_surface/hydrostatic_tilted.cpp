// Water at rest in a tank that stands at 35 degrees to the lattice.
#include "cases/validate/free_surface/water_at_rest.h"

namespace lahar::validate {
namespace {

std::vector<Row> run(const Context& context) { return rows_at_rest(tilted_tank(context), "", context); }

}  // namespace

Entry hydrostatic_tilted() {
  return {"free_surface.hydrostatic_tilted", {"water at rest, tank at 35 degrees to the lattice"}, run};
}

}  // namespace lahar::validate
