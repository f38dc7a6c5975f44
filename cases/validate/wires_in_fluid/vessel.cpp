#include "cases/validate/wires_in_fluid/vessel.h"

#include <memory>
#include <numbers>
#include <optional>

#include "cases/validate/free_surface/surface_flows.h"
#include "cases/validate/wires_in_fluid/wire_flows.h"
#include "coupling/coupled_step.h"

namespace lahar::validate {

double circle(double diameter) { return std::numbers::pi / 4 * diameter * diameter; }

namespace {

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

}  // namespace

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

template Discharge run_out<float>(const Vessel&);
template Discharge run_out<double>(const Vessel&);

}  // namespace lahar::validate
