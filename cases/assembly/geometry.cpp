#include "cases/assembly/geometry.h"

#include "cases/files/heightmap_file.h"
#include "cases/files/mesh_file.h"
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

lbm::Hydrograph hydrograph_of(const Inflow& inflow) {
  lbm::Hydrograph hydrograph;
  for (const TimeValue& point : inflow.discharge) hydrograph.points.push_back({point.time, point.value});
  return hydrograph;
}

Wall make_wall(const WallSettings& settings, int material) {
  Wall wall{settings.name, make_shape(settings), settings.slip, material, settings.velocity, settings.roughness};
  if (settings.opens_at > 0) wall.opens_at = settings.opens_at;
  return wall;
}

Walls make_walls(const Scene& scene) {
  Walls walls;
  for (const WallSettings& w : scene.walls) walls.add(make_wall(w, material_index(scene, w.material)));
  return walls;
}

std::optional<double> open_depth(const Walls& walls, const Vec3& lower, const Vec3& upper) {
  constexpr int n = 9;  // points along an edge
  if (walls.empty()) return upper.z() - lower.z();
  for (int i = 0; i < n * n * n; ++i) {
    const int layer = i / (n * n);
    const Vec3 part((i % n + 0.5) / n, (i / n % n + 0.5) / n, (layer + 0.5) / n);
    if (walls.nearest(lower + (upper - lower).cwiseProduct(part)).distance > 0)
      return (upper.z() - lower.z()) * (n - layer) / n;
  }
  return std::nullopt;
}

bool filled_by_walls(const Walls& walls, const Vec3& lower, const Vec3& upper) {
  return !open_depth(walls, lower, upper).has_value();
}

Bounds heightmap_bounds(const WallSettings& s) {
  const ShapeFile& f = s.file;
  const auto map = cases::placed(cases::parse_heightmap(cases::read_bytes(f.file), f.spacing), f.scale, f.translate);
  const Vec3 first(map.x - map.spacing / 2, map.y - map.spacing / 2, map.lowest());
  const Vec3 extent(static_cast<double>(map.columns), static_cast<double>(map.rows), 0);
  Vec3 last = first + map.spacing * extent;
  last.z() = map.highest();
  return {first, last};
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
