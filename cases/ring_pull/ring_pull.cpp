#include "cases/ring_pull/ring_pull.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "barrier/ring.h"
#include "core/check.h"
#include "dem/solids.h"
#include "dem/time_step.h"

namespace lahar::cases {

namespace {

using std::numbers::pi;

double radius(const RingPull& r) { return r.perimeter / (2 * pi); }

/// The beads that are held and pulled.
struct Ends {
  dem::ParticleIndex held, pulled;
};

dem::Solids build(const RingPull& ring, Ends& ends) {
  dem::Materials materials;
  const int wire = materials.add({"wire", ring.youngs_modulus, ring.poisson_ratio});
  materials.set_pair(wire, wire, 0, 1);
  dem::BondSort sort;
  sort.axial.stiffness = {ring.normal_stiffness, ring.normal_stiffness, ring.normal_stiffness};
  sort.shear_stiffness = ring.shear_stiffness;
  sort.bond_radius = ring.bond_radius;
  sort.damping_ratio = ring.damping_ratio;

  dem::Particles particles;
  dem::Bonds bonds;
  const barrier::RingShape shape{ring.perimeter / pi, static_cast<int>(ring.beads), 0, 0};
  const barrier::Wire wire_of_ring = barrier::add_ring(shape, {}, {ring.bead_diameter(), ring.density, wire},
                                                       bonds.add_sort(sort), 0, particles, bonds);
  ends = {wire_of_ring.first_bead + wire_of_ring.beads / 2, wire_of_ring.first_bead};  // at x = -R and x = R
  for (const dem::ParticleIndex end : {ends.held, ends.pulled}) {
    particles.state[end] = dem::ParticleState::fixed;
    particles.inverse_mass[end] = 0;
  }
  dem::SolidsOptions options;
  options.gravity = Vec3::Zero();  // it would pull with a thousandth of the first force
  // The strands close up beside the held bead until its neighbours all but coincide; 5 MPa is meant to let them.
  options.watchdog.overlap_limit = 2;
  options.time_step = ring.safety * dem::bond_time_step(bonds, particles);
  return {std::move(particles), std::move(bonds), std::move(materials), Walls{}, options};
}

}  // namespace

RingPull RingPull::scaled() const {
  RingPull ring = *this;
  const double finer = static_cast<double>(beads) / static_cast<double>(reference_beads);
  ring.normal_stiffness *= finer;
  ring.shear_stiffness *= finer;
  ring.density *= finer * finer;  // a bead has 1 / finer^3 of the volume, and there are `finer` times as many
  ring.reference_beads = beads;
  return ring;
}

WireStiffness wire_stiffness(const RingPull& unscaled) {
  const RingPull ring = unscaled.scaled();
  const double area = pi * ring.bond_radius * ring.bond_radius, length = ring.bead_diameter();
  return {ring.normal_stiffness * area * length,
          ring.normal_stiffness * 0.25 * area * ring.bond_radius * ring.bond_radius * length,
          ring.shear_stiffness * area * length};
}

double first_stiffness(const RingPull& ring) {
  const WireStiffness wire = wire_stiffness(ring);
  const double r = radius(ring);
  return 1 / ((pi / 4 - 2 / pi) * r * r * r / wire.bending + pi / 4 * r / wire.shear + pi / 4 * r / wire.axial);
}

double last_stiffness(const RingPull& ring) { return 2 * wire_stiffness(ring).axial / (ring.perimeter / 2); }

double straight_displacement(const RingPull& ring) { return ring.perimeter / 2 - 2 * radius(ring); }

double PullCurve::force_at(double d) const {
  const auto above = std::lower_bound(displacement.begin(), displacement.end(), d);
  if (above == displacement.begin()) return force.front() * d / displacement.front();
  if (above == displacement.end()) return force.back();
  const auto k = static_cast<std::size_t>(above - displacement.begin());
  const double t = (d - displacement[k - 1]) / (displacement[k] - displacement[k - 1]);
  return force[k - 1] + t * (force[k] - force[k - 1]);
}

double PullCurve::slope(double from, double to) const { return (force_at(to) - force_at(from)) / (to - from); }

bool as_in_paper(const RingPull& ring) {
  const RingPull paper;
  RingPull as_paper = ring;
  as_paper.stroke = paper.stroke, as_paper.samples = paper.samples, as_paper.safety = paper.safety;
  return as_paper == paper;
}

void check(const RingPull& ring, scene::Findings& findings) {
  if (ring.beads % 2 != 0)
    return findings.mistake("ring.beads",
                            "ring.beads is odd, expected an even number: the pulled bead lies opposite the held one");
  Ends ends{};
  const double in_a_step = ring.speed * build(ring.scaled(), ends).options().time_step;
  if (const double apart = ring.stroke / static_cast<double>(ring.samples); in_a_step > apart)
    findings.mistake("loading.speed_m_s",
                     fmt::format("loading.speed_m_s is {:g}, {:.2g} m in a time step, and loading.samples asks for one "
                                 "every {:.2g} m, expected a lower speed or fewer samples",
                                 ring.speed, in_a_step, apart));
}

PullCurve pull_ring(const RingPull& unscaled, const std::function<bool()>& go_on) {
  scene::Findings findings("ring_pull");
  check(unscaled, findings);
  findings.raise();
  const RingPull ring = unscaled.scaled();
  Ends ends{};
  dem::Solids solids = build(ring, ends);
  const double dt = solids.options().time_step;
  const double start_up = 0.05 * ring.stroke / ring.speed;  // s, in which the speed rises evenly

  PullCurve curve;
  curve.time_step = dt;
  double pulled = 0, time = 0;
  dem::BondEnergy energy;  // none at rest
  for (std::int64_t k = 1; k <= ring.samples && !curve.interrupted; ++k) {
    const double until = ring.stroke * static_cast<double>(k) / static_cast<double>(ring.samples), from = pulled;
    double work = 0, anchor = 0, moment = 0;  // integrals over the way: of forces, of the time
    while (pulled < until) {
      const double speed = ring.speed * std::min(1.0, (time + 0.5 * dt) / start_up);
      solids.particles().velocity.set(ends.pulled, Vec3(speed, 0, 0));
      const double before = -solids.particles().force.x[ends.pulled];
      solids.step();
      work += 0.5 * (before - solids.particles().force.x[ends.pulled]) * speed * dt;
      anchor += solids.particles().force.x[ends.held] * speed * dt;
      moment += (time + 0.5 * dt) * speed * dt;
      pulled += speed * dt;
      time += dt;
    }
    const dem::BondEnergy former = std::exchange(energy, solids.bond_energy());
    curve.time.push_back(moment / (pulled - from));
    curve.displacement.push_back(0.5 * (from + pulled));
    curve.force.push_back(work / (pulled - from));
    curve.anchor_force.push_back(anchor / (pulled - from));
    curve.axial.push_back(0.5 * (former.axial + energy.axial));
    curve.shear.push_back(0.5 * (former.shear + energy.shear));
    curve.bending.push_back(0.5 * (former.bending + energy.bending));
    curve.work += work;
    curve.interrupted = !go_on();
  }
  curve.steps = solids.step_count();
  // The pulled bead's own motion is prescribed: its kinetic energy is no work of the ring.
  const double own = 0.5 * solids.particles().mass[ends.pulled] * ring.speed * ring.speed;
  curve.ledger_gap = solids.ledger().total() - own - curve.work;
  return curve;
}

Transition transition_of(const PullCurve& curve, const RingPull& ring) {
  Transition t;
  const double first = first_stiffness(ring);
  for (std::size_t k = 1; k < curve.force.size() && t.tenfold_tangent == 0; ++k) {
    const double step = curve.displacement[k] - curve.displacement[k - 1];
    if ((curve.force[k] - curve.force[k - 1]) / step >= 10 * first)
      t.tenfold_tangent = 0.5 * (curve.displacement[k] + curve.displacement[k - 1]);
  }
  for (std::size_t k = 0; k < curve.force.size() && t.half_axial == 0; ++k)
    if (curve.axial[k] >= curve.shear[k] + curve.bending[k]) t.half_axial = curve.displacement[k];
  const double end = curve.displacement.back(), last = curve.slope(0.97 * end, end);
  t.tangents_cross = (last * end - curve.force.back()) / (last - first);
  return t;
}

}  // namespace lahar::cases
