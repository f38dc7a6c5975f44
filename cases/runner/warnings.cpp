#include "cases/runner/warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <variant>

#include "cases/assembly/estimates.h"
#include "cases/assembly/geometry.h"
#include "cases/assembly/grain_sizes.h"
#include "cases/assembly/memory.h"
#include "coupling/coupling_options.h"

namespace lahar::cases {
namespace {

using List = std::vector<std::string>;

void add_times(const scene::Scene& s, List& list) {
  const auto longer = [&](double interval, const char* key) {
    if (interval > s.run.duration)
      list.push_back(fmt::format("run.{} ({:g} s) is longer than the run ({:g} s)", key, interval, s.run.duration));
  };
  longer(s.run.series_interval, "series_interval_s");
  longer(s.run.output_interval, "output_interval_s");
  longer(s.run.image_interval, "image_interval_s");
  longer(s.run.force_map_interval, "force_map_interval_s");
  longer(s.run.checkpoint_interval, "checkpoint_interval_s");
}

/// Rows of the series come at the first step that has reached their time.
void add_rows(const scene::Scene& s, const CheckReport& figures, List& list) {
  const double step = figures.fluid ? figures.fluid->time_step : figures.solids ? figures.solids->time_step : 0;
  if (step <= 0 || s.run.series_interval <= 0 || s.fluid.adaptive_time_step) return;
  const double steps = s.run.series_interval / step, between = std::abs(steps - std::round(steps));
  constexpr double bearable = 0.1;  // of the interval
  if (between > bearable * steps || steps < 1 - bearable)
    list.push_back(fmt::format("run.series_interval_s ({:g} s) is {:.2g} time steps: rows come every {} steps",
                               s.run.series_interval, steps,
                               steps < 1 ? "1" : fmt::format("{:.0f} or {:.0f}", std::floor(steps), std::ceil(steps))));
}

/// m^3 of the domain, judged at the points of a lattice that has at most 64 an axis.
struct Room {
  double free = 0;    ///< outside walls
  double filled = 0;  ///< of it, by liquid at the start
};

Room room_of(const scene::Scene& s) {
  const Walls walls = scene::make_walls(s);
  std::vector<std::optional<Shape>> bodies;
  for (const scene::FluidRegion& r : s.fluid.regions) bodies.push_back(scene::make_body(r));
  const auto is_filled = [&](const Vec3& p) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const scene::FluidRegion& r = s.fluid.regions[i];
      const bool in_box = (p.array() >= r.lower.array()).all() && (p.array() < r.upper.array()).all();
      if (in_box && (!bodies[i] || std::visit([&](const auto& body) { return body.distance(p); }, *bodies[i]) < 0))
        return true;
    }
    return false;
  };
  const Vec3 extent = s.domain.upper - s.domain.lower;
  const Vec3i points = (extent / s.fluid.cell_size).array().round().max(1).min(64).cast<int>();
  const Vec3 apart = extent.cwiseQuotient(points.cast<double>());
  Room room;
  for (int x = 0; x < points.x(); ++x)
    for (int y = 0; y < points.y(); ++y)
      for (int z = 0; z < points.z(); ++z) {
        const Vec3 p = s.domain.lower + apart.cwiseProduct(Vec3(x + 0.5, y + 0.5, z + 0.5));
        if (walls.nearest(p).distance < 0) continue;
        room.free += apart.prod();
        if (is_filled(p)) room.filled += apart.prod();
      }
  return room;
}

/// Inflows into a domain that nothing leaves.
void add_overfilling(const scene::Scene& s, const FluidFigures& f, List& list) {
  if (f.inflow_cells == 0 || !s.domain.open_faces.empty()) return;
  const Room room = room_of(s);
  const double comes_in = f.inflow_cells * std::pow(s.fluid.cell_size, 3);
  constexpr double rounding = 1e-9;
  if (room.filled + comes_in <= room.free * (1 + rounding)) return;
  std::string names;
  for (const scene::Inflow& i : s.fluid.inflows) names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", i.name);
  list.push_back(
      fmt::format("fluid.inflow {}: {:.3g} m^3 in the time of the run and {:.3g} m^3 at the start are more than the "
                  "{:.3g} m^3 that the domain has room for, and no face is open",
                  names, comes_in, room.filled, room.free));
}

