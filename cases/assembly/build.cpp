#include "cases/assembly/build.h"

#include <fmt/format.h>

#include "cases/assembly/check_start.h"
#include "cases/assembly/estimates.h"
#include "cases/assembly/geometry.h"
#include "cases/assembly/grain_extent.h"
#include "cases/assembly/net_spec.h"
#include "cases/assembly/packings.h"
#include "cases/assembly/settled_barrier.h"

namespace lahar::cases {

namespace {

lbm::InflowOptions inflow_of(const scene::Inflow& s) {
  return {s.name, s.lower, s.upper, s.velocity, scene::hydrograph_of(s)};
}

lbm::FaceKind face_kind(const scene::Scene& scene, int face) {
  if (scene.domain.periodic(static_cast<scene::Axis>(face / 2))) return lbm::FaceKind::periodic;
  return scene.domain.open(static_cast<scene::Face>(face)) ? lbm::FaceKind::open : lbm::FaceKind::closed;
}

void add_grains(const scene::Scene& scene, dem::Particles& particles, GrainStart start) {
  if (start == GrainStart::placeholders)
    add_placeholders(scene, particles);
  else
    add_packings(scene, particles);
  for (const auto& s : scene.grains.spheres) {
    dem::ParticleSpec grain;
    grain.position = s.position;
    grain.velocity = s.velocity;
    grain.angular_velocity = s.angular_velocity;
    grain.radius = s.diameter / 2;
    grain.density = s.density;
    grain.material = scene::material_index(scene, s.material);
    grain.state = s.fixed ? dem::ParticleState::fixed : dem::ParticleState::free;
    particles.add(grain);
  }
}

}  // namespace

lbm::FluidOptions fluid_options(const scene::Scene& scene) {
  lbm::FluidOptions o;
  o.domain.lower = scene.domain.lower;
  o.domain.upper = scene.domain.upper;
  o.domain.cell_size = scene.fluid.cell_size;
  for (int face = 0; face < 6; ++face) o.domain.faces[static_cast<std::size_t>(face)] = face_kind(scene, face);
  o.domain.slip = scene.domain.slip;
  o.domain.walls = scene::make_walls(scene);
  o.domain.placement = scene.fluid.wall_placement;
  o.time_step = fluid_time_step(scene);
  o.adaptive_time_step = scene.fluid.adaptive_time_step;
  o.lattice_velocity = scene.fluid.lattice_velocity;
  o.uncounted_share = scene.fluid.uncounted_share;
  o.density = scene.fluid.density;
  o.kinematic_viscosity = scene.fluid.kinematic_viscosity;
  o.gravity = scene.gravity.vector();
  o.surface_tension = scene.fluid.surface_tension;
  o.collision = scene.fluid.collision;
  o.weighting = scene.coupling.body_weighting;
  o.solid_operator = scene.coupling.solid_operator;
  o.smagorinsky = scene.fluid.smagorinsky;
  o.rheology = scene.fluid.rheology;
  for (const scene::Inflow& inflow : scene.fluid.inflows) o.inflows.push_back(inflow_of(inflow));
  return o;
}

namespace {

/// Whether there is no room right beyond a face of a box: walls, or the end of the domain.
bool ends_at_walls(const scene::Scene& scene, const Walls& walls, const lbm::LiquidRegion& box, int axis, bool upper) {
  constexpr int n = 9;  // points along an edge
  const double beyond = 1e-3 * scene.fluid.cell_size;
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  for (int i = 0; i < n * n; ++i) {
    Vec3 p = upper ? box.upper : box.lower;
    p[axis] += upper ? beyond : -beyond;
    p[a] = box.lower[a] + (i % n + 0.5) / n * (box.upper[a] - box.lower[a]);
    p[b] = box.lower[b] + (i / n + 0.5) / n * (box.upper[b] - box.lower[b]);
    if (scene.domain.contains(p) && (walls.empty() || walls.nearest(p).distance > 0)) return false;
  }
  return true;
}

/// A box of liquid that ends at walls fills the cells that they cut: walls are felt at the faces of cells, or farther
/// out, and a strip of gas before them would be filled by sloshing.
lbm::LiquidRegion up_to_walls(const scene::Scene& scene, const Walls& walls, lbm::LiquidRegion box) {
  const double dx = scene.fluid.cell_size;
  const lbm::LiquidRegion given = box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto face = [&](double x) { return (x - scene.domain.lower[axis]) / dx; };
    constexpr double rounding = 1e-6;  // of a cell
    if (ends_at_walls(scene, walls, given, axis, false))
      box.lower[axis] = scene.domain.lower[axis] + dx * std::floor(face(given.lower[axis]) + rounding);
    if (ends_at_walls(scene, walls, given, axis, true))
      box.upper[axis] = scene.domain.lower[axis] + dx * std::ceil(face(given.upper[axis]) - rounding);
  }
  return box;
}

/// Number of particle steps in a fluid step, or 1 without fluid.
int substeps_of(const scene::Scene& scene) {
  return scene.fluid.enabled && scene.has_solids()
             ? static_cast<int>(substeps(fluid_time_step(scene), solids_time_step(scene)))
             : 1;
}

}  // namespace

