// Cross checks of the barrier: its place, its bonds, and whether it can be built.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/assembly/cross_checks.h"
#include "cases/assembly/drawn_out_dissipators.h"
#include "cases/assembly/estimates.h"
#include "cases/assembly/geometry.h"
#include "cases/assembly/grain_extent.h"
#include "cases/assembly/net_spec.h"
#include "dem/time_step.h"

namespace lahar::scene {
namespace {

bool check_directions(const Net& net, Findings& findings) {
  for (const auto& [v, key] : {std::pair{net.width_direction, "width"}, std::pair{net.height_direction, "height"}})
    if (v.norm() == 0)
      findings.mistake(fmt::format("barrier.net.{}_direction", key),
                       fmt::format("barrier.net.{}_direction is zero, expected a direction", key));
  if (!findings.sound({"barrier.net"})) return false;
  const bool square = std::abs(net.width_direction.normalized().dot(net.height_direction.normalized())) < 1e-6;
  if (!square)
    findings.mistake("barrier.net.height_direction",
                     "barrier.net.height_direction is not at right angles to width_direction, expected it so",
                     {"barrier.net.width_direction"});
  return square;
}

/// A frame must hold at least one ring with its cables.
void check_frame(const Net& net, Findings& findings) {
  if (net.kind != NetKind::rings) return;  // building it names sizes that would do
  const double least = net.ring_diameter + 2 * net.wire_diameter;
  for (const auto& [length, key] :
       {std::pair{net.width, "barrier.net.width_m"}, std::pair{net.height, "barrier.net.height_m"}})
    if (length < least)
      findings.mistake(key,
                       fmt::format("{} is {:g}, expected at least a ring and its cables, {:g}", key, length, least),
                       {"barrier.net.ring_diameter_m", "barrier.net.wire_diameter_m"});
}

void check_net_place(const Scene& scene, Findings& findings) {
  const Net& net = scene.barrier.net;
  const barrier::SpansSpec spans = make_spans_spec(scene);
  const double more = scene.barrier.posts.enabled ? (spans.spans - 1) * post_distance(spans) : 0.0;
  const Vec3 across = (net.width + more) * net.width_direction.normalized(),
             up = net.height * net.height_direction.normalized();
  const double slack = net.wire_diameter;
  const Walls walls = findings.sound({"wall"}) ? make_walls(scene) : Walls{};
  const std::string origin = "barrier.net.origin_m", width = "barrier.net.width_m", height = "barrier.net.height_m";
  const auto check_corner = [&](const Vec3& p, const std::string& key) {
    const double depth = walls.empty() ? 0.0 : -walls.nearest(p).distance;
    const char* where = !scene.domain.contains(p, slack) ? "the domain" : depth > slack ? "the walls" : nullptr;
    if (where)
      findings.mistake(
          key,
          fmt::format("{}: the net's corner ({:g}, {:g}, {:g}) lies outside {}, expected it in the channel", key, p.x(),
                      p.y(), p.z(), where),
          {origin, height, "barrier.net.width_direction", "barrier.net.height_direction", "barrier.posts.spans",
           "domain.lower_m", "domain.upper_m"});
  };
  check_corner(net.origin, origin);
  if (!findings.sound({origin})) return;
  check_corner(net.origin + across, width);
  check_corner(net.origin + up, height);
  if (findings.sound({width, height})) check_corner(net.origin + across + up, width);
}

void check_dissipators(const BarrierBonds& bonds, Findings& findings) {
  if (!findings.sound({"barrier.bonds"})) return;
  const std::string path = "barrier.bonds.dissipator_force_limit_N";
  const auto& k = bonds.dissipator_stiffness;
  const auto& limits = bonds.dissipator_force_limit;
  if (k.size() == 1)
    return findings.mistake("barrier.bonds.dissipator_stiffness_N_m3",
                            "barrier.bonds.dissipator_stiffness_N_m3 has 1 entry, expected none, two or three");
  const std::size_t expected = k.empty() ? 0 : k.size() - 1;
  if (limits.size() != expected)
    return findings.mistake(
        path, fmt::format("{} has {} entries, expected {}: one less than stages", path, limits.size(), expected));
  if (limits.size() == 2 && limits[1] <= limits[0])
    findings.mistake(path, path + " does not rise, expected the second above the first");
  for (const auto& [key, given] :
       {std::pair{"plastic_unloading", bonds.plastic_unloading},
        std::pair{"dissipator_places", bonds.dissipator_places != BarrierBonds{}.dissipator_places}})
    if (k.empty() && given)
      findings.mistake(fmt::format("barrier.bonds.{}", key),
                       fmt::format("barrier.bonds.{} without dissipator_stiffness_N_m3, expected the stiffness of "
                                   "their stages",
                                   key));
  // Plastic elongation would not grow under load (dem/bonds/axial_law.h).
  if (bonds.plastic_unloading && k.size() > 1 && (k[1] >= k[0] || k.back() > k[0]))
    findings.mistake(
        "barrier.bonds.plastic_unloading",
        "barrier.bonds.plastic_unloading is true and a later stage of dissipator_stiffness_N_m3 as stiff as "
        "the first, expected softer ones");
}

/// A stiffness that no run could follow: most likely meant in another unit.
void check_bond_steps(const Scene& scene, Findings& findings) {
  if (!findings.sound({"barrier", "materials", "solids"})) return;
  constexpr double least = 1e-8;  // s; the paper's is 5e-7
  const barrier::RingNetSpec spec = make_net_spec(scene);
  const auto refuse = [&](double step, const barrier::WireProperties& bead, const std::string& key) {
    if (step < least)
      findings.mistake("barrier.bonds." + key,
                       fmt::format("barrier.bonds.{} needs a time step of {:.2g} s with beads of {:.2g} kg, expected a "
                                   "stiffness per unit area (N/m^3) that allows {:g} s",
                                   key, step, bead.bead_mass(), least));
  };
  if (!spec.mesh) refuse(spec.bond_limit(spec.ring), spec.bead_properties(), "ring_stiffness_N_m3");
  refuse(spec.bond_limit(spec.cable), spec.bead_properties(), "cable_stiffness_N_m3");
  if (!scene.barrier.bonds.dissipator_stiffness.empty())
    refuse(spec.bond_limit(spec.dissipator), spec.bead_properties(), "dissipator_stiffness_N_m3");
}

/// Grains that begin where the barrier is would burst out of it.
void check_grains_beside_barrier(const Scene& scene, const dem::Particles& beads, Findings& findings) {
  for (std::size_t i = 0; i < scene.grains.packings.size(); ++i) {
    const Packing& packing = scene.grains.packings[i];
    const Vec3 upper = upper_of_content(packing);
    std::int64_t inside = 0;
    for (dem::ParticleIndex b = 0; b < beads.size(); ++b) {
      const Vec3 x = beads.position[b];
      const double reach = (1 - kLargestOverlap) * beads.radius[b];
      inside += (x.array() > packing.lower.array() - reach).all() && (x.array() < upper.array() + reach).all();
    }
    const std::string path = fmt::format("grains.packing[{}]", i);
    if (inside > 0)
      findings.mistake(path + ".lower_m",
                       fmt::format("{} holds {} beads of the barrier, expected it beside the barrier", path, inside));
  }
  for (std::size_t i = 0; i < scene.grains.spheres.size(); ++i) {
    const GrainSphere& s = scene.grains.spheres[i];
    for (dem::ParticleIndex b = 0; b < beads.size(); ++b) {
      const double gap = (beads.position[b] - s.position).norm() - beads.radius[b] - s.diameter / 2;
      if (-gap <= kLargestOverlap * beads.radius[b]) continue;
      const std::string path = fmt::format("grains.sphere[{}]", i);
      findings.mistake(path + ".position_m", path + " overlaps the barrier, expected a gap");
      break;
    }
  }
}

/// Beads that begin in a wall would be pushed out of it, and load what holds them.
void check_beads_beside_walls(const Scene& scene, const dem::Particles& beads, Findings& findings) {
  const Walls walls = make_walls(scene);
  if (walls.empty()) return;
  const std::string path = scene.barrier.posts.enabled ? "barrier.posts" : "barrier.net.origin_m";
  for (dem::ParticleIndex b = 0; b < beads.size(); ++b) {
    const Vec3 x = beads.position[b];
    const double r = beads.radius[b], depth = r - walls.nearest(x).distance;
    if (beads.state[b] != dem::ParticleState::free || beads.is_buried(b) || depth <= kLargestOverlap * r) continue;
    return findings.mistake(
        path, fmt::format("{}: a bead at ({:.4g}, {:.4g}, {:.4g}) of {:.3g} m across begins {:.2g} m deep in a wall, "
                          "expected net, posts and retaining cables clear of the ground and of what stands on it",
                          path, x.x(), x.y(), x.z(), 2 * r, depth));
  }
}

/// The time step comes from single bonds of beads that touch. Beads farther apart, ties and posts can ask for a shorter
/// one.
void check_step_of_barrier(const Scene& scene, const dem::Particles& beads, const dem::Bonds& bonds,
                           Findings& findings) {
  if (scene.solids.time_step > 0) return;  // asked for: a warning (warn_of_solids.cpp)
  constexpr double room = 0.8;             // below the limit, as by default
  const double step = cases::solids_time_step(scene), limit = dem::bond_time_step(bonds, beads);
  if (step <= limit) return;
  const double safety = scene.solids.bond_safety;
  findings.mistake("solids.bond_safety",
                   fmt::format("solids.bond_safety is {:g}: the time step is {:.3g} s, and the barrier as built allows "
                               "{:.3g} s, expected at most {:.2g}, or solids.time_step_s",
                               safety, step, limit, std::floor(100 * room * safety * limit / step) / 100));
}

/// A dissipator that is drawn out asks for a shorter step. One that cannot even activate is a mistake; where the step
/// stops holding soon after that, a warning says so (warn_of_solids.cpp).
void check_step_of_dissipators(const Scene& scene, const cases::DrawnOutDissipators& dissipators, Findings& findings) {
  if (scene.barrier.bonds.dissipator_stiffness.empty() || scene.solids.time_step > 0) return;
  constexpr double room = 0.8;  // below the limit, as by default
  const double step = cases::solids_time_step(scene), elongation = cases::activation_elongation(scene);
  const double limit = dissipators.time_step(elongation);
  if (step <= limit) return;
  findings.mistake(
      "solids.bond_safety",
      fmt::format("solids.bond_safety is {:g}: the time step is {:.3g} s, and dissipators drawn out by {:.3g} m, "
                  "where they activate, allow {:.3g} s, expected at most {:.2g}, or solids.time_step_s",
                  scene.solids.bond_safety, step, elongation, limit, cases::bond_safety_for(scene, room * limit)),
      {"barrier.bonds.dissipator_force_limit_N", "barrier.bonds.dissipator_stiffness_N_m3",
       "solids.bond_stiffness_scale"});
}

}  // namespace

void check_barrier(const Scene& scene, Findings& findings) {
  if (!scene.barrier.enabled) return;
  check_dissipators(scene.barrier.bonds, findings);
  check_ring_bonds(scene, findings);
  check_bond_steps(scene, findings);
  if (!findings.sound({"barrier.net"}) || !check_directions(scene.barrier.net, findings)) return;
  check_frame(scene.barrier.net, findings);
  if (findings.sound({"domain", "barrier.posts", "barrier.net.width_m", "barrier.net.height_m"}))
    check_net_place(scene, findings);
  check_hexagonal_net(scene, findings);
  check_posts(scene, findings);
}

void check_net_can_be_built(const Scene& scene, Findings& findings) {
  if (!scene.barrier.enabled || !findings.mistakes().empty() || !cases::can_be_tried(scene)) return;
  dem::Particles particles;
  dem::Bonds bonds;
  barrier::Net net;
  const auto attempt = [&](const std::string& path, const std::vector<std::string>& keys, const auto& build) {
    std::vector<std::string> others;
    for (const std::string& key : keys) others.push_back(fmt::format("{}.{}", path, key));
    try {
      build();
    } catch (const InputError& e) {
      for (const InputMistake& m : e.mistakes()) findings.mistake(path, path + ": " + m.message, others);
    }
  };
  attempt("barrier.net",
          {"ring_diameter_m", "ring_pitch_m", "beads_per_ring", "wire_diameter_m", "width_m", "height_m",
           "mesh_width_m", "mesh_height_m", "twist_length_m", "node_diameter_m"},
          [&] { net = barrier::build_net(make_net_spec(scene), particles, bonds); });
  if (scene.barrier.posts.enabled && findings.mistakes().empty()) {
    particles = {}, bonds = {};
    attempt("barrier.posts", {"spans", "height_m", "diameter_m"},
            [&] { net = barrier::build_spans(make_spans_spec(scene), particles, bonds); });
  }
  if (findings.mistakes().empty()) check_grains_beside_barrier(scene, particles, findings);
  if (findings.mistakes().empty()) check_beads_beside_walls(scene, particles, findings);
  if (findings.mistakes().empty()) check_step_of_barrier(scene, particles, bonds, findings);
  if (findings.mistakes().empty()) check_step_of_dissipators(scene, {net.dissipators, particles, bonds}, findings);
}

}  // namespace lahar::scene
