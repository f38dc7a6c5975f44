// Water at rest in a tank that is level in the lattice, its surface between two cells.
#include "cases/validate/free_surface/water_at_rest.h"

namespace lahar::validate {
namespace {

std::vector<Row> run(const Context& context) { return rows_at_rest(level_tank(context), "", context); }

}  // namespace

Entry hydrostatic() { return {"free_surface.hydrostatic", {"water at rest"}, run}; }

}  // namespace lahar::validate
