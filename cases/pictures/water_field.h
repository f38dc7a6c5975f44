#pragma once
// The fluid's fill level as a continuous field, and where rays cross its surface (fill level 0.5).
#include <array>
#include <cstdint>
#include <vector>

#include "cases/pictures/ray.h"
#include "lbm/step/fluid_snapshot.h"

namespace lahar::cases {

/// The stretches of a ray that lie in the liquid, in order.
struct WetSpans {
  struct Span {
    float entry, exit;  ///< exit is the end of the ray if the ray ends in the liquid
  };
  std::array<Span, 8> spans;
  int count = 0;
};

class WaterField {
 public:
  /// `smoothing_passes` averages with weights 1-2-1 along each axis take the steps of the cells out of the surface.
  WaterField(const lbm::FluidSnapshot& fluid, int smoothing_passes);

  [[nodiscard]] bool empty() const { return bricks_.empty(); }
  /// Trilinear interpolation between cell centres; 0 away from the fluid.
  [[nodiscard]] float fill_level(const Vec3f& position) const;
  /// Unit vector out of the liquid (against the gradient of the fill level).
  [[nodiscard]] Vec3f normal(const Vec3f& position) const;
  /// The wet stretches of a ray up to `limit`; those beyond the eighth are left out.
  [[nodiscard]] WetSpans wet_spans(const Ray& ray, float limit) const;
  [[nodiscard]] float cell_size() const { return cell_; }

 private:
  static constexpr int kWidth = lbm::FluidSnapshot::block_width;
  static constexpr int kPadded = kWidth + 2;  // one cell of each neighbour, for interpolation
  using Brick = std::array<float, kPadded * kPadded * kPadded>;
  enum class Content : std::uint8_t { gas, surface, liquid };

  static std::size_t padded_index(int x, int y, int z) {
    return static_cast<std::size_t>(((x + 1) * kPadded + y + 1) * kPadded + z + 1);
  }
  void index_blocks(const lbm::FluidSnapshot& fluid);
  void fill_padding();
  void smooth();
  void classify();
  [[nodiscard]] std::int32_t brick_at(const Vec3i& block) const;
  [[nodiscard]] float cell_value(const Vec3i& cell) const;
  [[nodiscard]] float interpolate(const Brick& brick, const Vec3f& local) const;
  [[nodiscard]] Vec3f to_cells(const Vec3f& position) const { return (position - origin_) / cell_; }
  template <class Visit>
  void visit_blocks(const Ray& ray_in_cells, float limit, const Visit& visit) const;

  float cell_;
  Vec3f origin_;
  Vec3i first_block_ = Vec3i::Zero(), blocks_ = Vec3i::Zero();  // extent of table_, in blocks
  std::vector<std::int32_t> table_;                             // brick of each block in the extent, -1 if none
  std::vector<Vec3i> block_of_brick_;
  std::vector<Brick> bricks_;
  std::vector<Content> content_;
};

}  // namespace lahar::cases
