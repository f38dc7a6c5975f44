#include "coupling/wires/wire_crowding.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/parallel.h"

namespace lahar::coupling {

namespace {

constexpr double kLargestSolidity = 0.7;

/// Pieces sorted into boxes at least as wide as the longest reach, or as the period where that is less.
class Boxes {
 public:
  Boxes(const std::vector<WireSegment>& pieces, const Vec3& period, double reach) : pieces_(pieces), period_(period) {
    Vec3 low = pieces.front().place, high = low;
    for (const WireSegment& p : pieces) low = low.cwiseMin(p.place), high = high.cwiseMax(p.place);
    low_ = low;
    for (int a = 0; a < 3; ++a) {
      const double length = period[a] > 0 ? period[a] : high[a] - low[a] + 1e-9 * reach;
      count_[a] = std::clamp(static_cast<int>(length / reach), 1, 64);
      width_[a] = length / count_[a];
      steps_[a] = period[a] > 0 ? static_cast<int>(std::ceil(reach / width_[a])) : 1;
    }
    start_.assign(static_cast<std::size_t>(count_.prod()) + 1, 0);
    std::vector<std::size_t> box(pieces.size());
    for (std::size_t k = 0; k < pieces.size(); ++k) ++start_[(box[k] = index(place_of(pieces[k].place))) + 1];
    for (std::size_t b = 1; b < start_.size(); ++b) start_[b] += start_[b - 1];
    sorted_.resize(pieces.size());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t k = 0; k < pieces.size(); ++k) sorted_[next[box[k]]++] = k;
  }

  /// Calls visit(piece, vector to it) for all pieces, and their periodic images, in the boxes around a point.
  template <class Visit>
  void for_near(const Vec3& from, const Visit& visit) const {
    const Vec3i here = place_of(from);
    const Vec3 wrapped = from - shift_of(from);
    for (int x = -steps_.x(); x <= steps_.x(); ++x)
      for (int y = -steps_.y(); y <= steps_.y(); ++y)
        for (int z = -steps_.z(); z <= steps_.z(); ++z) {
          Vec3i box = here + Vec3i(x, y, z);
          Vec3 shift = Vec3::Zero();
          bool inside = true;
          for (int a = 0; a < 3; ++a) {
            const int turns = static_cast<int>(std::floor(static_cast<double>(box[a]) / count_[a]));
            if (period_[a] > 0) {
              box[a] -= turns * count_[a];
              shift[a] = turns * period_[a];
            } else {
              inside = inside && turns == 0;
            }
          }
          if (!inside) continue;
          const std::size_t b = index(box);
          for (std::size_t k = start_[b]; k < start_[b + 1]; ++k) {
            const WireSegment& p = pieces_[sorted_[k]];
            visit(p, Vec3(p.place - shift_of(p.place) + shift - wrapped));
          }
        }
  }

 private:
  /// Whole periods between a point and the first box.
  [[nodiscard]] Vec3 shift_of(const Vec3& p) const {
    Vec3 shift = Vec3::Zero();
    for (int a = 0; a < 3; ++a)
      if (period_[a] > 0) shift[a] = std::floor((p[a] - low_[a]) / period_[a]) * period_[a];
    return shift;
  }
  [[nodiscard]] Vec3i place_of(const Vec3& p) const {
    const Vec3 inside = p - shift_of(p) - low_;
    Vec3i box;
    for (int a = 0; a < 3; ++a) box[a] = std::clamp(static_cast<int>(inside[a] / width_[a]), 0, count_[a] - 1);
    return box;
  }
  [[nodiscard]] std::size_t index(const Vec3i& box) const {
    return static_cast<std::size_t>((box.z() * count_.y() + box.y()) * count_.x() + box.x());
  }

  const std::vector<WireSegment>& pieces_;
  Vec3 period_, low_, width_;
  Vec3i count_, steps_;
  std::vector<std::size_t> start_, sorted_;
};

}  // namespace

std::vector<Crowding> wire_crowding(const std::vector<WireSegment>& pieces, const Vec3& period) {
  std::vector<Crowding> crowding(pieces.size());
  double thickest = 0;
  for (const WireSegment& p : pieces) thickest = std::max(thickest, p.diameter);
  if (thickest <= 0) return crowding;
  const Boxes boxes(pieces, period, kCrowdingReach * thickest);
  constexpr double own = 8 / (3 * std::numbers::pi * kCrowdingReach);
  parallel_for(0, pieces.size(), 64, [&](std::size_t k) {
    const double reach = kCrowdingReach * pieces[k].diameter, reach2 = reach * reach;
    double along = 0, across = 0;
    boxes.for_near(pieces[k].place, [&](const WireSegment& p, const Vec3& arm) {
      const double r2 = arm.squaredNorm();
      if (r2 >= reach2) return;
      const double area = p.diameter * p.length * (1 - r2 / reach2), cosine = p.along.dot(pieces[k].along);
      along += area * cosine * cosine, across += area * (1 - cosine * cosine);
    });
    const double disc = std::numbers::pi / 2 * reach2;
    along = std::max(0.0, along / disc - own), across /= disc;
    along += std::min(own, along + across);
    const double solidity = 1 - (1 - std::min(1.0, along)) * (1 - std::min(1.0, across));
    crowding[k] = {along + across, along, std::min(kLargestSolidity, solidity)};
  });
  return crowding;
}

}  // namespace lahar::coupling
