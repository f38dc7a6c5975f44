#pragma once
// Small things that several entries of the solids build their scenes from.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/solids.h"

namespace lahar::validate {

inline constexpr double kGravity = 9.81;  // m/s^2

inline dem::Materials one_material(double youngs_modulus, double poisson_ratio, double friction, double restitution) {
  dem::Materials m;
  m.add({"stone", youngs_modulus, poisson_ratio});
  m.set_pair(0, 0, friction, restitution);
  return m;
}

inline dem::SolidsOptions solids_options(double time_step, const Vec3& gravity) {
  dem::SolidsOptions o;
  o.time_step = time_step;
  o.gravity = gravity;
  return o;
}

/// A drag -rate m v (rate in 1/s) on every free particle as its external force; with it a structure comes to rest. To
/// be renewed every few steps.
inline void set_drag(dem::Particles& p, double rate) {
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.inverse_mass[i] > 0) p.external_force.set(i, -rate * p.mass[i] * p.velocity[i]);
}

inline double sphere_mass(double radius, double density) {
  return 4.0 / 3 * std::numbers::pi * radius * radius * radius * density;
}

}  // namespace lahar::validate
