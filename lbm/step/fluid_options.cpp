#include "lbm/step/fluid_options.h"

#include <algorithm>
#include <cmath>

#include "core/capillary.h"
#include "core/check.h"

namespace lahar::lbm {

namespace {

constexpr double kShortestStep = 1.0 / 32;  // of the first: shorter, and something else is wrong

}  // namespace

LatticeUnits units_of(const FluidOptions& o) { return {o.domain.cell_size, o.time_step, o.density}; }

SweepParameters parameters_of(const FluidOptions& o, const LatticeUnits& units) {
  SweepParameters p;
  p.collision = o.collision;
  p.tau = 0.5 + 3 * units.viscosity_to_lu(o.kinematic_viscosity);
  p.coverage_weight = coverage_weight_law(o.weighting, p.tau);
  p.third_moments_at_bodies = by_wall_distance(o.weighting);
  p.solid_operator = o.solid_operator;
  p.smagorinsky = o.smagorinsky;
  // The Smagorinsky constant is that of a Newtonian inertial range; in a plug its eddy viscosity would hide the yield
  // stress.
  require(o.time_step <= capillary_time_step(o.density, o.domain.cell_size, o.surface_tension) * (1 + 1e-9),
          "Fluid: the time step is longer than ripples of two cells allow (core/capillary.h)");
  require(o.rheology.law == FlowLaw::newtonian || o.smagorinsky == 0,
          "Fluid: Smagorinsky is for Newtonian fluids alone");
  require(o.rheology.law == FlowLaw::newtonian || takes_flow_laws(o.collision),
          "Fluid: this collision operator is for Newtonian fluids alone");
  require(!bounces_back(o.solid_operator) || (o.rheology.law == FlowLaw::newtonian && o.smagorinsky == 0),
          "Fluid: solid operators that bounce populations back are for a constant viscosity alone");
  require(o.weighting != BodyWeighting::inertial || o.rheology.law == FlowLaw::newtonian,
          "Fluid: the inertial weighting is for Newtonian fluids alone");
  const auto& walls = o.domain.walls.all();
  const bool modelled =
      o.domain.slip == WallSlip::wall_model ||
      std::any_of(walls.begin(), walls.end(), [](const Wall& w) { return w.slip == WallSlip::wall_model; });
  require(o.rheology.law == FlowLaw::newtonian || !modelled, "Fluid: the wall model is for Newtonian fluids alone");
  p.rheology = rheology_to_lu(o.rheology, o.kinematic_viscosity, units);
  for (int a = 0; a < 3; ++a) p.gravity[static_cast<std::size_t>(a)] = units.acceleration_to_lu(o.gravity[a]);
  return p;
}

TimeStepLimits time_step_limits(const FluidOptions& o, const Domain& domain) {
  TimeStepLimits limits;
  limits.target = o.lattice_velocity;
  limits.uncounted = o.uncounted_share;
  limits.cell_size = o.domain.cell_size;
  limits.shortest = kShortestStep * o.time_step;
  const double viscosity = o.rheology.law == FlowLaw::newtonian ? o.kinematic_viscosity : o.rheology.limit_viscosity;
  limits.longest = std::max(o.time_step, o.domain.cell_size * o.domain.cell_size / (6 * viscosity));
  limits.longest = std::min(limits.longest, capillary_time_step(o.density, o.domain.cell_size, o.surface_tension));
  limits.gravity = o.gravity.norm();
  for (const Wall& w : o.domain.walls.all())  // of one that turns: its speed grows outwards
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 far(corner & 1, corner >> 1 & 1, corner >> 2);
      const Vec3 place = o.domain.lower + far.cwiseProduct(o.domain.upper - o.domain.lower);
      limits.known_speed = std::max(limits.known_speed, w.surface_velocity(place).norm());
    }
  for (const InflowOptions& in : o.inflows) {
    limits.known_speed = std::max(limits.known_speed, in.velocity.norm());
    if (const double peak = in.discharge.peak(); peak > 0)  // what its box can take in a step
      limits.longest = std::min(limits.longest, std::max(o.time_step, kLargestDose * free_volume(in, domain) / peak));
  }
  return limits;
}

}  // namespace lahar::lbm
