#include "cases/assembly/geometry.h"

#include "core/check.h"

namespace lahar::scene {
namespace {

Shape make_shape(const WallSettings& s) {
  switch (s.shape) {
    case WallShape::box:
      return SolidBox{s.lower, s.upper};
    case WallShape::cylinder:
      return SolidCylinder{s.start, s.end, s.radius};
    case WallShape::sphere:
      return SolidSphere{s.centre, s.radius};
    case WallShape::mesh:
    case WallShape::heightmap:
      require(s.file.sampled.grid != nullptr, "make_shape: the file was not loaded");
      return SampledDistance{s.file.sampled.grid};
    case WallShape::plane:
      break;
  }
  return HalfSpace{s.point, s.normal.normalized()};
}

}  // namespace

std::optional<Shape> make_body(const FluidRegion& r) {
  switch (r.shape) {
    case RegionShape::cylinder:
      return SolidCylinder{r.start, r.end, r.radius};
    case RegionShape::sphere:
      return SolidSphere{r.centre, r.radius};
    case RegionShape::mesh:
      require(r.file.sampled.grid != nullptr, "make_body: the file was not loaded");
      return SampledDistance{r.file.sampled.grid};
    case RegionShape::box:
      break;
  }
  return std::nullopt;
}

Wall make_wall(const WallSettings& settings, int material) {
  return {settings.name, make_shape(settings), settings.slip, material, settings.velocity, settings.roughness};
}

Walls make_walls(const Scene& scene) {
  Walls walls;
  for (const WallSettings& w : scene.walls) walls.add(make_wall(w, material_index(scene, w.material)));
  return walls;
}

bool filled_by_walls(const Walls& walls, const Vec3& lower, const Vec3& upper) {
  constexpr int n = 9;  // points along an edge
  if (walls.empty()) return false;
  for (int i = 0; i < n * n * n; ++i) {
    const Vec3 part((i % n + 0.5) / n, (i / n % n + 0.5) / n, (i / (n * n) + 0.5) / n);
    if (walls.nearest(lower + (upper - lower).cwiseProduct(part)).distance > 0) return false;
  }
  return true;
}

dem::Materials make_materials(const Scene& scene) {
  dem::Materials materials;
  for (const MaterialSettings& m : scene.materials)
    materials.add({m.name, m.youngs_modulus * scene.solids.contact_modulus_scale, m.poisson_ratio});
  for (const Contact& c : scene.contacts)
    materials.set_pair(material_index(scene, c.materials[0]), material_index(scene, c.materials[1]), c.friction,
                       c.restitution, c.rolling_friction);
  return materials;
}

}  // namespace lahar::scene
