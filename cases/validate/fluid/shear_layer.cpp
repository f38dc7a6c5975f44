// Which operators stay stable at vanishing viscosity, with and without an eddy viscosity, in float.
#include <fmt/format.h>

#include "cases/validate/entry.h"
#include "cases/validate/fluid/periodic_flows.h"

namespace lahar::validate {

namespace {

/// The default without LES and every operator with Cs = 0.16 must not gain energy. How far energy rises above the
/// lowest that it had has no bar: at Ma 0.2 compression is more than its kinetic and pressure parts. BGK and TRT
/// without LES have no bar: how far they get is shown.
void add_row(std::vector<Row>& rows, const StabilityCase& c) {
  const Stability s = run_periodic(c, Precision::float32);
  const std::string label = fmt::format("{} Cs {}, {}, nu {:g}, Ma {}", name(c.collision), c.smagorinsky,
                                        c.flow == PeriodicFlow::vortex ? "vortex" : "layer", c.viscosity, c.mach);
  if (!stable_without_eddies(c.collision) && c.smagorinsky == 0)
    return rows.push_back(note_row(label + ": time run", s.finished));
  rows.push_back(at_most_row(label + ": kinetic energy", s.largest, 1.001));
  rows.push_back(note_row(label + ": rise above the lowest before", s.rise));
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  for (const lbm::CollisionOperator collision : kOperators)
    for (const double smagorinsky : {0.0, 0.16})
      for (const PeriodicFlow flow : {PeriodicFlow::shear_layer, PeriodicFlow::vortex})
        for (const double viscosity : {1e-5, 1e-6})
          for (const double mach : {0.1, 0.2}) {
            StabilityCase c{flow, collision, viscosity, mach, smagorinsky, flow == PeriodicFlow::vortex ? 32 : 64};
            if (context.quick) {
              if (viscosity > 1e-6 || mach < 0.2 || (collision != kOperators.front() && smagorinsky == 0)) continue;
              c.cells /= 2;
            }
            add_row(rows, c);
          }
  return rows;
}

}  // namespace

Entry shear_layer() {
  return {"fluid.shear_layer", {"energy of an unforced flow cannot rise; Minion & Brown 1997 for the layer"}, run};
}

}  // namespace lahar::validate
