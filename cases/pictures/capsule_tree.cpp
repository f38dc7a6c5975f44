#include "cases/pictures/capsule_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace lahar::cases {

namespace {

constexpr std::uint32_t kLeafSize = 3;
constexpr int kBins = 12;
// Every split leaves at most 7/8 on one side, so 2^32 capsules give fewer than 170 levels; one entry waits per level.
constexpr std::size_t kStack = 192;

// Smallest distance >= 0 with |origin + t direction - centre| = radius, coming from outside.
float sphere_entry(const Vec3f& centre, float radius, const Ray& ray) {
  const Vec3f to_centre = centre - ray.origin;
  const float along = to_centre.dot(ray.direction);
  const float miss2 = (to_centre - along * ray.direction).squaredNorm();
  const float half2 = radius * radius - miss2;
  if (half2 < 0) return kNoHit;
  const float entry = along - std::sqrt(half2);
  return entry >= 0 ? entry : kNoHit;
}

float half_area(const Vec3f& lower, const Vec3f& upper) {
  const Vec3f d = (upper - lower).cwiseMax(0.0F);
  return d.x() * d.y() + d.y() * d.z() + d.z() * d.x();
}

struct Bin {
  Vec3f lower = Vec3f::Constant(kNoHit), upper = Vec3f::Constant(-kNoHit);
  std::uint32_t count = 0;
  void grow(const Capsule& c) {
    lower = lower.cwiseMin(c.start.cwiseMin(c.end) - Vec3f::Constant(c.radius));
    upper = upper.cwiseMax(c.start.cwiseMax(c.end) + Vec3f::Constant(c.radius));
    ++count;
  }
  void grow(const Bin& other) {
    lower = lower.cwiseMin(other.lower);
    upper = upper.cwiseMax(other.upper);
    count += other.count;
  }
  [[nodiscard]] float cost() const { return count == 0 ? 0 : static_cast<float>(count) * half_area(lower, upper); }
};

// Surface area heuristic: the border between bins with the smallest sum of area x count; 0 if all lie in one bin.
int cheapest_border(const std::array<Bin, kBins>& bins) {
  std::array<float, kBins> right_cost{};
  Bin right;
  for (int b = kBins - 1; b > 0; --b) {
    right.grow(bins[static_cast<std::size_t>(b)]);
    right_cost[static_cast<std::size_t>(b)] = right.count > 0 ? right.cost() : kNoHit;
  }
  Bin left;
  int best = 0;
  float least = kNoHit;
  for (int b = 1; b < kBins; ++b) {
    left.grow(bins[static_cast<std::size_t>(b - 1)]);
    const float cost = left.cost() + right_cost[static_cast<std::size_t>(b)];
    if (left.count > 0 && cost < least) least = cost, best = b;
  }
  return best;
}

}  // namespace

float capsule_entry(const Capsule& capsule, const Ray& ray) {
  const Vec3f axis = capsule.end - capsule.start;
  const float length2 = axis.squaredNorm();
  if (length2 == 0) return sphere_entry(capsule.start, capsule.radius, ray);
  // The infinite cylinder, in components normal to the axis (scaled by length^2 to save divisions).
  const Vec3f r = ray.origin - capsule.start;
  const float ad = axis.dot(ray.direction), ar = axis.dot(r);
  const float a = length2 - ad * ad;
  const float b = length2 * r.dot(ray.direction) - ar * ad;
  const float c = length2 * (r.squaredNorm() - capsule.radius * capsule.radius) - ar * ar;
  const float discriminant = b * b - a * c;
  if (discriminant < 0) return kNoHit;
  float nearest_end = ad < 0 ? length2 : 0;
  if (a > 0) {
    const float t = (-b - std::sqrt(discriminant)) / a;
    const float along = ar + t * ad;
    if (along > 0 && along < length2) return t >= 0 ? t : kNoHit;
    nearest_end = along;
  }
  return sphere_entry(nearest_end <= 0 ? capsule.start : capsule.end, capsule.radius, ray);
}

Vec3f capsule_normal(const Capsule& capsule, const Vec3f& point) {
  const Vec3f axis = capsule.end - capsule.start;
  const float length2 = axis.squaredNorm();
  const float along = length2 > 0 ? std::clamp((point - capsule.start).dot(axis) / length2, 0.0F, 1.0F) : 0.0F;
  return (point - capsule.start - along * axis).normalized();
}

CapsuleTree::CapsuleTree(std::vector<Capsule> capsules) : capsules_(std::move(capsules)), order_(capsules_.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  std::vector<Vec3f> centres(capsules_.size());
  for (std::size_t i = 0; i < centres.size(); ++i) centres[i] = 0.5F * (capsules_[i].start + capsules_[i].end);
  build(centres);
}

