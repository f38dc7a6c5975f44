#include "barrier/response.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "dem/bonds/axial_law.h"
#include "dem/bonds/bond_constants.h"

namespace lahar::barrier {

namespace {

/// A spring of this force: F^2 / (2 k).
double spring_energy(double force_squared, double stiffness) {
  return stiffness > 0 ? 0.5 * force_squared / stiffness : 0.0;
}

/// What a bond has dissipated by plastic elongation and, while it is whole, holds: dem::energy_of of this bond but for
/// rounding. Without plastic unloading the axial part comes from the elongation, not from the force.
dem::BondEnergy bond_energy(const dem::Bonds& bonds, std::size_t b) {
  const dem::BondConstants c = dem::constants_of(bonds.sorts[static_cast<std::size_t>(bonds.sort[b])]);
  dem::BondEnergy e;
  if (c.plastic) e.plastic = dem::plastic_work(c.axial, bonds.plastic_elongation[b]);
  if (!bonds.intact[b]) return e;
  e.axial = c.plastic ? spring_energy(bonds.axial_force[b] * bonds.axial_force[b], c.axial.k1)
                      : dem::curve_energy(c.axial, bonds.elongation[b]);
  e.shear = spring_energy(bonds.shear_force[b].squaredNorm(), c.shear_stiffness);
  e.bending = spring_energy(bonds.moment[b].squaredNorm(), c.bending_stiffness);
  e.torsion = spring_energy(bonds.torsion_moment[b] * bonds.torsion_moment[b], c.torsion_stiffness);
  return e;
}

void add_bond(std::size_t b, const dem::Bonds& bonds, ComponentResponse& sum) {
  sum.energy += bond_energy(bonds, b);
  if (!bonds.intact[b]) {
    ++sum.broken_bonds;
    return;
  }
  sum.force_sum += std::hypot(bonds.axial_force[b], bonds.shear_force[b].norm());
  sum.max_tension = std::max(sum.max_tension, bonds.axial_force[b]);
}

void add_bonds(const Wire& wire, const dem::Bonds& bonds, ComponentResponse& sum) {
  for (std::size_t b = wire.first_bond; b < wire.first_bond + wire.bonds; ++b) add_bond(b, bonds, sum);
}

/// What acts on a fixed bead and its anchor takes up; 0 for a free one.
Vec3 anchored(const dem::Particles& particles, dem::ParticleId bead) {
  const dem::ParticleIndex i = particles.index(bead);
  return particles.state[i] == dem::ParticleState::fixed ? particles.force[i] : Vec3::Zero();
}

void add_reactions(const Wire& wire, const dem::Particles& particles, ComponentResponse& sum) {
  const dem::ParticleId end = wire.first_bead + wire.beads;
  sum.start_reaction = anchored(particles, wire.first_bead);
  sum.end_reaction = anchored(particles, end - 1);
  sum.anchor_force = std::max({sum.anchor_force, sum.start_reaction.norm(), sum.end_reaction.norm()});
  for (dem::ParticleId bead = wire.first_bead; bead < end; ++bead) sum.reaction += anchored(particles, bead);
  for (const dem::Rail& rail : particles.rails)
    if (rail.id >= wire.first_bead && rail.id < end) sum.reaction += rail.taken_up;
}

void add_component(const ComponentResponse& part, ComponentResponse& whole) {
  whole.force_sum += part.force_sum;
  whole.max_tension = std::max(whole.max_tension, part.max_tension);
  whole.reaction += part.reaction;
  whole.energy += part.energy;
  whole.broken_bonds += part.broken_bonds;
}

Component component_of(Side side) {
  switch (side) {
    case Side::lower:
      return Component::lower_cable;
    case Side::upper:
      return Component::upper_cable;
    case Side::left:
      return Component::left_cable;
    case Side::right:
      break;
  }
  return Component::right_cable;
}

void add_motion(const Net& net, const dem::Particles& particles, const dem::Bonds& bonds, const Vec3& gravity,
                BarrierResponse& r) {
  const std::vector<bool> holding = holding_beads(net, bonds);
  for (std::size_t k = 0; k < net.beads; ++k) {
    const dem::ParticleIndex i = particles.index(net.first_bead + k);
    const Vec3 moved = particles.position[i] - net.start[k];
    if (holding[k]) r.elongation = std::max(r.elongation, moved.dot(net.normal));
    r.potential_energy -= particles.gravitational_mass[i] * gravity.dot(moved);
    if (particles.state[i] != dem::ParticleState::free) continue;
    r.kinetic_energy += 0.5 * (particles.mass[i] * particles.velocity[i].squaredNorm() +
                               particles.inertia[i] * particles.angular_velocity[i].squaredNorm());
  }
}

}  // namespace

std::string_view name(Component component) {
  constexpr std::array<std::string_view, static_cast<std::size_t>(Component::first_element)> names{
      "lower_cable", "upper_cable", "left_cable", "right_cable", "rings", "mesh", "posts"};
  const auto number = static_cast<std::size_t>(component);
  if (number < names.size()) return names[number];
  return component == Component::barrier ? "barrier" : Elements::components[number - names.size()];
}

bool is_reported(Component component, const Net& net) {
  if (component == Component::mesh) return !net.meshes.empty();
  if (component == Component::posts) return !net.posts.empty();
  for (std::size_t kind = 0; kind < Elements::components.size(); ++kind)
    if (component == component_of_kind(kind)) return kind < net.elements.size() && !net.elements[kind].empty();
  return true;
}

double dissipator_elongation(const Net& net, const dem::Bonds& bonds, std::size_t k) {
  return bonds.elongation[net.dissipators[k]];
}

std::vector<bool> holding_beads(const Net& net, const dem::Bonds& bonds) {
  std::vector<bool> holding(net.beads, true);
  const auto is_broken = [&](std::size_t b) { return bonds.intact[b] == 0; };
  const auto look_at = [&](const Wire& wire) {
    if (is_whole(wire, bonds)) return;
    for (dem::ParticleId bead = wire.first_bead; bead < wire.first_bead + wire.beads; ++bead)
      holding[bead - net.first_bead] = false;
  };
  for (const Wire& ring : net.rings) look_at(ring);
  for (const Wire& cable : net.cables) look_at(cable);
  for (const auto& kind : net.elements)
    for (const Wire& wire : kind) look_at(wire);
  for (const MeshPart& mesh : net.meshes)
    for (std::size_t b = mesh.first_bond; b < mesh.first_bond + mesh.bonds; ++b)
      if (is_broken(b)) holding[bonds.id_i[b] - net.first_bead] = holding[bonds.id_j[b] - net.first_bead] = false;
  return holding;
}

BarrierResponse response(const Net& net, const dem::Particles& particles, const dem::Bonds& bonds,
                         const Vec3& gravity) {
  require(net.first_bead + net.beads <= particles.size() && net.first_bond + net.bonds <= bonds.size(),
          "response: these are not the net's particles and bonds");
  BarrierResponse r;
  const auto part = [&](Component c) -> ComponentResponse& { return r.components[static_cast<std::size_t>(c)]; };
  for (std::size_t k = 0; k < net.cables.size(); ++k) {
    add_bonds(net.cables[k], bonds, part(component_of(net.cable_sides[k])));
    add_reactions(net.cables[k], particles, part(component_of(net.cable_sides[k])));
  }
  for (const Wire& ring : net.rings) add_bonds(ring, bonds, part(Component::rings));
  for (const MeshPart& mesh : net.meshes)
    for (std::size_t b = mesh.first_bond; b < mesh.first_bond + mesh.bonds; ++b)
      add_bond(b, bonds, part(Component::mesh));
  for (const Post& post : net.posts) {
    add_bonds(post.wire, bonds, part(Component::posts));
    // What the links of a joint bear is the foot's load, by the way in which each happens to lie.
    for (const std::size_t b : post.joint) part(Component::posts).energy += bond_energy(bonds, b);
    const Vec3 reaction = foot_reaction(post, particles);
    part(Component::posts).reaction -= reaction;
    part(Component::posts).anchor_force = std::max(part(Component::posts).anchor_force, reaction.norm());
    part(Component::posts).anchor_moment =
        std::max(part(Component::posts).anchor_moment, foot_moment(post, particles).norm());
  }
  for (std::size_t kind = 0; kind < net.elements.size(); ++kind)
    for (const Wire& wire : net.elements[kind]) {
      add_bonds(wire, bonds, part(component_of_kind(kind)));
      add_reactions(wire, particles, part(component_of_kind(kind)));
    }
  for (const std::size_t b : net.ties) add_bond(b, bonds, part(Component::barrier));
  for (const Component c : all_components)
    if (c != Component::barrier) add_component(part(c), part(Component::barrier));
  add_motion(net, particles, bonds, gravity, r);
  for (std::size_t k = 0; k < net.dissipators.size(); ++k)
    r.largest_dissipator_elongation = std::max(r.largest_dissipator_elongation, dissipator_elongation(net, bonds, k));
  return r;
}

}  // namespace lahar::barrier
