// Case H6 of reference/hard_cases.csv, the ring: water runs out of a tank through a round hole in a plate, and the rim
// of the hole is one ring of a net, of 7 cells clear opening (14 in the full form). The ring lies in the hole and
// touches its rim all round, so that the opening is all that is left free. Torricelli: sqrt(2 g h) through the free
// area. A sharp edge lets 0.61 of that through, an edge rounded like this wire some 0.67 to 0.70 (Idelchik's inlet
// losses at r/D = 0.056, 0.2 to 0.25 of the velocity head in place of 0.5 for a sharp edge; from memory), which is
// within what the case asks.
//
// The holes without a ring tell how much of an error is the wire's. They let through more than 0.61, and more on finer
// grids: water of the outermost cells loses its head in the one cell in which it turns round the edge, and a collar of
// slow water clings to the back of the plate; it is there too if the run starts with a contracted jet.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "cases/validate/entry.h"
#include "cases/validate/free_surface/surface_flows.h"
#include "cases/validate/wires_in_fluid/wire_flows.h"
#include "coupling/coupled_step.h"

namespace lahar::validate {
namespace {

/// Rings of the net are 300 mm wide with wire bundles of 30 mm: 1/9 of the clear opening.
constexpr double kWireOverOpening = 1.0 / 9.0;

enum class Rim { plate, wire_law, mapped_wire };

struct Vessel {
  double opening = 7;  ///< clear, cells
  Rim rim = Rim::plate;
  bool wide = true;  ///< the plate's hole reaches to the outside of the ring, else to its opening only
  int width = 48;
  double head = 40;  ///< cells, at the start, over the middle of the hole
  /// The second is whole periods of the sound that the opening of the hole leaves in the tank, 4 depths / 0.577.
  int settle = 600, measure = 1070;

  [[nodiscard]] double wire() const { return kWireOverOpening * opening; }
  [[nodiscard]] double hole() const { return wide ? opening + 2 * wire() : opening; }
  /// Middle of the hole: the centre of a cell.
  [[nodiscard]] double foot() const { return std::round(1.5 * opening) + 0.5; }
  [[nodiscard]] double middle() const { return std::floor(0.5 * width) + 0.5; }
  [[nodiscard]] double plate() const { return width; }
  [[nodiscard]] double thickness() const { return std::round(opening / 4); }
  [[nodiscard]] double gravity() const { return 0.01 / (2 * head); }  ///< the jet's speed is 0.1 lu
  [[nodiscard]] Vec3i cells() const {
    return {width + static_cast<int>(thickness() + 3 * opening), width, static_cast<int>(foot() + head) + 2};
  }
};

/// Means while it is measured, after the jet has formed.
struct Discharge {
  double per_speed = 0;        ///< discharge over sqrt(2 g h), cells^2
  double lattice_area = 0;     ///< cells in the plate's hole
  double jet_over_loss = 0;    ///< what is found beyond the plate over what the tank lost
  double area = 0, speed = 0;  ///< of the jet an opening behind the plate, cells^2, and over sqrt(2 g h)
  double push = 0;             ///< on the ring, over the pressure of the head on its shadow
  double audit = 0, ledger = 0;
};

double circle(double diameter) { return std::numbers::pi / 4 * diameter * diameter; }

/// The plate as boxes of whole cells: a cell is free where its centre lies within the hole. Returns the free cells.
double add_plate(const Vessel& v, Walls& walls) {
  const double x0 = v.plate(), x1 = x0 + v.thickness(), far = v.cells().z() + 8.0;
  int free = 0, low = v.cells().z(), high = 0;
  for (int z = 0; z < v.cells().z(); ++z) {
    int first = v.width, last = -1;
    for (int y = 0; y < v.width; ++y)
      if (std::hypot(y + 0.5 - v.middle(), z + 0.5 - v.foot()) < v.hole() / 2) first = std::min(first, y), last = y;
    if (last < first) continue;
    low = std::min(low, z), high = std::max(high, z);
    free += last + 1 - first;
    walls.add({"beside", SolidBox{Vec3(x0, -8, z), Vec3(x1, first, z + 1)}});
    walls.add({"beside", SolidBox{Vec3(x0, last + 1, z), Vec3(x1, v.width + 8, z + 1)}});
  }
  walls.add({"below", SolidBox{Vec3(x0, -8, -8), Vec3(x1, v.width + 8, low)}});
  walls.add({"above", SolidBox{Vec3(x0, -8, high + 1), Vec3(x1, v.width + 8, far)}});
  return free;
}

/// The ring lies within the plate, its middle in a layer of cell centres: there the lattice sees most of a thin wire.
std::optional<dem::Solids> ring_of(const Vessel& v) {
  if (v.rim == Rim::plate) return std::nullopt;
  HeldWire ring;
  ring.start = Vec3(v.plate() + std::floor((v.thickness() - 1) / 2) + 0.5, v.middle(), v.foot());
  ring.ring_diameter = v.opening + v.wire();
  return held_wires({ring}, v.wire());
}

template <class Real>
std::unique_ptr<coupling::CoupledStep<Real>> make_vessel(const Vessel& v, double& lattice_area) {
  lbm::FluidOptions o = open_tank(v.cells(), 1e-4, Vec3(0, 0, -v.gravity()));
  o.domain.faces[1] = lbm::FaceKind::open;
  lattice_area = add_plate(v, o.domain.walls);
  coupling::CouplingOptions coupling;
  if (v.rim == Rim::mapped_wire) coupling.mapped_wires = coupling::MappedWires{.from_diameter = 0.5 * v.wire()};
  auto step = std::make_unique<coupling::CoupledStep<Real>>(o, ring_of(v), coupling);
  step->fill({{Vec3::Zero(), Vec3(v.plate(), v.width, v.foot() + v.head)}});
  return step;
}

struct Look {
  double tank = 0, level = 0, beyond = 0;  ///< mass and mass before the plate and its level, mass behind it
  double area = 0, flux = 0;               ///< of the jet, in a slice
};

template <class Real>
Look look(const lbm::Fluid<Real>& fluid, const Vessel& v) {
  Look sum;
  const double behind = v.plate() + v.thickness(), slice = std::floor(behind + v.opening) + 0.5;
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
    const double mass = c.liquid_volume * (1 + 3 * c.pressure);
    if (c.centre.x() < v.plate()) sum.tank += mass, sum.level += c.liquid_volume / (v.plate() * v.width);
    if (c.centre.x() > behind) sum.beyond += mass;
    if (std::abs(c.centre.x() - slice) > 0.25) return;
    sum.area += c.liquid_volume;
    sum.flux += mass * c.velocity.x();
  });
  return sum;
}

