// The terminal form of `lahar check`.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/runner/check.h"
#include "cases/runner/progress.h"
#include "coupling/coupling_options.h"

namespace lahar::cases {
namespace {

std::string line(const char* name, const std::string& text) { return fmt::format("  {:<26} {}\n", name, text); }

/// Whether a wall that is named, or a face of the domain, is no-slip.
bool holds_liquid(const scene::Scene& scene) {
  const auto& walls = scene.walls;
  const auto is_no_slip = [](const scene::WallSettings& w) { return w.slip == WallSlip::no_slip; };
  return scene.domain.slip == WallSlip::no_slip || std::any_of(walls.begin(), walls.end(), is_no_slip);
}

/// How far the friction of a wall reaches into the liquid by the end, sqrt(nu t) (Stokes 1851), beside the layer of a
/// cell that no-slip walls hold (docs/decisions/0070).
std::string layer_text(const scene::Scene& scene) {
  constexpr double thin = 0.5;
  const double cells = std::sqrt(scene.fluid.kinematic_viscosity * scene.run.duration) / scene.fluid.cell_size;
  std::string text = fmt::format("{:.2g} cells", cells);
  if (cells < thin && holds_liquid(scene)) text += "; no-slip walls hold a layer of one: free_slip is nearer";
  return line("friction of walls reaches", text);
}

std::string fluid_text(const scene::Scene& scene, const FluidFigures& f) {
  std::string t = "fluid\n";
  t += line("cells", fmt::format("{:.4g} in the domain, {:.4g} liquid at the start{}", f.domain_cells, f.liquid_cells,
                                 f.inflow_cells > 0 ? fmt::format(", {:.4g} flow in", f.inflow_cells) : ""));
  t += line("blocks of 8^3", fmt::format("{:.0f} at the start, up to about {:.0f}", f.start_blocks, f.expected_blocks));
  t += line("memory", fmt::format("{:.3g} GB at the start, up to about {:.3g} GB", f.start_bytes * 1e-9,
                                  f.expected_bytes * 1e-9));
  t += line("time step", fmt::format("{:.4g} s, {:.0f} steps", f.time_step, f.steps));
  if (f.time_step >= longest_capillary_step(scene) * (1 - 1e-9))
    t += line("", "by the surface tension: the shortest ripple may not run farther than half a cell in a step");
  if (scene.fluid.adaptive_time_step)
    t +=
        line("", fmt::format("this is the first; it then follows the liquid, all but the fastest {:g} of its cells, to "
                             "about {:g} lu ({:.3g} s at the least)",
                             scene.fluid.uncounted_share, scene.fluid.lattice_velocity, f.time_step / 32));
  t += line("largest speed, depth", fmt::format("{:.4g} m/s, {:.4g} m", f.max_speed, f.depth));
  t += line("tau", fmt::format("1/2 + {:.3g} (viscosity {:.3g} lu)", f.tau - 0.5, f.lattice_viscosity));
  t += line("Ma", fmt::format("{:.3g} (compressibility error about {:.2g} %)", f.mach, 100 * f.compressibility_error));
  t += line("Re, Fr, Bo",
            fmt::format("{:.3g}, {:.3g}, {:.3g} ({})", f.reynolds, f.froude, f.bond,
                        scene.fluid.surface_tension > 0 ? "surface tension is modelled, 90 degrees at walls"
                                                        : "surface tension is not modelled"));
  if (scene.fluid.rheology.law != scene::FlowLaw::newtonian) {
    t += line("Bingham, Hedstrom", fmt::format("{:.3g}, {:.3g}", f.bingham, f.hedstrom));
    t += line("limit viscosity",
              fmt::format("{:.3g} m^2/s, tau {:.3g}", scene.fluid.rheology.limit_viscosity, f.limit_tau));
  }
  t += line("cells per depth", fmt::format("{:.3g}", f.depth / scene.fluid.cell_size));
  if (scene.fluid.rheology.law == scene::FlowLaw::newtonian) t += layer_text(scene);
  return t;
}

std::string solids_text(const scene::Scene& scene, const SolidsFigures& s) {
  std::string t = "particles\n";
  t += line("grains, beads", fmt::format("{}, about {}", s.grains, s.beads));
  const auto limit = [&](const char* name, double seconds) {
    if (std::isfinite(seconds)) t += line(name, fmt::format("{:.3g} s", seconds));
  };
  const bool linear = std::holds_alternative<dem::LinearSpringDashpot>(scene.solids.contact_law);
  limit(linear ? "limit of the linear law, grains" : "Rayleigh time, grains", s.limits.grain_rayleigh);
  limit(linear ? "limit of the linear law, beads" : "Rayleigh time, beads", s.limits.bead_rayleigh);
  limit(scene.barrier.net.kind == scene::NetKind::rings ? "bond limit, rings" : "bond limit, mesh", s.limits.ring_bond);
  limit("bond limit, cables", s.limits.cable_bond);
  limit("bond limit, posts", s.limits.post_bond);
  t += line("time step", fmt::format("{:.4g} s, {:.0f} steps", s.time_step, s.steps));
  if (s.substeps > 0) t += line("steps in a fluid step", fmt::format("{}", s.substeps));
  if (s.long_step > 1) t += line("steps in one of the grains' contacts", fmt::format("{}", s.long_step));
  if (s.cells_per_smallest_grain)
    t += line("cells per smallest grain", fmt::format("{:.3g}", *s.cells_per_smallest_grain));
  if (s.cell_reynolds)
    t += line("cell Re, settling grains", fmt::format("{:.3g} (radius_shift_cells: {:.2f})", *s.cell_reynolds,
                                                      coupling::radius_shift_at(*s.cell_reynolds)));
  if (s.averaging_cells)
    t += line("averaging length", fmt::format("{:.3g} cells, {:.3g} diameters of the largest grain; by axis {:.3g}, "
                                              "{:.3g}, {:.3g} m",
                                              *s.averaging_cells, *s.averaging_diameters, s.averaging_lengths->x(),
                                              s.averaging_lengths->y(), s.averaging_lengths->z()));
  if (s.cells_per_wire) t += line("cells per wire", fmt::format("{:.3g}", *s.cells_per_wire));
  return t;
}

}  // namespace

std::string report_text(const scene::Scene& scene, const CheckReport& report) {
  const std::string title = scene.identity.title.empty() ? "" : ": " + scene.identity.title;
  std::string text = fmt::format("{}{}\n", scene.identity.name, title);
  if (report.fluid) text += fluid_text(scene, *report.fluid);
  if (report.solids) text += solids_text(scene, *report.solids);
  text += fmt::format("checkpoint: {:.3g} MB at the start, up to about {:.3g} MB\n", report.checkpoint_bytes * 1e-6,
                      report.expected_checkpoint_bytes * 1e-6);
  text += fmt::format("run time, a rough estimate: {}\n", time_text(report.run_time));
  for (const std::string& w : report.warnings) text += "warning: " + w + "\n";
  return text;
}

}  // namespace lahar::cases
