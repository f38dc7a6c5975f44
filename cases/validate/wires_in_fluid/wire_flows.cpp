#include "cases/validate/wires_in_fluid/wire_flows.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/sphere.h"
#include "coupling/coupled_step.h"

namespace lahar::validate {
namespace {

void add_bead(const Vec3& place, double diameter, dem::Particles& particles) {
  dem::ParticleSpec bead;
  bead.position = place;
  bead.radius = diameter / 2;
  bead.density = 100;  // of no account: held beads; heavy, so that a mapped one feels the fluid's force itself
  bead.kind = dem::ParticleKind::bead;
  bead.state = dem::ParticleState::fixed;
  particles.add(bead);
}

/// Beads about a diameter apart; both ends of a straight wire stand for half a piece.
void add_wire(const HeldWire& wire, double diameter, dem::Particles& particles, dem::Bonds& bonds) {
  const bool ring = wire.ring_diameter > 0;
  const double length = ring ? std::numbers::pi * wire.ring_diameter : (wire.end - wire.start).norm();
  const int pieces = std::max(ring ? 3 : 1, static_cast<int>(std::lround(length / diameter)));
  const auto first = static_cast<dem::ParticleIndex>(particles.size());
  for (int k = 0; k < pieces + (ring ? 0 : 1); ++k) {
    const double share = static_cast<double>(k) / pieces, angle = 2 * std::numbers::pi * share;
    const double r = wire.ring_diameter / 2;
    add_bead(ring ? Vec3(wire.start + r * Vec3(0, std::cos(angle), std::sin(angle)))
                  : Vec3(wire.start + share * (wire.end - wire.start)),
             diameter, particles);
    if (k > 0)
      bonds.add({first + static_cast<dem::ParticleIndex>(k) - 1, first + static_cast<dem::ParticleIndex>(k), 0},
                particles);
  }
  if (ring) bonds.add({first + static_cast<dem::ParticleIndex>(pieces) - 1, first, 0}, particles);
}

lbm::FluidOptions stream_options(const WireStream& s) {
  lbm::FluidOptions o;
  o.domain.upper = s.cells.cast<double>();
  o.domain.cell_size = 1;
  o.domain.faces.fill(lbm::FaceKind::periodic);
  o.time_step = 1;
  o.density = 1;
  o.kinematic_viscosity = s.speed * s.diameter / s.reynolds;
  o.rheology = s.rheology;
  o.gravity = s.expected_drag / s.cells.cast<double>().prod() * s.direction.normalized();
  return o;
}

/// Volume of the beads, cells: by it the drag law lifts them.
double volume_of(const dem::Solids& solids) {
  double volume = 0;
  for (const double radius : solids.particles().radius) volume += sphere_volume(radius);
  return volume;
}

/// That of mapped wires, as they are mapped.
template <class Real>
double mapped_volume(lbm::Fluid<Real>& fluid) {
  double volume = 0;
  for (const lbm::BlockIndex b : fluid.grid().owned())
    if (const auto* body = fluid.grid().block(b).body)
      for (const Real eps : body->solid_fraction) volume += static_cast<double>(eps);
  return volume;
}

template <class Real>
Vec3 momentum(const lbm::Fluid<Real>& fluid) {
  Vec3 sum = Vec3::Zero();
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) { sum += (1 + 3 * c.pressure) * c.velocity; });
  return sum;
}

template <class Real>
WireLoad measure(const WireStream& s) {
  const lbm::FluidOptions options = stream_options(s);
  coupling::CouplingOptions coupling;
  if (s.resolved) coupling.mapped_wires = {1, s.radius_shift};
  coupling::CoupledStep<Real> step(options, held_wires(s.wires, s.diameter), coupling);
  const Vec3 along = s.direction.normalized(), push = options.gravity * s.cells.cast<double>().prod();
  auto& fluid = *step.fluid();
  fluid.fill_everything([&](const Vec3&) { return Vec3(s.speed * along); }, [](const Vec3&) { return 0.0; });
  const Vec3 start = momentum(fluid);
  const int steps = static_cast<int>(s.travel / s.speed), first = steps * 2 / 3;
  Vec3 given = Vec3::Zero(), mean = Vec3::Zero();
  double exchanged = 0, low = 1e300, high = -1e300, speed = 0;
  int samples = 0;
  // Weight of the displaced liquid under the body force: no part of the drag. The drag law gives it back to the fluid;
  // of a mapped wire the fluid keeps it.
  Vec3 lift = -volume_of(*step.solids()) * options.gravity, kept = Vec3::Zero();
  for (int k = 0; k < steps; ++k) {
    step.advance();
    if (s.resolved && k == 0) kept = lift = -mapped_volume(fluid) * options.gravity;
    const auto& particles = step.solids()->particles();
    Vec3 force = Vec3::Zero();
    for (std::size_t i = 0; i < particles.size(); ++i) force += particles.external_force[i];
    given += force - kept;
    exchanged += force.norm();
    if (k < first) continue;
    const double drag = (force - lift).dot(along);
    low = std::min(low, drag), high = std::max(high, drag);
    mean += (force - lift) / (steps - first);
    if ((steps - 1 - k) % 32 == 0) speed += momentum(fluid).dot(along) / s.cells.cast<double>().prod(), ++samples;
  }
  WireLoad load;
  load.drag = mean.dot(along);
  load.side = (mean - load.drag * along).norm();
  load.spread = (high - low) / load.drag;
  load.speed = speed / samples;
  load.audit = std::max(
      (momentum(fluid) - step.owed_to_wires() - start - (steps * push - given)).norm() / (start.norm() + exchanged),
      step.audit().relative());
  load.cell_updates = fluid.cell_updates();
  load.tau = fluid.tau();
  return load;
}

}  // namespace

dem::Solids held_wires(const std::vector<HeldWire>& wires, double diameter) {
  dem::Particles particles;
  dem::Bonds bonds;
  dem::BondSort sort;
  sort.axial.stiffness = {1e-6, 1e-6, 1e-6};
  sort.bond_radius = diameter / 2;
  bonds.add_sort(sort);
  for (const HeldWire& wire : wires) add_wire(wire, diameter, particles, bonds);
  dem::Materials materials;
  materials.add({"wire", 1e-6, 0.3});
  dem::SolidsOptions options;
  options.gravity = Vec3::Zero();
  options.time_step = 1;
  options.watchdog.overlap_limit = 10;  // wires may cross
  return {std::move(particles), std::move(bonds), std::move(materials), Walls{}, options};
}

WireLoad run_stream(const WireStream& stream, const Context& context) {
  return context.precision == Precision::float32 ? measure<float>(stream) : measure<double>(stream);
}

double cylinder_law(double re) {
  return 1.18 + 6.8 / std::pow(re, 0.89) + 1.96 / std::sqrt(re) - 0.0004 * re / (1 + 3.64e-7 * re * re);
}

WireCoefficient coefficient_of(const WireStream& s, const WireLoad& load, double length, double width) {
  const double raw = load.drag / (0.5 * s.diameter * length * load.speed * load.speed);
  const double seen = load.speed * (1 + raw * s.diameter / (4 * width));
  return {load.drag / (0.5 * s.diameter * length * seen * seen), cylinder_law(s.reynolds * seen / s.speed)};
}

}  // namespace lahar::validate
