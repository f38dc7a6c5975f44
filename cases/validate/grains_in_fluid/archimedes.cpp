// A sphere is lowered into a tank and lifted out again: the level rises by its volume and falls back, the water carries
// the weight of what is displaced, and none is lost.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "cases/validate/entry.h"
#include "cases/validate/grains_in_fluid/sphere_tanks.h"

namespace lahar::validate {
namespace {

/// Means over a number of steps at rest.
struct Rest {
  double volume = 0, liquid = 0, lift = 0;  ///< volume with the bodies in it
};

template <class Real>
double liquid_volume(const lbm::Fluid<Real>& fluid) {
  double volume = 0;
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) { volume += c.liquid_volume; });
  return volume;
}

template <class Real>
Rest rest(coupling::CoupledStep<Real>& step, int settle, int measure) {
  Rest mean;
  for (int s = 0; s < settle + measure; ++s) {
    step.advance();
    if (s < settle) continue;
    mean.lift += step.solids()->particles().external_force.z[0] / measure;
    if (s % 10 != 0) continue;
    mean.volume += filled_volume(*step.fluid()) * 10 / measure;
    mean.liquid += liquid_volume(*step.fluid()) * 10 / measure;
  }
  return mean;
}

template <class Real>
void move_to(coupling::CoupledStep<Real>& step, double height, double speed) {
  auto& p = step.solids()->particles();
  const double way = height - p.position.z[0];
  const int steps = static_cast<int>(std::abs(way) / speed);
  p.velocity.set(0, Vec3(0, 0, way > 0 ? speed : -speed));
  for (int s = 0; s < steps; ++s) step.advance();
  p.velocity.set(0, Vec3::Zero());
}

template <class Real>
void lower(std::vector<Row>& rows, double diameter, double speed, bool lift, const Context& context) {
  const int w = static_cast<int>(4 * diameter), settle = context.quick ? 600 : 1500;
  SphereTank t;
  t.cells = Vec3i(w, w, w + static_cast<int>(diameter));
  t.depth = 2.5 * diameter + 0.3;
  t.diameter = diameter;
  t.place = Vec3(w / 2 + 0.1, w / 2 - 0.3, t.depth + 1.5 * diameter);
  t.held = true;
  const auto tank = make_tank<Real>(t);
  auto& step = *tank;
  const double volume = std::numbers::pi / 6 * std::pow(diameter, 3);
  const Rest before = rest(step, 100, 200);
  move_to(step, 1.2 * diameter, speed);
  const Rest under = rest(step, settle, settle);
  const std::string what = fmt::format("D {:g} cells at {:g} lu", diameter, speed);
  rows.push_back(relative_row(what + ": level rise times the tank's area, over the volume",
                              (under.volume - before.volume) / volume, 1, 0.01));
  if (!context.quick)
    rows.push_back(
        relative_row(what + ": lift / weight of the water displaced", under.lift / (volume * t.gravity), 1, 0.05));
  if (lift) {
    move_to(step, t.depth + 1.5 * diameter, speed);
    const Rest after = rest(step, settle, settle);  // a mean: the volume swings with the sound in the tank
    // The sphere keeps a film of interface cells; the rest is in the tank again.
    double carried = 0;
    step.fluid()->for_each_wet_cell([&](const lbm::WetCell& c) {
      if (c.centre.z() > t.depth + diameter / 2) carried += c.liquid_volume;
    });
    rows.push_back(note_row(what + ": liquid that it keeps when it is lifted out, of its volume", carried / volume));
    // Where it is fast some is thrown over the rim.
    const double left = step.fluid()->outflow_mass() / step.fluid()->units().mass();
    rows.push_back(note_row(what + ": liquid thrown out of the tank, of its volume", left / volume));
    rows.push_back(absolute_row(what + ": level after it is lifted out, less that before, of its volume, with what it "
                                       "keeps and has thrown out",
                                (after.liquid + left - before.liquid) / volume, 0, 0.01));
  }
  add_ledgers(rows, what, step);
}

std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    std::vector<Row> rows;
    lower<Real>(rows, 8, 0.02, !context.quick, context);
    if (context.quick) return rows;
    lower<Real>(rows, 8, 0.1, true, context);
    lower<Real>(rows, 4, 0.05, true, context);
    return rows;
  });
}

}  // namespace

Entry archimedes() { return {"grains_in_fluid.archimedes", {"volume of the sphere; ledger"}, run}; }

}  // namespace lahar::validate
