#include "cases/assembly/net_spec.h"

#include <algorithm>

namespace lahar::scene {
namespace {

dem::BondSort wire(const Scene& scene, double stiffness) {
  dem::BondSort sort =
      barrier::wire_bond(stiffness * scene.solids.bond_stiffness_scale, scene.barrier.net.wire_diameter / 2);
  sort.damping_ratio = scene.solids.bond_damping_ratio;
  return sort;
}

/// With the strengths of a scene, Pa, where 0 is none.
dem::BondSort breakable(dem::BondSort sort, double tensile_strength, double shear_strength) {
  if (tensile_strength > 0) sort.tensile_strength = tensile_strength;
  if (shear_strength > 0) sort.shear_strength = shear_strength;
  return sort;
}

/// Two or three stages; a stage that is not given continues the one before. Force limits are not scaled.
dem::BondSort dissipator(const Scene& scene) {
  const BarrierBonds& bonds = scene.barrier.bonds;
  dem::BondSort sort = wire(scene, bonds.dissipator_stiffness.front());
  for (std::size_t stage = 1; stage < 3; ++stage) {
    const std::size_t given = std::min(stage, bonds.dissipator_stiffness.size() - 1);
    sort.axial.stiffness[stage] = bonds.dissipator_stiffness[given] * scene.solids.bond_stiffness_scale;
  }
  std::copy(bonds.dissipator_force_limit.begin(), bonds.dissipator_force_limit.end(), sort.axial.force_limit.begin());
  sort.axial.plastic_unloading = bonds.plastic_unloading;
  return sort;
}

barrier::CableSupport support(const Scene& scene, std::vector<double> fixed_at) {
  const bool braked = !scene.barrier.bonds.dissipator_stiffness.empty();
  return {.fixed_at = std::move(fixed_at),
          .fixed_all = false,
          .dissipators_at = braked ? scene.barrier.bonds.dissipator_places : std::vector<double>{}};
}

barrier::CableSupport bottom_support(const Scene& scene) {
  switch (scene.barrier.anchors.bottom_cable) {
    case BottomCable::at_places:
      break;
    case BottomCable::along_bed:
      return {.fixed_at = {0, 1}, .fixed_all = false, .dissipators_at = {}, .held_across = true};
    case BottomCable::fixed:
      return {.fixed_at = {}, .fixed_all = true, .dissipators_at = {}};
  }
  return support(scene, scene.barrier.anchors.cable_places);
}

barrier::WireLaw wire_law(const Scene& scene, const std::vector<double>& strain, const std::vector<double>& force) {
  barrier::WireLaw law;
  std::copy_n(strain.begin(), std::min(strain.size(), law.strain.size()), law.strain.begin());
  std::copy_n(force.begin(), std::min(force.size(), law.force.size()), law.force.begin());
  for (double& e : law.strain) e /= scene.solids.bond_stiffness_scale;
  return law;
}

barrier::HexagonalMesh mesh_of(const Scene& scene) {
  const Net& net = scene.barrier.net;
  barrier::HexagonalMesh mesh;
  mesh.mesh_width = net.mesh_width, mesh.mesh_height = net.mesh_height, mesh.twist_length = net.twist_length;
  mesh.wire_diameter = net.mesh_wire_diameter, mesh.wire_density = net.density, mesh.node_diameter = net.node_diameter;
  mesh.single = wire_law(scene, net.single_strain, net.single_force);
  mesh.twist = wire_law(scene, net.twist_strain, net.twist_force);
  mesh.plastic_unloading = net.wires_unload_plastically;
  mesh.damping_ratio = scene.solids.bond_damping_ratio;
  return mesh;
}

/// Of the net's plane, down the flow (x) whichever way the width runs. A net along the flow has the normal of its axes.
Vec3 flow_side_normal(const Vec3& across, const Vec3& up) {
  const Vec3 normal = across.cross(up);
  constexpr double rounding = 1e-9;
  return normal.x() < -rounding ? Vec3(-normal) : normal;
}

}  // namespace

barrier::RingNetSpec make_net_spec(const Scene& scene) {
  const Net& net = scene.barrier.net;
  const Anchors& anchors = scene.barrier.anchors;
  barrier::RingNetSpec spec;
  spec.origin = net.origin;
  spec.across = net.width_direction.normalized();
  spec.up = net.height_direction.normalized();
  spec.normal = flow_side_normal(spec.across, spec.up);
  spec.width = net.width;
  spec.height = net.height;
  if (net.kind == NetKind::hexagonal) spec.mesh = mesh_of(scene);
  spec.ring_diameter = net.ring_diameter;
  spec.ring_pitch = net.ring_pitch;
  spec.beads_per_ring = static_cast<int>(net.beads_per_ring);
  spec.wire_diameter = net.wire_diameter;
  spec.density = net.density;
  spec.bead_mass_scale = net.bead_mass_scale;
  spec.bead_inertia_scale = net.bead_inertia_scale;
  spec.material = material_index(scene, net.material);
  const BarrierBonds& bonds = scene.barrier.bonds;
  spec.ring = breakable(wire(scene, bonds.ring_stiffness), bonds.ring_tensile_strength, bonds.ring_shear_strength);
  spec.cable = breakable(wire(scene, bonds.cable_stiffness), bonds.cable_tensile_strength, bonds.cable_shear_strength);
  if (!bonds.dissipator_stiffness.empty()) spec.dissipator = dissipator(scene);
  spec.upper.support = support(scene, anchors.cable_places);
  spec.lower.support = bottom_support(scene);
  std::vector<double> lateral = anchors.cable_places;
  if (anchors.lateral_cable_middles_fixed) lateral.push_back(0.5);
  std::ranges::sort(lateral);
  spec.left.support = spec.right.support = support(scene, lateral);
  return spec;
}

barrier::SpansSpec make_spans_spec(const Scene& scene) {
  const Posts& posts = scene.barrier.posts;
  barrier::SpansSpec spec;
  spec.net = make_net_spec(scene);
  spec.spans = static_cast<int>(posts.spans);
  spec.post_height = posts.height;
  spec.post_diameter = posts.diameter;
  spec.section = {posts.youngs_modulus * scene.solids.bond_stiffness_scale, posts.area, posts.second_moment,
                  posts.density, scene.solids.bond_damping_ratio};
  spec.foot = posts.foot;
  spec.elements = posts.elements;
  return spec;
}

barrier::Net build_barrier(const Scene& scene, dem::Particles& particles, dem::Bonds& bonds) {
  if (scene.barrier.posts.enabled) return barrier::build_spans(make_spans_spec(scene), particles, bonds);
  return barrier::build_net(make_net_spec(scene), particles, bonds);
}

}  // namespace lahar::scene
