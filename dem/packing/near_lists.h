#pragma once
// Lists of near spheres for the packing, which needs no contact history: plain, each pair with both of its spheres.
#include <cstdint>
#include <span>
#include <vector>

#include "core/vector.h"

namespace lahar::dem {

class NearLists {
 public:
  /// `width` and `depth`: of the box, from the origin (m); spheres closer than `skin` (m) are near.
  NearLists(double width, double depth, std::vector<double> radius, double skin);

  void list(const Vec3Field& position);
  /// Lists again once a sphere has moved by half the skin.
  void update(const Vec3Field& position);

  /// Near spheres of one, in an order that depends on the positions alone.
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t i) const {
    return std::span(neighbour_).subspan(first_neighbour_[i], first_neighbour_[i + 1] - first_neighbour_[i]);
  }

 private:
  [[nodiscard]] std::size_t size() const { return radius_.size(); }
  [[nodiscard]] bool looks_for(std::size_t i, std::size_t j) const;
  [[nodiscard]] Vec3i cell_at(const Vec3& x) const;
  [[nodiscard]] std::size_t cell_index(const Vec3i& c) const;
  void build_cells(const Vec3Field& x);
  void search(const Vec3Field& x, std::size_t i);
  void add_finders();

  double width_, depth_;
  std::vector<double> radius_;
  double skin_;
  bool graded_;  ///< sizes so different that a sphere looks for smaller ones only
  double cell_;  ///< m
  Vec3i cells_ = Vec3i::Zero();
  double bottom_ = 0;
  Vec3Field listed_at_;
  std::vector<std::uint32_t> first_neighbour_, neighbour_, first_in_cell_, in_cell_;
  std::vector<std::vector<std::uint32_t>> near_;
};

}  // namespace lahar::dem
