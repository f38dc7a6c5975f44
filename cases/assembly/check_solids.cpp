// Cross checks of grains, barrier and of what refers to them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "cases/assembly/check_gradings.h"
#include "cases/assembly/cross_checks.h"
#include "cases/assembly/estimates.h"
#include "cases/assembly/geometry.h"
#include "cases/assembly/grain_sizes.h"
#include "cases/assembly/memory.h"
#include "cases/assembly/net_spec.h"
#include "dem/time_step.h"

namespace lahar::scene {
namespace {

constexpr double largest_overlap = 0.1;  // of the smaller radius: more would burst apart

/// The largest depth (m, > 0) at which points of a box lie inside walls, on a lattice that includes the corners.
double depth_in_walls(const Walls& walls, const Vec3& lower, const Vec3& upper) {
  constexpr int n = 8;
  double deepest = 0;
  for (int i = 0; i < (n + 1) * (n + 1) * (n + 1); ++i) {
    const Vec3 part(i % (n + 1), i / (n + 1) % (n + 1), i / ((n + 1) * (n + 1)));
    const Vec3 p = lower + (upper - lower).cwiseProduct(part / n);
    if (!walls.empty()) deepest = std::max(deepest, -walls.nearest(p).distance);
  }
  return deepest;
}

/// m^3 of grains in a packing.
double solid_volume(const Packing& packing) {
  double volume = 0;
  for (const GrainSize& size : packing.sizes)
    volume += static_cast<double>(size.count) * std::numbers::pi / 6 * std::pow(size.diameter, 3);
  for (const LogNormalGrains& g : packing.log_normal) volume += solid_volume(packing, g.amount, g.density);
  for (const SievedGrains& g : packing.sieved) volume += solid_volume(packing, g.amount, g.density);
  return volume;
}

void check_packing_content(const Packing& packing, const std::string& path, Findings& findings) {
  const Vec3 extent = packing.upper - packing.lower;
  for (std::size_t k = 0; k < packing.sizes.size(); ++k) {
    const GrainSize& size = packing.sizes[k];
    const std::string key = fmt::format("{}.sizes[{}].diameter_m", path, k);
    if (size.diameter > extent.minCoeff())
      findings.mistake(key, fmt::format("{} is {:g}, expected at most the smallest extent of the box, {:g}", key,
                                        size.diameter, extent.minCoeff()));
  }
  constexpr double densest = 0.74;  // of equal spheres; mixtures settle far below
  const double volume = solid_volume(packing);
  if (volume > densest * extent.prod())
    findings.mistake(path, fmt::format("{}: grains fill {:.2f} of the box, expected at most {}", path,
                                       volume / extent.prod(), densest));
}

void check_packing(const Scene& scene, std::size_t i, Findings& findings) {
  const Packing& packing = scene.grains.packings[i];
  const std::string path = fmt::format("grains.packing[{}]", i);
  if (!findings.sound({path})) return;
  if (packing.sizes.empty() && packing.log_normal.empty() && packing.sieved.empty())
    return findings.mistake(path, path + " has no grains, expected at least one [[grains.packing.sizes]]");
  check_gradings(scene, i, findings);
  if (findings.sound({path})) check_packing_content(packing, path, findings);
  const double slack = 1e-6 * (packing.upper - packing.lower).norm();
  if (findings.sound({"domain"}) &&
      !(scene.domain.contains(packing.lower, slack) && scene.domain.contains(packing.upper, slack)))
    return findings.mistake(path + ".lower_m", path + " reaches outside the domain, expected it inside [domain]");
  if (!findings.sound({"wall"})) return;
  if (const double depth = depth_in_walls(make_walls(scene), packing.lower, packing.upper); depth > slack)
    findings.mistake(path + ".lower_m",
                     fmt::format("{} reaches {:.3g} m into a wall, expected it in free space", path, depth));
}

/// m
double largest_diameter(const Packing& packing) {
  double largest = 0;
  for (const GrainSize& size : packing.sizes) largest = std::max(largest, size.diameter);
  for (const LogNormalGrains& g : packing.log_normal) largest = std::max(largest, g.largest);
  for (const SievedGrains& g : packing.sieved)
    for (const SievePoint& p : g.passing) largest = std::max(largest, p.opening);
  return largest;
}

/// Upper corner of the part of a packing's box that its grains will fill, once they have settled: their volume, and a
/// grain on top.
Vec3 upper_of_content(const Packing& packing) {
  constexpr double loosest = 0.5;  // solid fraction of random packings that settle without friction
  const Vec3 extent = packing.upper - packing.lower;
  double height = largest_diameter(packing) + solid_volume(packing) / (loosest * extent.x() * extent.y());
  if (packing.target_height > 0) height = std::min(height, packing.target_height);
  return packing.lower + Vec3(extent.x(), extent.y(), std::min(height, extent.z()));
}

void check_sphere(const Scene& scene, std::size_t i, Findings& findings) {
  const GrainSphere& s = scene.grains.spheres[i];
  const std::string path = fmt::format("grains.sphere[{}]", i);
  if (!findings.sound({path})) return;
  if (findings.sound({"domain"})) {
    const double room = (scene.domain.upper - scene.domain.lower).minCoeff();
    if (s.diameter > room)
      findings.mistake(path + ".diameter_m",
                       fmt::format("{}.diameter_m is {:g}, expected at most the smallest extent of "
                                   "the domain, {:g}",
                                   path, s.diameter, room));
    if (!scene.domain.contains(s.position))
      findings.mistake(path + ".position_m", path + ".position_m lies outside the domain, expected it inside [domain]");
  }
  if (s.fixed && (s.velocity.norm() > 0 || s.angular_velocity.norm() > 0))
    findings.mistake(path + ".fixed", path + ".fixed holds it in place, expected no velocity and no spin");
  if (!findings.sound({"wall", path})) return;
  const Walls walls = make_walls(scene);
  if (!s.fixed && !walls.empty() && walls.nearest(s.position).distance < (1 - largest_overlap) * s.diameter / 2)
    findings.mistake(path + ".position_m", path + " is inside a wall, expected it in free space");
  for (std::size_t k = 0; k < i; ++k) {
    const GrainSphere& other = scene.grains.spheres[k];
    if (!findings.sound({fmt::format("grains.sphere[{}]", k)})) continue;
    const double gap = (s.position - other.position).norm() - (s.diameter + other.diameter) / 2;
    if (-gap > largest_overlap * std::min(s.diameter, other.diameter) / 2)
      findings.mistake(path + ".position_m", fmt::format("{} overlaps grains.sphere[{}], expected a gap", path, k));
  }
  for (std::size_t k = 0; k < scene.grains.packings.size(); ++k) {
    const Packing& packing = scene.grains.packings[k];
    if (!findings.sound({fmt::format("grains.packing[{}]", k)})) continue;
    const Vec3 nearest = s.position.cwiseMax(packing.lower).cwiseMin(upper_of_content(packing));
    if ((s.position - nearest).norm() < (1 - largest_overlap) * s.diameter / 2)
      findings.mistake(path + ".position_m",
                       fmt::format("{} reaches into grains.packing[{}], expected it beside the packing", path, k));
  }
}

bool check_directions(const Net& net, Findings& findings) {
  for (const auto& [v, key] : {std::pair{net.width_direction, "width"}, std::pair{net.height_direction, "height"}})
    if (v.norm() == 0)
      findings.mistake(fmt::format("barrier.net.{}_direction", key),
                       fmt::format("barrier.net.{}_direction is zero, expected a direction", key));
  if (!findings.sound({"barrier.net"})) return false;
  const bool square = std::abs(net.width_direction.normalized().dot(net.height_direction.normalized())) < 1e-6;
  if (!square)
    findings.mistake("barrier.net.height_direction",
                     "barrier.net.height_direction is not at right angles to width_direction, expected it so");
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
                       fmt::format("{} is {:g}, expected at least a ring and its cables, {:g}", key, length, least));
}

void check_net_place(const Scene& scene, Findings& findings) {
  const Net& net = scene.barrier.net;
  const barrier::SpansSpec spans = make_spans_spec(scene);
  const double more = scene.barrier.posts.enabled ? (spans.spans - 1) * post_distance(spans) : 0.0;
  const Vec3 across = (net.width + more) * net.width_direction.normalized(),
             up = net.height * net.height_direction.normalized();
  struct Corner {
    Vec3 position;
    std::string key;
  };
  const double slack = net.wire_diameter;
  const Walls walls = findings.sound({"wall"}) ? make_walls(scene) : Walls{};
  for (const auto& [p, key] : std::array<Corner, 3>{Corner{net.origin, "barrier.net.origin_m"},
                                                    Corner{net.origin + across, "barrier.net.width_m"},
                                                    Corner{net.origin + up, "barrier.net.height_m"}}) {
    if (!findings.sound({"barrier.net.origin_m"})) return;
    const double depth = walls.empty() ? 0.0 : -walls.nearest(p).distance;
    const char* where = !scene.domain.contains(p, slack) ? "the domain" : depth > slack ? "the walls" : nullptr;
    if (where)
      findings.mistake(
          key, fmt::format("{}: the net's corner ({:g}, {:g}, {:g}) lies outside {}, expected it in the channel", key,
                           p.x(), p.y(), p.z(), where));
  }
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

void check_memory_of_particles(const Scene& scene, Findings& findings) {
  if (!findings.sound({"barrier", "grains"})) return;
  const std::int64_t beads = scene.barrier.enabled ? cases::barrier_beads(scene) : 0,
                     grains = cases::grain_count(scene);
  const auto have = static_cast<double>(physical_memory());
  const double need = kBytesPerParticle * (static_cast<double>(beads) + static_cast<double>(grains));
  const std::string path = beads > grains ? "barrier.net" : "grains";
  if (need > have)
    findings.mistake(path,
                     fmt::format("{}: {} beads and {} grains need about {:.0f} GB, more than the {:.0f} GB of this "
                                 "machine, expected fewer",
                                 path, beads, grains, need * 1e-9, have * 1e-9));
}

void check_section(const Scene& scene, Findings& findings) {
  const Measure& m = scene.measure;
  const std::optional<double> section = section_of(scene);
  if (!section || !findings.sound({"measure", "domain", "barrier.net.origin_m"})) return;
  const double low = scene.domain.lower.x(), high = scene.domain.upper.x();
  const auto inside = [&](double x) { return x >= low && x <= high; };
  const auto refuse = [&](const std::string& key, double x) {
    if (!inside(x))
      findings.mistake(
          key, fmt::format("{} leads to x = {:g}, expected inside the domain, {:g} to {:g}", key, x, low, high));
  };
  refuse("measure.section_x_m", *section);
  if (!findings.sound({"measure"})) return;
  refuse("measure.inflow_distance_m", *section - m.inflow_distance);
  refuse("measure.outflow_distance_m", *section + m.outflow_distance);
}

}  // namespace

void check_grains(const Scene& scene, Findings& findings) {
  for (std::size_t i = 0; i < scene.grains.packings.size(); ++i) check_packing(scene, i, findings);
  for (std::size_t i = 0; i < scene.grains.spheres.size(); ++i) check_sphere(scene, i, findings);
}

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

namespace {

/// Grains that begin where the barrier is would burst out of it.
void check_grains_beside_barrier(const Scene& scene, const dem::Particles& beads, Findings& findings) {
  for (std::size_t i = 0; i < scene.grains.packings.size(); ++i) {
    const Packing& packing = scene.grains.packings[i];
    const Vec3 upper = upper_of_content(packing);
    std::int64_t inside = 0;
    for (dem::ParticleIndex b = 0; b < beads.size(); ++b) {
      const Vec3 x = beads.position[b];
      inside += (x.array() > packing.lower.array()).all() && (x.array() < upper.array()).all();
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
      if (-gap <= largest_overlap * beads.radius[b]) continue;
      const std::string path = fmt::format("grains.sphere[{}]", i);
      findings.mistake(path + ".position_m", path + " overlaps the barrier, expected a gap");
      break;
    }
  }
}

/// The time step comes from single bonds of beads that touch. Beads farther apart, ties and posts can ask for a shorter
/// one.
void check_step_of_barrier(const Scene& scene, const dem::Particles& beads, const dem::Bonds& bonds,
                           Findings& findings) {
  if (scene.solids.time_step > 0) return;  // asked for
  constexpr double agree = 1.02;           // the two limits do, for a net of rings of touching beads
  constexpr double room = 0.8;             // below the limit, as by default
  const double step = cases::solids_time_step(scene), limit = dem::bond_time_step(bonds, beads);
  if (step <= agree * limit) return;
  const double safety = scene.solids.bond_safety;
  findings.mistake("solids.bond_safety",
                   fmt::format("solids.bond_safety is {:g}: the time step is {:.3g} s, and the barrier as built allows "
                               "{:.3g} s, expected at most {:.2g}, or solids.time_step_s",
                               safety, step, limit, std::floor(100 * room * safety * limit / step) / 100));
}

}  // namespace

void check_net_can_be_built(const Scene& scene, Findings& findings) {
  constexpr std::int64_t most_beads = 500'000;  // a few seconds; of larger nets the run finds it out
  if (!scene.barrier.enabled || !findings.mistakes().empty() || cases::barrier_beads(scene) > most_beads) return;
  dem::Particles particles;
  dem::Bonds bonds;
  const auto attempt = [&](const std::string& path, const auto& build) {
    try {
      build();
    } catch (const InputError& e) {
      for (const InputMistake& m : e.mistakes()) findings.mistake(path, path + ": " + m.message);
    }
  };
  attempt("barrier.net", [&] { barrier::build_net(make_net_spec(scene), particles, bonds); });
  if (scene.barrier.posts.enabled && findings.mistakes().empty()) {
    particles = {}, bonds = {};
    attempt("barrier.posts", [&] { barrier::build_spans(make_spans_spec(scene), particles, bonds); });
  }
  if (findings.mistakes().empty()) check_grains_beside_barrier(scene, particles, findings);
  if (findings.mistakes().empty()) check_step_of_barrier(scene, particles, bonds, findings);
}

void check_averaged(const Scene& scene, Findings& findings) {
  const Coupling& c = scene.coupling;
  if (c.lubrication)
    findings.mistake("coupling.lubrication",
                     "coupling.lubrication is for what resolved grains miss between them, expected false with grains = "
                     "\"averaged\"");
  if (c.averaging_length < scene.fluid.cell_size)
    findings.mistake("coupling.averaging_length_m",
                     fmt::format("coupling.averaging_length_m is {:g}, expected at least a cell (fluid.cell_size_m = "
                                 "{:g})",
                                 c.averaging_length, scene.fluid.cell_size));
  else if (!findings.sound({"grains"}))
    return;
  else if (const double largest = cases::largest_grain(scene); c.averaging_length < largest * (1 - 1e-9))
    findings.mistake("coupling.averaging_length_m",
                     fmt::format("coupling.averaging_length_m is {:g}, expected at least the diameter of the largest "
                                 "grain, {:g}: averages around its centre do not see the water at its rim",
                                 c.averaging_length, largest));
  if (c.resolve_wires_from_cells)
    findings.mistake("coupling.resolve_wires_from_cells",
                     "coupling.resolve_wires_from_cells maps wires as bodies that cells hold whole, expected none with "
                     "grains = \"averaged\", which cells hold as far as they are filled");
}

void check_holdych(const Scene& scene, Findings& findings) {
  const auto& spheres = scene.grains.spheres;
  const bool free_wires = scene.barrier.enabled && scene.coupling.resolve_wires_from_cells;
  const bool all_held = !free_wires && scene.grains.packings.empty() &&
                        std::all_of(spheres.begin(), spheres.end(), [](const GrainSphere& s) { return s.fixed; });
  if (lbm::by_wall_distance(scene.coupling.body_weighting))
    findings.mistake(
        "coupling.solid_operator",
        "coupling.solid_operator = \"holdych\" turns the flow round by 2 B, which is stable for B up to 1, and "
        "wall_distance and inertial have B up to 1.25; expected another body_weighting or another solid operator");
  else if (!all_held)
    findings.mistake(
        "coupling.solid_operator",
        "coupling.solid_operator = \"holdych\" lets the liquid in free grains and mapped wires swing undamped, "
        "expected fixed grains and wires by the drag law, or another solid operator");
}

void check_uses(const Scene& scene, Findings& findings) {
  if (scene.coupling.enabled && findings.sound({"coupling", "fluid", "grains", "barrier"})) {
    if (!scene.fluid.enabled)
      findings.mistake("coupling.enabled",
                       "coupling.enabled is true without a fluid, expected fluid.enabled = true as well");
    if (!scene.has_solids())
      findings.mistake("coupling.enabled", "coupling.enabled is true without grains or barrier, expected some");
  }
  if (scene.coupling.enabled && scene.coupling.grains == GrainFluid::averaged && findings.sound({"coupling", "fluid"}))
    check_averaged(scene, findings);
  const bool turns = lbm::bounces_back(scene.coupling.solid_operator);
  if (scene.coupling.enabled && turns && findings.sound({"coupling", "fluid"}) &&
      (scene.fluid.smagorinsky > 0 || scene.fluid.rheology.law != FlowLaw::newtonian))
    findings.mistake("coupling.solid_operator",
                     "coupling.solid_operator turns populations, which is for a constant viscosity alone, expected "
                     "fluid.smagorinsky = 0 and a Newtonian fluid, or another solid operator");
  if (scene.coupling.enabled && scene.coupling.solid_operator == SolidOperator::wall_velocity_bounce_back &&
      findings.sound({"coupling", "grains"}))
    check_holdych(scene, findings);
  if (scene.coupling.enabled && scene.coupling.resolve_wires_from_cells &&
      scene.coupling.body_weighting == BodyWeighting::inertial && findings.sound({"coupling"}))
    findings.mistake("coupling.body_weighting",
                     "coupling.body_weighting = \"inertial\" is for grains and lets too much through wires that are "
                     "resolved, expected \"wall_distance\", or no resolve_wires_from_cells");
  if (scene.coupling.enabled && scene.coupling.grains == GrainFluid::resolved &&
      scene.coupling.body_weighting == BodyWeighting::inertial && findings.sound({"coupling", "fluid"}) &&
      scene.fluid.rheology.law != FlowLaw::newtonian)
    findings.mistake(
        "coupling.body_weighting",
        "coupling.body_weighting = \"inertial\" lets the flow into bodies as far as its kinematic viscosity "
        "allows, which says little of mud, expected \"wall_distance\" with this fluid.rheology.law");
  if (!scene.fluid.enabled && !scene.has_solids() && findings.sound({"fluid", "grains", "barrier"}))
    findings.mistake("scene", "the scene is empty, expected a fluid, grains or a barrier");
  check_section(scene, findings);
  check_memory_of_particles(scene, findings);
}

}  // namespace lahar::scene
