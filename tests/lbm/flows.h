#pragma once
// Small flows that several tests use, in lattice units (cell size, time step and density 1).
#include "lbm/step/fluid.h"

namespace lahar::lbm {

inline FluidOptions lattice_options(const Vec3i& cells, double viscosity) {
  FluidOptions o;
  o.domain.upper = cells.cast<double>();
  o.domain.cell_size = 1;
  o.domain.faces.fill(FaceKind::periodic);
  o.time_step = 1;
  o.density = 1;
  o.kinematic_viscosity = viscosity;
  return o;
}

/// A tank of water, SI: walls all round, open top.
inline FluidOptions tank_options(const Vec3& size, double cell_size, double speed, double lattice_velocity = 0.05) {
  FluidOptions o;
  o.domain.upper = size;
  o.domain.cell_size = cell_size;
  o.domain.faces[5] = FaceKind::open;
  o.time_step = lattice_velocity * cell_size / speed;
  o.gravity = Vec3(0, 0, -9.81);
  return o;
}

inline double no_pressure(const Vec3&) { return 0; }

template <class Real>
double largest_speed(const Fluid<Real>& fluid) {
  double speed = 0;
  fluid.for_each_wet_cell([&](const WetCell& c) { speed = std::max(speed, c.velocity.norm()); });
  return speed;
}

}  // namespace lahar::lbm
