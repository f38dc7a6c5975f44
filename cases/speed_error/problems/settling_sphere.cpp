// A sphere settles from rest in a closed box of oil at Reynolds number 32 (ten Cate et al. 2002, E4): its highest
// speed.
#include <fmt/format.h>

#include <cmath>

#include "cases/speed_error/problems/problems.h"
#include "cases/validate/grains_in_fluid/settling.h"

namespace lahar::validate {

namespace {

Trial trial(std::vector<Knob> turned, const FallGrid& grid, double speed_scale = 1, bool double_precision = false) {
  return {std::move(turned), [grid, speed_scale, double_precision] {
            Oil oil = oils().back();
            oil.lattice_speed *= speed_scale;
            return timed([&] {
              const Fall fall = double_precision ? fall_in<double>(oil, grid, false) : fall_in<float>(oil, grid, false);
              return std::abs(fall.fastest / oil.fastest - 1);
            });
          }};
}

}  // namespace

Problem settling_sphere_problem(bool quick) {
  Problem p{
      "settling_sphere",
      "highest speed of the sphere",
      "measured (ten Cate et al. 2002)",
      "6 cells a sphere, 0.05 lu, one particle step a fluid step, wall_distance with equilibrium_difference, radius "
      "shift -0.06, central moments, float",
      {}};
  const FallGrid standard{.cells_per_diameter = 6, .immersion = {.collision = lbm::CentralMoments{}}};
  p.trials.push_back(trial({}, standard));
  for (const int cells : {4, 8, 12}) {
    if (quick && cells > 4) continue;
    FallGrid g = standard;
    g.cells_per_diameter = cells;
    p.trials.push_back(trial({{"cells", fmt::to_string(cells)}}, g));
  }
  for (const double scale : {2.0, 0.5})
    p.trials.push_back(trial({{"lattice_velocity", fmt::format("{:g}", 0.05 * scale)}}, standard, scale));
  FallGrid g = standard;
  g.substeps = 10;
  p.trials.push_back(trial({{"particle steps a fluid step", "10"}}, g));
  g = standard;
  g.immersion.collision = lbm::Trt{};
  p.trials.push_back(trial({{"collision", "trt"}}, g));
  for (const double shift : {0.0, -0.2}) {
    g = standard;
    g.immersion.radius_shift = shift;
    p.trials.push_back(trial({{"radius_shift_cells", fmt::to_string(shift)}}, g));
  }
  g = standard;
  g.immersion.solid_operator = lbm::SolidOperator::damped_nonequilibrium;
  p.trials.push_back(trial({{"solid_operator", "faded"}}, g));
  g.immersion.weighting = lbm::BodyWeighting::noble_torczynski;
  p.trials.push_back(trial({{"body_weighting", "noble_torczynski"}, {"solid_operator", "faded"}}, g));
  p.trials.push_back(trial({{"precision", "double"}}, standard, 1, true));
  return p;
}

}  // namespace lahar::validate