void add_fluid(const scene::Scene& s, const FluidFigures& f, List& list) {
  const bool fragile = !stable_without_eddies(s.fluid.collision) && s.fluid.smagorinsky == 0;
  if (fragile && f.tau - 0.5 < 1e-3)
    list.push_back(fmt::format("tau - 1/2 is {:.2g}: this collision operator is unstable there without smagorinsky > 0",
                               f.tau - 0.5));
  if (f.mach > 0.3)
    list.push_back(
        fmt::format("Ma = {:.2f}: errors of compressibility reach {:.0f} %", f.mach, 100 * f.compressibility_error));
  if (const double drop = drop_speed(s); s.fluid.max_speed > 0 && s.fluid.max_speed < drop)
    list.push_back(
        fmt::format("fluid.max_speed_m_s is {:g} m/s; liquid that enters or falls without loss to the lowest of the "
                    "domain reaches {:.3g} m/s: Ma would be {:.2f}",
                    s.fluid.max_speed, drop, f.mach * drop / s.fluid.max_speed));
  if (!s.fluid.inflows.empty() && f.inflow_cells == 0) list.push_back("inflows bring nothing in the time of the run");
  add_overfilling(s, f, list);
  constexpr double light = 500, heavy = 3000;  // kg/m^3
  if (s.fluid.density < light || s.fluid.density > heavy)
    list.push_back(fmt::format("fluid.density_kg_m3 is {:g}", s.fluid.density));
  if (f.least_limit_viscosity && s.fluid.rheology.limit_viscosity < *f.least_limit_viscosity)
    list.push_back(
        fmt::format("fluid.rheology.limit_viscosity_m2_s is {:g}, less than the {:.3g} of the flow law where "
                    "the liquid shears by its largest speed over its depth: the law is not felt",
                    s.fluid.rheology.limit_viscosity, *f.least_limit_viscosity));
  const bool models =
      s.domain.slip == WallSlip::wall_model ||
      std::any_of(s.walls.begin(), s.walls.end(), [](const auto& wall) { return wall.slip == WallSlip::wall_model; });
  if (models && s.fluid.smagorinsky == 0)
    list.push_back("slip = \"wall_model\" wants an eddy viscosity: fluid.smagorinsky is 0");
  if (f.depth < 4 * s.fluid.cell_size)
    list.push_back(fmt::format("the liquid is only {:.1f} cells deep", f.depth / s.fluid.cell_size));
  const auto have = static_cast<double>(scene::physical_memory());
  if (f.expected_bytes > 0.8 * have)
    list.push_back(fmt::format("the fluid may need {:.1f} GB of the {:.1f} GB of this machine", f.expected_bytes * 1e-9,
                               have * 1e-9));
}

/// Faces of the domain hold the liquid alone: grains need a plane that faces inwards, or a box on the face. What
/// terrain and meshes hold cannot be told; cylinders and spheres hold nothing back.
void add_leaks(const scene::Scene& s, List& list) {
  const auto guards = [&](const scene::WallSettings& w, const Vec3& inwards, int axis, double at) {
    if (w.shape == scene::WallShape::plane) return w.normal.normalized().dot(inwards) > 0.05;
    if (w.shape != scene::WallShape::box)
      return w.shape == scene::WallShape::heightmap || w.shape == scene::WallShape::mesh;
    return w.lower[axis] <= at + 1e-6 && w.upper[axis] >= at - 1e-6;
  };
  std::string faces;
  for (int face = 0; face < 5; ++face) {  // not the top
    const int axis = face / 2;
    const bool upper = face % 2 == 1;
    if (s.domain.open(static_cast<scene::Face>(face)) || s.domain.periodic(static_cast<scene::Axis>(axis))) continue;
    Vec3 inwards = Vec3::Zero();
    inwards[axis] = upper ? -1 : 1;
    const double at = (upper ? s.domain.upper : s.domain.lower)[axis];
    if (std::none_of(s.walls.begin(), s.walls.end(), [&](const auto& w) { return guards(w, inwards, axis, at); }))
      faces += fmt::format("{}{}{}", faces.empty() ? "" : ", ", "xyz"[axis], upper ? '+' : '-');
  }
  if (!faces.empty())
    list.push_back("faces of the domain hold liquid, not grains, which are lost through those without a [[wall]]: " +
                   faces);
}

