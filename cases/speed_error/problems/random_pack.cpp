// Slow flow (Reynolds number 1) through a random pack of spheres of volume fraction 0.4: its drag, Beetstra, van der
// Hoef & Kuipers 2007.
#include <fmt/format.h>

#include <cmath>

#include "cases/speed_error/problems/problems.h"
#include "cases/validate/grains_in_fluid/bed_flow.h"
#include "cases/validate/grains_in_fluid/closed_forms.h"

namespace lahar::validate {

namespace {

struct Pack {
  int cells = 4;
  double speed = 0.005;  ///< superficial, lu
  Immersion immersion = {.collision = lbm::CentralMoments{}};
  bool double_precision = false;
};

Trial trial(std::vector<Knob> turned, const Pack& pack) {
  constexpr double fraction = 0.4, reynolds = 1;
  return {std::move(turned), [pack] {
            const Bed bed = make_bed(fraction, pack.cells, 8);
            const double d = bed.diameter, nu = pack.speed * d / reynolds;
            const double g =
                18 * nu * pack.speed * fraction * drag_of_pack(fraction, reynolds) / (d * d * (1 - fraction));
            return timed([&] {
              const BedDrag found = pack.double_precision ? drag_of_flow<double>(bed, nu, g, pack.speed, pack.immersion)
                                                          : drag_of_flow<float>(bed, nu, g, pack.speed, pack.immersion);
              return std::abs(found.coefficient / drag_of_pack(fraction, found.reynolds) - 1);
            });
          }};
}

}  // namespace

Problem random_pack_problem(bool quick) {
  Problem p{"random_pack",
            "drag of the pack",
            "computed (Beetstra et al. 2007, +-8 %)",
            "4 cells a sphere, 0.005 lu (tau - 1/2 = 0.06), wall_distance with equilibrium_difference, radius shift "
            "-0.06, central moments, float",
            {}};
  const Pack standard;
  p.trials.push_back(trial({}, standard));
  for (const int cells : {2, 8}) {
    if (quick && cells > 4) continue;
    Pack k = standard;
    k.cells = cells;
    p.trials.push_back(trial({{"cells", fmt::to_string(cells)}}, k));
  }
  for (const double speed : {0.02, 0.001}) {
    Pack k = standard;
    k.speed = speed;
    p.trials.push_back(trial({{"lattice_velocity", fmt::to_string(speed)}}, k));
  }
  for (const double shift : {0.0, -0.2}) {
    Pack k = standard;
    k.immersion.radius_shift = shift;
    p.trials.push_back(trial({{"radius_shift_cells", fmt::to_string(shift)}}, k));
  }
  Pack k = standard;
  k.immersion.collision = lbm::Trt{};
  p.trials.push_back(trial({{"collision", "trt"}}, k));
  k = standard;
  k.immersion.solid_operator = lbm::SolidOperator::damped_nonequilibrium;
  p.trials.push_back(trial({{"solid_operator", "faded"}}, k));
  k.immersion.weighting = lbm::BodyWeighting::noble_torczynski;
  p.trials.push_back(trial({{"body_weighting", "noble_torczynski"}, {"solid_operator", "faded"}}, k));
  k = standard;
  k.double_precision = true;
  p.trials.push_back(trial({{"precision", "double"}}, k));
  return p;
}

}  // namespace lahar::validate
