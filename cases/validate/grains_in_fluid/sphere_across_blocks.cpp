// Case H7 of reference/hard_cases.csv: a sphere that crosses the borders of blocks and the periodic faces at 0.3
// lattice units a step. Where the blocks lie must not matter.
#include <algorithm>
#include <cmath>

#include "cases/validate/entry.h"
#include "cases/validate/fluid/flows.h"
#include "cases/validate/free_surface/surface_flows.h"
#include "cases/validate/grains_in_fluid/sphere_flow.h"
#include "core/worst.h"
#include "coupling/coupled_step.h"

namespace lahar::validate {
namespace {

struct Flight {
  std::vector<Vec3> place, force;
  double audit = 0;
};

/// A free sphere in liquid at rest, started at a whole number of cells from the corner.
template <class Real>
Flight fly(const Vec3& shift, int steps) {
  dem::ParticleSpec sphere;
  sphere.position = Vec3(10.3, 12.1, 11.7) + shift;
  sphere.velocity = Vec3(0.3, 0.02, -0.01);
  sphere.radius = 3;
  sphere.density = 8;
  dem::Particles particles;
  particles.add(sphere);
  dem::Materials materials;
  materials.add({"stone", 100, 0.3});
  dem::SolidsOptions options;
  options.gravity = Vec3::Zero();
  options.time_step = 1;
  const Immersion immersion;
  lbm::FluidOptions fluid = lattice_box({32, 24, 24}, 1e-3);
  fluid.weighting = immersion.weighting;
  fluid.solid_operator = immersion.solid_operator;
  coupling::CoupledStep<Real> step(
      fluid, dem::Solids(std::move(particles), dem::Bonds{}, std::move(materials), Walls{}, options),
      {.grains = coupling::ResolvedGrains{immersion.radius_shift}});
  step.fluid()->fill_everything(at_rest, no_pressure);
  Flight flight;
  for (int s = 0; s < steps; ++s) {
    step.advance();
    flight.place.push_back(step.solids()->particles().position[0] - shift);
    flight.force.push_back(step.solids()->particles().external_force[0]);
  }
  flight.audit = step.audit().relative();
  return flight;
}

double largest_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double difference = 0, size = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    keep_worst(difference, (a[k] - b[k]).norm());
    size = std::max(size, a[k].norm());
  }
  return difference / size;
}

/// Shifted by 3, 5 and 7 cells the same flight crosses all borders at other times; by 30 cells along x a periodic face.
std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    const int steps = context.quick ? 60 : 200;  // 18 and 60 cells: twice round
    const double bar = sizeof(Real) == 8 ? 1e-12 : 1e-3;
    const Flight one = fly<Real>(Vec3::Zero(), steps), inside = fly<Real>(Vec3(3, 5, 7), steps),
                 beyond = fly<Real>(Vec3(18, 8, 16), steps);
    return std::vector<Row>{
        at_most_row("places, shifted by (3, 5, 7) cells", largest_difference(one.place, inside.place), bar),
        at_most_row("forces, shifted by (3, 5, 7) cells", largest_difference(one.force, inside.force), bar),
        at_most_row("places, started at the periodic faces", largest_difference(one.place, beyond.place), bar),
        at_most_row("forces, started at the periodic faces", largest_difference(one.force, beyond.force), bar),
        at_most_row("momentum audit", one.audit, sizeof(Real) == 8 ? 1e-10 : 1e-4)};
  });
}

}  // namespace

Entry sphere_across_blocks() {
  return {"grains_in_fluid.sphere_across_blocks", {"case H7 of the hard cases", {"hard_cases.csv"}}, run};
}

}  // namespace lahar::validate
