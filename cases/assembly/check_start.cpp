#include "cases/assembly/check_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "cases/assembly/geometry.h"
#include "cases/assembly/grain_extent.h"
#include "cases/assembly/grain_sizes.h"
#include "core/check.h"
#include "dem/contact/contact_energy.h"

namespace lahar::cases {

namespace {

/// By how much two particles reach into each other beyond what is allowed, m; not above 0 if they may begin so.
double excess(const dem::Particles& p, dem::ParticleIndex i, dem::ParticleIndex j) {
  const double overlap = p.radius[i] + p.radius[j] - (Vec3(p.position[i]) - Vec3(p.position[j])).norm();
  return overlap - scene::kLargestOverlap * std::min(p.radius[i], p.radius[j]);
}

[[noreturn]] void refuse(const scene::WrittenAt& at, std::string message) {
  throw InputError(std::vector<InputMistake>{{at.file, at.line, at.column, std::move(message)}});
}

/// A packing settles in its own box and knows of no walls.
void require_clear_of_walls(const scene::Scene& scene, const dem::Particles& p) {
  const Walls walls = scene::make_walls(scene);
  if (walls.empty()) return;
  dem::ParticleIndex i = 0;
  for (std::size_t k = 0; k < scene.grains.packings.size(); ++k)
    for (const scene::GrainSize& size : scene::grain_sizes(scene, k))
      for (const dem::ParticleIndex end = i + static_cast<dem::ParticleIndex>(size.count); i < end; ++i) {
        const Vec3 x = p.position[i];
        const WallPoint wall = walls.nearest(x);
        if (wall.distance >= (1 - scene::kLargestOverlap) * p.radius[i]) continue;
        refuse(scene.grains.packings[k].written_at,
               fmt::format("grains.packing[{}]: a grain at ({:.4g}, {:.4g}, {:.4g}) m reaches into wall[{}], expected "
                           "walls outside of its box",
                           k, x.x(), x.y(), x.z(), wall.wall));
      }
}

}  // namespace

void require_clear_start(const scene::Scene& scene, const dem::Particles& p) {
  require_clear_of_walls(scene, p);
  const auto is_grain = [](dem::ParticleKind kind) { return kind == dem::ParticleKind::grain; };
  const auto grains = static_cast<dem::ParticleIndex>(std::count_if(p.kind.begin(), p.kind.end(), is_grain));
  const auto packed = static_cast<dem::ParticleIndex>(grains - scene.grains.spheres.size());
  const auto name = [&](dem::ParticleIndex i) {
    if (i >= packed) return fmt::format("grains.sphere[{}]", i - packed);
    const Vec3 x = p.position[i];
    return fmt::format("a packed grain at ({:.4g}, {:.4g}, {:.4g})", x.x(), x.y(), x.z());
  };
  for (dem::ParticleIndex k = packed; k < grains; ++k)
    for (dem::ParticleIndex i = 0; i < packed; ++i)
      if (excess(p, k, i) > 0)
        refuse(scene.grains.spheres[k - packed].written_at,
               fmt::format("{} reaches into {}, expected it clear of the packing as it has settled, higher "
                           "than its target_height_m by a grain at most",
                           name(k), name(i)));
  Vec3 lower = Vec3::Constant(1e300), upper = -lower;  // of the barrier
  for (dem::ParticleIndex b = grains; b < p.size(); ++b) {
    lower = lower.cwiseMin(Vec3(p.position[b]) - Vec3::Constant(p.radius[b]));
    upper = upper.cwiseMax(Vec3(p.position[b]) + Vec3::Constant(p.radius[b]));
  }
  for (dem::ParticleIndex i = 0; i < grains; ++i) {
    const Vec3 x = p.position[i];
    if ((x.array() < lower.array() - p.radius[i]).any() || (x.array() > upper.array() + p.radius[i]).any()) continue;
    for (dem::ParticleIndex b = grains; b < p.size(); ++b)
      if (excess(p, i, b) > 0)
        refuse(i >= packed ? scene.grains.spheres[i - packed].written_at : scene.barrier.written_at,
               fmt::format("{} reaches into the barrier, expected it clear of the net as that hangs after "
                           "barrier.settle_time_s",
                           name(i)));
  }
}

std::string burst_at_start(const dem::Solids& solids) {
  constexpr double bearable = 1;  // m/s: packings hold themselves to a third of it
  dem::SolidsOptions options = solids.options();
  options.time_step = 1e-15;  // s: contacts are found, nothing moves
  dem::Solids held(solids.particles(), solids.bonds(), solids.materials(), solids.walls(), options);
  held.step();
  const dem::Particles& p = held.particles();
  dem::ParticleIndex worst = 0;
  double fastest = 0, energy = 0;
  for (dem::ParticleIndex i = 0; i < p.size(); ++i) {
    if (p.state[i] != dem::ParticleState::free) continue;
    double w = held.wires() ? held.wires()->normal_energy_of(i, p) : 0;
    for (const dem::ContactDetection* contacts : {&held.contacts(), &held.slow_contacts()})
      w += normal_energy_of(i, p, held.materials(), held.walls(), *contacts, options.contact_law);
    if (const double speed = std::sqrt(2 * w / p.mass[i]); speed > fastest) worst = i, fastest = speed, energy = w;
  }
  if (fastest <= bearable) return {};
  const Vec3 x = p.position[worst];
  return fmt::format(
      "at the start a particle at ({:.4g}, {:.4g}, {:.4g}) m, {:.3g} m across, is pressed into others or "
      "into a wall: the {:.3g} J of its contacts would throw it at up to {:.2g} m/s",
      x.x(), x.y(), x.z(), 2 * p.radius[worst], energy, fastest);
}

}  // namespace lahar::cases
