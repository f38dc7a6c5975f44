// Water through a fixed bed of gravel (solid fraction 0.6), as in a debris flow: its drag, against Ergun 1952.
#include <fmt/format.h>

#include <cmath>

#include "cases/speed_error/problems/problems.h"
#include "cases/validate/grains_in_fluid/bed_flow.h"
#include "cases/validate/grains_in_fluid/closed_forms.h"

namespace lahar::validate {

namespace {

struct GravelBed {
  int cells = 4;
  double speed = 7;  ///< m/s, that a scene expects: 0.1 lu
  Immersion immersion;
  bool double_precision = false;
};

Trial trial(std::vector<Knob> turned, const GravelBed& g) {
  return {std::move(turned), [g] {
            const Bed bed = make_bed(0.6, g.cells, 8);
            return timed([&] {
              const BedDrag found = g.double_precision ? drag_of_gravel<double>(bed, g.speed, g.immersion)
                                                       : drag_of_gravel<float>(bed, g.speed, g.immersion);
              return std::abs(found.coefficient / drag_of_bed(bed.fraction, found.reynolds) - 1);
            });
          }};
}

}  // namespace

Problem gravel_bed_problem(bool quick) {
  Problem p{"gravel_bed",
            "drag of the bed",
            "measured (Ergun 1952)",
            "as in the debris flow: 4 cells a grain, 7 m/s at 0.1 lu, inertial with equilibrium_difference, radius "
            "shift -0.2, Cs 0.16, central moments, float",
            {}};
  GravelBed standard;
  standard.immersion = debris_immersion();
  standard.immersion.weighting = lbm::BodyWeighting::inertial;
  standard.immersion.radius_shift = coupling::kRadiusShiftFast;
  p.trials.push_back(trial({}, standard));
  for (const int cells : {2, 8}) {
    if (quick && cells > 4) continue;
    GravelBed g = standard;
    g.cells = cells;
    p.trials.push_back(trial({{"cells", fmt::to_string(cells)}}, g));
  }
  for (const double speed : {3.5, 14.0}) {
    GravelBed g = standard;
    g.speed = speed;
    p.trials.push_back(trial({{"lattice_velocity", speed < 7 ? "0.2" : "0.05"}}, g));
  }
  for (const double shift : {-0.06, -0.15, -0.25}) {
    GravelBed g = standard;
    g.immersion.radius_shift = shift;
    p.trials.push_back(trial({{"radius_shift_cells", fmt::to_string(shift)}}, g));
  }
  for (const double cs : {0.0, 0.1}) {
    if (quick && cs == 0) continue;
    GravelBed g = standard;
    g.immersion.smagorinsky = cs;
    p.trials.push_back(trial({{"smagorinsky", fmt::to_string(cs)}}, g));
  }
  GravelBed g = standard;
  g.immersion.weighting = lbm::BodyWeighting::wall_distance;
  p.trials.push_back(trial({{"body_weighting", "wall_distance"}}, g));
  g.immersion.solid_operator = lbm::SolidOperator::damped_nonequilibrium;
  p.trials.push_back(trial({{"body_weighting", "wall_distance"}, {"solid_operator", "faded"}}, g));
  const std::pair<const char*, lbm::BodyWeighting> weightings[] = {
      {"noble_torczynski", lbm::BodyWeighting::noble_torczynski},
      {"solid_fraction", lbm::BodyWeighting::solid_fraction}};
  for (const auto& [name, weighting] : weightings) {
    g.immersion.weighting = weighting;
    p.trials.push_back(trial({{"body_weighting", name}, {"solid_operator", "faded"}}, g));
  }
  g = standard;
  g.double_precision = true;
  p.trials.push_back(trial({{"precision", "double"}}, g));
  return p;
}

}  // namespace lahar::validate