double push_of(dem::Solids* solids) {
  double push = 0;
  if (solids)
    for (std::size_t i = 0; i < solids->particles().size(); ++i) push += solids->particles().external_force.x[i];
  return push;
}

template <class Real>
Discharge run_out(const Vessel& v) {
  Discharge d;
  const auto vessel = make_vessel<Real>(v, d.lattice_area);
  auto& step = *vessel;
  auto& fluid = *step.fluid();
  for (int s = 0; s < v.settle; ++s) step.advance();
  constexpr int every = 10;
  const double part = static_cast<double>(every) / v.measure,
               shadow = circle(v.opening + 2 * v.wire()) - circle(v.opening);
  const Look before = look(fluid, v);
  const double gone = fluid.outflow_mass();
  double ideal = 0;
  for (int s = 0; s < v.measure; ++s) {
    step.advance();
    if (s % every != every / 2) continue;
    const Look now = look(fluid, v);
    const double head = now.level - v.foot(), speed = std::sqrt(2 * v.gravity() * head);
    ideal += every * speed;
    d.area += part * now.area;
    d.speed += part * now.flux / now.area / speed;
    d.push += part * push_of(step.solids()) / (v.gravity() * head * shadow);
  }
  const Look after = look(fluid, v);
  d.per_speed = (before.tank - after.tank) / ideal;
  d.jet_over_loss = (after.beyond - before.beyond + fluid.outflow_mass() - gone) / (before.tank - after.tank);
  d.audit = step.audit().relative();
  d.ledger = std::abs(fluid.mass_drift());
  return d;
}

Row cd_row(const std::string& what, const Discharge& d, double area) {
  return absolute_row(what + ": discharge over free area sqrt(2 g h), 0.55 to 0.70", d.per_speed / area, 0.625, 0.075);
}

Row jet_row(const std::string& what, const Discharge& d) {
  return relative_row(what + ": what the jet won over what the tank lost", d.jet_over_loss, 1, 0.005);
}

template <class Real>
Discharge bare_hole(std::vector<Row>& rows, Vessel v, bool wide, const std::string& note) {
  v.rim = Rim::plate, v.wide = wide;
  const Discharge d = run_out<Real>(v);
  const std::string what = fmt::format("hole of {:.3g} cells{}", v.hole(), note);
  rows.push_back(cd_row(what, d, d.lattice_area));
  rows.push_back(jet_row(what, d));
  return d;
}

template <class Real>
void ask(std::vector<Row>& rows, Vessel v, bool quick) {
  const bool exact = sizeof(Real) == 8;
  const Discharge bare = bare_hole<Real>(rows, v, true, " without a ring");
  if (!quick) bare_hole<Real>(rows, v, false, ", the ring's opening");
  for (const Rim rim : {Rim::wire_law, Rim::mapped_wire}) {
    v.rim = rim;
    const Discharge d = run_out<Real>(v);
    const std::string what = fmt::format("ring of {:g} cells, wire {:.3g} {}", v.opening, v.wire(),
                                         rim == Rim::wire_law ? "by the drag law" : "mapped");
    if (!quick) rows.push_back(cd_row(what, d, circle(v.opening)));
    rows.push_back(jet_row(what, d));
    rows.push_back(at_most_row(fmt::format("{}: discharge over that of the hole without it (free area {:.2f} of it)",
                                           what, circle(v.opening) / bare.lattice_area),
                               d.per_speed / bare.per_speed, 1));
    rows.push_back(at_most_row(what + ": speed of the jet an opening behind, over sqrt(2 g h)", d.speed, 1));
    rows.push_back(
        at_least_row(what + ": push on the ring over the head on its shadow (bar: along the jet)", d.push, 0));
    rows.push_back(at_most_row(what + ": momentum audit", d.audit, exact ? 1e-10 : 1e-4));
    rows.push_back(at_most_row(what + ": liquid ledger", d.ledger, exact ? 1e-10 : 1e-5));
  }
}

std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    std::vector<Row> rows;
    Vessel seven, fourteen;
    if (context.quick) seven.width = 28, seven.head = 24, seven.settle = 400, seven.measure = 240;
    ask<Real>(rows, seven, context.quick);
    fourteen.opening = 14, fourteen.width = 56, fourteen.settle = 450, fourteen.measure = 850;
    if (!context.quick) ask<Real>(rows, fourteen, false);
    return rows;
  });
}

}  // namespace

Entry jet_through_ring() {
  return {"wires_in_fluid.jet_through_ring", {"case H6 of the hard cases, the ring", {"hard_cases.csv"}}, run};
}

}  // namespace lahar::validate
