// Creeping flow through a simple-cubic array of spheres of volume fraction 0.343: its drag, Zick & Homsy 1982.
#include <fmt/format.h>

#include <cmath>

#include "cases/speed_error/problems/problems.h"
#include "cases/validate/grains_in_fluid/sphere_array.h"
#include "cases/validate/reference_table.h"

namespace lahar::validate {

namespace {

struct Array {
  int cells = 8;          ///< of the cube; a sphere has 0.87 of that a diameter
  double shifted = 0.05;  ///< tau - 1/2
  Immersion immersion = {.collision = lbm::CentralMoments{}};
};

constexpr int kRuns = 20;  // one takes too little time to be measured

Trial trial(std::vector<Knob> turned, const Array& a) {
  return {
      std::move(turned), [a] {
        const ReferenceTable known = reference("sc_array_drag.csv").where("phi", "0.343");
        const SphereArray array{a.cells, 1, known.number("phi"), known.number("K_ZickHomsy"), Vec3(0.3, 0.51, 0.69)};
        return timed([&] {
          double drag = 0;
          for (int k = 0; k < kRuns; ++k) drag = array_drag(array, a.shifted, a.immersion).drag;
          return std::abs(drag / array.drag - 1);
        });
      }};
}

}  // namespace

Problem sphere_array_problem(bool quick) {
  Problem p{
      "sphere_array",
      "drag of the array",
      "exact (Zick & Homsy 1982)",
      "7 cells a sphere, tau - 1/2 = 0.05, wall_distance with equilibrium_difference, radius shift -0.06, central "
      "moments, double",
      {}};
  const Array standard;
  p.trials.push_back(trial({}, standard));
  for (const int cells : {16, 24}) {
    if (quick && cells > 16) continue;
    Array a = standard;
    a.cells = cells;
    p.trials.push_back(trial({{"cells", fmt::to_string(cells * 7 / 8)}}, a));
  }
  for (const double shifted : {0.5, 0.2, 0.01}) {
    Array a = standard;
    a.shifted = shifted;
    p.trials.push_back(trial({{"tau - 1/2", fmt::to_string(shifted)}}, a));
  }
  for (const double shift : {0.0, -0.2}) {
    Array a = standard;
    a.immersion.radius_shift = shift;
    p.trials.push_back(trial({{"radius_shift_cells", fmt::to_string(shift)}}, a));
  }
  Array a = standard;
  a.immersion.collision = lbm::Trt{};
  p.trials.push_back(trial({{"collision", "trt"}}, a));
  a = standard;
  a.immersion.solid_operator = lbm::SolidOperator::damped_nonequilibrium;
  p.trials.push_back(trial({{"solid_operator", "faded"}}, a));
  const std::pair<const char*, lbm::BodyWeighting> weightings[] = {
      {"noble_torczynski", lbm::BodyWeighting::noble_torczynski},
      {"solid_fraction", lbm::BodyWeighting::solid_fraction}};
  for (const auto& [name, weighting] : weightings) {
    a.immersion.weighting = weighting;
    p.trials.push_back(trial({{"body_weighting", name}, {"solid_operator", "faded"}}, a));
  }
  return p;
}

}  // namespace lahar::validate
