// Cross checks of extents: boxes, walls, fluid regions, cells.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "cases/assembly/cells_inside.h"
#include "cases/assembly/cross_checks.h"
#include "cases/assembly/estimates.h"
#include "cases/assembly/geometry.h"
#include "cases/assembly/memory.h"
#include "cases/scene/value.h"
#include "lbm/free_surface/inflow.h"

namespace lahar::scene {
namespace {

/// Adds a mistake unless a box has an extent along every axis. Returns whether the box is usable.
bool check_box(const Vec3& lower, const Vec3& upper, const std::string& path, Findings& findings) {
  if (!findings.sound({path + ".lower_m", path + ".upper_m"})) return false;
  if ((upper.array() > lower.array()).all()) return true;
  findings.mistake(path + ".upper_m", path + ".upper_m is not above lower_m, expected every component above",
                   {path + ".lower_m"});
  return false;
}

/// Adds a mistake for each corner of a box that lies outside the domain.
void check_corners(const Vec3& lower, const Vec3& upper, const Domain& domain, const std::string& path,
                   Findings& findings) {
  const double slack = 1e-9 * (domain.upper - domain.lower).norm();
  for (const auto& [corner, key] : {std::pair{lower, ".lower_m"}, std::pair{upper, ".upper_m"}})
    if (!domain.contains(corner, slack))
      findings.mistake(path + key, fmt::format("{}{} lies outside the domain, expected it inside [domain]", path, key));
}

/// Whether a box has a face in the domain that its velocity leaves: liquid would be pumped through.
bool leaves_its_faces(const WallSettings& w, const Domain& domain) {
  for (int a = 0; a < 3; ++a) {
    const bool inside = w.lower[a] > domain.lower[a] || w.upper[a] < domain.upper[a];
    if (w.velocity[a] != 0 && inside) return true;
  }
  return false;
}

void check_wall(const WallSettings& w, const Scene& scene, const std::string& path, Findings& findings) {
  if (!findings.sound({path})) return;
  if (w.roughness > 0 && w.slip != WallSlip::wall_model)
    findings.mistake(path + ".roughness_m", path + ".roughness_m without a wall model, expected slip = \"wall_model\"");
  if (w.slip == WallSlip::free_slip && w.velocity.norm() > 0)
    findings.mistake(path + ".velocity_m_s",
                     path + ".velocity_m_s of a wall that slips moves nothing, expected slip = \"no_slip\"");
  if (w.shape == WallShape::box && check_box(w.lower, w.upper, path, findings) && findings.sound({"domain"}) &&
      leaves_its_faces(w, scene.domain))
    findings.mistake(path + ".velocity_m_s", path +
                                                 ".velocity_m_s leaves a face of the box in the domain, expected it "
                                                 "along all of them (the wall stays in place)");
  if (w.shape == WallShape::cylinder && (w.end - w.start).norm() == 0)
    findings.mistake(path + ".end_m", path + ".end_m equals start_m, expected an axis with a length");
  if (w.shape != WallShape::plane) return;
  if (w.normal.norm() == 0) {
    findings.mistake(path + ".normal", path + ".normal is zero, expected a direction");
  } else if (std::abs(w.normal.normalized().dot(w.velocity)) > 1e-9 * (1 + w.velocity.norm())) {
    findings.mistake(path + ".velocity_m_s",
                     path + ".velocity_m_s leaves the plane, expected it at right angles to normal");
  }
}

/// Beyond its map the ground goes on level: a map beside the domain would be a level floor.
void check_heightmap(const Scene& scene, std::size_t i, Findings& findings) {
  const WallSettings& w = scene.walls[i];
  const std::string path = fmt::format("wall[{}].file", i);
  if (w.shape != WallShape::heightmap || w.file.sampled.grid == nullptr) return;
  const Bounds map = heightmap_bounds(w);
  if ((map.lower.head<2>().array() < scene.domain.upper.head<2>().array()).all() &&
      (map.upper.head<2>().array() > scene.domain.lower.head<2>().array()).all())
    return;
  findings.mistake(
      path, fmt::format("{}: {} covers x from {:g} to {:g} m and y from {:g} to {:g} m, expected some "
                        "of the domain (translate_m moves it)",
                        path, string_text(w.file.file), map.lower.x(), map.upper.x(), map.lower.y(), map.upper.y()));
}

void check_region(const Scene& scene, std::size_t i, Findings& findings) {
  const FluidRegion& r = scene.fluid.regions[i];
  const std::string path = fmt::format("fluid.region[{}]", i);
  if (!findings.sound({path, "domain"})) return;
  if (r.shape == RegionShape::cylinder && (r.end - r.start).norm() == 0)
    return findings.mistake(path + ".end_m", path + ".end_m equals start_m, expected an axis with a length");
  if (r.shape == RegionShape::box && !check_box(r.lower, r.upper, path, findings)) return;
  const double slack = 1e-9 * (scene.domain.upper - scene.domain.lower).norm();
  if (r.shape != RegionShape::box) {
    if (!scene.domain.contains(r.lower, slack) || !scene.domain.contains(r.upper, slack))
      findings.mistake(path + ".shape", path + " reaches outside the domain, expected it inside [domain]");
    return;
  }
  check_corners(r.lower, r.upper, scene.domain, path, findings);
}

/// s, when liquid begins to come.
double start_of(const Inflow& in) {
  const auto comes = std::find_if(in.discharge.begin(), in.discharge.end(), [](const auto& q) { return q.value > 0; });
  if (comes == in.discharge.end()) return 0;
  return comes == in.discharge.begin() ? comes->time : std::prev(comes)->time;
}

/// Cells of an inflow's box outside walls that stand when it begins, both by their centres
/// (lbm/free_surface/inflow.h). Not all are counted where there are `enough`.
double free_cells(const Inflow& in, const Scene& scene, double enough) {
  const double dx = scene.fluid.cell_size;
  Walls walls = make_walls(scene);
  walls.open_by(start_of(in));
  const auto cell_from = [&](const Vec3& p) {
    return Vec3i(((p - scene.domain.lower) / dx - Vec3::Constant(0.5 + 1e-9)).array().ceil().cast<int>());
  };
  const CellBox box{cell_from(in.lower), cell_from(in.upper), scene.domain.lower, dx};
  // A centre on a wall counts as free.
  return cells_inside(box, enough, [&](const Vec3& p) { return -walls.nearest(p).distance - 1e-9 * dx; });
}

void check_inflow(const Scene& scene, std::size_t i, Findings& findings) {
  const Inflow& in = scene.fluid.inflows[i];
  const std::string path = fmt::format("fluid.inflow[{}]", i);
  if (!check_box(in.lower, in.upper, path, findings)) return;
  if (findings.sound({"domain"})) check_corners(in.lower, in.upper, scene.domain, path, findings);
  if (findings.sound({"fluid.cell_size_m"}) && (in.upper - in.lower).minCoeff() < scene.fluid.cell_size)
    findings.mistake(path + ".upper_m", path + ".upper_m: the box is thinner than a cell, expected at least one");
  if (!findings.sound({path + ".discharge_m3_s"})) return;
  for (std::size_t k = 0; k + 1 < in.discharge.size(); ++k)
    if (in.discharge[k + 1].time <= in.discharge[k].time)
      return findings.mistake(
          path + ".discharge_m3_s",
          fmt::format("{}.discharge_m3_s: entry {} is not later than the one before, expected rising "
                      "times",
                      path, k + 2));
  if (!findings.sound({"fluid", "domain", "gravity", "run", "wall"})) return;
  const double largest = cases::peak_discharge(in);
  const double cell_takes = lbm::kLargestDose * std::pow(scene.fluid.cell_size, 3) / cases::fluid_time_step(scene);
  const double needed = std::ceil(largest / cell_takes * (1 - 1e-9)), cells = free_cells(in, scene, needed);
  if (cells < needed)
    findings.mistake(path + ".discharge_m3_s",
                     fmt::format("{}.discharge_m3_s reaches {:g} m^3/s, expected at most the {:.3g} m^3/s that "
                                 "its box takes ({:.0f} cells outside walls), or a larger box",
                                 path, largest, cells * cell_takes, cells));
}

void check_rheology(const Scene& scene, Findings& findings) {
  const Rheology& r = scene.fluid.rheology;
  const std::string path = "fluid.rheology";
  if (!findings.sound({path, "fluid.smagorinsky", "fluid.collision", "fluid.kinematic_viscosity_m2_s", "wall"})) return;
  const auto wrong = [&](const std::string& key, const std::string& text) {
    findings.mistake(path + key, path + key + text);
  };
  if (r.law == FlowLaw::newtonian) {
    if (r.yield_stress > 0 || r.consistency > 0)
      wrong(".law", " is \"newtonian\" with a yield stress or a consistency, expected another law");
    else if (r.exponent != 1 || r.limit_viscosity > 0)
      wrong(".law", " is \"newtonian\" with an exponent or a limit viscosity, expected another law");
    return;
  }
  if (r.law == FlowLaw::herschel_bulkley && r.consistency == 0)
    wrong(".consistency_Pa_s_n", " is 0, expected above 0 with this law");
  if (r.law == FlowLaw::bingham && (r.consistency > 0 || r.exponent != 1))
    wrong(".law", " is \"bingham\" with a consistency or an exponent, expected \"herschel_bulkley\"");
  const bool plastic = r.law == FlowLaw::bingham;
  const double of_flow = plastic           ? scene.fluid.kinematic_viscosity
                         : r.exponent == 1 ? r.consistency / scene.fluid.density
                                           : 0;  // it has no largest one
  if (r.limit_viscosity <= of_flow)
    wrong(
        ".limit_viscosity_m2_s",
        fmt::format(" is {:g}, expected the viscosity below the yield stress, above that of flow", r.limit_viscosity));
  if (scene.fluid.smagorinsky > 0)
    findings.mistake(path + ".law",
                     path +
                         ".law with fluid.smagorinsky above 0, expected one or the other: an eddy viscosity would "
                         "hide the yield stress",
                     {"fluid.smagorinsky"});
  if (!takes_flow_laws(scene.fluid.collision))
    wrong(".law", fmt::format(" with collision = \"{}\", expected another operator: it is for Newtonian fluids alone",
                              name(scene.fluid.collision)));
  if (scene.domain.slip == WallSlip::wall_model)
    return wrong(".law", " with domain.slip = \"wall_model\", expected faces without: its law is that of water");
  for (const WallSettings& w : scene.walls)
    if (w.slip == WallSlip::wall_model)
      return wrong(".law", " with a wall of slip = \"wall_model\", expected walls without: its law is that of water");
}

void check_cells(const Scene& scene, Findings& findings) {
  const std::string path = "fluid.cell_size_m";
  if (!findings.sound({path, "domain"})) return;
  const double dx = scene.fluid.cell_size;
  const Vec3 extent = scene.domain.upper - scene.domain.lower;
  constexpr double most_along_axis = 1 << 20;
  if (dx > extent.minCoeff())
    return findings.mistake(path, fmt::format("{} is {:g}, expected at most the smallest extent of the domain, {:g}",
                                              path, dx, extent.minCoeff()));
  if (extent.maxCoeff() / dx > most_along_axis)
    return findings.mistake(path, fmt::format("{} is {:g}: {:.3g} cells along the domain, expected at most {:.0f}",
                                              path, dx, extent.maxCoeff() / dx, most_along_axis));
  if (!findings.sound({"fluid.region", "wall"})) return;
  const double of_domain = findings.sound({"coupling"}) ? bytes_of_domain(scene) : 0;
  const double cells = liquid_cells(scene);
  const double need = bytes_of_blocks(scene, cells / 512, 0) + kBytesPerFilledCell * cells + of_domain;
  const auto have = static_cast<double>(physical_memory());
  constexpr double least_in_files = 1.5e-5;  // m: OpenVDB takes cells of less than 3e-15 m^3 for none
  if (need > have)
    findings.mistake(
        path, fmt::format("{} is {:g}: the liquid of the start takes {:.3g} cells, what is kept for the whole domain "
                          "{:.1f} GB, both {:.1f} GB, expected at most the {:.1f} GB of this machine",
                          path, dx, cells, of_domain * 1e-9, need * 1e-9, have * 1e-9));
  else if (dx < least_in_files && scene.run.output_interval > 0 && findings.sound({"run.output_interval_s"}))
    findings.mistake("run.output_interval_s",
                     fmt::format("run.output_interval_s is {:g}, but fluid_NNNNNN.vdb can hold no cells of {:g} m, "
                                 "expected 0 with a fluid.cell_size_m of less than {:g}",
                                 scene.run.output_interval, dx, least_in_files));
}

void check_periodic(const Scene& scene, Findings& findings) {
  const std::string path = "domain.periodic_axes";
  if (!findings.sound({"domain"}) || scene.domain.periodic_axes.empty()) return;
  if (scene.has_solids()) return findings.mistake(path, path + " with grains or a barrier, expected fluid alone");
  for (const Axis axis : scene.domain.periodic_axes) {
    const int k = static_cast<int>(axis);
    if (scene.domain.open(static_cast<Face>(2 * k)) || scene.domain.open(static_cast<Face>(2 * k + 1)))
      findings.mistake(path, path + " names an axis with an open face, expected one or the other");
    if (!scene.fluid.enabled || !findings.sound({"fluid.cell_size_m"})) continue;
    const double blocks = (scene.domain.upper - scene.domain.lower)[k] / (8 * scene.fluid.cell_size);
    constexpr double rounding = 1e-7;  // of a block: lbm::Domain rounds up from 1e-6 cells on
    if (std::abs(blocks - std::round(blocks)) > rounding || blocks < 0.5)
      findings.mistake(
          path, fmt::format("{}: \"{}\" is {:.9g} cells long, expected a multiple of 8", path, "xyz"[k], 8 * blocks),
          {"fluid.cell_size_m", "domain.upper_m", "domain.lower_m"});
  }
}

void check_speed(const Scene& scene, Findings& findings) {
  if (scene.fluid.max_speed > 0 || scene.gravity.magnitude > 0) return;
  if (!findings.sound({"fluid.max_speed_m_s", "gravity", "fluid.region", "wall"})) return;
  double fastest = 0;
  for (const FluidRegion& r : scene.fluid.regions) fastest = std::max(fastest, r.velocity.norm());
  for (const WallSettings& w : scene.walls) fastest = std::max(fastest, w.velocity.norm());
  for (const Inflow& i : scene.fluid.inflows) fastest = std::max(fastest, cases::inflow_speed(i));
  if (fastest == 0)
    findings.mistake("fluid.max_speed_m_s",
                     "fluid.max_speed_m_s is 0 where nothing moves and nothing falls, expected the "
                     "largest speed");
}

/// What fluid.max_speed_m_s makes of the liquid's weight (see start_compression). A step that adapts takes most of it
/// back: of 44 % too much 1.4 % stay, of 200 % 4.4 %.
void check_compression(const Scene& scene, Findings& findings) {
  const double most = scene.fluid.adaptive_time_step ? 1.0 : 0.1;  // of the mass
  const std::string path = "fluid.max_speed_m_s";
  if (scene.fluid.max_speed == 0 || scene.fluid.regions.empty()) return;
  if (!findings.sound({"fluid", "domain", "gravity", "wall"})) return;
  const double share = cases::start_compression(scene);
  if (share > most)
    findings.mistake(
        path, fmt::format("{} is {:g}: sound then runs at {:.3g} m/s, and the liquid, compressed by its own weight "
                          "(density exp(g h / c_s^2)), would start {:.3g} % too heavy, expected at most {:g} %; a drop "
                          "to the lowest of the domain, a cell at least, makes {:.3g} m/s",
                          path, scene.fluid.max_speed, cases::sound_speed(scene), 100 * share, 100 * most,
                          cases::drop_speed(scene)));
}

}  // namespace

void check_shapes(const Scene& scene, Findings& findings) {
  check_box(scene.domain.lower, scene.domain.upper, "domain", findings);
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    check_wall(scene.walls[i], scene, fmt::format("wall[{}]", i), findings);
    check_heightmap(scene, i, findings);
  }
  if (findings.sound({"domain", "wall"}) && filled_by_walls(make_walls(scene), scene.domain.lower, scene.domain.upper))
    findings.mistake("domain", "domain lies in walls, expected room beside them");
  for (std::size_t i = 0; i < scene.grains.packings.size(); ++i)
    check_box(scene.grains.packings[i].lower, scene.grains.packings[i].upper, fmt::format("grains.packing[{}]", i),
              findings);
}

void check_fluid(const Scene& scene, Findings& findings) {
  check_periodic(scene, findings);
  if (!scene.fluid.enabled) return;
  if (scene.fluid.regions.empty() && scene.fluid.inflows.empty() && findings.sound({"fluid.region", "fluid.inflow"}))
    findings.mistake("fluid", "fluid has no liquid, expected at least one [[fluid.region]] or [[fluid.inflow]]");
  check_rheology(scene, findings);
  for (std::size_t i = 0; i < scene.fluid.regions.size(); ++i) check_region(scene, i, findings);
  check_cells(scene, findings);  // before anything counts them
  for (std::size_t i = 0; i < scene.fluid.inflows.size(); ++i) check_inflow(scene, i, findings);
  check_speed(scene, findings);
  check_compression(scene, findings);
}

}  // namespace lahar::scene
