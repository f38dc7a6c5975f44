// Water runs out of a tank through a hole in a plate whose rim is one ring of a net: discharge through the ring's
// opening, of which theory and experiment allow 0.55 to 0.70 of the area times sqrt(2 g h).
#include <fmt/format.h>

#include <cmath>

#include "cases/speed_error/problems/problems.h"
#include "cases/validate/wires_in_fluid/vessel.h"

namespace lahar::validate {

namespace {

Trial trial(std::vector<Knob> turned, const Vessel& vessel, bool double_precision = false) {
  constexpr double contraction = 0.625;  // the middle of 0.55 to 0.70, of the free area
  return {std::move(turned), [vessel, double_precision] {
            return timed([&] {
              const Discharge found = double_precision ? run_out<double>(vessel) : run_out<float>(vessel);
              const double area = vessel.rim == Rim::plate ? found.lattice_area : circle(vessel.opening);
              return std::abs(found.per_speed / area / contraction - 1);
            });
          }};
}

}  // namespace

Problem ring_in_hole_problem(bool quick) {
  Problem p{"ring_in_hole",
            "discharge through the ring",
            "measured (0.625 +- 12 % of the free area)",
            "opening of 7 cells, wire of 0.8 cells by the drag law, jet of 0.1 lu, float",
            {}};
  Vessel standard;
  standard.rim = Rim::wire_law;
  // Four openings wide; measured over a period of the sound in the tank, two in the full form.
  standard.width = 28, standard.head = 24, standard.settle = 400, standard.measure = quick ? 245 : 490;
  p.trials.push_back(trial({}, standard));
  Vessel v = standard;
  v.rim = Rim::mapped_wire;
  p.trials.push_back(trial({{"wires", "mapped"}}, v));
  v.rim = Rim::plate, v.wide = false;
  p.trials.push_back(trial({{"rim", "of the plate"}}, v));
  p.trials.push_back(trial({{"precision", "double"}}, standard, true));
  if (quick) return p;
  v = standard;
  v.opening *= 2, v.width *= 2, v.head *= 2, v.settle *= 2, v.measure *= 2;
  p.trials.push_back(trial({{"cells", "14"}}, v));
  v.rim = Rim::mapped_wire;
  p.trials.push_back(trial({{"cells", "14"}, {"wires", "mapped"}}, v));
  return p;
}

}  // namespace lahar::validate
