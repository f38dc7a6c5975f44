#include "cases/assembly/drawn_out_dissipators.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "barrier/wire.h"
#include "cases/assembly/estimates.h"
#include "cases/assembly/net_spec.h"
#include "dem/bonds/axial_law.h"
#include "dem/time_step.h"

namespace lahar::cases {
namespace {

bool is_dissipator(const dem::Bonds& bonds, std::size_t bond) {
  return std::isfinite(bonds.sorts[static_cast<std::size_t>(bonds.sort[bond])].axial.force_limit[0]);
}

dem::AxialCurve curve_of(const barrier::RingNetSpec& spec) {
  const dem::BondSort sort = barrier::with_wire_radius(spec.dissipator, spec.wire_diameter);
  return dem::axial_curve(sort.axial, std::numbers::pi * sort.bond_radius * sort.bond_radius);
}

/// Two dissipators side by side in a cable without a fixed bead: no barrier asks for a shorter step.
DrawnOutDissipators in_free_cable(const barrier::RingNetSpec& spec) {
  dem::Particles particles;
  dem::Bonds bonds;
  barrier::WireSpec cable;
  cable.properties = spec.bead_properties();
  cable.sort = bonds.add_sort(barrier::with_wire_radius(spec.cable, spec.wire_diameter));
  cable.dissipator_sort = bonds.add_sort(barrier::with_wire_radius(spec.dissipator, spec.wire_diameter));
  cable.dissipator_bonds = {1, 2};
  for (int k = 0; k < 5; ++k) cable.line.points.push_back(Vec3(k * spec.wire_diameter, 0, 0));
  barrier::add_wire(cable, particles, bonds);
  return {cable.dissipator_bonds, particles, bonds};
}

DrawnOutDissipators as_built(const scene::Scene& scene) {
  dem::Particles particles;
  dem::Bonds bonds;
  const barrier::Net net = scene::build_barrier(scene, particles, bonds);
  return {net.dissipators, particles, bonds};
}

}  // namespace

DrawnOutDissipators::HeldBead DrawnOutDissipators::held_bead(dem::ParticleIndex bead, const dem::Particles& particles,
                                                             const dem::Bonds& bonds) {
  HeldBead held;
  held.bonds.sorts = bonds.sorts;
  const auto add = [&](dem::ParticleIndex i, double x) {
    const auto id = held.particles.add({.position = Vec3(x, 0, 0), .radius = particles.radius[i], .density = 1});
    held.particles.inverse_mass[id] = particles.inverse_mass[i];
    held.particles.inertia[id] = particles.inertia[i];
    return id;
  };
  const dem::ParticleId middle = add(bead, 0);
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    if (bonds.i[b] != bead && bonds.j[b] != bead) continue;
    const dem::ParticleIndex other = bonds.i[b] == bead ? bonds.j[b] : bonds.i[b];
    held.bonds.add({middle, add(other, bonds.rest_length[b]), bonds.sort[b]}, held.particles);
  }
  return held;
}

DrawnOutDissipators::DrawnOutDissipators(const std::vector<std::size_t>& dissipators, const dem::Particles& particles,
                                         const dem::Bonds& bonds) {
  std::set<dem::ParticleIndex> ends;
  for (const std::size_t b : dissipators) ends.insert({bonds.i[b], bonds.j[b]});
  for (const dem::ParticleIndex bead : ends)
    if (particles.inverse_mass[bead] > 0) beads_.push_back(held_bead(bead, particles, bonds));
}

double DrawnOutDissipators::time_step(double elongation) const {
  double least = std::numeric_limits<double>::infinity();
  for (const HeldBead& held : beads_) {
    dem::Particles drawn_out = held.particles;
    for (std::size_t b = 0; b < held.bonds.size(); ++b)
      if (is_dissipator(held.bonds, b)) drawn_out.position.add(b + 1, Vec3(elongation, 0, 0));
    least = std::min(least, dem::bond_time_step(held.bonds, drawn_out));
  }
  return least;
}

double DrawnOutDissipators::elongation(double time_step, double furthest) const {
  if (this->time_step(furthest) >= time_step) return furthest;
  double holds = 0, fails = furthest;
  for (int k = 0; k < 50; ++k) {
    const double middle = 0.5 * (holds + fails);
    (this->time_step(middle) >= time_step ? holds : fails) = middle;
  }
  return holds;
}

double activation_elongation(const scene::Scene& scene) { return curve_of(scene::make_net_spec(scene)).e1; }

std::optional<DrawnOutLimit> early_limit(const scene::Scene& scene, double time_step) {
  if (!can_be_tried(scene) || scene.barrier.bonds.dissipator_stiffness.empty()) return std::nullopt;
  const barrier::RingNetSpec spec = scene::make_net_spec(scene);
  const dem::AxialCurve curve = curve_of(spec);
  DrawnOutLimit limit;
  limit.further = curve.e1 + spec.wire_diameter, limit.far = curve.e1 + 10 * spec.wire_diameter;
  const auto is_early = [&](const DrawnOutDissipators& dissipators) {
    limit.elongation = dissipators.elongation(time_step, limit.further);
    limit.force = dem::curve_force(curve, limit.elongation);
    return limit.elongation < limit.further && limit.force < 2 * curve.f1;
  };
  if (!is_early(in_free_cable(spec))) return std::nullopt;  // saves building large barriers
  const DrawnOutDissipators dissipators = as_built(scene);
  if (!is_early(dissipators) || dissipators.time_step(0) < time_step) return std::nullopt;
  limit.step_for_further = dissipators.time_step(limit.further);
  limit.step_for_far = dissipators.time_step(limit.far);
  return limit;
}

double bond_safety_for(const scene::Scene& scene, double time_step) {
  const SolidsLimits limits = solids_limits(scene);
  return two_digits_down(time_step / std::min({limits.ring_bond, limits.cable_bond, limits.post_bond}));
}

double two_digits_down(double number) {
  const double last_digit = std::pow(10.0, std::floor(std::log10(number)) - 1);
  return std::floor(number / last_digit) * last_digit;
}

}  // namespace lahar::cases
