#pragma once
// Soft darkening between grains without noise: the volume fraction of grains on a coarse grid stands for how much of
// the sky a point near them cannot see.
#include <span>
#include <vector>

#include "cases/pictures/capsule.h"

namespace lahar::cases {

class OcclusionField {
 public:
  /// Only capsules with coinciding ends (grains) count.
  explicit OcclusionField(std::span<const Capsule> capsules);
  /// Share of the sky seen from a point with the given unit normal: 1 in the open.
  [[nodiscard]] float openness(const Vec3f& position, const Vec3f& normal) const;

 private:
  [[nodiscard]] float fraction(const Vec3f& position) const;
  void add(const Vec3f& position, float volume);

  Vec3f origin_ = Vec3f::Zero();
  Vec3i cells_ = Vec3i::Zero();
  float cell_ = 1;
  std::vector<float> fraction_;
};

}  // namespace lahar::cases