std::vector<lbm::LiquidRegion> liquid_regions(const scene::Scene& scene) {
  const Walls walls = scene::make_walls(scene);
  std::vector<lbm::LiquidRegion> regions;
  for (const auto& r : scene.fluid.regions) {
    lbm::LiquidRegion region{r.lower, r.upper, r.velocity, scene::make_body(r)};
    regions.push_back(region.body ? region : up_to_walls(scene, walls, region));
  }
  return regions;
}

coupling::CouplingOptions coupling_options(const scene::Scene& scene) {
  const scene::Coupling& c = scene.coupling;
  coupling::CouplingOptions o;
  o.substeps = substeps_of(scene);
  if (!c.enabled) {
    o.grains = coupling::UncoupledGrains{};
    o.thin_wires = coupling::ThinWires::uncoupled;
    return o;
  }
  const bool averaged = c.grains == scene::GrainFluid::averaged;
  if (averaged)
    o.grains = coupling::AveragedGrains{c.averaging_length, c.bed_drag, c.beads_as_grains};
  else
    o.grains = coupling::ResolvedGrains{c.radius_shift_cells};
  o.films = c.lubrication ? coupling::GrainFilms::lubrication : coupling::GrainFilms::none;
  o.thin_wires =
      c.wire_drag && !(averaged && c.beads_as_grains) ? coupling::ThinWires::drag_law : coupling::ThinWires::uncoupled;
  if (c.resolve_wires_from_cells) o.mapped_wires = {*c.resolve_wires_from_cells, c.radius_shift_cells};
  return o;
}

BuiltSolids build_solids(const scene::Scene& scene, GrainStart grains) {
  dem::Particles particles;
  dem::Bonds bonds;
  add_grains(scene, particles, grains);
  std::optional<barrier::Net> net;
  if (scene.barrier.enabled) net = scene::build_barrier(scene, particles, bonds);
  if (net && grains == GrainStart::packed && scene.barrier.settle_time > 0)
    settle_barrier(scene, *net, particles, bonds);
  if (grains == GrainStart::packed) require_clear_start(scene, particles);
  dem::SolidsOptions options;
  options.gravity = scene.gravity.vector();
  options.contact_law = scene.solids.contact_law;
  options.wire_contacts = scene.solids.wire_contacts;
  options.watchdog.speed_limit = scene::kLargestSpeed;
  options.watchdog.overlap_limit = 1;  // beyond it a bead has gone through
  options.watchdog.interval = 20;
  // Beads are hit by boulders and move far in a step, for their size: a skin of half a wire between them would be used
  // up in a few steps.
  if (scene.barrier.enabled) options.neighbours.minimum_skin = scene.barrier.net.wire_diameter / 2;
  options.time_step = solids_time_step(scene);
  if (scene.fluid.enabled) options.time_step = fluid_time_step(scene) / substeps_of(scene);
  options.long_step = static_cast<int>(long_step_of(scene));
  return {dem::Solids(std::move(particles), std::move(bonds), scene::make_materials(scene), scene::make_walls(scene),
                      options),
          std::move(net)};
}

}  // namespace lahar::cases
