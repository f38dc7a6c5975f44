#pragma once
// What the fluid gives to walls: momentum exchange over their links (Ladd 1994, J. Fluid Mech. 271, eq. 3.3). A link
// that sends f_i into a wall and gets f_opposite(i) back gives it the momentum (f_i + f_opposite(i)) c_i. Populations
// are stored less their weights, so the sum is that of the pressure above ambient: air presses on the dry side too.
// Links into the edge where two walls meet load both: each gets the component along the axis that leads to it.
#include <vector>

#include "core/archive.h"

namespace lahar::lbm {

/// Momentum and angular momentum that a wall got.
struct WallLoad {
  Vec3 impulse = Vec3::Zero();
  Vec3 angular_impulse = Vec3::Zero();  ///< about the origin of the coordinates

  void transfer(Archive& archive) {
    archive.value("impulse", impulse);
    archive.value("angular_impulse", angular_impulse);
  }
};

/// The loads on the few walls that a block touches, in one step, lattice units. Positions are those of the middle of
/// the links.
class BlockWallLoads {
 public:
  struct Entry {
    int wall;
    WallLoad load;
  };

  void clear() { entries_.clear(); }
  void add(int wall, const Vec3& position, const Vec3& impulse) {
    WallLoad& load = of(wall);
    load.impulse += impulse;
    load.angular_impulse += position.cross(impulse);
  }
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }

 private:
  WallLoad& of(int wall) {
    for (Entry& e : entries_)
      if (e.wall == wall) return e.load;
    return entries_.emplace_back(Entry{wall, {}}).load;
  }

  std::vector<Entry> entries_;
};

}  // namespace lahar::lbm