/// A grain that sinks into the ground under its own weight (Hertz): its modulus is not in Pa.
void add_soft_grains(const scene::Scene& s, List& list) {
  const auto look = [&](const std::string& name, double diameter, double density) {
    const auto m =
        std::find_if(s.materials.begin(), s.materials.end(), [&](const auto& one) { return one.name == name; });
    if (m == s.materials.end()) return false;
    const double radius = diameter / 2, modulus = s.solids.contact_modulus_scale * m->youngs_modulus /
                                                  (2 * (1 - m->poisson_ratio * m->poisson_ratio));
    const double weight = density * std::numbers::pi / 6 * std::pow(diameter, 3) * s.gravity.magnitude;
    const double sunk = std::pow(0.75 * weight / (modulus * std::sqrt(radius)), 2.0 / 3) / radius;
    constexpr double bearable = 0.05;
    if (sunk > bearable)
      list.push_back(
          fmt::format("grains of \"{}\" sink into each other by {:.2g} of a radius under their own weight: "
                      "youngs_modulus_Pa of {:g} Pa is small",
                      name, sunk, m->youngs_modulus));
    return sunk > bearable;
  };
  for (std::size_t i = 0; i < s.grains.packings.size(); ++i)
    for (const scene::GrainSize& size : scene::grain_sizes(s, i))
      if (look(size.material, size.diameter, size.density)) return;
  for (const scene::GrainSphere& sphere : s.grains.spheres)
    if (look(sphere.material, sphere.diameter, sphere.density)) return;
}

void add_barrier(const scene::Scene& s, List& list) {
  const scene::Posts& posts = s.barrier.posts;
  if (posts.enabled && posts.foot == scene::FootJoint::hinged && posts.elements.of<barrier::RetainingCable>().empty())
    list.push_back("posts are hinged, and no [[barrier.posts.retaining]] holds them");
  if (!posts.enabled && s.barrier.anchors.cable_places.empty())
    list.push_back("barrier.anchors.cable_places is empty: no end of a cable is fixed");
}

void add_solids(const scene::Scene& s, const SolidsFigures& f, List& list) {
  const double critical = std::min(
      {f.limits.grain_rayleigh, f.limits.bead_rayleigh, f.limits.ring_bond, f.limits.cable_bond, f.limits.post_bond});
  if (s.solids.time_step > critical)
    list.push_back(fmt::format("solids.time_step_s ({:.3g} s) is above the critical time step ({:.3g} s)",
                               s.solids.time_step, critical));
  if (s.solids.contact_modulus_scale < 1)
    list.push_back(fmt::format("contacts are softened: moduli times {:g}", s.solids.contact_modulus_scale));
  if (s.solids.bond_stiffness_scale < 1 && s.barrier.enabled)
    list.push_back(fmt::format("bonds are softened: stiffness times {:g}", s.solids.bond_stiffness_scale));
  if (s.barrier.enabled && s.barrier.net.bead_mass_scale > 1)
    list.push_back(fmt::format("beads of the barrier are slow: inertia times {:g}", s.barrier.net.bead_mass_scale));
  if (s.walls.empty() && f.grains > 0) list.push_back("there are grains but no walls: nothing holds them");
  if (!s.walls.empty() && f.grains > 0) add_leaks(s, list);
  if (f.grains > 0) add_soft_grains(s, list);
  if (s.barrier.enabled) add_barrier(s, list);
}

/// The domain is divided into equal lengths: where few have room each is much longer than was asked for.
void add_divided_lengths(const scene::Scene& s, const Vec3& lengths, List& list) {
  constexpr double bearable = 1.15;  // of what was asked for
  const double asked = s.coupling.averaging_length;
  for (int a = 0; a < 3; ++a)
    if (lengths[a] > bearable * asked)
      list.push_back(
          fmt::format("coupling.averaging_length_m is {:g}, but along {} the domain is divided into lengths "
                      "of {:.3g} m: choose one that divides it",
                      asked, "xyz"[a], lengths[a]));
}

