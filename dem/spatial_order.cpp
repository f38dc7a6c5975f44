#include "dem/spatial_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/morton.h"

namespace lahar::dem {

namespace {

constexpr std::uint32_t kMostCells = (1U << 21) - 1;  // along an axis: three coordinates fill 63 bits

struct Cells {
  Vec3 corner = Vec3::Constant(std::numeric_limits<double>::infinity());  // m, the lowest coordinates
  double size = 0;                                                        // m

  explicit Cells(const Particles& p) {
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (p.state[i] == ParticleState::removed) continue;
      corner = corner.cwiseMin(p.position[i]);
      size = std::max(size, 2 * p.radius[i]);
    }
  }
  [[nodiscard]] std::uint64_t code_of(const Vec3& x) const {
    std::array<std::uint64_t, 3> cell{};
    for (Eigen::Index a = 0; a < 3; ++a)
      cell[static_cast<std::size_t>(a)] =
          static_cast<std::uint64_t>(std::clamp((x[a] - corner[a]) / size, 0.0, static_cast<double>(kMostCells)));
    return morton_code(cell[0], cell[1], cell[2]);
  }
};

}  // namespace

Renumbering spatial_order(const Particles& p) {
  const Cells cells(p);
  std::vector<std::pair<std::uint64_t, ParticleId>> by_code(p.size());  // pairs compare by code, then by id
  std::int32_t body = -1;
  std::uint64_t code = 0;
  for (ParticleId id = 0; id < p.size(); ++id) {
    const ParticleIndex i = p.index(id);
    const bool goes_on = id > 0 && body >= 0 && p.body[i] == body;
    body = p.body[i];
    if (p.state[i] == ParticleState::removed) {
      by_code[id] = {std::numeric_limits<std::uint64_t>::max(), id};
      body = -1;
      continue;
    }
    if (!goes_on) code = cells.code_of(p.position[i]);
    by_code[id] = {code, id};
  }
  std::sort(by_code.begin(), by_code.end());
  std::vector<ParticleIndex> order;
  for (const auto& [of_cell, id] : by_code) order.push_back(p.index(id));
  return Renumbering(std::move(order));
}

}  // namespace lahar::dem
