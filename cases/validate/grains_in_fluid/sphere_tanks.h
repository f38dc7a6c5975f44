#pragma once
// Spheres in an open tank of water: what the entries on bodies at the surface share. Lattice units.
#include <memory>

#include "cases/validate/free_surface/surface_flows.h"
#include "cases/validate/grains_in_fluid/sphere_flow.h"
#include "coupling/coupled_step.h"

namespace lahar::validate {

struct SphereTank {
  Vec3i cells{32, 32, 40};
  double depth = 20;  ///< of the water
  double gravity = 1e-4;
  double viscosity = 1e-3;
  double diameter = 8;
  Vec3 place = Vec3::Zero();     ///< of the centre
  Vec3 velocity = Vec3::Zero();  ///< at the start
  double density = 1;            ///< over that of water
  bool held = false;             ///< moved by hand
  double smagorinsky = 0.1;
  int substeps = 10;
  double youngs_modulus = 1, restitution = 0.5;
  bool lubrication = false;
  Immersion immersion;                        ///< but for its collision operator, which is the default one
  std::vector<Wall> walls = {};               ///< that the water alone meets
  std::vector<lbm::LiquidRegion> water = {};  ///< in place of all that lies below the depth
};

template <class Real>
std::unique_ptr<coupling::CoupledStep<Real>> make_tank(const SphereTank& t) {
  lbm::FluidOptions fluid = open_tank(t.cells, t.viscosity, Vec3(0, 0, -t.gravity));
  fluid.smagorinsky = t.smagorinsky;
  fluid.weighting = t.immersion.weighting;
  fluid.solid_operator = t.immersion.solid_operator;
  for (const Wall& wall : t.walls) fluid.domain.walls.add(wall);
  dem::ParticleSpec sphere;
  sphere.position = t.place;
  sphere.velocity = t.velocity;
  sphere.radius = t.diameter / 2;
  sphere.density = t.density;
  sphere.state = t.held ? dem::ParticleState::fixed : dem::ParticleState::free;
  dem::Particles particles;
  particles.add(sphere);
  dem::Materials materials;
  materials.add({"stone", t.youngs_modulus, 0.3});
  materials.set_pair(0, 0, 0.3, t.restitution);
  Walls walls;
  walls.add({"floor", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}});
  dem::SolidsOptions options;
  options.gravity = fluid.gravity;
  options.time_step = 1;
  coupling::CouplingOptions coupling;
  coupling.substeps = t.substeps;
  coupling.grains = coupling::ResolvedGrains{t.immersion.radius_shift};
  if (t.lubrication) coupling.films = coupling::GrainFilms::lubrication;
  auto step = std::make_unique<coupling::CoupledStep<Real>>(
      fluid, dem::Solids(std::move(particles), dem::Bonds{}, std::move(materials), std::move(walls), options),
      coupling);
  const lbm::LiquidRegion all{Vec3::Zero(), Vec3(t.cells.x(), t.cells.y(), t.depth)};
  step->fill(t.water.empty() ? std::vector{all} : t.water);
  return step;
}

/// Volume under the surface, bodies included.
template <class Real>
double filled_volume(const lbm::Fluid<Real>& fluid) {
  double volume = 0;
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) { volume += c.fill_level; });
  return volume;
}

/// The bars of every case with bodies: momentum given is momentum taken, and no liquid is lost.
template <class Real>
void add_ledgers(std::vector<Row>& rows, const std::string& what, coupling::CoupledStep<Real>& step) {
  const bool exact = sizeof(Real) == 8;
  rows.push_back(at_most_row(what + ": momentum audit", step.audit().relative(), exact ? 1e-10 : 1e-4));
  rows.push_back(at_most_row(what + ": liquid ledger", std::abs(step.fluid()->mass_drift()), exact ? 1e-10 : 1e-5));
}

}  // namespace lahar::validate