void add_coupling(const scene::Scene& s, const SolidsFigures& f, List& list) {
  if (!s.coupling.enabled) return list.push_back("fluid and particles do not feel each other: coupling is off");
  if (f.cells_per_smallest_grain && *f.cells_per_smallest_grain < 4)
    list.push_back(fmt::format("the smallest grain is {:.1f} cells across: its drag is uncertain below about 4",
                               *f.cells_per_smallest_grain));
  constexpr double light = 0.2;  // docs/decisions/0034
  if (f.lightest_grain && *f.lightest_grain < light)
    list.push_back(
        fmt::format("the lightest grain has {:.2g} of the liquid's density: those below {:g} that touch each "
                    "other or a wall may be thrown about",
                    *f.lightest_grain, light));
  if (f.averaging_diameters && *f.averaging_diameters < 2)
    list.push_back(fmt::format(
        "coupling.averaging_length_m is {:.2g} diameters of the largest grain: averages swing with every grain below 2",
        *f.averaging_diameters));
  if (f.averaging_lengths) add_divided_lengths(s, *f.averaging_lengths, list);
  constexpr double shift_of_note = 0.05;  // cells: a fifth of the drag of grains of 4 cells
  if (f.cell_reynolds && lbm::by_wall_distance(s.coupling.body_weighting))
    if (const double shift = coupling::radius_shift_at(*f.cell_reynolds);
        std::abs(shift - s.coupling.radius_shift_cells) > shift_of_note)
      list.push_back(
          fmt::format("coupling.radius_shift_cells is {:g}: for grains that settle, with {:.3g} as the "
                      "Reynolds number of a cell, {:.2f} gives the drag",
                      s.coupling.radius_shift_cells, *f.cell_reynolds, shift));
  constexpr double fast = 25;  // cell Reynolds number: docs/decisions/0054
  if (f.cell_reynolds && *f.cell_reynolds > fast && !s.grains.packings.empty() &&
      s.coupling.body_weighting == scene::BodyWeighting::wall_distance)
    list.push_back(
        "coupling.body_weighting is \"wall_distance\": grains that run through the cells much faster than the liquid "
        "runs past them drag it up to 13 times too much at 30 times that speed; \"inertial\" twice");
  if (f.cells_per_wire && !s.coupling.wire_drag &&
      *f.cells_per_wire < s.coupling.resolve_wires_from_cells.value_or(*f.cells_per_wire + 1))
    list.push_back(fmt::format(
        "wires are {:.1f} cells across and coupling.wire_drag is off: water does not feel the net", *f.cells_per_wire));
  if (s.barrier.enabled && s.barrier.net.kind == scene::NetKind::hexagonal)
    list.push_back("water feels the cables of a hexagonal mesh, but not its wires");
  if (const double post = s.barrier.posts.diameter / s.fluid.cell_size;
      s.coupling.wire_drag && post > 4 && post < s.coupling.resolve_wires_from_cells.value_or(post + 1))
    list.push_back(fmt::format("posts are {:.1f} cells across: their drag law is for wires up to about 4", post));
  if (s.coupling.body_weighting == scene::BodyWeighting::noble_torczynski)
    list.push_back("coupling.body_weighting = \"noble_torczynski\" lets water through bodies at low viscosity");
}

std::set<std::string> materials_in_use(const scene::Scene& s) {
  std::set<std::string> names;
  for (const auto& w : s.walls) names.insert(w.material);
  for (const auto& p : s.grains.packings) {
    for (const auto& g : p.sizes) names.insert(g.material);
    for (const auto& g : p.log_normal) names.insert(g.material);
    for (const auto& g : p.sieved) names.insert(g.material);
  }
  for (const auto& g : s.grains.spheres) names.insert(g.material);
  if (s.barrier.enabled) names.insert(s.barrier.net.material);
  return names;
}

