#include "cases/validate/grains_in_fluid/settling.h"

#include <algorithm>
#include <utility>

#include "cases/validate/fluid/flows.h"
#include "cases/validate/reference_table.h"
#include "coupling/coupled_step.h"

namespace lahar::validate {

namespace {

constexpr double kDiameter = 0.015, kDensity = 1120, kGravity = 9.81, kGap = 0.120;
constexpr double kSlowedDown = 0.95;  // of the highest speed so far: it has begun to feel the floor

}  // namespace

std::vector<Oil> oils() {
  const ReferenceTable table = reference("tencate2002.csv");
  std::vector<Oil> all;
  for (const auto& [name, lattice_speed] : {std::pair{"E1", 0.020}, {"E2", 0.030}, {"E3", 0.050}, {"E4", 0.050}}) {
    const ReferenceTable row = table.where("case", name);
    all.push_back({name, row.number("rho_f"), row.number("mu_Pas"), row.number("u_max_box"), lattice_speed});
  }
  return all;
}

template <class Real>
Fall fall_in(const Oil& oil, const FallGrid& grid, bool to_floor) {
  const double dx = kDiameter / grid.cells_per_diameter, dt = oil.lattice_speed * dx / oil.fastest;
  const Immersion& immersion = grid.immersion;
  lbm::FluidOptions fluid;
  fluid.domain.upper = Vec3(0.1, 0.1, 0.16);
  fluid.domain.cell_size = dx;
  fluid.time_step = dt;
  fluid.density = oil.density;
  fluid.kinematic_viscosity = oil.viscosity / oil.density;
  fluid.collision = immersion.collision;
  fluid.smagorinsky = immersion.smagorinsky;
  fluid.weighting = immersion.weighting;
  fluid.solid_operator = immersion.solid_operator;
  dem::Particles particles;
  dem::ParticleSpec sphere;
  sphere.position = Vec3(0.05, 0.05, kGap + kDiameter / 2);
  sphere.radius = kDiameter / 2;
  sphere.density = kDensity;
  particles.add(sphere);
  dem::Materials materials;
  materials.add({"nylon", 1e6, 0.3});
  materials.set_pair(0, 0, 0.3, 0.5);
  dem::SolidsOptions options;
  options.gravity = Vec3(0, 0, -kGravity * (1 - oil.density / kDensity));
  options.time_step = dt;
  coupling::CoupledStep<Real> step(
      fluid, dem::Solids(std::move(particles), dem::Bonds{}, std::move(materials), Walls{}, options),
      {.grains = coupling::ResolvedGrains{immersion.radius_shift}, .substeps = grid.substeps});
  step.fluid()->fill_everything(at_rest, no_pressure);
  Fall fall;
  fall.shifted_viscosity = step.fluid()->tau() - 0.5;
  const dem::Particles& p = step.solids()->particles();
  while (p.position.z[0] > kDiameter / 2 + 2 * dx) {
    step.advance();
    const double speed = -p.velocity.z[0];
    fall.time.push_back(step.time()), fall.speed.push_back(speed);
    fall.fastest = std::max(fall.fastest, speed);
    if (!to_floor && speed < kSlowedDown * fall.fastest) break;
  }
  fall.audit = step.audit();
  return fall;
}

template Fall fall_in<float>(const Oil&, const FallGrid&, bool);
template Fall fall_in<double>(const Oil&, const FallGrid&, bool);

}  // namespace lahar::validate
