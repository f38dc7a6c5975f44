#pragma once
// Nodes at which fluid and grains are averaged: a lattice as coarse as the averaging length, over cells as fine as the
// fluid needs. A point shares itself among the eight nodes around it (linear weights, sum 1), so what is carried from
// points to nodes and back is kept.
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/vector.h"
#include "lbm/grid/domain.h"

namespace lahar::coupling {

class AveragingGrid {
 public:
  /// Along an axis: the node below a place, which may lie outside, and the weight of the one above it.
  struct Between {
    int below;
    double above_weight;
  };
  /// A node and a weight.
  struct Share {
    std::size_t node;
    double weight;
  };

  /// Into how many equal lengths, none shorter than `length`, an extent is divided: as many as it has room for.
  [[nodiscard]] static int divisions(double extent, double length) {
    return std::max(1, static_cast<int>(extent / length * (1 + 1e-9)));
  }

  /// Divides each axis of the domain by `length` (m); nodes stand in the middles of what comes of it.
  AveragingGrid(const lbm::Domain& domain, double length) : first_(domain.first()) {
    for (int a = 0; a < 3; ++a) {
      const double cells = domain.cells()[a];
      nodes_[a] = divisions(cells * domain.cell_size(), length);
      spacing_[a] = cells / nodes_[a];
      periodic_[a] = domain.period()[a] > 0;
    }
  }

  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(nodes_.x()) * static_cast<std::size_t>(nodes_.y()) *
           static_cast<std::size_t>(nodes_.z());
  }
  /// Cells between nodes.
  [[nodiscard]] const Vec3& spacing() const { return spacing_; }

  /// `place`: in cells from the corner of cell (0, 0, 0).
  [[nodiscard]] Between between(int axis, double place) const {
    const double x = (place - first_[axis]) / spacing_[axis] - 0.5, below = std::floor(x);
    return {static_cast<int>(below), x - below};
  }
  /// Beyond the last node of an axis that one holds; a periodic axis goes round.
  [[nodiscard]] int inside(int axis, int node) const {
    const int n = nodes_[axis];
    return periodic_[axis] ? ((node % n) + n) % n : std::clamp(node, 0, n - 1);
  }
  [[nodiscard]] std::size_t index(const Vec3i& node) const {
    const auto at = [&](int a) { return static_cast<std::size_t>(inside(a, node[a])); };
    return (at(0) * static_cast<std::size_t>(nodes_.y()) + at(1)) * static_cast<std::size_t>(nodes_.z()) + at(2);
  }

  /// visit(node, weight) for the eight nodes around a point.
  template <class Visit>
  void around(const Vec3& place, const Visit& visit) const {
    const Between b[3] = {between(0, place.x()), between(1, place.y()), between(2, place.z())};
    for (int n = 0; n < 8; ++n) {
      const Vec3i up(n >> 2 & 1, n >> 1 & 1, n & 1);
      double weight = 1;
      for (int a = 0; a < 3; ++a) weight *= up[a] ? b[a].above_weight : 1 - b[a].above_weight;
      visit(index(Vec3i(b[0].below, b[1].below, b[2].below) + up), weight);
    }
  }
  /// visit(node) for the nodes around all places up to `reach` cells away along each axis from a point.
  template <class Visit>
  void within(const Vec3& place, double reach, const Visit& visit) const {
    Vec3i low, high;
    for (int a = 0; a < 3; ++a)
      low[a] = between(a, place[a] - reach).below, high[a] = between(a, place[a] + reach).below + 1;
    for (int x = low.x(); x <= high.x(); ++x)
      for (int y = low.y(); y <= high.y(); ++y)
        for (int z = low.z(); z <= high.z(); ++z) visit(index(Vec3i(x, y, z)));
  }

 private:
  Vec3i first_;
  Vec3i nodes_ = Vec3i::Ones();
  Vec3 spacing_ = Vec3::Ones();
  bool periodic_[3] = {};
};

}  // namespace lahar::coupling
