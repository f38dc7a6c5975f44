#include "cases/assembly/grain_extent.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/assembly/grain_sizes.h"

namespace lahar::scene {
namespace {

/// m
double largest_diameter(const Packing& packing) {
  double largest = 0;
  for (const GrainSize& size : packing.sizes) largest = std::max(largest, size.diameter);
  for (const LogNormalGrains& g : packing.log_normal) largest = std::max(largest, g.largest);
  for (const SievedGrains& g : packing.sieved)
    for (const SievePoint& p : g.passing) largest = std::max(largest, p.opening);
  return largest;
}

}  // namespace

double solid_volume(const Packing& packing) {
  double volume = 0;
  for (const GrainSize& size : packing.sizes)
    volume += static_cast<double>(size.count) * std::numbers::pi / 6 * std::pow(size.diameter, 3);
  for (const LogNormalGrains& g : packing.log_normal) volume += solid_volume(packing, g.amount, g.density);
  for (const SievedGrains& g : packing.sieved) volume += solid_volume(packing, g.amount, g.density);
  return volume;
}

Vec3 upper_of_content(const Packing& packing) {
  constexpr double loosest = 0.5;  // solid fraction of random packings that settle without friction
  const Vec3 extent = packing.upper - packing.lower;
  double height = largest_diameter(packing) + solid_volume(packing) / (loosest * extent.x() * extent.y());
  if (packing.target_height > 0) height = std::min(height, packing.target_height);
  return packing.lower + Vec3(extent.x(), extent.y(), std::min(height, extent.z()));
}

}  // namespace lahar::scene
