// Cross checks of the posts and of a net of hexagonal mesh.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/assembly/cross_checks.h"
#include "cases/assembly/estimates.h"
#include "cases/assembly/geometry.h"
#include "cases/assembly/net_spec.h"
#include "dem/time_step.h"

namespace lahar::scene {
namespace {

const char* const kPosts = "barrier.posts";

std::string key_of(const char* key) { return fmt::format("{}.{}", kPosts, key); }

void check_size(const Scene& scene, Findings& findings) {
  const Posts& posts = scene.barrier.posts;
  if (posts.height < scene.barrier.net.height)
    findings.mistake(key_of("height_m"),
                     fmt::format("{} is {:g}, shorter than the net, expected at least barrier.net.height_m, {:g}",
                                 key_of("height_m"), posts.height, scene.barrier.net.height));
  if (posts.height < 6 * posts.diameter)
    findings.mistake(key_of("diameter_m"),
                     fmt::format("{} is {:g}, too thick for a beam of {:g} m, expected at most a sixth of it, {:.4g}",
                                 key_of("diameter_m"), posts.diameter, posts.height, posts.height / 6));
}

/// Nothing flows far above the domain: posts that reach there are a slip of the pen, and take any number of beads.
void check_heads(const Scene& scene, const barrier::SpansSpec& spec, Findings& findings) {
  const Vec3 &up = spec.net.up, &lower = scene.domain.lower, &upper = scene.domain.upper;
  const Vec3 highest = (up.array() > 0).select(upper, lower), lowest = (up.array() > 0).select(lower, upper);
  const double foot = std::max(post_base(spec, 0).dot(up), post_base(spec, spec.spans).dot(up));
  const double above = foot + spec.post_height - highest.dot(up), height = (highest - lowest).dot(up);
  if (above > height)
    findings.mistake(key_of("height_m"),
                     fmt::format("{} is {:g}: heads of posts stand {:.3g} m above the domain, expected at most its "
                                 "height, {:g} m",
                                 key_of("height_m"), spec.post_height, above, height),
                     {"barrier.net.origin_m", "domain.lower_m", "domain.upper_m"});
}

/// Where something that stands in the ground lies, in words, or nothing if all is well.
const char* out_of_place(const Scene& scene, const Walls& walls, const Vec3& p) {
  const double slack = scene.barrier.net.wire_diameter;
  if (!scene.domain.contains(p, slack)) return "outside the domain";
  if (!walls.empty() && -walls.nearest(p).distance > slack) return "below the ground or inside a wall";
  return nullptr;
}

void check_bases(const Scene& scene, const barrier::SpansSpec& spec, const Walls& walls, Findings& findings) {
  for (const int k : {0, spec.spans}) {
    const Vec3 base = post_base(spec, k);
    if (const char* where = out_of_place(scene, walls, base))
      return findings.mistake(
          key_of("spans"),
          fmt::format("{}: post {} at ({:g}, {:g}, {:g}) stands {}, expected fewer or narrower spans, or another "
                      "barrier.net.origin_m",
                      key_of("spans"), k, base.x(), base.y(), base.z(), where));
  }
}

void check_retaining(const Scene& scene, const barrier::SpansSpec& spec, const Walls& walls, std::size_t n,
                     Findings& findings) {
  const std::string path = fmt::format("{}.retaining[{}]", kPosts, n), key = path + ".anchor_offset_m";
  const barrier::RetainingCable& cable = spec.elements.of<barrier::RetainingCable>()[n];
  if (cable.post > spec.spans)
    return findings.mistake(path + ".post", fmt::format("{}.post is {}, expected 0 to {}, or -1 for every post", path,
                                                        cable.post, spec.spans));
  const Vec3 aside = cable.anchor - cable.anchor.dot(spec.net.up) * spec.net.up;
  if (aside.norm() < spec.post_diameter)
    return findings.mistake(
        key, fmt::format("{} leads {:.3g} m away from the post's axis, expected at least its diameter, {:g}", key,
                         aside.norm(), spec.post_diameter));
  if (cable.anchor.dot(spec.net.up) >= spec.post_height)
    return findings.mistake(key, fmt::format("{} leads above the head of the post, expected an anchor below it", key));
  for (int k = 0; k <= spec.spans; ++k) {
    if (cable.post != -1 && cable.post != k) continue;
    const Vec3 anchor = post_base(spec, k) + cable.anchor;
    if (const char* where = out_of_place(scene, walls, anchor))
      return findings.mistake(key,
                              fmt::format("{}: the anchor of post {} at ({:g}, {:g}, {:g}) lies {}, expected it on "
                                          "the ground inside [domain]",
                                          key, k, anchor.x(), anchor.y(), anchor.z(), where));
  }
  if (!cable.dissipators_at.empty() && scene.barrier.bonds.dissipator_stiffness.empty())
    findings.mistake(path + ".dissipator_places",
                     fmt::format("{}.dissipator_places without barrier.bonds.dissipator_stiffness_N_m3, expected the "
                                 "stiffness of their stages",
                                 path));
}

void check_post_step(const barrier::SpansSpec& spec, Findings& findings) {
  constexpr double least = 1e-8;  // s, as of the net's bonds
  if (const double step = cases::post_bond_limit(spec); step < least)
    findings.mistake(
        key_of("youngs_modulus_Pa"),
        fmt::format("{}: these posts need a time step of {:.2g} s, expected a modulus, section and density "
                    "that allow {:g} s",
                    key_of("youngs_modulus_Pa"), step, least));
}

/// Ends of cables hang on the posts where they stand among the places; elsewhere beads are held in space.
void check_ends(const Scene& scene, Findings& findings) {
  const std::string key = "barrier.anchors.cable_places";
  const std::vector<double>& places = scene.barrier.anchors.cable_places;
  if (!findings.sound({key})) return;
  for (const double end : {0.0, 1.0})
    if (std::find(places.begin(), places.end(), end) == places.end())
      return findings.mistake(key, fmt::format("{} lacks {:g}: that end of the cables hangs on no post, expected 0 and "
                                               "1 among them with [barrier.posts]",
                                               key, end));
}

/// One line for a tensile law that makes no sense.
void check_law(const Scene& scene, const char* wire, Findings& findings) {
  const bool twist = std::string_view(wire) == "twist";
  const barrier::RingNetSpec spec = make_net_spec(scene);
  const std::string key = fmt::format("barrier.net.{}_force_N", wire);
  try {
    const double length = twist ? spec.mesh->twist_length : spec.mesh->single_length();
    const dem::BondSort sort = wire_law_bond(twist ? spec.mesh->twist : spec.mesh->single, length, *spec.mesh);
    if (const double step = dem::bond_time_step(sort, spec.mesh->node_mass()); step < 1e-8)
      findings.mistake(key, fmt::format("{} needs a time step of {:.2g} s with nodes of {:.2g} kg, expected a law that "
                                        "allows 1e-08 s",
                                        key, step, spec.mesh->node_mass()));
  } catch (const InputError& e) {
    findings.mistake(key, fmt::format("{}: {}, expected rising points that the curve bends down between", key,
                                      e.mistakes().front().message));
  }
}

}  // namespace

void check_ring_bonds(const Scene& scene, Findings& findings) {
  const BarrierBonds& bonds = scene.barrier.bonds;
  const std::string table = "barrier.bonds.", stiffness = table + "ring_stiffness_N_m3";
  if (!findings.sound({stiffness, "barrier.net.kind"})) return;
  if (scene.barrier.net.kind == NetKind::rings) {
    if (bonds.ring_stiffness == 0)
      findings.mistake(stiffness, stiffness + " is 0 or missing, expected a number above 0");
    return;
  }
  for (const auto& [key, value] : {std::pair{stiffness, bonds.ring_stiffness},
                                   std::pair{table + "ring_tensile_strength_Pa", bonds.ring_tensile_strength},
                                   std::pair{table + "ring_shear_strength_Pa", bonds.ring_shear_strength}})
    if (value > 0) findings.mistake(key, key + " does not apply here, expected only with barrier.net.kind = \"rings\"");
}

void check_hexagonal_net(const Scene& scene, Findings& findings) {
  const Net& net = scene.barrier.net;
  if (net.kind != NetKind::hexagonal || !findings.sound({"barrier.net"})) return;
  if (net.twist_length >= net.mesh_height)
    return findings.mistake("barrier.net.twist_length_m",
                            fmt::format("barrier.net.twist_length_m is {:g}, expected below mesh_height_m, {:g}",
                                        net.twist_length, net.mesh_height));
  for (const char* wire : {"single", "twist"}) check_law(scene, wire, findings);
}

void check_posts(const Scene& scene, Findings& findings) {
  if (!scene.barrier.posts.enabled || !findings.sound({"barrier", "materials", "solids"})) return;
  check_ends(scene, findings);
  check_size(scene, findings);
  if (!findings.sound({kPosts})) return;
  const barrier::SpansSpec spec = make_spans_spec(scene);
  check_post_step(spec, findings);
  if (!findings.sound({"domain"})) return;
  check_heads(scene, spec, findings);
  const Walls walls = findings.sound({"wall"}) ? make_walls(scene) : Walls{};
  check_bases(scene, spec, walls, findings);
  const std::size_t cables = spec.elements.of<barrier::RetainingCable>().size();
  for (std::size_t n = 0; n < cables; ++n) check_retaining(scene, spec, walls, n, findings);
}

}  // namespace lahar::scene
