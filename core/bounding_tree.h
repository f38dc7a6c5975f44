#pragma once
// A tree of axis-aligned boxes over many items, for queries that want the nearest of them: to a point, or along a ray.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace lahar {

/// Square of the distance from a point to a box: the bound for the nearest item to a point.
template <class Real>
struct SquaredDistanceFrom {
  Eigen::Matrix<Real, 3, 1> point;
  Real operator()(const Eigen::AlignedBox<Real, 3>& box) const {
    return (box.min() - point).cwiseMax(point - box.max()).cwiseMax(Real(0)).squaredNorm();
  }
};

/// Where a ray enters a box (0 from inside, infinite if it misses): the bound for the first item on a ray.
template <class Real>
class EntryOfRay {
 public:
  EntryOfRay(const Eigen::Matrix<Real, 3, 1>& origin, const Eigen::Matrix<Real, 3, 1>& direction)
      : origin_(origin), inverse_(direction.array().inverse()) {}
  Real operator()(const Eigen::AlignedBox<Real, 3>& box) const {
    const Eigen::Array<Real, 3, 1> a = (box.min() - origin_).array() * inverse_;
    const Eigen::Array<Real, 3, 1> b = (box.max() - origin_).array() * inverse_;
    const Real entry = std::max(Real(0), a.min(b).maxCoeff());
    return entry <= a.max(b).minCoeff() ? entry : std::numeric_limits<Real>::infinity();
  }

 private:
  Eigen::Matrix<Real, 3, 1> origin_;
  Eigen::Array<Real, 3, 1> inverse_;
};

/// Item: anything for which `bounding_box(item)` gives an Eigen::AlignedBox. Built by the surface area heuristic in
/// bins (Wald 2007, On fast construction of SAH-based bounding volume hierarchies).
template <class Item>
class BoundingTree {
 public:
  using Box = decltype(bounding_box(std::declval<const Item&>()));
  using Real = typename Box::Scalar;

  explicit BoundingTree(std::vector<Item> items) : items_(std::move(items)), order_(items_.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    if (!items_.empty()) build();
  }

  [[nodiscard]] const std::vector<Item>& items() const { return items_; }

  /// Calls visit(index) for the items of every leaf whose box has bound(box) < limit, nearer boxes first. `bound` gives
  /// a lower bound for what a visit finds; `visit` may lower `limit`, and so ends the search by a limit below 0.
  template <class Bound, class Visit>
  void visit(const Bound& bound, Real& limit, const Visit& visit) const {
    if (nodes_.empty()) return;
    std::array<Waiting, kDeepest> stack;
    std::size_t depth = 0;
    stack[depth++] = {0, bound(nodes_[0].box)};
    while (depth > 0) {
      const Waiting top = stack[--depth];
      if (!(top.bound < limit)) continue;
      const Node& node = nodes_[top.node];
      for (std::uint32_t n = node.first; n < node.first + node.count; ++n) visit(order_[n]);
      if (node.count > 0) continue;
      const Waiting left{node.first, bound(nodes_[node.first].box)};
      const Waiting right{node.first + 1, bound(nodes_[node.first + 1].box)};
      const bool left_is_near = left.bound < right.bound;
      const Waiting &far = left_is_near ? right : left, &near = left_is_near ? left : right;
      if (far.bound < limit) stack[depth++] = far;
      if (near.bound < limit) stack[depth++] = near;
    }
  }

 private:
  struct Node {
    Box box;
    std::uint32_t first;  // of the items in order_ (leaf), else the left child; the right one follows it
    std::uint32_t count;  // 0 for an inner node
  };
  struct Waiting {
    std::uint32_t node;
    Real bound;
  };
  struct Bin {
    Box box;
    std::uint32_t count = 0;
    void grow(const Bin& other) { box.extend(other.box), count += other.count; }
    [[nodiscard]] Real cost() const {
      if (count == 0) return 0;
      const Eigen::Matrix<Real, 3, 1> d = box.sizes();
      return static_cast<Real>(count) * (d.x() * d.y() + d.y() * d.z() + d.z() * d.x());
    }
  };

  static constexpr std::uint32_t kLeafSize = 3;
  static constexpr int kBins = 12;
  // Every split leaves at most 7/8 on one side, so 2^32 items give fewer than 170 levels; one entry waits per level.
  static constexpr std::size_t kDeepest = 192;

  void build() {
    std::vector<Box> boxes;
    boxes.reserve(items_.size());
    for (const Item& item : items_) boxes.push_back(bounding_box(item));
    nodes_.reserve(2 * items_.size());
    nodes_.push_back({Box(), 0, static_cast<std::uint32_t>(items_.size())});
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      const std::uint32_t first = nodes_[n].first, count = nodes_[n].count;
      for (std::uint32_t k = first; k < first + count; ++k) nodes_[n].box.extend(boxes[order_[k]]);
      if (count <= kLeafSize) continue;
      const std::uint32_t left = split(first, count, boxes);
      nodes_[n].first = static_cast<std::uint32_t>(nodes_.size());
      nodes_[n].count = 0;
      nodes_.push_back({Box(), first, left});
      nodes_.push_back({Box(), first + left, count - left});
    }
  }

  // Sorts the items of a leaf into two parts and returns the size of the first.
  std::uint32_t split(std::uint32_t begin, std::uint32_t count, const std::vector<Box>& boxes) {
    const auto first = order_.begin() + begin, last = first + count;
    Box centres;
    for (auto i = first; i != last; ++i) centres.extend(boxes[*i].center());
    Eigen::Index axis = 0;
    const Real width = centres.sizes().maxCoeff(&axis);
    const auto place = [&](std::uint32_t i) { return boxes[i].center()[axis]; };
    const auto bin_of = [&](std::uint32_t i) {
      return std::min(kBins - 1, static_cast<int>(kBins * (place(i) - centres.min()[axis]) / width));
    };
    int border = 0;
    if (width > 0 && count > 2 * kLeafSize) {
      std::array<Bin, kBins> bins;
      for (auto i = first; i != last; ++i) bins[static_cast<std::size_t>(bin_of(*i))].grow({boxes[*i], 1});
      border = cheapest_border(bins);
    }
    if (border > 0) {
      const auto middle = std::partition(first, last, [&](std::uint32_t i) { return bin_of(i) < border; });
      const auto left = static_cast<std::uint32_t>(middle - first);
      // A lopsided cut would make the tree deep: no side gets less than an eighth.
      if (8 * std::min(left, count - left) >= count) return left;
    }
    std::nth_element(first, first + count / 2, last,
                     [&](std::uint32_t i, std::uint32_t j) { return std::pair(place(i), i) < std::pair(place(j), j); });
    return count / 2;
  }

  // The border between bins with the smallest sum of area x count; 0 if all items lie in one bin.
  static int cheapest_border(const std::array<Bin, kBins>& bins) {
    constexpr Real none = std::numeric_limits<Real>::infinity();
    std::array<Real, kBins> right_cost{};
    Bin right;
    for (std::size_t b = kBins - 1; b > 0; --b) {
      right.grow(bins[b]);
      right_cost[b] = right.count > 0 ? right.cost() : none;
    }
    Bin left;
    int best = 0;
    Real least = none;
    for (std::size_t b = 1; b < kBins; ++b) {
      left.grow(bins[b - 1]);
      const Real cost = left.cost() + right_cost[b];
      if (left.count > 0 && cost < least) least = cost, best = static_cast<int>(b);
    }
    return best;
  }

  std::vector<Item> items_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace lahar
