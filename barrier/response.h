#pragma once
// What a barrier does under load: forces, elongation and energy of its parts. Only looks; changes nothing.
#include <array>
#include <string_view>
#include <vector>

#include "barrier/elements.h"
#include "barrier/net.h"
#include "dem/bonds/bond_forces.h"

namespace lahar::barrier {

/// Parts that are reported by name; one for each kind of element from `first_element` on.
enum class Component {
  lower_cable,
  upper_cable,
  left_cable,
  right_cable,
  rings,
  mesh,
  posts,
  first_element,
  barrier = first_element + static_cast<int>(Elements::components.size())
};
inline constexpr auto all_components = [] {
  std::array<Component, static_cast<std::size_t>(Component::barrier) + 1> all{};
  for (std::size_t c = 0; c < all.size(); ++c) all[c] = static_cast<Component>(c);
  return all;
}();
/// The component of a kind of element.
[[nodiscard]] constexpr Component component_of_kind(std::size_t kind) {
  return static_cast<Component>(static_cast<std::size_t>(Component::first_element) + kind);
}
[[nodiscard]] std::string_view name(Component component);
/// Whether results tell of it: meshes, posts and elements only where there are any, all else always.
[[nodiscard]] bool is_reported(Component component, const Net& net);

struct ComponentResponse {
  double force_sum = 0;    ///< N, sum over intact bonds of the force's magnitude (axial and shear): the paper's "force
                           ///< of a cable"; grows with the number of beads
  double max_tension = 0;  ///< N, largest axial tension of a bond, 0 if none is stretched
  Vec3 start_reaction = Vec3::Zero();  ///< N, that the anchors at a cable's two ends must hold; 0 if not fixed
  Vec3 end_reaction = Vec3::Zero();
  Vec3 reaction = Vec3::Zero();  ///< N, that all anchors of the component must hold, and the bed under a held cable
  double anchor_force = 0;       ///< N, largest of a single anchor of an element, of a single foot of a post
  double anchor_moment = 0;      ///< Nm, largest about a single foot of a post
  dem::BondEnergy energy;  ///< J: the elastic parts and `plastic`; damping and breakage are not told apart by component
  int broken_bonds = 0;
};

struct BarrierResponse {
  std::array<ComponentResponse, all_components.size()> components;  ///< by Component; cables that the net lacks are 0
  double elongation = 0;        ///< m, largest displacement along the flow since the net was built, of holding beads
  double kinetic_energy = 0;    ///< J, with rotation
  double potential_energy = 0;  ///< J, in gravity since the net was built
  double largest_dissipator_elongation = 0;  ///< m
  [[nodiscard]] const ComponentResponse& operator[](Component c) const {
    return components[static_cast<std::size_t>(c)];
  }
};

/// By bead, in the order of the net: false for those of a wire of which a bond is broken, and for nodes of a mesh at a
/// broken bond. They may fly off.
[[nodiscard]] std::vector<bool> holding_beads(const Net& net, const dem::Bonds& bonds);

/// The response as of the last force evaluation. gravity in m/s^2.
[[nodiscard]] BarrierResponse response(const Net& net, const dem::Particles& particles, const dem::Bonds& bonds,
                                       const Vec3& gravity = {0, 0, -9.81});

/// Elongation of the k-th dissipator of net.dissipators, m.
[[nodiscard]] double dissipator_elongation(const Net& net, const dem::Bonds& bonds, std::size_t k);

}  // namespace lahar::barrier
