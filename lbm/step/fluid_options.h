#pragma once
// What a fluid is made of, SI, and what follows from it for the lattice.
#include <optional>
#include <vector>

#include "core/units.h"
#include "lbm/free_surface/inflow.h"
#include "lbm/grid/domain.h"
#include "lbm/step/sweep.h"
#include "lbm/step/time_step_control.h"

namespace lahar::lbm {

struct FluidOptions {
  DomainSpec domain;
  double time_step = 0;               ///< s; the first, where it adapts
  bool adaptive_time_step = false;    ///< follows the speed of the liquid (time_step_control.h)
  double lattice_velocity = 0.1;      ///< lu, largest speed that an adaptive step aims at
  double uncounted_share = 0.001;     ///< of the wet cells, the fastest, that an adaptive step does not count
  double density = 1000;              ///< kg/m^3
  double kinematic_viscosity = 1e-6;  ///< m^2/s
  Vec3 gravity = Vec3::Zero();        ///< m/s^2
  double surface_tension = 0;         ///< N/m; 0 is off
  CollisionOperator collision = CentralMoments{};
  BodyWeighting weighting = kBodyWeighting;
  SolidOperator solid_operator = kSolidOperator;  ///< those that bounce back: Newtonian without LES only
  double smagorinsky = 0;                         ///< Cs; 0 is off; only with a Newtonian fluid
  RheologyOptions rheology;                       ///< flow law of mud and slurry
  std::vector<InflowOptions> inflows;             ///< boxes through which liquid enters
};

/// How the populations of a flow without a surface start.
enum class Start {
  equilibrium,  ///< no stress: it builds up in a few tau; at small viscosity it rings from step to step until it has
  with_stress,  ///< with the viscous stress of the velocity's gradient; for smooth velocities
};

/// Liquid at the start: a box, or a body within it. What boxes share is filled once; a cell that a body and another
/// region fill in part holds the sum.
struct LiquidRegion {
  Vec3 lower, upper;                         ///< m
  Vec3 velocity = Vec3::Zero();              ///< m/s
  std::optional<Shape> body = std::nullopt;  ///< liquid where its distance is below 0
};

LatticeUnits units_of(const FluidOptions& options);

/// Throws std::logic_error where options exclude each other.
SweepParameters parameters_of(const FluidOptions& options, const LatticeUnits& units);

/// The step grows no further than to tau = 1 (walls and stress are accurate around it), or where it started.
TimeStepLimits time_step_limits(const FluidOptions& options, const Domain& domain);

}  // namespace lahar::lbm