/// Materials of things that move: walls do not touch each other.
bool only_walls(const scene::Scene& s, const std::string& a) {
  const auto is = [&](const auto& thing) { return thing.material == a; };
  for (const auto& p : s.grains.packings)
    if (std::any_of(p.sizes.begin(), p.sizes.end(), is) || std::any_of(p.log_normal.begin(), p.log_normal.end(), is) ||
        std::any_of(p.sieved.begin(), p.sieved.end(), is))
      return false;
  if (std::any_of(s.grains.spheres.begin(), s.grains.spheres.end(), is)) return false;
  return !(s.barrier.enabled && s.barrier.net.material == a);
}

void add_contacts(const scene::Scene& s, List& list) {
  constexpr double steep = 3;
  for (const scene::Contact& c : s.contacts)
    if (c.friction > steep)
      list.push_back(fmt::format("friction of \"{}\" and \"{}\" is {:g}: it is a coefficient, no angle", c.materials[0],
                                 c.materials[1], c.friction));
  const std::set<std::string> names = materials_in_use(s);
  for (auto a = names.begin(); a != names.end(); ++a)
    for (auto b = a; b != names.end(); ++b) {
      const bool listed = std::any_of(s.contacts.begin(), s.contacts.end(), [&](const scene::Contact& c) {
        return (c.materials[0] == *a && c.materials[1] == *b) || (c.materials[0] == *b && c.materials[1] == *a);
      });
      if (!listed && !(only_walls(s, *a) && only_walls(s, *b)))
        list.push_back(fmt::format("no [[contact]] for \"{}\" and \"{}\": they are smooth and elastic", *a, *b));
    }
}

void add_packings(const scene::Scene& s, List& list) {
  constexpr double random_close_packing = 0.64;
  for (std::size_t i = 0; i < s.grains.packings.size(); ++i) {
    const scene::Packing& p = s.grains.packings[i];
    double solid = 0;
    for (const scene::GrainSize& size : scene::grain_sizes(s, i))
      solid += static_cast<double>(size.count) * std::numbers::pi / 6 * std::pow(size.diameter, 3);
    Vec3 box = p.upper - p.lower;
    if (p.target_height > 0) box.z() = p.target_height;
    constexpr double rounding = 1e-3;  // of drawn grains
    if (solid > (random_close_packing + rounding) * box.prod())
      list.push_back(fmt::format("a packing is to fill {:.3f} of its space: more than random packings do (about {})",
                                 solid / box.prod(), random_close_packing));
  }
}

