#include "cases/runner/run_time.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/assembly/estimates.h"
#include "cases/assembly/grain_extent.h"
#include "cases/assembly/grain_sizes.h"
#include "cases/assembly/settled_barrier.h"

namespace lahar::cases {
namespace {

// Of one thread, each a step. Of the fluid: a wet cell, and what an interface cell takes beside.
constexpr double seconds_per_cell = 40e-9, seconds_per_surface_cell = 340e-9;
// A flow spreads and its surface is rugged: interface cells, of those of the same liquid at rest.
constexpr double surface_of_a_flow = 13;
constexpr double surface_among_grains = 0.4;  // of the wet cells, at least, among resolved grains
// With run.precision = "double", of what is done in cells: 1.5 in deep liquid to 1.8 where much of it is surface.
constexpr double of_double = 1.6;
// Cells around grains, with what sweep and conversion take longer there; cells over which grains are averaged; beads
// that feel the water.
constexpr double seconds_per_body_cell = 45e-9, seconds_per_averaged_cell = 110e-9, seconds_per_wet_bead = 590e-9;
// Particles with contacts and bonds; of smooth wires, beside, places where a ring hangs in another or on a cable.
constexpr double seconds_per_particle = 143e-9, seconds_per_link = 9e-6;
// Share of a particle step that is not in each of them with two rates (docs/decisions/0096).
constexpr double of_grain_contacts = 0.7;
// Of a packing, once: a grain, and a grain for each radius of the smallest that the solid volume is deep
// (packing_time).
constexpr double seconds_per_packed_grain = 2e-4, seconds_per_grain_and_radius = 6.5e-5;
constexpr double seconds_per_picture = 1.2;  // of 1280 x 720
// Of a row of the series: a wet cell, a grain, a bead with its bonds; of a frame: a wet cell, a particle; of a
// checkpoint: a wet cell. Probes and sections cost less than runs differ by, and are not counted.
constexpr double seconds_per_row_cell = 120e-9, seconds_per_row_grain = 60e-9, seconds_per_row_bead = 900e-9;
constexpr double seconds_per_frame_cell = 200e-9, seconds_per_frame_particle = 1.3e-6;
constexpr double seconds_per_checkpoint_cell = 450e-9;

double steps_of(const CheckReport& report) {
  return report.fluid ? report.fluid->steps : report.solids ? report.solids->steps : 0;
}

/// How often what is due at an interval is done after the start, the end included: no more than once a step.
double times(double interval, const scene::Run& run, const CheckReport& report) {
  return std::min(steps_of(report), std::ceil(run.duration / interval - 1e-9));
}

double of_precision(const scene::Run& run) { return run.precision == scene::Precision::float64 ? of_double : 1; }

/// Rows, frames, pictures and checkpoints; the checkpoints of an interval of wall time are few.
double output_time(const scene::Scene& scene, const CheckReport& report) {
  const scene::Run& run = scene.run;
  const double cells = report.fluid ? of_precision(run) * report.fluid->mean_cells : 0;
  const double grains = report.solids ? static_cast<double>(report.solids->grains) : 0;
  const double beads = report.solids ? static_cast<double>(report.solids->beads) : 0;
  const double row = seconds_per_row_cell * cells + seconds_per_row_grain * grains + seconds_per_row_bead * beads;
  const double frame = seconds_per_frame_cell * cells + seconds_per_frame_particle * (grains + beads);
  const double rows = run.series_interval > 0 ? times(run.series_interval, run, report) : steps_of(report);
  double seconds = row * (1 + rows);
  if (run.output_interval > 0) seconds += frame * (1 + times(run.output_interval, run, report));
  if (run.image_interval > 0) seconds += seconds_per_picture * (1 + times(run.image_interval, run, report));
  if (run.checkpoint_interval > 0)
    seconds += seconds_per_checkpoint_cell * cells * times(run.checkpoint_interval, run, report);
  return seconds;
}

double fluid_step(const scene::Scene& scene, const CheckReport& report) {
  const FluidFigures& fluid = *report.fluid;
  const bool among_grains = report.solids && report.solids->cells_per_smallest_grain;
  const double surface = std::clamp(surface_of_a_flow * scene.fluid.cell_size / fluid.depth,
                                    among_grains ? surface_among_grains : 0.0, 1.0);
  return of_precision(scene.run) * fluid.mean_cells * (seconds_per_cell + seconds_per_surface_cell * surface);
}

/// Spheres settle in steps that shrink with the smallest, for a time that grows with their depth: whatever their
/// density, the number of steps is that of its radii in the depth (dem/packing/relaxer.cpp).
double packing_time(const scene::Packing& packing, const std::vector<scene::GrainSize>& sizes) {
  double count = 0, smallest = std::numeric_limits<double>::infinity();  // diameter, m
  for (const scene::GrainSize& s : sizes) {
    if (s.count == 0) continue;
    count += static_cast<double>(s.count);
    smallest = std::min(smallest, s.diameter);
  }
  const double depth = scene::solid_volume(packing) / (packing.upper - packing.lower).head<2>().prod();
  return count * (seconds_per_packed_grain + seconds_per_grain_and_radius * depth / (smallest / 2));
}

/// Cells that grains are mapped to; on either side of a grain one is touched.
double body_cells(const std::vector<scene::GrainSize>& sizes, double cell_size) {
  double cells = 0;
  for (const scene::GrainSize& s : sizes)
    cells += static_cast<double>(s.count) * std::pow(s.diameter / cell_size + 2, 3);
  return cells;
}

/// One step of smooth wires (dem/wires), by the places where rings hang in each other and on their cables.
double wire_step(const scene::Scene& scene) {
  const scene::Net& net = scene.barrier.net;
  if (!scene.barrier.enabled || net.kind != scene::NetKind::rings ||
      scene.solids.wire_contacts != scene::WireContacts::capsules)
    return 0;
  const auto columns = static_cast<double>(net_columns(net)), rows = static_cast<double>(net_rows(net));
  const double spans = scene.barrier.posts.enabled ? static_cast<double>(scene.barrier.posts.spans) : 1.0;
  return seconds_per_link * spans * (2 * columns * rows + columns + rows);
}

/// One step of all particles, the mean of the steps that contacts of grains are in and of those that they are not.
double solids_step(const scene::Scene& scene, const SolidsFigures& solids) {
  const double of_each_step = 1 - of_grain_contacts * (1 - 1 / static_cast<double>(solids.long_step));
  return of_each_step * seconds_per_particle * static_cast<double>(solids.grains + solids.beads) + wire_step(scene);
}

/// What grains and wires in the fluid add to one of its steps.
double coupling_step(const scene::Scene& scene, const CheckReport& report, double body_cells) {
  const bool averaged = scene.coupling.grains == scene::GrainFluid::averaged;
  const double averaged_cells = report.solids->grains > 0 ? report.fluid->mean_cells : 0;
  const double cells = averaged ? seconds_per_averaged_cell * averaged_cells : seconds_per_body_cell * body_cells;
  return seconds_per_wet_bead * static_cast<double>(report.solids->beads) + of_precision(scene.run) * cells;
}

}  // namespace

double run_time(const scene::Scene& scene, const CheckReport& report) {
  double seconds = output_time(scene, report);
  if (report.fluid) seconds += report.fluid->steps * fluid_step(scene, report);
  if (!report.solids) return seconds;
  const SolidsFigures& solids = *report.solids;
  seconds += solids.steps * solids_step(scene, solids);
  if (scene.barrier.settle_time > 0)
    seconds += scene.barrier.settle_time / solids_time_step(barrier_alone(scene)) *
               (seconds_per_particle * static_cast<double>(solids.beads) + wire_step(scene));
  double cells = 0;
  for (std::size_t i = 0; i < scene.grains.packings.size(); ++i) {
    const std::vector<scene::GrainSize> sizes = scene::grain_sizes(scene, i);
    seconds += packing_time(scene.grains.packings[i], sizes);
    cells += body_cells(sizes, scene.fluid.cell_size);
  }
  for (const scene::GrainSphere& g : scene.grains.spheres)
    cells += body_cells({{g.diameter, 1, g.density, g.material}}, scene.fluid.cell_size);
  if (report.fluid && scene.coupling.enabled) seconds += report.fluid->steps * coupling_step(scene, report, cells);
  return seconds;
}

}  // namespace lahar::cases
