#include "cases/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lahar::scene {

Vec3 Gravity::vector() const {
  const double angle = slope_deg * std::numbers::pi / 180.0;
  const double across = slope_deg == 90 ? 0.0 : std::cos(angle);  // cos(pi / 2) rounds to 6e-17
  return magnitude * Vec3{std::sin(angle), 0.0, -across};
}

bool Domain::open(Face face) const { return std::find(open_faces.begin(), open_faces.end(), face) != open_faces.end(); }

bool Domain::periodic(Axis axis) const {
  return std::find(periodic_axes.begin(), periodic_axes.end(), axis) != periodic_axes.end();
}

bool Domain::contains(const Vec3& p, double tolerance) const {
  return ((p - lower).array() >= -tolerance).all() && ((upper - p).array() >= -tolerance).all();
}

int material_index(const Scene& scene, const std::string& name) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    if (scene.materials[i].name == name) return static_cast<int>(i);
  return -1;
}

std::optional<double> section_of(const Scene& scene) {
  if (scene.measure.section_x || !scene.barrier.enabled || !scene.fluid.enabled) return scene.measure.section_x;
  return scene.barrier.net.origin.x();
}

}  // namespace lahar::scene
