#include "cases/pictures/occlusion_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lahar::cases {

namespace {

constexpr float kCellsAcross = 96;  // along the longest side, at most
constexpr float kDarkening = 1.5F;  // openness = exp(-kDarkening * weighted fraction)
constexpr std::array<float, 3> kReach{0.9F, 1.9F, 3.4F}, kWeight{0.5F, 0.4F, 0.35F};  // distances in cells

}  // namespace

OcclusionField::OcclusionField(std::span<const Capsule> capsules) {
  std::vector<float> radii;
  Vec3f lower = Vec3f::Constant(kNoHit), upper = -lower;
  for (const Capsule& c : capsules) {
    if (c.start != c.end) continue;
    radii.push_back(c.radius);
    lower = lower.cwiseMin(c.start), upper = upper.cwiseMax(c.start);
  }
  if (radii.empty()) return;
  std::nth_element(radii.begin(), radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2), radii.end());
  cell_ = std::max(2 * radii[radii.size() / 2], (upper - lower).maxCoeff() / kCellsAcross);
  origin_ = lower - Vec3f::Constant(2 * cell_);
  cells_ = ((upper - origin_) / cell_).array().ceil().cast<int>() + 3;
  fraction_.assign(static_cast<std::size_t>(cells_.x()) * static_cast<std::size_t>(cells_.y()) *
                       static_cast<std::size_t>(cells_.z()),
                   0.0F);
  const float sphere = 4.0F / 3.0F * std::numbers::pi_v<float>;
  for (const Capsule& c : capsules)
    if (c.start == c.end) add(c.start, sphere * c.radius * c.radius * c.radius);
}

void OcclusionField::add(const Vec3f& position, float volume) {
  const Vec3f p = (position - origin_) / cell_;
  const Vec3i base = p.array().floor().cast<int>();
  const Vec3f f = p - base.cast<float>();
  for (int n = 0; n < 8; ++n) {
    const Vec3i corner(n & 1, n >> 1 & 1, n >> 2 & 1);
    float weight = volume / (cell_ * cell_ * cell_);
    for (int d = 0; d < 3; ++d) weight *= corner[d] != 0 ? f[d] : 1 - f[d];
    const Vec3i c = base + corner;
    fraction_[static_cast<std::size_t>((c.x() * cells_.y() + c.y()) * cells_.z() + c.z())] += weight;
  }
}

float OcclusionField::fraction(const Vec3f& position) const {
  const Vec3f p = (position - origin_) / cell_;
  if ((p.array() < 0).any() || (p.array() >= (cells_.array() - 1).cast<float>()).any()) return 0;
  const Vec3i base = p.cast<int>();
  const Vec3f f = p - base.cast<float>();
  float sum = 0;
  for (int n = 0; n < 8; ++n) {
    const Vec3i corner(n & 1, n >> 1 & 1, n >> 2 & 1);
    float weight = 1;
    for (int d = 0; d < 3; ++d) weight *= corner[d] != 0 ? f[d] : 1 - f[d];
    const Vec3i c = base + corner;
    sum += weight * fraction_[static_cast<std::size_t>((c.x() * cells_.y() + c.y()) * cells_.z() + c.z())];
  }
  return std::min(sum, 1.0F);
}

float OcclusionField::openness(const Vec3f& position, const Vec3f& normal) const {
  if (fraction_.empty()) return 1;
  float hidden = 0;
  for (std::size_t k = 0; k < kReach.size(); ++k)
    hidden += kWeight[k] * fraction(position + kReach[k] * cell_ * normal);
  return std::exp(-kDarkening * hidden);
}

}  // namespace lahar::cases
