// Cross checks of packings and spheres.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "cases/assembly/check_gradings.h"
#include "cases/assembly/cross_checks.h"
#include "cases/assembly/geometry.h"
#include "cases/assembly/grain_extent.h"
#include "cases/assembly/grain_sizes.h"
#include "core/bounding_tree.h"

namespace lahar::scene {
namespace {

WallPoint deeper(const WallPoint& a, const WallPoint& b) { return b.distance < a.distance ? b : a; }

/// Where points of a box lie deepest inside a wall, on a lattice that includes the corners; at distance 0 from no wall
/// where none does.
WallPoint deepest_on_lattice(const Walls& walls, const Vec3& lower, const Vec3& upper) {
  constexpr int n = 8;
  WallPoint deepest{.distance = 0};
  for (int i = 0; i < (n + 1) * (n + 1) * (n + 1); ++i) {
    const Vec3 part(i % (n + 1), i / (n + 1) % (n + 1), i / ((n + 1) * (n + 1)));
    deepest = deeper(deepest, walls.nearest(lower + (upper - lower).cwiseProduct(part / n)));
  }
  return deepest;
}

/// The same where centres of grains may be, for what is too thin for a lattice: boxes that a wall may reach into are
/// halved along each side until they are `finest` (m) small, or as many as can be looked at in a second.
WallPoint deepest_at_centres(const Walls& walls, const Vec3& lower, const Vec3& upper, double finest) {
  constexpr std::size_t most = 100'000;
  std::vector<Vec3> centres{0.5 * (lower + upper)};
  Vec3 half = 0.5 * (upper - lower);
  WallPoint deepest{.distance = 0};
  for (; half.minCoeff() >= 0 && half.norm() > finest && deepest.wall < 0 && centres.size() < most / 8; half /= 2) {
    std::vector<Vec3> parts;
    for (const Vec3& centre : centres) {
      const WallPoint nearest = walls.nearest(centre);
      deepest = deeper(deepest, nearest);
      if (nearest.distance > half.norm()) continue;
      for (int k = 0; k < 8; ++k)
        parts.push_back(centre + 0.5 * half.cwiseProduct(Vec3(k & 1, k >> 1 & 1, k >> 2) * 2 - Vec3::Ones()));
    }
    centres = std::move(parts);
  }
  return deepest;
}

WallPoint deepest_in_walls(const Walls& walls, const Packing& packing, double smallest) {
  if (walls.empty()) return {};
  const Vec3 rim = Vec3::Constant(smallest / 2);
  return deeper(deepest_on_lattice(walls, packing.lower, packing.upper),
                deepest_at_centres(walls, packing.lower + rim, packing.upper - rim, smallest / 16));
}

void check_packing_content(const Scene& scene, const Packing& packing, const std::string& path, Findings& findings) {
  const Vec3 extent = packing.upper - packing.lower;
  for (std::size_t k = 0; k < packing.sizes.size(); ++k) {
    const GrainSize& size = packing.sizes[k];
    const std::string key = fmt::format("{}.sizes[{}].diameter_m", path, k);
    if (size.diameter > extent.minCoeff())
      findings.mistake(key, fmt::format("{} is {:g}, expected at most the smallest extent of the box, {:g}", key,
                                        size.diameter, extent.minCoeff()));
    check_mapped_diameter(scene, size.diameter, key, "is", findings);
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
  if (findings.sound({path})) check_packing_content(scene, packing, path, findings);
  const double slack = 1e-6 * (packing.upper - packing.lower).norm();
  if (findings.sound({"domain"})) {
    bool outside = false;
    for (const auto& [corner, key] : {std::pair{packing.lower, ".lower_m"}, std::pair{packing.upper, ".upper_m"}})
      if (!scene.domain.contains(corner, slack)) {
        findings.mistake(path + key, path + " reaches outside the domain, expected it inside [domain]");
        outside = true;
      }
    if (outside) return;
  }
  if (!findings.sound({"wall"})) return;
  double smallest = (packing.upper - packing.lower).minCoeff();
  for (const GrainSize& size : findings.sound({path}) ? grain_sizes(scene, i) : packing.sizes)
    smallest = std::min(smallest, size.diameter);
  if (const WallPoint deepest = deepest_in_walls(make_walls(scene), packing, smallest); deepest.distance < -slack)
    findings.mistake(path + ".lower_m", fmt::format("{} reaches {:.3g} m into wall[{}], expected it in free space",
                                                    path, -deepest.distance, deepest.wall));
}

void check_sphere(const Scene& scene, const Walls& walls, std::size_t i, Findings& findings) {
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
  check_mapped_diameter(scene, s.diameter, path + ".diameter_m", "is", findings);
  if (s.fixed && (s.velocity.norm() > 0 || s.angular_velocity.norm() > 0))
    findings.mistake(path + ".fixed", path + ".fixed holds it in place, expected no velocity and no spin");
  if (s.velocity.norm() > kLargestSpeed)
    findings.mistake(path + ".velocity_m_s",
                     fmt::format("{}.velocity_m_s is {:g} m/s, expected at most {:g} m/s, where a run stops", path,
                                 s.velocity.norm(), kLargestSpeed));
  if (const double surface = s.angular_velocity.norm() * s.diameter / 2; surface > kLargestSpeed)
    findings.mistake(path + ".angular_velocity_rad_s",
                     fmt::format("{}.angular_velocity_rad_s is {:g} rad/s, which moves its surface at {:g} m/s, "
                                 "expected at most {:g} m/s",
                                 path, s.angular_velocity.norm(), surface, kLargestSpeed));
  if (!findings.sound({"wall", path})) return;
  if (const WallPoint wall = walls.nearest(s.position);
      !s.fixed && wall.distance < (1 - kLargestOverlap) * s.diameter / 2)
    findings.mistake(path + ".position_m",
                     fmt::format("{} is inside wall[{}], expected it in free space", path, wall.wall));
  for (std::size_t k = 0; k < scene.grains.packings.size(); ++k) {
    const Packing& packing = scene.grains.packings[k];
    if (!findings.sound({fmt::format("grains.packing[{}]", k)})) continue;
    const Vec3 nearest = s.position.cwiseMax(packing.lower).cwiseMin(upper_of_content(packing));
    if ((s.position - nearest).norm() < (1 - kLargestOverlap) * s.diameter / 2)
      findings.mistake(path + ".position_m",
                       fmt::format("{} reaches into grains.packing[{}], expected it beside the packing", path, k));
  }
}

/// A sphere of the scene, by its number there.
struct NumberedSphere {
  std::size_t number;
  Vec3 centre;
  double radius;
};

Eigen::AlignedBox3d bounding_box(const NumberedSphere& s) {
  const Vec3 reach = Vec3::Constant(s.radius);
  return {s.centre - reach, s.centre + reach};
}

/// Spheres that are sound by themselves must lie apart. Of two that overlap the later one is to blame, and only once.
void check_gaps(const Scene& scene, Findings& findings) {
  const auto path = [](std::size_t i) { return fmt::format("grains.sphere[{}]", i); };
  std::vector<NumberedSphere> sound;
  for (std::size_t i = 0; i < scene.grains.spheres.size(); ++i)
    if (const GrainSphere& s = scene.grains.spheres[i]; findings.sound({path(i)}))
      sound.push_back({i, s.position, s.diameter / 2});
  const BoundingTree<NumberedSphere> tree(sound);
  std::vector<char> to_blame(sound.size());
  for (std::size_t n = 0; n < sound.size(); ++n) {
    const NumberedSphere& s = sound[n];
    std::size_t hit = n;
    double limit = s.radius * s.radius;
    tree.visit(SquaredDistanceFrom<double>{s.centre}, limit, [&](std::size_t k) {
      const NumberedSphere& other = sound[k];
      const double overlap = s.radius + other.radius - (s.centre - other.centre).norm();
      if (k < hit && !to_blame[k] && overlap > kLargestOverlap * std::min(s.radius, other.radius)) hit = k;
    });
    if (hit == n) continue;
    to_blame[n] = 1;
    findings.mistake(path(s.number) + ".position_m",
                     fmt::format("{} overlaps {}, expected a gap", path(s.number), path(sound[hit].number)));
  }
}

}  // namespace

void check_grains(const Scene& scene, Findings& findings) {
  for (std::size_t i = 0; i < scene.grains.packings.size(); ++i) check_packing(scene, i, findings);
  if (scene.grains.spheres.empty()) return;
  const Walls walls = findings.sound({"wall"}) ? make_walls(scene) : Walls{};
  for (std::size_t i = 0; i < scene.grains.spheres.size(); ++i) check_sphere(scene, walls, i, findings);
  check_gaps(scene, findings);
}

}  // namespace lahar::scene
