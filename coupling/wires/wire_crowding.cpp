#include "coupling/wires/wire_crowding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/parallel.h"
#include "core/simd_math.h"

namespace lahar::coupling {

namespace {

constexpr double kLargestSolidity = 0.7;

/// Pieces sorted into boxes at least as wide as the longest reach, or as the period where that is less; by number, so
/// that those of a box are looked at eight at a time.
class Boxes {
 public:
  Boxes(const std::vector<WireSegment>& pieces, const Vec3& period, double reach) : period_(period) {
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
    for (std::vector<double>& n : numbers_) n.assign(pieces.size() + kRow, 0.0);  // rows may run over the end
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const WireSegment& p = pieces[k];
      const Vec3 place = p.place - shift_of(p.place);
      const std::array<double, kNumbers> of{
          place.x(), place.y(), place.z(), p.along.x(), p.along.y(), p.along.z(), p.diameter * p.length};
      const std::size_t at = next[box[k]]++;
      for (std::size_t n = 0; n < kNumbers; ++n) numbers_[n][at] = of[n];
    }
  }

  /// Area of the pieces and periodic images around one, weighted by 1 - r^2/reach^2: along it, across it.
  [[nodiscard]] std::array<double, 2> areas_around(const WireSegment& piece, double reach) const {
    Sums sums;
    const Vec3i here = place_of(piece.place);
    const Vec3 wrapped = piece.place - shift_of(piece.place);
    for (int z = -steps_.z(); z <= steps_.z(); ++z)
      for (int y = -steps_.y(); y <= steps_.y(); ++y)
        for (int x = -steps_.x(); x <= steps_.x(); ++x) {
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
          if (inside) add_box(index(box), Vec3(wrapped - shift), piece.along, 1 / (reach * reach), sums);
        }
    return {sum_of_lanes(sums.along), sum_of_lanes(sums.across)};
  }

 private:
  using Lanes = Row<double>;
  static constexpr std::size_t kNumbers = 7;  // place, direction, area
  struct Sums {
    Lanes along{}, across{};
  };

  void add_box(std::size_t b, const Vec3& from, const Vec3& along, double per_reach2, Sums& sums) const {
    const auto& [x, y, z, ax, ay, az, area] = numbers_;
    for (std::size_t k = start_[b]; k < start_[b + 1]; k += kRow) {
      const auto read = [&](const std::vector<double>& of) { return load<Lanes>(&of[k]); };
      const Lanes dx = read(x) - Lanes(from.x()), dy = read(y) - Lanes(from.y()), dz = read(z) - Lanes(from.z());
      const Lanes near = Lanes(1) - Lanes(per_reach2) * (dx * dx + dy * dy + dz * dz);
      const Lanes cosine = Lanes(along.x()) * read(ax) + Lanes(along.y()) * read(ay) + Lanes(along.z()) * read(az);
      const auto of_box = lane_index<Lanes>() < Lanes(static_cast<double>(start_[b + 1] - k));
      const Lanes weighted = select(of_box, read(area) * max(near, Lanes(0)), Lanes(0)), parallel = cosine * cosine;
      sums.along += weighted * parallel;
      sums.across += weighted * (Lanes(1) - parallel);
    }
  }

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

  Vec3 period_, low_, width_;
  Vec3i count_, steps_;
  std::vector<std::size_t> start_;
  std::array<std::vector<double>, kNumbers> numbers_;  // box by box
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
    const double reach = kCrowdingReach * pieces[k].diameter, disc = std::numbers::pi / 2 * reach * reach;
    auto [along, across] = boxes.areas_around(pieces[k], reach);
    along = std::max(0.0, along / disc - own), across /= disc;
    along += std::min(own, along + across);
    const double solidity = 1 - (1 - std::min(1.0, along)) * (1 - std::min(1.0, across));
    crowding[k] = {along + across, along, std::min(kLargestSolidity, solidity)};
  });
  return crowding;
}

}  // namespace lahar::coupling
