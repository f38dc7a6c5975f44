#pragma once
// Small things that several entries of the solids build their scenes from.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/solids.h"
#include "dem/time_step.h"

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

/// A sphere of 2 cm on a plane, sunk in as far as at rest, that rolls down at `speed` (m/s) without slip.
struct SphereOnPlane {
  double angle = 0, friction = 0, rolling_friction = 0, speed = 0;  ///< angle of the plane in rad
  static constexpr double kRadius = 0.02, kDensity = 2650;

  [[nodiscard]] Vec3 normal() const { return {std::sin(angle), 0, std::cos(angle)}; }
  [[nodiscard]] Vec3 down() const { return {std::cos(angle), 0, -std::sin(angle)}; }
  [[nodiscard]] dem::Solids solids() const {
    dem::Materials m = one_material(70e9, 0.3, friction, 0.5);
    m.set_pair(0, 0, friction, 0.5, rolling_friction);
    const double weight = sphere_mass(kRadius, kDensity) * kGravity * std::cos(angle);
    const double overlap = std::pow(weight / (4.0 / 3 * m.pair(0, 0).effective_modulus * std::sqrt(kRadius)), 2.0 / 3);
    dem::ParticleSpec sphere;
    sphere.position = (kRadius - overlap) * normal();
    sphere.velocity = speed * down();
    sphere.angular_velocity = Vec3(0, speed / kRadius, 0);
    sphere.radius = kRadius;
    sphere.density = kDensity;
    dem::Particles p;
    p.add(sphere);
    Walls walls;
    walls.add({"plane", HalfSpace{Vec3::Zero(), normal()}});
    const double step = 0.2 * dem::rayleigh_time_step(kRadius, kDensity, m[0]);
    return {p, {}, m, walls, solids_options(step, Vec3(0, 0, -kGravity))};
  }
};

}  // namespace lahar::validate
