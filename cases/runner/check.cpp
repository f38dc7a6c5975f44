#include "cases/runner/check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/assembly/geometry.h"
#include "cases/assembly/grain_sizes.h"
#include "cases/assembly/memory.h"
#include "cases/runner/run_time.h"
#include "cases/runner/warnings.h"
#include "core/units.h"
#include "coupling/grains/averaging_grid.h"
#include "lbm/grid/domain.h"

namespace lahar::cases {
namespace {

// A layer that runs out thin touches more blocks than the same liquid in a heap.
constexpr double spreading = 3;

/// Blocks that hold the regions and a layer of one cell around them; where these lie in walls or in each other, those
/// whose middle is nearer to the liquid than its corners are.
double blocks_at_start(const scene::Scene& scene) {
  const double dx = scene.fluid.cell_size, middle_to_corner = 4 * std::sqrt(3.0) * dx;
  const Walls walls = scene::make_walls(scene);
  double blocks = 0;
  for (std::size_t k = 0; k < scene.fluid.regions.size(); ++k) {
    const scene::FluidRegion& r = scene.fluid.regions[k];
    blocks += scene::liquid_of_region(scene, walls, k, middle_to_corner).share *
              (((r.upper - r.lower) / dx).array() + 2.0).unaryExpr([](double n) { return std::ceil(n / 8); }).prod();
  }
  return blocks;
}

/// At least a cell: numbers are divided by it.
double depth_of(const scene::Scene& scene) {
  const Walls walls = scene::make_walls(scene);
  double depth = scene.fluid.cell_size;
  for (std::size_t k = 0; k < scene.fluid.regions.size(); ++k)
    depth = std::max(depth, scene::liquid_of_region(scene, walls, k).depth);
  if (scene.fluid.regions.empty())
    for (const scene::Inflow& i : scene.fluid.inflows) depth = std::max(depth, i.upper.z() - i.lower.z());
  return depth;
}

/// Of what inflows bring, mean over the run if none leaves.
double mean_inflow_cells(const scene::Scene& scene) {
  constexpr int times = 64;
  double sum = 0;
  for (int k = 0; k < times; ++k) sum += scene::inflow_cells(scene, scene.run.duration * (k + 0.5) / times);
  return sum / times;
}

/// nu, tau, Ma, Re, Fr, Bo.
void set_numbers(const scene::Scene& scene, FluidFigures& f) {
  const scene::Fluid& fluid = scene.fluid;
  const double normal_gravity = -scene.gravity.vector().z();
  const LatticeUnits units{fluid.cell_size, f.time_step, fluid.density};
  f.lattice_viscosity = units.viscosity_to_lu(fluid.kinematic_viscosity);
  f.tau = 0.5 + 3 * f.lattice_viscosity;
  const double speed_lu = units.velocity_to_lu(f.max_speed);
  f.mach = std::sqrt(3.0) * speed_lu;
  f.compressibility_error = 3 * speed_lu * speed_lu;
  f.reynolds = f.max_speed * f.depth / fluid.kinematic_viscosity;
  f.froude =
      normal_gravity > 0 ? f.max_speed / std::sqrt(normal_gravity * f.depth) : std::numeric_limits<double>::infinity();
  f.bond = fluid.density * scene.gravity.magnitude * f.depth * f.depth /
           (fluid.surface_tension > 0 ? fluid.surface_tension : water_surface_tension);
}

void set_flow_law_numbers(const scene::Scene& scene, FluidFigures& f) {
  const scene::Rheology& r = scene.fluid.rheology;
  if (r.law == scene::FlowLaw::newtonian) return;
  const double rate = f.max_speed / f.depth, density = scene.fluid.density;
  const double viscous = r.law == scene::FlowLaw::bingham ? density * scene.fluid.kinematic_viscosity * rate
                                                          : r.consistency * std::pow(rate, r.exponent);
  f.reynolds = density * f.max_speed * f.max_speed / viscous;
  f.bingham = r.yield_stress / viscous;
  f.hedstrom = f.bingham * f.reynolds;
  const LatticeUnits units{scene.fluid.cell_size, f.time_step, density};
  f.least_limit_viscosity = (r.yield_stress + viscous) / (density * rate);
  f.limit_tau = 0.5 + 3 * units.viscosity_to_lu(r.limit_viscosity);
}

FluidFigures fluid_figures(const scene::Scene& scene) {
  FluidFigures f;
  const double dx = scene.fluid.cell_size;
  const Vec3 extent = scene.domain.upper - scene.domain.lower;
  const Vec3 cells = extent.unaryExpr([&](double e) { return lbm::covering_cells(e, dx); });
  f.domain_cells = cells.prod();
  f.liquid_cells = scene::liquid_cells(scene);
  f.inflow_cells = scene::inflow_cells(scene, scene.run.duration);
  f.mean_cells = std::min(f.domain_cells, f.liquid_cells + mean_inflow_cells(scene));
  f.start_blocks = blocks_at_start(scene);
  const double all_blocks = cells.unaryExpr([](double n) { return std::ceil((n + 2) / 8); }).prod();
  f.expected_blocks = std::min(all_blocks, spreading * (f.start_blocks + f.inflow_cells / 512));
  f.start_bytes = scene::bytes_at_start(scene, f.start_blocks, f.liquid_cells);
  f.expected_bytes = std::max(f.start_bytes, scene::bytes_when_spread(scene, f.expected_blocks, spreading));
  f.max_speed = expected_max_speed(scene);
  f.time_step = fluid_time_step(scene);
  f.steps = std::ceil(scene.run.duration / f.time_step);
  f.depth = depth_of(scene);
  set_numbers(scene, f);
  set_flow_law_numbers(scene, f);
  return f;
}

bool averages_grains(const scene::Scene& scene) {
  return scene.coupling.enabled && scene.coupling.grains == scene::GrainFluid::averaged;
}

Vec3 averaging_lengths(const scene::Scene& scene) {
  const double dx = scene.fluid.cell_size;
  const Vec3 extent = scene.domain.upper - scene.domain.lower;
  return extent.unaryExpr([&](double e) {
    const double whole_cells = dx * lbm::covering_cells(e, dx);
    return whole_cells / coupling::AveragingGrid::divisions(whole_cells, scene.coupling.averaging_length);
  });
}

SolidsFigures solids_figures(const scene::Scene& scene, const std::optional<FluidFigures>& fluid) {
  SolidsFigures s;
  s.grains = grain_count(scene);
  s.beads = scene.barrier.enabled ? barrier_beads(scene) : 0;
  s.limits = solids_limits(scene);
  s.time_step = solids_time_step(scene);
  if (fluid) {
    s.substeps = substeps(fluid->time_step, s.time_step);
    s.time_step = fluid->time_step / static_cast<double>(s.substeps);
    s.long_step = long_step_of(scene);
    if (s.grains > 0 && averages_grains(scene)) {
      s.averaging_cells = scene.coupling.averaging_length / scene.fluid.cell_size;
      s.averaging_diameters = scene.coupling.averaging_length / largest_grain(scene);
      s.averaging_lengths = averaging_lengths(scene);
    } else if (s.grains > 0) {
      s.cells_per_smallest_grain = smallest_grain(scene) / scene.fluid.cell_size;
      if (has_free_grains(scene)) s.lightest_grain = lightest_free_grain(scene) / scene.fluid.density;
      if (const auto speed = settling_speed(scene))
        s.cell_reynolds = *speed * scene.fluid.cell_size / scene.fluid.kinematic_viscosity;
    }
    if (s.beads > 0) s.cells_per_wire = scene.barrier.net.wire_diameter / scene.fluid.cell_size;
  }
  s.steps = std::ceil(scene.run.duration / s.time_step);
  return s;
}

/// Bytes of a checkpoint: 19 populations and the type of every cell, three numbers of the surface, twelve of the
/// bodies; what is known of a particle with its neighbours and contacts, of a bond, and of a grain's mapping into the
/// fluid or of the nodes that it is averaged at.
double checkpoint_bytes(const scene::Scene& scene, const CheckReport& report, double blocks) {
  constexpr double small_parts = 1e5, particle = 500, bond = 150, mapping = 250;
  double bytes = small_parts;
  if (report.fluid) {
    const double number = scene.run.precision == scene::Precision::float32 ? sizeof(float) : sizeof(double);
    bytes += blocks * 512 * ((19 + 3 + (report.solids && scene.coupling.enabled ? 12 : 0)) * number + 1);
  }
  if (report.solids) {
    bytes += particle * static_cast<double>(report.solids->grains + report.solids->beads);
    bytes += bond * static_cast<double>(report.solids->beads);
    if (report.fluid) bytes += mapping * static_cast<double>(report.solids->grains);
    bytes += scene::averaging_nodes(scene) * scene::kStoredBytesPerNode;
  }
  return bytes;
}

}  // namespace

CheckReport check_scene(const scene::Scene& scene, int threads) {
  CheckReport report;
  if (scene.fluid.enabled) report.fluid = fluid_figures(scene);
  if (scene.has_solids()) report.solids = solids_figures(scene, report.fluid);
  report.run_time = run_time(scene, report) / std::max(1, threads);
  report.checkpoint_bytes = checkpoint_bytes(scene, report, report.fluid ? report.fluid->start_blocks : 0);
  report.expected_checkpoint_bytes = checkpoint_bytes(scene, report, report.fluid ? report.fluid->expected_blocks : 0);
  report.warnings = warnings(scene, report);
  return report;
}

}  // namespace lahar::cases
