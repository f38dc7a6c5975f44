#include "cases/assembly/grain_sizes.h"

#include <deque>
#include <memory>
#include <mutex>

namespace lahar::scene {
namespace {

/// Diameters (m) of a grading, fixed by its volume (m^3) and a seed. To draw a million takes two seconds, and a check
/// asks for the same a dozen times: those asked for last are kept.
template <class Grains>
std::shared_ptr<const std::vector<double>> diameters_of(const Grains& grains, double volume, std::uint64_t seed) {
  struct Drawn {
    Grains grains;
    double volume;
    std::uint64_t seed;
    std::shared_ptr<const std::vector<double>> diameters;
  };
  constexpr std::size_t most = 4'000'000;  // diameters, but for the last drawn
  static std::mutex mutex;
  static std::deque<Drawn> kept;
  static std::size_t count = 0;  // of all diameters that are kept
  const std::lock_guard lock(mutex);
  for (const Drawn& d : kept)
    if (d.grains == grains && d.volume == volume && d.seed == seed) return d.diameters;
  auto drawn = std::make_shared<const std::vector<double>>(dem::draw_diameters(distribution_of(grains), volume, seed));
  kept.push_back({grains, volume, seed, drawn});
  for (count += drawn->size(); count > most && kept.size() > 1; kept.pop_front())
    count -= kept.front().diameters->size();
  return drawn;
}

/// Draws every grading of one packing, each with numbers of its own.
class Drawing {
 public:
  Drawing(const Scene& scene, std::size_t packing)
      : packing_(scene.grains.packings[packing]),
        seed_(static_cast<std::uint64_t>(scene.run.seed) + kStride * kMostTables * packing) {}

  template <class Grains>
  void add(const Grains& grains, std::vector<GrainSize>& sizes) {
    const double volume = solid_volume(packing_, grains.amount, grains.density);
    seed_ += kStride;
    for (const double d : *diameters_of(grains, volume, seed_))
      sizes.push_back({d, 1, grains.density, grains.material});
  }

 private:
  static constexpr std::uint64_t kStride = 0x9E3779B97F4A7C15;  // 2^64 / golden ratio: no two multiples meet
  static constexpr std::uint64_t kMostTables = 1u << 20;        // of one packing
  const Packing& packing_;
  std::uint64_t seed_;
};

}  // namespace

dem::LogNormalSizes distribution_of(const LogNormalGrains& g) {
  return {g.median, g.deviation, g.smallest, g.largest, g.weighting};
}

dem::SieveCurve distribution_of(const SievedGrains& grains) {
  dem::SieveCurve curve;
  for (const SievePoint& p : grains.passing) curve.push_back({p.opening, p.passing / 100});
  return curve;
}

double solid_volume(const Packing& packing, const GrainAmount& amount, double density) {
  if (amount.mass > 0) return amount.mass / density;
  return amount.solid_fraction * (packing.upper - packing.lower).head<2>().prod() * packing.target_height;
}

std::vector<GrainSize> grain_sizes(const Scene& scene, std::size_t i) {
  const Packing& packing = scene.grains.packings[i];
  std::vector<GrainSize> sizes = packing.sizes;
  Drawing drawing(scene, i);
  for (const LogNormalGrains& g : packing.log_normal) drawing.add(g, sizes);
  for (const SievedGrains& g : packing.sieved) drawing.add(g, sizes);
  return sizes;
}

std::vector<GrainSize> grain_sizes(const Scene& scene) {
  std::vector<GrainSize> all;
  for (std::size_t i = 0; i < scene.grains.packings.size(); ++i) {
    const std::vector<GrainSize> sizes = grain_sizes(scene, i);
    all.insert(all.end(), sizes.begin(), sizes.end());
  }
  return all;
}

}  // namespace lahar::scene
