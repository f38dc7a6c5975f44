#include "cases/assembly/packings.h"

#include <fmt/format.h>

#include <algorithm>

#include "cases/assembly/grain_sizes.h"
#include "dem/packing/packing.h"

namespace lahar::cases {

namespace {

dem::PackingSpec packing_spec(const scene::Scene& scene, std::size_t i) {
  const scene::Packing& packing = scene.grains.packings[i];
  dem::PackingSpec spec;
  spec.lower = packing.lower;
  spec.upper = packing.upper;
  constexpr std::uint64_t stride = 0xD1B54A32D192ED03;  // no two packings are alike, and none is drawn as its sizes
  spec.seed = static_cast<std::uint64_t>(scene.run.seed) + stride * i;
  spec.target_height = packing.target_height;
  for (const auto& s : scene::grain_sizes(scene, i))
    spec.classes.push_back(
        {s.diameter / 2, static_cast<int>(s.count), s.density, scene::material_index(scene, s.material)});
  return spec;
}

[[noreturn]] void refuse_packing(const scene::Scene& scene, std::size_t i, const std::string& message) {
  const scene::WrittenAt& at = scene.grains.packings[i].written_at;
  throw InputError(
      std::vector<InputMistake>{{at.file, at.line, at.column, fmt::format("grains.packing[{}]: {}", i, message)}});
}

/// Throws InputError, located at the packing, if its grains do not fit.
std::vector<dem::ParticleSpec> packed(const scene::Scene& scene, std::size_t i) {
  try {
    return dem::pack(packing_spec(scene, i));
  } catch (const InputError& e) {
    refuse_packing(scene, i, e.mistakes().front().message);
  }
}

/// The space that grains reach into.
Eigen::AlignedBox3d reach_of(const std::vector<dem::ParticleSpec>& grains) {
  Eigen::AlignedBox3d box;
  for (const dem::ParticleSpec& g : grains) {
    box.extend(g.position - Vec3::Constant(g.radius));
    box.extend(g.position + Vec3::Constant(g.radius));
  }
  return box;
}

/// Throws InputError, located at packing i, if a grain of it lies in one of packing k. Their boxes may lie apart: a few
/// grains stand out of the top of theirs.
void check_apart(const scene::Scene& scene, std::size_t k, const std::vector<dem::ParticleSpec>& others, std::size_t i,
                 const std::vector<dem::ParticleSpec>& grains) {
  const Eigen::AlignedBox3d shared = reach_of(others).intersection(reach_of(grains));
  if (shared.isEmpty()) return;
  const auto reaches_in = [&](const dem::ParticleSpec& g) {
    return (g.position.array() + g.radius > shared.min().array()).all() &&
           (g.position.array() - g.radius < shared.max().array()).all();
  };
  constexpr double bearable = 0.01;  // of a radius, as within a packing
  for (const dem::ParticleSpec& a : others) {
    if (!reaches_in(a)) continue;
    for (const dem::ParticleSpec& b : grains)
      if (reaches_in(b) &&
          a.radius + b.radius - (a.position - b.position).norm() > bearable * std::min(a.radius, b.radius))
        refuse_packing(scene, i,
                       fmt::format("a grain at ({:.3g}, {:.3g}, {:.3g}) m lies in one of grains.packing[{}], expected "
                                   "boxes that share no space, with room for grains that stand out of a box's top",
                                   b.position.x(), b.position.y(), b.position.z(), k));
  }
}

}  // namespace

void add_placeholders(const scene::Scene& scene, dem::Particles& particles) {
  for (std::size_t i = 0; i < scene.grains.packings.size(); ++i)
    for (const auto& c : packing_spec(scene, i).classes)
      for (int k = 0; k < c.count; ++k) {
        dem::ParticleSpec grain;
        grain.radius = c.radius;
        grain.density = c.density;
        particles.add(grain);
      }
}

void add_packings(const scene::Scene& scene, dem::Particles& particles) {
  std::vector<std::vector<dem::ParticleSpec>> packings;
  for (std::size_t i = 0; i < scene.grains.packings.size(); ++i) {
    packings.push_back(packed(scene, i));
    for (std::size_t k = 0; k < i; ++k) check_apart(scene, k, packings[k], i, packings[i]);
    for (const dem::ParticleSpec& grain : packings[i]) particles.add(grain);
  }
}

std::vector<std::string> missed_heights(const scene::Scene& scene, const dem::Particles& particles) {
  constexpr double bearable = 0.005;  // of the height: less is no news
  std::vector<std::string> missed;
  dem::ParticleId first = 0;
  for (std::size_t i = 0; i < scene.grains.packings.size(); ++i) {
    const dem::PackingSpec spec = packing_spec(scene, i);
    std::vector<dem::ParticleSpec> grains;
    for (const auto& c : spec.classes)
      for (int k = 0; k < c.count; ++k, ++first) {
        dem::ParticleSpec grain;
        grain.radius = c.radius;
        grain.position = particles.position[particles.index(first)];
        grains.push_back(grain);
      }
    if (spec.target_height <= 0 || grains.empty()) continue;
    const double height = dem::measure_packing(spec, grains).surface_height;
    if (height > (1 + bearable) * spec.target_height)
      missed.push_back(fmt::format("grains.packing[{}] stands {:.4g} m high, above its target_height_m of {:.4g}", i,
                                   height, spec.target_height));
  }
  return missed;
}

}  // namespace lahar::cases
