// Water runs out of a tank through a slot in its wall (Torricelli).
#include <cmath>
#include <string>
#include <vector>

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

struct Slot {
  double opening = 3, thickness = 2;  ///< cells
  WallSlip slip = WallSlip::no_slip;  ///< of the plate
  int settle = 2000, measure = 4000;  ///< steps
};

struct Discharge {
  double coefficient = 0;    ///< over opening sqrt(2 g head)
  double won = 0, lost = 0;  ///< by the jet, by the tank, lu
};

/// A slot in a plate, 40 cells under the surface.
template <class Real>
Discharge discharge_of(const Slot& slot) {
  const Vec3i cells(128, 8, 64);
  const double gravity = 1.25e-4, plate = 64;  // sqrt(2 g 40) = 0.1
  const double opening = slot.opening, foot = 8 * opening / 3, behind = plate + slot.thickness;
  lbm::FluidOptions o = open_tank(cells, 1e-4, Vec3(0, 0, -gravity));
  o.domain.faces[1] = lbm::FaceKind::open;
  o.domain.faces[2] = o.domain.faces[3] = lbm::FaceKind::periodic;
  o.domain.walls.add({"below", SolidBox{Vec3(plate, -8, -8), Vec3(behind, 16, foot)}, slot.slip});
  o.domain.walls.add({"above", SolidBox{Vec3(plate, -8, foot + opening), Vec3(behind, 16, 80)}, slot.slip});
  lbm::Fluid<Real> fluid(o);
  fluid.fill({{Vec3::Zero(), Vec3(plate, cells.y() - 1e-9, foot + opening / 2 + 40)}});
  const auto head = [&] { return volume_left_of(fluid, plate) / (plate * cells.y()) - foot - opening / 2; };
  for (int s = 0; s < slot.settle; ++s) fluid.step();
  const auto tank = [&] { return mass_between(fluid, 0, plate); };
  const auto beyond = [&] { return mass_between(fluid, behind, cells.x()) + fluid.outflow_mass(); };
  const double volume = volume_left_of(fluid, plate), held = tank(), past = beyond();
  double ideal = 0;
  for (int s = 0; s < slot.measure; ++s) {
    if (s % 20 == 0) ideal += 20 * opening * cells.y() * std::sqrt(2 * gravity * head());
    fluid.step();
  }
  return {(volume - volume_left_of(fluid, plate)) / ideal, beyond() - past, held - tank()};
}

/// The case asks for a slot of 3 cells in a plate of 2. Through a sharp edge the discharge is 0.611 (Kirchhoff's jet,
/// pi / (pi + 2)): in plates of one cell, a sixth of the opening, within 0.60 to 0.68. The tank then empties twice as
/// fast.
std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    Slot slot;
    if (context.quick) slot.settle = slot.measure = 600;
    const Discharge found = discharge_of<Real>(slot);
    std::vector<Row> rows{absolute_row("discharge over A sqrt(2 g h), 0.55 to 0.70", found.coefficient, 0.625, 0.075),
                          relative_row("what the jet won over what the tank lost", found.won, found.lost, 0.005)};
    if (context.quick) return rows;
    for (const WallSlip slip : {WallSlip::no_slip, WallSlip::free_slip}) {
      const Slot thin{.opening = 6, .thickness = 1, .slip = slip, .settle = 1000, .measure = 2000};
      const std::string plate = slip == WallSlip::no_slip ? "no-slip plate" : "slipping plate";
      rows.push_back(absolute_row("slot of 6 cells in a " + plate + " of one: the same, 0.60 to 0.68",
                                  discharge_of<Real>(thin).coefficient, 0.64, 0.04));
    }
    return rows;
  });
}

}  // namespace

Entry orifice_jet() {
  return {"free_surface.orifice_jet",
          {"case H6 of the hard cases: jet through a slot of 3 cells, Torricelli; Kirchhoff's jet", {"hard_cases.csv"}},
          run};
}

}  // namespace lahar::validate
