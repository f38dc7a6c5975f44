#include "lbm/grid/mirror_geometry.h"

#include "lbm/boundary/slip_wall.h"
#include "lbm/grid/block_geometry.h"
#include "lbm/grid/velocity_set.h"

namespace lahar::lbm {

namespace {

bool is_wall(const Domain& domain, const Vec3i& cell) { return domain.classify(cell) == CellType::wall; }

/// Of a wall cell inside the domain: the wall that it is of.
std::size_t wall_in(const Domain& domain, const Vec3i& cell) {
  return static_cast<std::size_t>(domain.wall_of(domain.centre(cell)));
}

bool slips(const Domain& domain, std::size_t wall) { return domain.walls().all()[wall].slip != WallSlip::no_slip; }

/// A cell and the wall right below it; beyond a periodic face both are looked at where the wall is.
class StandingCell {
 public:
  StandingCell(const Domain& domain, const Vec3i& place, const Vec3i& into)
      : domain_(domain), below_(image_of(domain, place + into)), into_(into) {}

  [[nodiscard]] bool stands_on_slipping_wall() const {
    return !is_wall(domain_, image_of(domain_, below_ - into_)) && is_wall(domain_, below_) &&
           slips(domain_, wall_in(domain_, below_));
  }
  /// Whether the wall lies along the lattice there.
  [[nodiscard]] bool stands_level() const {
    const Vec3 normal = domain_.walls().gradient(wall_in(domain_, below_), domain_.centre(below_ - into_));
    return is_along_axis(static_cast<float>(normal.dot(into_.cast<double>())));
  }
  /// Whether some wall around holds the liquid.
  [[nodiscard]] bool is_held() const {
    for (const auto& c : D3Q19::c) {
      const Vec3i beside = image_of(domain_, below_ - into_ + Vec3i(c[0], c[1], c[2]));
      if (is_wall(domain_, beside) && !slips(domain_, wall_in(domain_, beside))) return true;
    }
    return false;
  }

 private:
  const Domain& domain_;
  Vec3i below_, into_;
};

}  // namespace

bool is_mirror_between(const Domain& domain, const Vec3i& place, const Vec3i& along, const Vec3i& into) {
  const StandingCell here(domain, place, into), beside(domain, place + along, into);
  if (!here.stands_on_slipping_wall() || !beside.stands_on_slipping_wall()) return false;
  const bool level_here = here.stands_level(), level_beside = beside.stands_level();
  if (level_here && level_beside) return true;
  return (level_here && !beside.is_held()) || (level_beside && !here.is_held());
}

}  // namespace lahar::lbm
