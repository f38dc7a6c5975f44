#pragma once
// Small particle scenes that several tests share.
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>

#include "dem/solids.h"

namespace lahar::dem::testing {

/// One material that touches itself with the given friction and restitution.
inline Materials one_material(double youngs_modulus, double poisson_ratio, double friction, double restitution) {
  Materials m;
  m.add({"stone", youngs_modulus, poisson_ratio});
  m.set_pair(0, 0, friction, restitution);
  return m;
}

inline ParticleSpec sphere(const Vec3& position, double radius, double density, const Vec3& velocity = Vec3::Zero()) {
  ParticleSpec s;
  s.position = position;
  s.velocity = velocity;
  s.radius = radius;
  s.density = density;
  return s;
}

/// Ground with its surface through the origin.
inline Walls ground(const Vec3& normal = Vec3::UnitZ()) {
  Walls w;
  w.add({"ground", HalfSpace{Vec3::Zero(), normal}});
  return w;
}

/// Five planes around [0, size.x] x [0, size.y] x [0, inf).
inline Walls open_box(const Vec3& size) {
  Walls w;
  w.add({"floor", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}});
  w.add({"left", HalfSpace{Vec3::Zero(), Vec3::UnitX()}});
  w.add({"right", HalfSpace{size, -Vec3::UnitX()}});
  w.add({"front", HalfSpace{Vec3::Zero(), Vec3::UnitY()}});
  w.add({"back", HalfSpace{size, -Vec3::UnitY()}});
  return w;
}

inline SolidsOptions options(double time_step, const Vec3& gravity = Vec3::Zero()) {
  SolidsOptions o;
  o.time_step = time_step;
  o.gravity = gravity;
  return o;
}

/// Spheres of two sizes at random places of a box, moving and spinning; some of them overlap a little.
inline Particles random_cloud(int large, double large_radius, int small, double small_radius, const Vec3& size,
                              double speed, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto u = [&] { return static_cast<double>(random()) / 4294967296.0; };
  const auto vector = [&] { return Vec3(u(), u(), u()); };
  Particles p;
  for (int n = 0; n < large + small; ++n) {
    const double r = n < large ? large_radius : small_radius;
    ParticleSpec s = sphere(vector().cwiseProduct(size), r, 2650, 2 * speed * (vector() - 0.5 * Vec3::Ones()));
    s.angular_velocity = 2 * speed / r * (vector() - 0.5 * Vec3::Ones());
    p.add(s);
  }
  return p;
}

/// Grains of two sizes on a loose lattice above the floor, jittered: they fall and settle.
inline Particles loose_grains(int columns, int rows, int layers, double small, double large, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto u = [&] { return static_cast<double>(random()) / 4294967296.0; };
  const double pitch = 2.05 * large;
  Particles p;
  for (int k = 0; k < layers; ++k)
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i) {
        const double r = u() < 0.5 ? small : large;
        const Vec3 jitter = (large - r) * Vec3(2 * u() - 1, 2 * u() - 1, 2 * u() - 1);
        p.add(sphere(pitch * Vec3(i + 0.5, j + 0.5, k + 0.5) + jitter, r, 2650));
      }
  return p;
}

}  // namespace lahar::dem::testing