/// What lies in walls, or over something else.
void add_places(const scene::Scene& s, List& list) {
  const Walls walls = scene::make_walls(s);
  const auto look = [&](const std::string& path, const Vec3& lower, const Vec3& upper) {
    if (scene::filled_by_walls(walls, lower, upper)) list.push_back(path + " lies in walls: nothing of it is left");
  };
  if (s.fluid.enabled) {
    for (std::size_t i = 0; i < s.fluid.regions.size(); ++i)
      look(fmt::format("fluid.region[{}]", i), s.fluid.regions[i].lower, s.fluid.regions[i].upper);
    for (std::size_t i = 0; i < s.fluid.inflows.size(); ++i)
      look(fmt::format("fluid.inflow[{}]", i), s.fluid.inflows[i].lower, s.fluid.inflows[i].upper);
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

/// Ground that a heightmap does not reach is level.
void add_heightmaps(const scene::Scene& s, List& list) {
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
  const Vec3i first = ((lower - s.domain.lower) / dx - Vec3::Constant(0.5)).array().ceil().cast<int>();
  const Vec3i end = ((upper - s.domain.lower) / dx - Vec3::Constant(0.5)).array().ceil().cast<int>();
  const Shape shape = scene::make_wall(solid, -1).shape;
  for (int z = first.z(); z < end.z(); ++z)
    for (int y = first.y(); y < end.y(); ++y)
      for (int x = first.x(); x < end.x(); ++x) {
        const Vec3 centre = s.domain.lower + dx * (Vec3(x, y, z) + Vec3::Constant(0.5));
        if (std::visit([&](const auto& body) { return body.distance(centre); }, shape) < 0) return true;
      }
  return false;
}

/// Walls that stand beside the domain, and shapes that are sampled more coarsely than the cells.
void add_lost_walls(const scene::Scene& s, List& list) {
  for (const scene::WallSettings& w : s.walls) {
    const auto bounds = bounds_of(w);
    if (bounds && !((bounds->upper.array() > s.domain.lower.array()).all() &&
                    (bounds->lower.array() < s.domain.upper.array()).all()))
      list.push_back(fmt::format("wall \"{}\" stands outside the domain: nothing meets it", w.name));
    if (s.fluid.enabled && w.file.resolution > s.fluid.cell_size)
      list.push_back(
          fmt::format("resolution_m of wall \"{}\" is {:g} m, more than a cell ({:g} m): what is smaller is "
                      "smoothed away",
                      w.name, w.file.resolution, s.fluid.cell_size));
  }
}

/// Solids so thin that they fall between the centres of cells.
void add_thin_walls(const scene::Scene& s, List& list) {
  for (const scene::WallSettings& w : s.walls) {
    const auto bounds = bounds_of(w);
    if (!bounds) continue;
    const bool inside = (bounds->upper.array() > s.domain.lower.array()).all() &&
                        (bounds->lower.array() < s.domain.upper.array()).all();
    if (inside && !has_a_cell(w, *bounds, s))
      list.push_back(fmt::format("wall \"{}\" has no cell of its own (of {:g} m): the liquid does not feel it", w.name,
                                 s.fluid.cell_size));
  }
}

/// Faces of the domain and walls along the axes that fall between the faces of cells.
void add_rounded_walls(const scene::Scene& s, List& list) {
  const auto acts_at = [&](double x, int axis) {
    const double from = s.domain.lower[axis];
    return from + s.fluid.cell_size * std::round((x - from) / s.fluid.cell_size);
  };
  const auto tell = [&](const std::string& what, double x, int axis) {
    constexpr double bearable = 0.01;  // of a cell
    if (x < s.domain.lower[axis] || x > s.domain.upper[axis]) return;
    if (std::abs(acts_at(x, axis) - x) > bearable * s.fluid.cell_size)
      list.push_back(fmt::format("{} at {} = {:.6g} m acts on the liquid at {:.6g} m, the nearest faces of cells", what,
                                 "xyz"[axis], x, acts_at(x, axis)));
  };
  const auto is_between_cells = [&](WallSlip slip) {
    return s.fluid.wall_placement == scene::WallPlacement::half_way || slip != WallSlip::no_slip;
  };
  for (int axis = 0; axis < 3; ++axis)
    if (is_between_cells(s.domain.slip) && !s.domain.open(static_cast<scene::Face>(2 * axis + 1)) &&
        !s.domain.periodic(static_cast<scene::Axis>(axis)))
      tell("domain.upper_m", s.domain.upper[axis], axis);
  for (const scene::WallSettings& w : s.walls) {
    if (!is_between_cells(w.slip)) continue;
    const std::string what = fmt::format("wall \"{}\"", w.name);
    for (int axis = 0; axis < 3; ++axis) {
      if (w.shape == scene::WallShape::plane && std::abs(w.normal.normalized()[axis]) > 1 - 1e-9)
        tell(what, w.point[axis], axis);
      if (w.shape == scene::WallShape::box && has_a_cell(w, {w.lower, w.upper}, s))
        tell(what, w.lower[axis], axis), tell(what, w.upper[axis], axis);
    }
  }
}

}  // namespace

std::vector<std::string> warnings(const scene::Scene& scene, const CheckReport& figures) {
  List list;
  add_times(scene, list);
  add_rows(scene, figures, list);
  add_places(scene, list);
  add_heightmaps(scene, list);
  add_lost_walls(scene, list);
  if (figures.fluid) add_thin_walls(scene, list);
  if (figures.fluid) add_rounded_walls(scene, list);
  if (figures.fluid) add_fluid(scene, *figures.fluid, list);
  if (figures.solids) add_solids(scene, *figures.solids, list);
  if (figures.fluid && figures.solids) add_coupling(scene, *figures.solids, list);
  if (figures.solids) add_contacts(scene, list), add_packings(scene, list);
  return list;
}

}  // namespace lahar::cases
