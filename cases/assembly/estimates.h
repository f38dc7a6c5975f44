#pragma once
// What a scene's numbers imply before anything runs: speeds, time steps, counts.
#include <cstdint>
#include <optional>

#include "barrier/spans.h"
#include "cases/scene/scene.h"

namespace lahar::cases {

/// m^3/s, the largest of its hydrograph from t = 0 on.
double peak_discharge(const scene::Inflow& inflow);

/// m/s, with which liquid comes out of an inflow's box: its velocity, or the peak of its discharge over the box's face
/// across that (its largest face where it comes without a velocity), whichever is more.
double inflow_speed(const scene::Inflow& inflow);

/// m/s: what liquid reaches that falls without loss from the highest point of its regions and inflows to the lowest of
/// the domain, a cell at least, sqrt(v0^2 + 2 g h); never less than the speed of a wall.
double drop_speed(const scene::Scene& scene);
/// m/s, of the fastest grain that falls without loss to the lowest of the domain; 0 without grains.
double grain_drop_speed(const scene::Scene& scene);

/// m/s: fluid.max_speed_m_s, or the drop_speed where it is 0.
double expected_max_speed(const scene::Scene& scene);

/// s: lattice_velocity x cell size / expected speed, or what ripples allow if that is less. The scene must have a
/// fluid.
double fluid_time_step(const scene::Scene& scene);

/// m/s: of the lattice fluid, cell size / time step / sqrt(3). The scene must have a fluid.
double sound_speed(const scene::Scene& scene);

/// By which share the deepest region of liquid that walls bear is too heavy at the start (lbm/step/fluid_filling.h).
/// Liquid at rest under its own weight has the density exp(g h / c_s^2) at a depth h; this is its mean over the depth,
/// less 1. The scene must have a fluid.
double start_compression(const scene::Scene& scene);

/// s: the longest step with surface tension; infinity without.
double longest_capillary_step(const scene::Scene& scene);

/// Number of rings across and up, but for the adjustment of the pitch.
std::int64_t net_columns(const scene::Net& net);
std::int64_t net_rows(const scene::Net& net);
/// Beads of all rings or nodes of a mesh, of four cables along the net's edges, of posts and what hangs on them.
std::int64_t barrier_beads(const scene::Scene& scene);
/// Grains of all packings and spheres.
std::int64_t grain_count(const scene::Scene& scene);
/// Whether some of them are free to move.
bool has_free_grains(const scene::Scene& scene);

/// Diameters of the smallest and the largest grain, m; infinity and 0 without grains.
double smallest_grain(const scene::Scene& scene);
double largest_grain(const scene::Scene& scene);
/// Density of the lightest grain that is free to move, kg/m^3; infinity without.
double lightest_free_grain(const scene::Scene& scene);

/// m/s: at which a sphere sinks or rises in still liquid, `density_ratio` its density over the liquid's; drag of
/// Schiller & Naumann 1935 up to Re 1000, Cd = 0.44 beyond.
double settling_speed(double diameter, double density_ratio, double viscosity, double gravity);
/// Mean of it over the grains' volume; none without grains, without fluid or where a flow law makes the viscosity.
std::optional<double> settling_speed(const scene::Scene& scene);

/// Largest stable time steps by cause, s; infinity where there is nothing of the kind.
struct SolidsLimits {
  double grain_rayleigh, bead_rayleigh, ring_bond, cable_bond, post_bond;  ///< ring: or wire of a mesh
};
SolidsLimits solids_limits(const scene::Scene& scene);

/// s: of the bonds of a post, from a few of its beads: all but those at its ends are held alike.
double post_bond_limit(const barrier::SpansSpec& spec);

/// Whether the barrier can be built to see whether it stands, in a few seconds; of larger ones the run finds it out.
bool can_be_tried(const scene::Scene& scene);

/// s: what all bonds of a bead together allow, in the barrier as built; infinity where it cannot be tried. Beads
/// farther apart than they are wide, ties and posts ask for less than single bonds of touching beads do.
double limit_as_built(const scene::Scene& scene);

/// s: solids.time_step_s, or the smallest limit times its safety; infinity without solids.
double solids_time_step(const scene::Scene& scene);

/// s: the limit of contacts of grains among themselves and with walls, times its safety; infinity without grains.
double grain_time_step(const scene::Scene& scene);

/// Number of particle steps that make one step of the contacts of grains (dem::SolidsOptions::long_step): the fluid
/// step's `substeps` steps of `time_step` (s), split evenly into as few as `grain_step` (s) allows; 1 if it is shorter.
std::int64_t long_step(std::int64_t substeps, double time_step, double grain_step);
/// The same of a scene; 1 where it has no fluid, no grains, no barrier or one rate for all.
std::int64_t long_step_of(const scene::Scene& scene);

/// Number of particle steps in a fluid step: the smallest that keeps each no longer than `solids_step`.
std::int64_t substeps(double fluid_step, double solids_step);

}  // namespace lahar::cases