void CapsuleTree::set_bounds(Node& node) const {
  Bin all;
  for (std::uint32_t n = node.first; n < node.first + node.count; ++n) all.grow(capsules_[order_[n]]);
  node.lower = all.lower, node.upper = all.upper;
}

// Sorts the capsules of a leaf into two parts and returns the size of the first.
std::uint32_t CapsuleTree::split(const Node& node, const std::vector<Vec3f>& centres) {
  const auto first = order_.begin() + node.first, last = first + node.count;
  Vec3f lower = centres[*first], upper = lower;
  for (auto i = first; i != last; ++i) lower = lower.cwiseMin(centres[*i]), upper = upper.cwiseMax(centres[*i]);
  Eigen::Index axis = 0;
  const float width = (upper - lower).maxCoeff(&axis);
  const auto bin_of = [&](std::uint32_t i) {
    return std::min(kBins - 1, static_cast<int>(kBins * (centres[i][axis] - lower[axis]) / width));
  };
  int border = 0;
  if (width > 0 && node.count > 2 * kLeafSize) {
    std::array<Bin, kBins> bins;
    for (auto i = first; i != last; ++i) bins[static_cast<std::size_t>(bin_of(*i))].grow(capsules_[*i]);
    border = cheapest_border(bins);
  }
  if (border > 0) {
    const auto middle = std::partition(first, last, [&](std::uint32_t i) { return bin_of(i) < border; });
    const auto left = static_cast<std::uint32_t>(middle - first);
    // A lopsided cut would make the tree deep: no side gets less than an eighth.
    if (8 * std::min(left, node.count - left) >= node.count) return left;
  }
  std::nth_element(first, first + node.count / 2, last, [&](std::uint32_t i, std::uint32_t j) {
    return std::pair(centres[i][axis], i) < std::pair(centres[j][axis], j);
  });
  return node.count / 2;
}

void CapsuleTree::build(const std::vector<Vec3f>& centres) {
  if (capsules_.empty()) return;
  const Vec3f zero = Vec3f::Zero();
  nodes_.reserve(2 * capsules_.size());
  nodes_.push_back({zero, zero, 0, static_cast<std::uint32_t>(capsules_.size())});
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    set_bounds(nodes_[n]);
    if (nodes_[n].count <= kLeafSize) continue;
    const Node parent = nodes_[n];
    const std::uint32_t left = split(parent, centres);
    nodes_[n].first = static_cast<std::uint32_t>(nodes_.size());
    nodes_[n].count = 0;
    nodes_.push_back({zero, zero, parent.first, left});
    nodes_.push_back({zero, zero, parent.first + left, parent.count - left});
  }
}

// Calls visit(capsule) for every capsule in leaves that the ray meets before `limit`, nearer children first; `visit`
// may lower the limit.
template <class Visit>
void CapsuleTree::visit_leaves(const Ray& ray, float& limit, const Visit& visit) const {
  struct Entry {
    std::uint32_t node;
    float distance;
  };
  const Eigen::Array3f inverse = ray.direction.array().inverse();
  const auto entry = [&](const Node& node) {
    const Eigen::Array3f a = (node.lower - ray.origin).array() * inverse;
    const Eigen::Array3f b = (node.upper - ray.origin).array() * inverse;
    const float near = std::max(0.0F, a.min(b).maxCoeff());
    return near <= a.max(b).minCoeff() ? near : kNoHit;
  };
  if (nodes_.empty()) return;
  std::array<Entry, kStack> stack;
  std::size_t depth = 0;
  stack[depth++] = {0, entry(nodes_[0])};
  while (depth > 0) {
    const Entry top = stack[--depth];
    if (!(top.distance < limit)) continue;
    const Node& node = nodes_[top.node];
    for (std::uint32_t n = node.first; n < node.first + node.count; ++n) visit(order_[n]);
    if (node.count > 0) continue;
    const Entry left{node.first, entry(nodes_[node.first])}, right{node.first + 1, entry(nodes_[node.first + 1])};
    const bool left_is_near = left.distance < right.distance;
    const Entry &far = left_is_near ? right : left, &near = left_is_near ? left : right;
    if (far.distance < limit) stack[depth++] = far;
    if (near.distance < limit) stack[depth++] = near;
  }
}

CapsuleHit CapsuleTree::nearest(const Ray& ray, float limit) const {
  CapsuleHit hit;
  visit_leaves(ray, limit, [&](std::uint32_t i) {
    const float distance = capsule_entry(capsules_[i], ray);
    if (distance < limit) limit = distance, hit = {distance, static_cast<std::int32_t>(i)};
  });
  return hit;
}

bool CapsuleTree::blocked(const Ray& ray, float limit) const {
  bool hit = false;
  visit_leaves(ray, limit, [&](std::uint32_t i) {
    if (capsule_entry(capsules_[i], ray) < limit) hit = true, limit = -1;
  });
  return hit;
}

}  // namespace lahar::cases
