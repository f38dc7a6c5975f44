#pragma once
// `lahar check`: what a scene will take and how well it is resolved, without running it.
#include <optional>
#include <string>
#include <vector>

#include "cases/assembly/estimates.h"
#include "cases/scene/scene.h"

namespace lahar::cases {

struct FluidFigures {
  double domain_cells = 0, liquid_cells = 0;     ///< of the whole domain; of the liquid at the start
  double inflow_cells = 0, mean_cells = 0;       ///< that flow in; of the liquid, mean over the run if none leaves
  double start_blocks = 0, expected_blocks = 0;  ///< blocks of 8^3 cells
  double start_bytes = 0, expected_bytes = 0;
  double time_step = 0, steps = 0;  ///< s, -
  double max_speed = 0, depth = 0;  ///< m/s, m: expected speed, depth of the deepest region outside walls
  double lattice_viscosity = 0, tau = 0, mach = 0;
  double compressibility_error = 0;           ///< 3 u_lattice^2, as a fraction
  double reynolds = 0, froude = 0, bond = 0;  ///< with expected speed and depth
  /// Flow laws with a yield stress: Bm = yield / (K (u/h)^n), He = Bm Re, Re = rho u^2 / (K (u/h)^n); tau at the limit
  /// viscosity.
  double bingham = 0, hedstrom = 0, limit_tau = 0;
  /// m^2/s, of the flow law at u/h: the limit viscosity has to be larger.
  std::optional<double> least_limit_viscosity;
};

struct SolidsFigures {
  std::int64_t grains = 0, beads = 0;
  SolidsLimits limits{};
  double time_step = 0, steps = 0;  ///< s, -
  std::int64_t substeps = 0;        ///< in a fluid step; 0 without fluid
  std::int64_t long_step = 1;       ///< of them that make one step of the contacts of grains
  std::optional<double> cells_per_smallest_grain, cells_per_wire;  ///< grains: resolved ones
  std::optional<double> lightest_grain;  ///< resolved, of those that move: its density over the liquid's
  std::optional<double> cell_reynolds;   ///< of settling resolved grains: settling speed x cell size / viscosity
  std::optional<double> averaging_cells, averaging_diameters;  ///< averaging length over cell size, over largest grain
  std::optional<Vec3> averaging_lengths;  ///< m, by axis: what it becomes as the domain is divided by it
};

struct CheckReport {
  std::optional<FluidFigures> fluid;
  std::optional<SolidsFigures> solids;
  double run_time = 0;                                         ///< s, estimated
  double checkpoint_bytes = 0, expected_checkpoint_bytes = 0;  ///< at the start; when the liquid has spread
  std::vector<std::string> warnings;
};

/// Surface tension of clean water at 20 degrees C, N/m: for the Bond number where none is modelled.
inline constexpr double water_surface_tension = 0.0728;

/// `threads` is what the estimate of the run time is for.
CheckReport check_scene(const scene::Scene& scene, int threads = 1);

/// The report for the terminal.
std::string report_text(const scene::Scene& scene, const CheckReport& report);

}  // namespace lahar::cases
