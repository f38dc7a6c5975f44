#pragma once
// Walls and terrain as signed distances: positive in the space that fluid and grains may fill, negative inside the
// wall. The same walls bound the fluid (link-wise distances) and the particles (contact).
#include <limits>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/archive.h"
#include "core/distance_grid.h"
#include "core/vector.h"

namespace lahar {

/// Everything on the side of the plane that `normal` (unit) points to is free; the rest is wall.
struct HalfSpace {
  Vec3 point, normal;
  [[nodiscard]] double distance(const Vec3& p) const { return normal.dot(p - point); }
  [[nodiscard]] Vec3 gradient(const Vec3&) const { return normal; }
};

/// A solid axis-aligned box; free space is outside.
struct SolidBox {
  Vec3 lower, upper;
  [[nodiscard]] double distance(const Vec3& p) const;
  [[nodiscard]] Vec3 gradient(const Vec3& p) const;
};

/// A solid capped cylinder of given axis (two end points) and radius; free space is outside. With `hollow` it is a bore
/// without ends: all within the radius is free, all beyond is solid.
struct SolidCylinder {
  Vec3 start, end;
  double radius = 0;
  bool hollow = false;
  [[nodiscard]] double distance(const Vec3& p) const;
  [[nodiscard]] Vec3 gradient(const Vec3& p) const;
};

/// A solid sphere; free space is outside.
struct SolidSphere {
  Vec3 centre;
  double radius = 0;
  [[nodiscard]] double distance(const Vec3& p) const { return (p - centre).norm() - radius; }
  [[nodiscard]] Vec3 gradient(const Vec3& p) const;
};

/// A solid of any shape whose distance was sampled beforehand: a mesh or a terrain from a file.
struct SampledDistance {
  std::shared_ptr<const DistanceGrid> grid;
  [[nodiscard]] double distance(const Vec3& p) const { return grid->distance(p); }
  [[nodiscard]] Vec3 gradient(const Vec3& p) const { return grid->gradient(p); }
};

using Shape = std::variant<HalfSpace, SolidBox, SolidCylinder, SolidSphere, SampledDistance>;

/// How fluid slides along a wall.
enum class WallSlip {
  no_slip,
  free_slip,
  wall_model,  ///< with the shear stress of the logarithmic law at the nearest cells
};

struct Wall {
  std::string name;
  Shape shape;
  WallSlip slip = WallSlip::no_slip;
  int material = 0;              ///< index into the DEM's materials
  Vec3 velocity = Vec3::Zero();  ///< m/s, tangential motion of the wall surface
  double roughness = 0;          ///< m, equivalent sand roughness k_s of WallSlip::wall_model
  /// rad/s, rotation of the surface about an axis through `centre`, in addition to `velocity`; felt by the fluid alone.
  Vec3 angular_velocity = Vec3::Zero();
  Vec3 centre = Vec3::Zero();  ///< m
  /// s, when the wall is taken away, as a gate.
  double opens_at = std::numeric_limits<double>::infinity();
  bool open = false;  ///< taken away: nothing is near it any more

  /// Velocity of the surface at a point, m/s.
  [[nodiscard]] Vec3 surface_velocity(const Vec3& p) const { return velocity + angular_velocity.cross(p - centre); }
};

struct WallPoint {
  double distance = std::numeric_limits<double>::infinity();  ///< m, signed
  Vec3 normal = Vec3::Zero();                                 ///< unit, out of the wall
  int wall = -1;                                              ///< index of the nearest wall, -1 if there is none
};

/// The union of all walls of a scene.
class Walls {
 public:
  void add(Wall wall) { walls_.push_back(std::move(wall)); }
  [[nodiscard]] const std::vector<Wall>& all() const { return walls_; }
  [[nodiscard]] bool empty() const { return walls_.empty(); }
  /// Takes away the walls that open by `time` (s), and says whether there were some. Indices stay as they are.
  bool open_by(double time);
  /// State of a checkpoint: which are open.
  void transfer(Archive& archive);
  /// Signed distance to one wall; infinite where it is open.
  [[nodiscard]] double distance(std::size_t wall, const Vec3& p) const;
  [[nodiscard]] Vec3 gradient(std::size_t wall, const Vec3& p) const;
  /// The nearest (deepest) wall; one counts as nearer than those before it by more than `slack` (m).
  [[nodiscard]] WallPoint nearest(const Vec3& p, double slack = 0) const;

 private:
  std::vector<Wall> walls_;
};

}  // namespace lahar
