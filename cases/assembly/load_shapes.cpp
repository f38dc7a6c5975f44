#include "cases/assembly/load_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>

#include "cases/assembly/memory.h"
#include "cases/files/checkpoint_file.h"
#include "cases/files/heightmap_file.h"
#include "cases/files/mesh_file.h"
#include "cases/scene/value.h"
#include "core/mesh_distance.h"

namespace lahar::scene {
namespace {

namespace fs = std::filesystem;

/// Diameters of the smallest and the largest grain, m; infinity and 0 without any.
std::pair<double, double> grain_diameters(const Scene& scene) {
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  const auto see = [&](double d) { smallest = std::min(smallest, d), largest = std::max(largest, d); };
  for (const Packing& p : scene.grains.packings) {
    for (const GrainSize& s : p.sizes) see(s.diameter);
    for (const LogNormalGrains& g : p.log_normal) see(g.smallest), see(g.largest);
    for (const SievedGrains& g : p.sieved)
      for (const SievePoint& point : g.passing) see(point.opening);
  }
  for (const GrainSphere& s : scene.grains.spheres) see(s.diameter);
  return {smallest, largest};
}

fs::path file_of(const ShapeFile& s, const Place& place) {
  return fs::absolute(fs::path(source_file(place)).parent_path() / s.file).lexically_normal();
}

/// Spacing of the samples: as given, or fine enough for the fluid's cells, or for the smallest grain.
double spacing_of(const Scene& scene, const ShapeFile& s, const Bounds& bounds) {
  if (s.resolution > 0) return s.resolution;
  if (scene.fluid.enabled) return scene.fluid.cell_size / 2;
  const double smallest = grain_diameters(scene).first;
  return std::isfinite(smallest) ? smallest / 8 : (bounds.upper - bounds.lower).norm() / 200;
}

/// At most the area of a surface within a box, m^2: what a triangle has there is no more than a plane through the box
/// around both, whose parts as seen along the axes are those of its sides.
double area_within(const TriangleMesh& mesh, const Vec3& lower, const Vec3& upper) {
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
    const Vec3 sides = upper.cwiseMin(a.cwiseMax(b).cwiseMax(c)) - lower.cwiseMax(a.cwiseMin(b).cwiseMin(c));
    if ((sides.array() < 0).any()) continue;
    const Vec3 seen(sides.y() * sides.z(), sides.z() * sides.x(), sides.x() * sides.y());
    area += std::min(0.5 * (b - a).cross(c - a).norm(), seen.norm());
  }
  return area;
}

/// How far around a surface the fine samples reach: grains touch within their radius.
double band_of(const Scene& scene, double spacing) {
  return std::max(4 * spacing, 0.6 * grain_diameters(scene).second);
}

/// A good file of a shape that does not fit the rest of the scene: `keys` have a part in that, and the file's own may.
/// Keys that begin with "." are those of the shape.
struct Misfit : cases::ShapeFileError {
  Misfit(const std::string& what, std::vector<std::string> with) : ShapeFileError(what), keys(std::move(with)) {}
  std::vector<std::string> keys;
};

const std::vector<std::string> kPlaceKeys{".translate_m", ".scale", "domain.lower_m", "domain.upper_m"},
    kSpacingKeys{".resolution_m", ".scale", "fluid.cell_size_m"};

std::string extent_text(const Vec3& lower, const Vec3& upper) {
  return fmt::format("from ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g}) m", lower.x(), lower.y(), lower.z(), upper.x(),
                     upper.y(), upper.z());
}

Misfit lies_outside(const Scene& scene, const Bounds& bounds) {
  return {fmt::format("lies outside the domain, {}, expected a part of it inside, {}",
                      extent_text(bounds.lower, bounds.upper), extent_text(scene.domain.lower, scene.domain.upper)),
          kPlaceKeys};
}

/// Samples the part of a surface that matters in the domain; `node`, if given, is one of the grid's. Throws Misfit.
std::shared_ptr<const DistanceGrid> sample(const Scene& scene, const TriangleMesh& mesh, const Bounds& bounds,
                                           double spacing, const std::optional<Vec3>& node = std::nullopt) {
  const double band = band_of(scene, spacing);
  const double beyond = std::max(2 * scene.fluid.cell_size, 4 * spacing);  // cells of walls lie outside the domain
  Vec3 lower = (bounds.lower - Vec3::Constant(band)).cwiseMax(scene.domain.lower - Vec3::Constant(beyond));
  const Vec3 upper = (bounds.upper + Vec3::Constant(band)).cwiseMin(scene.domain.upper + Vec3::Constant(beyond));
  if (!(upper.array() > lower.array()).all()) throw lies_outside(scene, bounds);
  const double brick = DistanceGrid::brick_cells * spacing;
  const double fine =
      area_within(mesh, lower, upper) / (brick * brick) * (2 * band / brick + 2) * DistanceGrid::brick_nodes;
  const double bytes = sizeof(float) * (fine + 2 * ((upper - lower) / brick).prod()) +
                       2 * sizeof(double) * (upper - lower).head<2>().prod() / (spacing * spacing);
  if (bytes > 0.25 * static_cast<double>(physical_memory()))
    throw Misfit(fmt::format("reaches {} and takes about {:.2g} GB at a resolution of {:g} m, expected a coarser "
                             "resolution_m (or a scale, where the file is not in metres)",
                             extent_text(bounds.lower, bounds.upper), bytes * 1e-9, spacing),
                 kSpacingKeys);
  if (node) lower = *node + spacing * ((lower - *node) / spacing).array().floor().matrix();
  return sample_distance(mesh, lower, upper, spacing, band);
}

Bounds sample_mesh(const Scene& scene, const fs::path& path, ShapeFile& s,
                   const std::optional<Vec3>& node = std::nullopt) {
  TriangleMesh mesh = cases::read_closed_mesh(path);
  for (Vec3& p : mesh.points) p = s.scale * p + s.translate;
  const Bounds bounds = bounds_of(mesh);
  const double spacing = spacing_of(scene, s, bounds), across = (bounds.upper - bounds.lower).maxCoeff();
  if (spacing > across)
    throw Misfit(fmt::format("is {:g} m across, expected a resolution_m below that, not {:g} m", across, spacing),
                 kSpacingKeys);
  s.sampled.grid = sample(scene, mesh, bounds, spacing, node);
  return bounds;
}

/// Liquid is filled in by distances a quarter of a cell from the faces of each cell (lbm/step/fluid_filling.cpp): with
/// nodes there these are exact, at creases, too. What reaches out of the domain is cut off.
void sample_region(const Scene& scene, const fs::path& path, FluidRegion& r) {
  const Vec3 node = scene.domain.lower + Vec3::Constant(scene.fluid.cell_size / 4);
  const Bounds bounds = sample_mesh(scene, path, r.file, node);
  r.lower = bounds.lower.cwiseMax(scene.domain.lower);
  r.upper = bounds.upper.cwiseMin(scene.domain.upper);
  if (!(r.upper.array() > r.lower.array()).all()) throw lies_outside(scene, bounds);
}

void sample_heightmap(const Scene& scene, const fs::path& path, ShapeFile& s) {
  const auto map = cases::placed(cases::parse_heightmap(cases::read_bytes(path), s.spacing), s.scale, s.translate);
  const Vec3 lower = scene.domain.lower, upper = scene.domain.upper;
  const double spacing = spacing_of(scene, s, {lower, upper}), band = band_of(scene, spacing);
  // Ground under all of the grid, which is rounded up to whole bricks, and for distances at its rim.
  const double beyond = band + std::max(2 * scene.fluid.cell_size, 4 * spacing) + DistanceGrid::brick_cells * spacing;
  const Vec3 margin(beyond, beyond, 0);
  const TriangleMesh mesh = cases::terrain(map, lower - margin, upper + margin);
  const Bounds ground = bounds_of(mesh);
  if (map.lowest() > upper.z() || map.highest() < lower.z())
    throw Misfit(fmt::format("has heights from {:g} to {:g} m, expected some inside the domain, from {:g} to {:g} m",
                             map.lowest(), map.highest(), lower.z(), upper.z()),
                 kPlaceKeys);
  s.sampled.grid = sample(scene, mesh, ground, spacing);
}

std::string check_sum(const fs::path& path) {
  const std::string bytes = cases::read_bytes(path);
  cases::CheckSum sum;
  sum.add(bytes.data(), bytes.size());
  return sum.text();
}

/// Calls `load` with the name of the file of the shape at `path` and makes a mistake of what goes wrong.
template <class Load>
void load_file(ShapeFile& s, const std::string& path, Findings& findings, const Load& load) {
  const std::string key = path + ".file";
  if (!findings.sound({key})) return;
  if (s.file.empty()) return findings.mistake(key, key + " is \"\", expected the name of a file");
  const fs::path file = file_of(s, findings.place(key));
  const auto text = [&](const std::string& what) {
    return fmt::format("{}: {} {}", key, string_text(file.string()), what);
  };
  try {
    load(file);
    s.sampled.check_sum = check_sum(file);
    s.file = file.string();
  } catch (const Misfit& e) {
    std::vector<std::string> others = e.keys;
    for (std::string& other : others)
      if (other.starts_with('.')) other = path + other;
    findings.mistake(key, text(e.what()), others);
  } catch (const cases::ShapeFileError& e) {
    findings.mistake(key, text(e.what()));
  }
}

/// Nothing may look at shapes that are still in their files.
void leave_files(const Scene& scene, Findings& findings) {
  for (std::size_t i = 0; i < scene.walls.size(); ++i)
    if (scene.walls[i].shape == WallShape::mesh || scene.walls[i].shape == WallShape::heightmap)
      findings.not_read(fmt::format("wall[{}].file", i));
  for (std::size_t i = 0; i < scene.fluid.regions.size(); ++i)
    if (scene.fluid.regions[i].shape == RegionShape::mesh) findings.not_read(fmt::format("fluid.region[{}].file", i));
}

/// Of spheres and cylinders, which need no file.
void set_bounds(FluidRegion& r) {
  const Vec3 around = Vec3::Constant(r.radius);
  if (r.shape == RegionShape::sphere) r.lower = r.centre - around, r.upper = r.centre + around;
  if (r.shape != RegionShape::cylinder) return;
  // A disc of radius r and unit axis a reaches r sqrt(1 - a_k^2) along k.
  const Vec3 axis = (r.end - r.start).normalized();
  const Vec3 reach = r.radius * (Vec3::Ones() - axis.cwiseAbs2()).cwiseMax(0).cwiseSqrt();
  r.lower = r.start.cwiseMin(r.end) - reach, r.upper = r.start.cwiseMax(r.end) + reach;
}

}  // namespace

