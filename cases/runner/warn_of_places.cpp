#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>

#include "cases/assembly/cells_inside.h"
#include "cases/assembly/geometry.h"
#include "cases/assembly/memory.h"
#include "cases/runner/warnings_by_part.h"
#include "cases/scene/value.h"

namespace lahar::cases {
namespace {

/// What lies in walls, or over something else.
void add_places(const scene::Scene& s, Warnings& list) {
  const Walls walls = scene::make_walls(s);
  if (s.fluid.enabled) {
    for (std::size_t i = 0; i < s.fluid.regions.size(); ++i)
      if (scene::liquid_of_region(s, walls, i).share == 0)
        list.push_back(
            fmt::format("fluid.region[{}] lies in walls, or in regions before it: nothing of it is left", i));
    for (std::size_t i = 0; i < s.fluid.inflows.size(); ++i)
      if (scene::filled_by_walls(walls, s.fluid.inflows[i].lower, s.fluid.inflows[i].upper))
        list.push_back(fmt::format("fluid.inflow[{}] lies in walls: nothing of it is left", i));
  }
  for (std::size_t i = 0; i < s.probes.size(); ++i) {
    const scene::Probe& p = s.probes[i];
    const double slack = s.fluid.enabled ? s.fluid.cell_size : 0.0;
    if ((p.kind == scene::ProbeKind::pressure || p.kind == scene::ProbeKind::velocity) && !walls.empty() &&
        walls.nearest(p.position).distance < -slack)
      list.push_back(fmt::format("probe[{}] lies in a wall", i));
  }
  constexpr double clear = 1.5;  // cells: cells at an open face hold less than what leaves through it
  for (const scene::FluxSection& section : s.sections)
    for (int a = 0; s.fluid.enabled && a < 3; ++a)
      for (const int side : {0, 1}) {
        const double from_face =
            std::abs(section.point[a] - (side == 0 ? s.domain.lower : s.domain.upper)[a]) / s.fluid.cell_size;
        if (s.domain.open(static_cast<scene::Face>(2 * a + side)) && from_face < clear &&
            std::abs(section.normal[a]) > 0.9 * section.normal.norm())
          list.push_back(
              fmt::format("section \"{}\" is {:.1f} cells off an open face, where it reads up to a fifth too "
                          "much; 2 cells off it reads what passes",
                          section.name, from_face));
      }
  const auto& packings = s.grains.packings;
  for (std::size_t i = 0; i < packings.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if ((packings[i].lower.array() < packings[k].upper.array()).all() &&
          (packings[k].lower.array() < packings[i].upper.array()).all())
        list.push_back(
            fmt::format("grains.packing[{}] and grains.packing[{}] share space: their grains may overlap", k, i));
}

/// A grain probe follows the nearest grain, however far it is.
void add_far_grains(const scene::Scene& s, Warnings& list) {
  for (std::size_t i = 0; i < s.probes.size(); ++i) {
    if (s.probes[i].kind != scene::ProbeKind::grain) continue;
    const Vec3& point = s.probes[i].position;
    double nearest = std::numeric_limits<double>::infinity(), size = 0;  // m; of the grain or the box of grains there
    const auto meet = [&](double distance, double size_there) {
      if (distance < nearest) nearest = distance, size = size_there;
    };
    for (const scene::GrainSphere& g : s.grains.spheres)
      meet((g.position - point).norm() - 0.5 * g.diameter, g.diameter);
    for (const scene::Packing& box : s.grains.packings)
      meet((point - point.cwiseMax(box.lower).cwiseMin(box.upper)).norm(), (box.upper - box.lower).minCoeff());
    if (std::isfinite(nearest) && nearest > size)
      list.push_back(fmt::format("probe[{}] follows the nearest grain, which starts {:.3g} m from its point or farther",
                                 i, nearest));
  }
}

/// Liquid that is made at a face of the domain and flows into it.
void add_inflows_that_leave(const scene::Scene& s, Warnings& list) {
  for (std::size_t i = 0; i < s.fluid.inflows.size(); ++i) {
    const scene::Inflow& in = s.fluid.inflows[i];
    Eigen::Index axis = 0;
    in.velocity.cwiseAbs().maxCoeff(&axis);
    const bool up = in.velocity[axis] > 0;
    const double room = up ? s.domain.upper[axis] - in.upper[axis] : in.lower[axis] - s.domain.lower[axis];
    if (in.velocity[axis] == 0 || s.domain.periodic(static_cast<scene::Axis>(axis)) || room >= s.fluid.cell_size)
      continue;
    list.push_back(fmt::format("fluid.inflow[{}] flows towards the domain's {} face, at which it stands", i,
                               std::string{"xyz"[axis], up ? '+' : '-'}));
  }
}

/// Names are optional.
std::string name_of(const scene::Scene& s, const scene::WallSettings& w) {
  return w.name.empty() ? fmt::format("wall[{}]", &w - s.walls.data()) : "wall " + scene::string_text(w.name);
}

/// Ground that a heightmap does not reach is level.
void add_heightmaps(const scene::Scene& s, Warnings& list) {
  for (std::size_t i = 0; i < s.walls.size(); ++i) {
    const scene::WallSettings& w = s.walls[i];
    if (w.shape != scene::WallShape::heightmap) continue;
    const Bounds map = scene::heightmap_bounds(w);
    const Vec3 missing = (map.lower - s.domain.lower).cwiseMax(s.domain.upper - map.upper);
    constexpr double bearable = 1e-6;  // m
    if (missing.head<2>().maxCoeff() > bearable)
      list.push_back(
          fmt::format("wall[{}] covers x from {:g} to {:g} m and y from {:g} to {:g} m, not all of the domain: beyond, "
                      "the ground is level",
                      i, map.lower.x(), map.upper.x(), map.lower.y(), map.upper.y()));
  }
}

/// The box around a solid that stands in the domain; none of other walls.
std::optional<Bounds> bounds_of(const scene::WallSettings& w) {
  const Vec3 around = Vec3::Constant(w.radius);
  switch (w.shape) {
    case scene::WallShape::box:
      return Bounds{w.lower, w.upper};
    case scene::WallShape::sphere:
      return Bounds{w.centre - around, w.centre + around};
    case scene::WallShape::cylinder:
      return Bounds{w.start.cwiseMin(w.end) - around, w.start.cwiseMax(w.end) + around};
    case scene::WallShape::mesh:
      return Bounds{w.file.sampled.grid->lower(), w.file.sampled.grid->upper()};
    case scene::WallShape::plane:
    case scene::WallShape::heightmap:
      break;
  }
  return std::nullopt;
}

/// Whether the centre of a cell lies in a solid within some bounds: without one it is no wall to the liquid.
bool has_a_cell(const scene::WallSettings& solid, const Bounds& bounds, const scene::Scene& s) {
  const double dx = s.fluid.cell_size;
  const Vec3 lower = bounds.lower.cwiseMax(s.domain.lower), upper = bounds.upper.cwiseMin(s.domain.upper);
  if (!(lower.array() < upper.array()).all()) return false;
  const auto cell_from = [&](const Vec3& p) {
    return Vec3i(((p - s.domain.lower) / dx - Vec3::Constant(0.5)).array().ceil().cast<int>());
  };
  const scene::CellBox box{cell_from(lower), cell_from(upper), s.domain.lower, dx};
  const Shape shape = scene::make_wall(solid, -1).shape;
  return scene::cells_inside(box, 1, [&](const Vec3& p) {
           return std::visit([&](const auto& body) { return body.distance(p) + 1e-6 * dx; }, shape);
         }) > 0;
}

/// Walls that stand beside the domain, and shapes that are sampled more coarsely than the cells.
void add_lost_walls(const scene::Scene& s, Warnings& list) {
  for (const scene::WallSettings& w : s.walls) {
    const auto bounds = bounds_of(w);
    // One that ends at a face of the domain bears what comes to rest there.
    if (bounds && !((bounds->upper.array() >= s.domain.lower.array()).all() &&
                    (bounds->lower.array() <= s.domain.upper.array()).all()))
      list.push_back(name_of(s, w) + " stands outside the domain: nothing meets it");
    if (s.fluid.enabled && w.file.resolution > s.fluid.cell_size)
      list.push_back(
          fmt::format("resolution_m of {} is {:g} m, more than a cell ({:g} m): what is smaller is "
                      "smoothed away",
                      name_of(s, w), w.file.resolution, s.fluid.cell_size));
  }
}

/// Solids so thin that they fall between the centres of cells.
void add_thin_walls(const scene::Scene& s, Warnings& list) {
  for (const scene::WallSettings& w : s.walls) {
    const auto bounds = bounds_of(w);
    if (!bounds) continue;
    const bool inside = (bounds->upper.array() > s.domain.lower.array()).all() &&
                        (bounds->lower.array() < s.domain.upper.array()).all();
    if (inside && !has_a_cell(w, *bounds, s))
      list.push_back(fmt::format("{} has no cell of its own (of {:g} m): the liquid does not feel it", name_of(s, w),
                                 s.fluid.cell_size));
  }
}

/// Faces of the domain and walls along the axes that fall between the faces of cells.
void add_rounded_walls(const scene::Scene& s, Warnings& list) {
  // A cell whose centre lies on a wall is liquid. `free`: on which side of the wall, 1 or -1.
  const auto acts_at = [&](double x, int axis, double free) {
    const double from = s.domain.lower[axis], dx = s.fluid.cell_size;
    double face = std::round((x - from) / dx);
    const auto is_wall = [&](double cell) { return free * (from - dx + (cell + 1.5) * dx - x) < -1e-6 * dx; };
    const auto beside = [&] { return free > 0 ? face : face - 1; };  // the free cell at the face
    if (is_wall(beside())) face += free;
    if (!is_wall(beside() - free)) face -= free;
    return from + dx * face;
  };
  int found = 0;
  constexpr int most_told = 12;
  const auto tell = [&](const std::string& what, double x, int axis, double free) {
    constexpr double bearable = 0.01;  // of a cell
    if (x < s.domain.lower[axis] || x > s.domain.upper[axis]) return;
    if (std::abs(acts_at(x, axis, free) - x) <= bearable * s.fluid.cell_size || ++found > most_told) return;
    list.push_back(fmt::format("{} at {} = {:.6g} m acts on the liquid at {:.6g} m, the nearest faces of cells", what,
                               "xyz"[axis], x, acts_at(x, axis, free)));
  };
  const auto is_between_cells = [&](WallSlip slip) {
    return s.fluid.wall_placement == scene::WallPlacement::half_way || slip != WallSlip::no_slip;
  };
  for (int axis = 0; axis < 3; ++axis)
    if (is_between_cells(s.domain.slip) && !s.domain.open(static_cast<scene::Face>(2 * axis + 1)) &&
        !s.domain.periodic(static_cast<scene::Axis>(axis)))
      tell("domain.upper_m", s.domain.upper[axis], axis, -1);
  for (const scene::WallSettings& w : s.walls) {
    if (!is_between_cells(w.slip)) continue;
    const std::string what = name_of(s, w);
    for (int axis = 0; axis < 3; ++axis) {
      if (w.shape == scene::WallShape::plane && std::abs(w.normal.normalized()[axis]) > 1 - 1e-9)
        tell(what, w.point[axis], axis, w.normal[axis] > 0 ? 1 : -1);
      if (w.shape == scene::WallShape::box && has_a_cell(w, {w.lower, w.upper}, s))
        tell(what, w.lower[axis], axis, -1), tell(what, w.upper[axis], axis, 1);
    }
  }
  if (found > most_told)
    list.push_back(
        fmt::format("{} more faces of walls act on the liquid elsewhere than where they stand", found - most_told));
}

/// Boxes let into a plane: what rolls over both touches both.
void add_flush_boxes(const scene::Scene& s, Warnings& list) {
  constexpr double level = 1e-6;  // m
  for (const scene::WallSettings& box : s.walls)
    for (const scene::WallSettings& plane : s.walls) {
      if (box.shape != scene::WallShape::box || plane.shape != scene::WallShape::plane) continue;
      const Vec3 normal = plane.normal.normalized();
      const int axis = static_cast<int>(
          std::max_element(&normal[0], &normal[0] + 3, [](double a, double b) { return std::abs(a) < std::abs(b); }) -
          &normal[0]);
      const double face = normal[axis] > 0 ? box.upper[axis] : box.lower[axis];
      if (std::abs(normal[axis]) > 1 - 1e-9 && std::abs(face - plane.point[axis]) < level)
        list.push_back(fmt::format("{} ends in the plane of {}: particles there touch both, and each bears half",
                                   name_of(s, box), name_of(s, plane)));
    }
}

void add_late_gates(const scene::Scene& s, Warnings& list) {
  for (const scene::WallSettings& w : s.walls)
    if (w.opens_at > 0 && w.opens_at >= s.run.duration)
      list.push_back(fmt::format("{} opens at {:g} s: not within run.duration_s = {:g}", name_of(s, w), w.opens_at,
                                 s.run.duration));
}

/// Coordinates of a map's own grid, say: far from the origin files hold them too coarsely.
void add_far_places(const scene::Scene& s, Warnings& list) {
  const double far = std::max(s.domain.lower.cwiseAbs().maxCoeff(), s.domain.upper.cwiseAbs().maxCoeff());
  const double apart = far * std::pow(2.0, -23);
  const double small = s.fluid.enabled ? s.fluid.cell_size : 1e-4 * (s.domain.upper - s.domain.lower).maxCoeff();
  if (apart > 0.01 * small)
    list.push_back(
        fmt::format("coordinates reach {:.6g} m: files hold places in single precision, up to {:.2g} m apart "
                    "there; put the origin near the domain",
                    far, apart));
}

}  // namespace

void warn_of_places(const scene::Scene& scene, bool has_fluid, Warnings& list) {
  add_places(scene, list);
  add_heightmaps(scene, list);
  add_lost_walls(scene, list);
  if (scene.has_solids()) add_flush_boxes(scene, list);
  add_late_gates(scene, list);
  add_far_grains(scene, list);
  if (has_fluid) add_inflows_that_leave(scene, list);
  add_far_places(scene, list);
  if (has_fluid) add_thin_walls(scene, list);
  if (has_fluid) add_rounded_walls(scene, list);
}

}  // namespace lahar::cases
