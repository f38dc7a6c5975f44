#include "dem/packing/near_lists.h"

#include <algorithm>

#include "core/parallel.h"

namespace lahar::dem {

namespace {

constexpr std::size_t kChunk = 256;  // spheres
constexpr double kGradedRatio = 3;   // largest / smallest radius from which looking for smaller ones alone pays

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

NearLists::NearLists(double width, double depth, std::vector<double> radius, double skin)
    : width_(width), depth_(depth), radius_(std::move(radius)), skin_(skin), near_(radius_.size()) {
  const auto [smallest, largest] = std::minmax_element(radius_.begin(), radius_.end());
  graded_ = *largest > kGradedRatio * *smallest;
  cell_ = 2 * (graded_ ? median(radius_) : *largest) + skin_;
}

/// Whether i enters j into its list when it finds it: with different sizes only the larger of two does.
bool NearLists::looks_for(std::size_t i, std::size_t j) const {
  if (!graded_) return j != i;
  return radius_[j] < radius_[i] || (radius_[j] == radius_[i] && j < i);
}

Vec3i NearLists::cell_at(const Vec3& x) const {
  const Vec3 at = (x - Vec3(0, 0, bottom_)) / cell_;
  return at.cast<int>().cwiseMax(0).cwiseMin(cells_ - Vec3i::Ones());
}

std::size_t NearLists::cell_index(const Vec3i& c) const {
  return static_cast<std::size_t>((c.z() * cells_.y() + c.y()) * cells_.x() + c.x());
}

void NearLists::build_cells(const Vec3Field& x) {
  bottom_ = *std::min_element(x.z.begin(), x.z.end());
  const double top = *std::max_element(x.z.begin(), x.z.end());
  const auto count = [&](double extent) { return static_cast<int>(extent / cell_) + 1; };
  cells_ = {count(width_), count(depth_), count(top - bottom_)};
  first_in_cell_.assign(cell_index(cells_ - Vec3i::Ones()) + 2, 0);
  for (std::size_t i = 0; i < size(); ++i) ++first_in_cell_[cell_index(cell_at(x[i])) + 1];
  for (std::size_t c = 1; c < first_in_cell_.size(); ++c) first_in_cell_[c] += first_in_cell_[c - 1];
  std::vector<std::uint32_t> slot(first_in_cell_.begin(), first_in_cell_.end() - 1);
  in_cell_.resize(size());
  for (std::uint32_t i = 0; i < size(); ++i) in_cell_[slot[cell_index(cell_at(x[i]))]++] = i;
}

/// Enters what sphere i finds. With different sizes no partner is larger than itself, so that it reaches 2 r + skin.
void NearLists::search(const Vec3Field& x, std::size_t i) {
  near_[i].clear();
  const Vec3 at = x[i], reach = Vec3::Constant(2 * radius_[i] + skin_);
  const Vec3i from = graded_ ? cell_at(at - reach) : Vec3i((cell_at(at).array() - 1).max(0));
  const Vec3i to = graded_ ? cell_at(at + reach) : Vec3i((cell_at(at).array() + 1).min(cells_.array() - 1));
  for (int z = from.z(); z <= to.z(); ++z)
    for (int y = from.y(); y <= to.y(); ++y) {  // the cells of a row follow each other
      const std::size_t begin = first_in_cell_[cell_index({from.x(), y, z})];
      const std::size_t end = first_in_cell_[cell_index({to.x(), y, z}) + 1];
      for (std::size_t k = begin; k < end; ++k) {
        const std::uint32_t j = in_cell_[k];
        const double near = radius_[i] + radius_[j] + skin_;
        if (looks_for(i, j) && (x[j] - at).squaredNorm() < near * near) near_[i].push_back(j);
      }
    }
}

/// Gives every sphere those that found it, after those that it found itself.
void NearLists::add_finders() {
  std::vector<std::size_t> own(size());
  for (std::size_t i = 0; i < size(); ++i) own[i] = near_[i].size();
  for (std::uint32_t i = 0; i < size(); ++i)
    for (std::size_t k = 0; k < own[i]; ++k) near_[near_[i][k]].push_back(i);
}

void NearLists::list(const Vec3Field& x) {
  build_cells(x);
  parallel_for(0, size(), kChunk, [&](std::size_t i) { search(x, i); });
  if (graded_) add_finders();
  first_neighbour_.assign(1, 0);
  neighbour_.clear();
  for (const auto& found : near_) {
    neighbour_.insert(neighbour_.end(), found.begin(), found.end());
    first_neighbour_.push_back(static_cast<std::uint32_t>(neighbour_.size()));
  }
  listed_at_ = x;
}

void NearLists::update(const Vec3Field& x) {
  const double limit = 0.25 * skin_ * skin_;
  for (std::size_t i = 0; i < size(); ++i)
    if ((x[i] - listed_at_[i]).squaredNorm() > limit) return list(x);
}

}  // namespace lahar::dem