void load_shapes(Scene& scene, Findings& findings) {
  for (std::size_t i = 0; i < scene.fluid.regions.size(); ++i)
    if (findings.sound({fmt::format("fluid.region[{}]", i)})) set_bounds(scene.fluid.regions[i]);
  if (!findings.sound({"domain", "fluid.cell_size_m", "grains"}) ||
      !(scene.domain.upper.array() > scene.domain.lower.array()).all())
    return leave_files(scene, findings);
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    WallSettings& w = scene.walls[i];
    const std::string path = fmt::format("wall[{}]", i);
    if (!findings.sound({path})) continue;
    if (w.shape == WallShape::mesh)
      load_file(w.file, path, findings, [&](const fs::path& file) { sample_mesh(scene, file, w.file); });
    if (w.shape == WallShape::heightmap)
      load_file(w.file, path, findings, [&](const fs::path& file) { sample_heightmap(scene, file, w.file); });
  }
  if (!scene.fluid.enabled) return;
  for (std::size_t i = 0; i < scene.fluid.regions.size(); ++i) {
    FluidRegion& r = scene.fluid.regions[i];
    const std::string path = fmt::format("fluid.region[{}]", i);
    if (!findings.sound({path})) continue;
    if (r.shape == RegionShape::mesh)
      load_file(r.file, path, findings, [&](const fs::path& file) { sample_region(scene, file, r); });
  }
}

}  // namespace lahar::scene
