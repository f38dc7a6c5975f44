// Case H8 of reference/hard_cases.csv, the sphere: gas that is shut in under a held sphere, deep in water. The gas has
// the pressure of the air above the water, whatever becomes of it: it holds nothing back, and every pocket must fill.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/validate/entry.h"
#include "cases/validate/grains_in_fluid/sphere_tanks.h"

namespace lahar::validate {
namespace {

/// A box of cells that is dry at the start, with a sphere over it. Water stands around it up to `level`.
struct Pocket {
  std::string name;
  Vec3i lower, upper;
  bool in_tube = false;  ///< walls of two cells around the box: it can fill from below alone
  double level = 40;
  double drop = 0;  ///< from the level of the water to the pocket's foot
};

SphereTank tank_of(const Pocket& p, double diameter, double above) {
  SphereTank t;
  t.cells = Vec3i(40, 40, 48);
  t.diameter = diameter;
  t.held = true;
  t.density = 2.6;
  t.place = Vec3(20, 20, p.upper.z() + above);
  const Vec3 low = p.lower.cast<double>(), high = p.upper.cast<double>();
  t.water = {{Vec3(0, 0, 0), Vec3(40, 40, low.z())},
             {Vec3(0, 0, low.z()), Vec3(low.x(), 40, p.level)},
             {Vec3(high.x(), 0, low.z()), Vec3(40, 40, p.level)},
             {Vec3(low.x(), 0, low.z()), Vec3(high.x(), low.y(), p.level)},
             {Vec3(low.x(), high.y(), low.z()), Vec3(high.x(), 40, p.level)},
             {Vec3(low.x(), low.y(), high.z()), Vec3(high.x(), high.y(), p.level)}};
  if (!p.in_tube) return t;
  const Vec3 thick(2, 2, 0);
  const auto wall = [&](const char* name, const Vec3& from, const Vec3& to) {
    t.walls.push_back({name, SolidBox{from, to}});
  };
  wall("left", low - thick, Vec3(low.x(), high.y() + 2, high.z()));
  wall("right", Vec3(high.x(), low.y() - 2, low.z()), high + thick);
  wall("front", low - thick, Vec3(high.x() + 2, low.y(), high.z()));
  wall("back", Vec3(low.x() - 2, high.y(), low.z()), high + thick);
  return t;
}

/// Gas in the box, outside of the sphere by at least half a cell.
template <class Real>
double gas_in(const lbm::Fluid<Real>& fluid, const Pocket& p, const SphereTank& t) {
  const Vec3 low = p.lower.cast<double>(), high = p.upper.cast<double>();
  const auto counts = [&](const Vec3& centre) { return (centre - t.place).norm() > t.diameter / 2 + 0.5; };
  double gas = 0;
  for (int x = p.lower.x(); x < p.upper.x(); ++x)
    for (int y = p.lower.y(); y < p.upper.y(); ++y)
      for (int z = p.lower.z(); z < p.upper.z(); ++z) gas += counts(Vec3(x + 0.5, y + 0.5, z + 0.5));
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
    if ((c.centre - low).minCoeff() > 0 && (high - c.centre).minCoeff() > 0 && counts(c.centre)) gas -= c.fill_level;
  });
  return gas;
}

/// Steps that are whole periods of the sound that the collapse leaves in the tank, 4 depths / 0.577.
constexpr int kSound = 554;

template <class Real>
void fill_up(std::vector<Row>& rows, const Pocket& p, const SphereTank& t, int steps, bool lift) {
  const auto tank = make_tank<Real>(t);
  auto& step = *tank;
  const double impact = std::sqrt(2 * t.gravity * (p.level - p.lower.z())), before = gas_in(*step.fluid(), p, t);
  const double weight = t.gravity * std::numbers::pi / 6 * std::pow(t.diameter, 3);
  double fastest = 0, lifted = 0;
  for (int s = 0; s < steps; ++s) {
    step.advance();
    fastest = std::max(fastest, step.fluid()->max_speed_lu() / impact);
    if (s >= steps - kSound) lifted += step.solids()->particles().external_force.z[0] / (kSound * weight);
  }
  rows.push_back(at_most_row(p.name + ": fastest cell over the fall of the level", fastest, 2));
  rows.push_back(at_most_row(p.name + ": gas that is left, of the pocket", gas_in(*step.fluid(), p, t) / before, 0.01));
  if (lift)
    rows.push_back(relative_row(p.name + ": lift afterwards over the weight of the water displaced", lifted, 1, 0.05));
  add_ledgers(rows, p.name, step);
}

std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    std::vector<Row> rows;
    const Pocket tube{.name = "tube under water that a sphere closes",
                      .lower = Vec3i(16, 16, 8),
                      .upper = Vec3i(24, 24, 22),
                      .in_tube = true};
    fill_up<Real>(rows, tube, tank_of(tube, 12, 2), 1000, false);
    const Pocket open{
        .name = "pocket under a sphere in open water", .lower = Vec3i(16, 16, 10), .upper = Vec3i(24, 24, 18)};
    fill_up<Real>(rows, open, tank_of(open, 12, 4), context.quick ? 600 : 2500, !context.quick);
    return rows;
  });
}

}  // namespace

Entry gas_under_sphere() {
  return {"grains_in_fluid.gas_under_sphere", {"case H8 of the hard cases", {"hard_cases.csv"}}, run};
}

}  // namespace lahar::validate
