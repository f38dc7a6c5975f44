// In less out less left: a dam break that splashes against the end wall of its tank for 1e4 steps.
#include "cases/validate/entry.h"
#include "cases/validate/free_surface/dam_break.h"

namespace lahar::validate {

namespace {

std::vector<Row> run(const Context& context) {
  DamBreak dam;
  dam.width = context.quick ? 8 : 16;
  dam.length = 3;
  dam.slip = false;
  dam.steps = context.quick ? 1000 : 10000;
  return {at_most_row("double, largest of |in - out - left| / in", run_dam_break<double>(dam).drift, 1e-10),
          at_most_row("float, the same", run_dam_break<float>(dam).drift, 1e-6)};
}

}  // namespace

Entry mass_ledger() { return {"free_surface.mass_ledger", {"conservation of mass"}, run}; }

}  // namespace lahar::validate
