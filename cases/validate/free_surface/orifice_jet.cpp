// Water runs out of a tank through a slot in its wall (Torricelli).
#include <cmath>

#include "cases/validate/entry.h"
#include "cases/validate/free_surface/surface_flows.h"

namespace lahar::validate {
namespace {

template <class Real>
double volume_left_of(const lbm::Fluid<Real>& fluid, double x) {
  double volume = 0;
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) { volume += c.centre.x() < x ? c.liquid_volume : 0; });
  return volume;
}

/// Liquid found between two planes across x, lu, whatever the fluid's own books say.
template <class Real>
double mass_between(const lbm::Fluid<Real>& fluid, double low, double high) {
  double sum = 0;
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
    if (c.centre.x() > low && c.centre.x() < high) sum += c.liquid_volume * (1 + 3 * c.pressure);
  });
  return sum;
}

/// A slot of 3 cells in a wall, 40 cells under the surface.
std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    const Vec3i cells(128, 8, 64);
    const double gravity = 1.25e-4, foot = 8, opening = 3, plate = 64;  // sqrt(2 g 40) = 0.1
    lbm::FluidOptions o = open_tank(cells, 1e-4, Vec3(0, 0, -gravity));
    o.domain.faces[1] = lbm::FaceKind::open;
    o.domain.faces[2] = o.domain.faces[3] = lbm::FaceKind::periodic;
    o.domain.walls.add({"below", SolidBox{Vec3(plate, -8, -8), Vec3(plate + 2, 16, foot)}});
    o.domain.walls.add({"above", SolidBox{Vec3(plate, -8, foot + opening), Vec3(plate + 2, 16, 80)}});
    lbm::Fluid<Real> fluid(o);
    fluid.fill({{Vec3::Zero(), Vec3(plate, cells.y() - 1e-9, foot + opening / 2 + 40)}});
    const auto head = [&] { return volume_left_of(fluid, plate) / (plate * cells.y()) - foot - opening / 2; };
    const int settle = context.quick ? 600 : 2000, measure = context.quick ? 600 : 4000;
    for (int s = 0; s < settle; ++s) fluid.step();
    const auto tank = [&] { return mass_between(fluid, 0, plate); };
    const auto beyond = [&] { return mass_between(fluid, plate + 2, cells.x()) + fluid.outflow_mass(); };
    const double volume = volume_left_of(fluid, plate), held = tank(), past = beyond();
    double ideal = 0;
    for (int s = 0; s < measure; ++s) {
      if (s % 20 == 0) ideal += 20 * opening * cells.y() * std::sqrt(2 * gravity * head());
      fluid.step();
    }
    const double discharge = (volume - volume_left_of(fluid, plate)) / ideal;
    return std::vector<Row>{
        absolute_row("discharge over A sqrt(2 g h), 0.55 to 0.70", discharge, 0.625, 0.075),
        relative_row("what the jet won over what the tank lost", beyond() - past, held - tank(), 0.005)};
  });
}

}  // namespace

Entry orifice_jet() {
  return {"free_surface.orifice_jet",
          {"case H6 of the hard cases: jet through a slot of 3 cells, Torricelli", {"hard_cases.csv"}},
          run};
}

}  // namespace lahar::validate
