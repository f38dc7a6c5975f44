#pragma once
// Small tanks of water that several tests use.
#include "dem/solids.h"
#include "lbm/step/fluid.h"

namespace lahar::coupling {

/// B = eps and damped stress, as many tests of the bookkeeping have it: it acts on every cell that a body touches.
inline lbm::FluidOptions by_fraction(lbm::FluidOptions o) {
  o.weighting = lbm::BodyWeighting::solid_fraction;
  o.solid_operator = lbm::SolidOperator::damped_nonequilibrium;
  return o;
}

/// The library's default, or the other weighting by the distance from the surface.
inline lbm::FluidOptions by_distance(lbm::FluidOptions o,
                                     lbm::BodyWeighting weighting = lbm::BodyWeighting::wall_distance) {
  o.weighting = weighting;
  o.solid_operator = lbm::SolidOperator::equilibrium_difference;
  return o;
}

/// Walls all round and an open top; cells of `cell_size` (m).
inline lbm::FluidOptions tank(const Vec3& size, double cell_size, double time_step) {
  lbm::FluidOptions o;
  o.domain.upper = size;
  o.domain.cell_size = cell_size;
  o.domain.faces[5] = lbm::FaceKind::open;
  o.time_step = time_step;
  o.gravity = Vec3(0, 0, -9.81);
  o.kinematic_viscosity = 1e-4;
  o.smagorinsky = 0.1;
  return by_fraction(o);
}

/// A closed periodic box of fluid in uniform motion.
inline lbm::FluidOptions stream(int cells, double cell_size, double time_step) {
  lbm::FluidOptions o;
  o.domain.upper = Vec3::Constant(cells * cell_size);
  o.domain.cell_size = cell_size;
  o.domain.faces.fill(lbm::FaceKind::periodic);
  o.time_step = time_step;
  return by_fraction(o);
}

inline dem::ParticleSpec grain(const Vec3& place, double radius, double density) {
  dem::ParticleSpec s;
  s.position = place;
  s.radius = radius;
  s.density = density;
  return s;
}

inline dem::Materials rock() {
  dem::Materials m;
  m.add({"rock", 1e8, 0.3});
  m.set_pair(0, 0, 0.3, 0.7);
  return m;
}

}  // namespace lahar::coupling
