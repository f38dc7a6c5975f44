// In less out less left: a dam break that splashes against the end wall of its tank for 1e4 steps.
#include "cases/validate/fluid/dam_break.h"
#include "cases/validate/fluid/surface_entries.h"

namespace lahar::validate {

std::vector<Row> mass_ledger(const Context& context) {
  DamBreak dam;
  dam.width = context.quick ? 8 : 16;
  dam.length = 3;
  dam.slip = false;
  dam.steps = context.quick ? 1000 : 10000;
  return {at_most_row("double, largest of |in - out - left| / in", run_dam_break<double>(dam).drift, 1e-10),
          at_most_row("float, the same", run_dam_break<float>(dam).drift, 1e-6)};
}

}  // namespace lahar::validate
