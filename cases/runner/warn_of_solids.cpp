#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "barrier/ring.h"
#include "cases/assembly/drawn_out_dissipators.h"
#include "cases/assembly/grain_sizes.h"
#include "cases/runner/warnings_by_part.h"
#include "cases/scene/value.h"

namespace lahar::cases {
namespace {

using scene::string_text;

/// Faces of the domain hold the liquid alone: grains need a plane that faces inwards, or a box on the face. What
/// terrain and meshes hold cannot be told; cylinders and spheres hold nothing back.
void add_leaks(const scene::Scene& s, Warnings& list) {
  const auto guards = [&](const scene::WallSettings& w, const Vec3& inwards, int axis, double at) {
    if (w.shape == scene::WallShape::plane) return w.normal.normalized().dot(inwards) > 0.05;
    if (w.shape != scene::WallShape::box)
      return w.shape == scene::WallShape::heightmap || w.shape == scene::WallShape::mesh;
    return w.lower[axis] <= at + 1e-6 && w.upper[axis] >= at - 1e-6;
  };
  std::string faces;
  for (int face = 0; face < 5; ++face) {  // not the top
    const int axis = face / 2;
    const bool upper = face % 2 == 1;
    if (s.domain.open(static_cast<scene::Face>(face)) || s.domain.periodic(static_cast<scene::Axis>(axis))) continue;
    Vec3 inwards = Vec3::Zero();
    inwards[axis] = upper ? -1 : 1;
    const double at = (upper ? s.domain.upper : s.domain.lower)[axis];
    if (std::none_of(s.walls.begin(), s.walls.end(), [&](const auto& w) { return guards(w, inwards, axis, at); }))
      faces += fmt::format("{}{}{}", faces.empty() ? "" : ", ", "xyz"[axis], upper ? '+' : '-');
  }
  if (!faces.empty())
    list.push_back("faces of the domain hold liquid, not grains, which are lost through those without a [[wall]]: " +
                   faces);
}

/// A grain that sinks into the ground under its own weight: its modulus is not in Pa, or its stiffness not in N/m.
void add_soft_grains(const scene::Scene& s, Warnings& list) {
  const auto look = [&](const std::string& name, double diameter, double density) {
    const auto m =
        std::find_if(s.materials.begin(), s.materials.end(), [&](const auto& one) { return one.name == name; });
    if (m == s.materials.end()) return false;
    const double radius = diameter / 2, modulus = s.solids.contact_modulus_scale * m->youngs_modulus /
                                                  (2 * (1 - m->poisson_ratio * m->poisson_ratio));
    const double weight = density * std::numbers::pi / 6 * std::pow(diameter, 3) * s.gravity.magnitude;
    const auto* linear = std::get_if<dem::LinearSpringDashpot>(&s.solids.contact_law);
    const double sunk = (linear ? weight / linear->normal_stiffness
                                : std::pow(0.75 * weight / (modulus * std::sqrt(radius)), 2.0 / 3)) /
                        radius;
    constexpr double bearable = 0.05;
    if (sunk > bearable)
      list.push_back(
          fmt::format("grains of {} sink into each other by {:.2g} of a radius under their own weight: {} is small",
                      string_text(name), sunk,
                      linear ? fmt::format("solids.normal_stiffness_N_m of {:g} N/m", linear->normal_stiffness)
                             : fmt::format("youngs_modulus_Pa of {:g} Pa", m->youngs_modulus)));
    return sunk > bearable;
  };
  for (std::size_t i = 0; i < s.grains.packings.size(); ++i)
    for (const scene::GrainSize& size : scene::grain_sizes(s, i))
      if (look(size.material, size.diameter, size.density)) return;
  for (const scene::GrainSphere& sphere : s.grains.spheres)
    if (look(sphere.material, sphere.diameter, sphere.density)) return;
}

/// Wires weigh little on each other: what tells a modulus that is not in Pa is its size.
void add_soft_wires(const scene::Scene& s, Warnings& list) {
  constexpr double softest = 1e6;  // Pa, rubber
  if (std::holds_alternative<dem::LinearSpringDashpot>(s.solids.contact_law)) return;
  for (const auto& m : s.materials)
    if (m.name == s.barrier.net.material && s.solids.contact_modulus_scale * m.youngs_modulus < softest)
      list.push_back(fmt::format("wires of {} are softer than rubber: youngs_modulus_Pa of {:g} Pa is small",
                                 string_text(m.name), m.youngs_modulus));
}

void add_barrier(const scene::Scene& s, Warnings& list) {
  const scene::Posts& posts = s.barrier.posts;
  if (posts.enabled && posts.foot == scene::FootJoint::hinged && posts.elements.of<barrier::RetainingCable>().empty())
    list.push_back("posts are hinged, and no [[barrier.posts.retaining]] holds them");
  if (!posts.enabled && s.barrier.anchors.cable_places.empty())
    list.push_back(fmt::format(
        "barrier.anchors.cable_places is empty: no end of {} is fixed",
        s.barrier.anchors.bottom_cable == scene::BottomCable::at_places ? "a cable" : "a cable but the bottom one"));
  const scene::Net& net = s.barrier.net;
  if (net.kind == scene::NetKind::hexagonal && net.node_diameter < net.mesh_wire_diameter)
    list.push_back(
        fmt::format("barrier.net.node_diameter_m ({:g} m) is less than the diameter of the wires that meet "
                    "there ({:g} m)",
                    net.node_diameter, net.mesh_wire_diameter));
}

/// Beads of a ring that overlap press on each other from the moment when the bond between them breaks.
void add_breaking_rings(const scene::Scene& s, Warnings& list) {
  const scene::Net& net = s.barrier.net;
  const scene::BarrierBonds& bonds = s.barrier.bonds;
  if (net.kind != scene::NetKind::rings || (bonds.ring_tensile_strength == 0 && bonds.ring_shear_strength == 0)) return;
  const auto apart = [&](std::int64_t beads) {
    return barrier::bead_spacing({net.ring_diameter, static_cast<int>(beads)}) / net.wire_diameter;
  };
  constexpr double rounding = 0.005;
  std::int64_t most = net.beads_per_ring;
  while (most > 8 && apart(most) < 1 - rounding) --most;
  if (most < net.beads_per_ring)
    list.push_back(
        fmt::format("barrier.net.beads_per_ring is {}: beads stand {:.2f} diameters apart, and where a ring breaks "
                    "they press apart, which makes energy (bonds_lost_J falls); {} do not overlap",
                    net.beads_per_ring, apart(net.beads_per_ring), most));
}

std::set<std::string> materials_in_use(const scene::Scene& s) {
  std::set<std::string> names;
  for (const auto& w : s.walls) names.insert(w.material);
  for (const auto& p : s.grains.packings) {
    for (const auto& g : p.sizes) names.insert(g.material);
    for (const auto& g : p.log_normal) names.insert(g.material);
    for (const auto& g : p.sieved) names.insert(g.material);
  }
  for (const auto& g : s.grains.spheres) names.insert(g.material);
  if (s.barrier.enabled) names.insert(s.barrier.net.material);
  return names;
}

/// Materials of things that move: walls do not touch each other.
bool only_walls(const scene::Scene& s, const std::string& a) {
  const auto is = [&](const auto& thing) { return thing.material == a; };
  for (const auto& p : s.grains.packings)
    if (std::any_of(p.sizes.begin(), p.sizes.end(), is) || std::any_of(p.log_normal.begin(), p.log_normal.end(), is) ||
        std::any_of(p.sieved.begin(), p.sieved.end(), is))
      return false;
  if (std::any_of(s.grains.spheres.begin(), s.grains.spheres.end(), is)) return false;
  return !(s.barrier.enabled && s.barrier.net.material == a);
}

/// A time step that was asked for; one of Lahar's own is held against it as the scene is read.
void add_step_of_barrier(const scene::Scene& s, double time_step, Warnings& list) {
  const double limit = limit_as_built(s);
  if (time_step <= limit) return;
  list.push_back(
      fmt::format("the time step of particles ({:.3g} s) is above what the bonds of the barrier as built "
                  "allow ({:.3g} s)",
                  time_step, limit));
}

/// A run stops where its step no longer holds for dissipators that are drawn out: told where that comes early
/// (drawn_out_dissipators.h).
void add_drawn_out(const scene::Scene& s, double time_step, Warnings& list) {
  const std::optional<DrawnOutLimit> limit = early_limit(s, time_step);
  if (!limit) return;
  const bool asked_for = s.solids.time_step > 0;
  const auto remedy = [&](double step) { return asked_for ? two_digits_down(step) : bond_safety_for(s, step); };
  list.push_back(fmt::format(
      "the time step of particles ({:.3g} s) holds until a dissipator is drawn out by {:.2g} m, at {:.4g} N, where the "
      "run stops; {} of {:.2g} would do up to {:.2g} m, of {:.2g} up to {:.2g} m",
      time_step, limit->elongation, limit->force, asked_for ? "solids.time_step_s" : "solids.bond_safety",
      remedy(limit->step_for_further), limit->further, remedy(limit->step_for_far), limit->far));
}

/// Where particles of both rates would have the same step.
void add_two_rates(const scene::Scene& s, double time_step, Warnings& list) {
  if (!s.solids.two_rates || long_step_of(s) > 1) return;
  const std::string what = "solids.two_rates changes nothing";
  const double grains = s.fluid.enabled && s.barrier.enabled ? grain_time_step(s) : 0;
  if (!std::isfinite(grains) || grains <= 0)
    list.push_back(what + " without fluid, grains and a barrier");
  else if (grains < 2 * time_step)
    list.push_back(fmt::format("{}: the grains' own step ({:.3g} s) is less than twice that of the beads ({:.3g} s)",
                               what, grains, time_step));
  else
    list.push_back(what + ": a step of the fluid is one of the particles");
}

/// Shares of limits, where the step is given.
void add_safeties(const scene::Scene& s, Warnings& list) {
  const scene::Solids usual;
  if (s.solids.time_step == 0) return;
  if (s.solids.bond_safety != usual.bond_safety)
    list.emplace_back("solids.bond_safety changes nothing with solids.time_step_s");
  if (s.solids.contact_safety != usual.contact_safety && long_step_of(s) == 1)
    list.emplace_back("solids.contact_safety changes nothing with solids.time_step_s");
}

/// Steps at which a bounce makes or loses energy; those of grains among themselves may be longer (two_rates).
void add_lossy_contacts(const scene::Scene& s, const SolidsFigures& f, Warnings& list) {
  constexpr double accurate = 0.3;  // of the limit: an elastic ball that bounces errs by 2 % there
  const double share = std::max(f.time_step / std::min(f.limits.grain_rayleigh, f.limits.bead_rayleigh),
                                static_cast<double>(f.long_step) * f.time_step / f.limits.grain_rayleigh);
  if (share <= accurate * (1 + 1e-9)) return;
  const bool linear = std::holds_alternative<dem::LinearSpringDashpot>(s.solids.contact_law);
  list.push_back(
      fmt::format("particles step by {:.2g} of the {} (solids.contact_safety); above {:g} the ledger of energy of an "
                  "elastic ball that bounces errs by more than 2 %",
                  share, linear ? "limit of the linear law" : "Rayleigh time", accurate));
}

}  // namespace

void warn_of_solids(const scene::Scene& s, const SolidsFigures& f, Warnings& list) {
  const double critical = std::min(
      {f.limits.grain_rayleigh, f.limits.bead_rayleigh, f.limits.ring_bond, f.limits.cable_bond, f.limits.post_bond});
  if (s.solids.time_step > critical)
    list.push_back(fmt::format("solids.time_step_s ({:.3g} s) is above the critical time step ({:.3g} s)",
                               s.solids.time_step, critical));
  else if (s.solids.time_step > 0)
    add_step_of_barrier(s, f.time_step, list);
  if (s.solids.time_step <= critical) add_lossy_contacts(s, f, list);
  if (s.solids.contact_modulus_scale < 1 && std::holds_alternative<dem::LinearSpringDashpot>(s.solids.contact_law))
    list.emplace_back("solids.contact_modulus_scale changes nothing with contact_law = \"linear\"");
  else if (s.solids.contact_modulus_scale < 1)
    list.push_back(fmt::format("contacts are softened: moduli times {:g}", s.solids.contact_modulus_scale));
  if (s.solids.bond_stiffness_scale < 1 && s.barrier.enabled)
    list.push_back(fmt::format("bonds are softened: stiffness times {:g}", s.solids.bond_stiffness_scale));
  if (s.barrier.enabled && s.barrier.net.bead_mass_scale > 1)
    list.push_back(fmt::format("beads of the barrier are slow: inertia times {:g}", s.barrier.net.bead_mass_scale));
  if (has_free_grains(s))
    s.walls.empty() ? list.push_back("there are grains but no walls: nothing holds them") : add_leaks(s, list);
  if (f.grains > 0) add_soft_grains(s, list);
  if (s.barrier.enabled) add_barrier(s, list), add_soft_wires(s, list), add_breaking_rings(s, list);
  if (s.barrier.enabled) add_drawn_out(s, f.time_step, list);
  add_two_rates(s, f.time_step, list);
  add_safeties(s, list);
}

void warn_of_contacts(const scene::Scene& s, Warnings& list) {
  if (s.barrier.enabled && s.solids.wire_contacts == dem::WireContacts::capsules &&
      std::holds_alternative<dem::LinearSpringDashpot>(s.solids.contact_law))
    list.push_back(
        "solids.contact_law is \"linear\" with smooth wires (capsules): their contacts are up to a sixth stiffer "
        "between beads than on them, more where wires lie along each other, twice as stiff sideways, and pull along "
        "the wire; Hertz's law has no such ripple");
  constexpr double steep = 3;
  for (const scene::Contact& c : s.contacts)
    if (c.friction > steep)
      list.push_back(fmt::format("friction of {} and {} is {:g}: it is a coefficient, no angle",
                                 string_text(c.materials[0]), string_text(c.materials[1]), c.friction));
  for (const scene::Contact& c : s.contacts) {
    const std::string& wire = s.barrier.net.material;
    const bool of_wires = c.materials[0] == wire ? !only_walls(s, c.materials[1])
                                                 : c.materials[1] == wire && !only_walls(s, c.materials[0]);
    if (s.barrier.enabled && s.solids.wire_contacts == dem::WireContacts::capsules && of_wires &&
        c.rolling_friction > 0)
      list.push_back(
          fmt::format("rolling_friction of {} and {} does not act on wires: smooth ones (capsules) "
                      "have no rolling resistance",
                      string_text(c.materials[0]), string_text(c.materials[1])));
  }
  const std::set<std::string> names = materials_in_use(s);
  for (auto a = names.begin(); a != names.end(); ++a)
    for (auto b = a; b != names.end(); ++b) {
      const bool listed = std::any_of(s.contacts.begin(), s.contacts.end(), [&](const scene::Contact& c) {
        return (c.materials[0] == *a && c.materials[1] == *b) || (c.materials[0] == *b && c.materials[1] == *a);
      });
      if (!listed && !(only_walls(s, *a) && only_walls(s, *b)))
        list.push_back(
            fmt::format("no [[contact]] for {} and {}: they are smooth and elastic", string_text(*a), string_text(*b)));
    }
}

void warn_of_packings(const scene::Scene& s, Warnings& list) {
  constexpr double random_close_packing = 0.64;
  for (std::size_t i = 0; i < s.grains.packings.size(); ++i) {
    const scene::Packing& p = s.grains.packings[i];
    double solid = 0;
    for (const scene::GrainSize& size : scene::grain_sizes(s, i))
      solid += static_cast<double>(size.count) * std::numbers::pi / 6 * std::pow(size.diameter, 3);
    Vec3 box = p.upper - p.lower;
    if (p.target_height > 0) box.z() = p.target_height;
    constexpr double rounding = 1e-3;  // of drawn grains
    if (solid > (random_close_packing + rounding) * box.prod())
      list.push_back(fmt::format("a packing is to fill {:.3f} of its space: more than random packings do (about {})",
                                 solid / box.prod(), random_close_packing));
  }
}

}  // namespace lahar::cases
