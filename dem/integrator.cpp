#include "dem/integrator.h"

#include "core/parallel.h"

namespace lahar::dem {

namespace {

constexpr std::size_t kChunk = 512;

void kick_component(double* v, const double* force, const double* inverse_mass, double dt, std::size_t first,
                    std::size_t last) {
  for (std::size_t i = first; i < last; ++i) v[i] += dt * inverse_mass[i] * force[i];
}

/// For spheres 1/I = 2.5 / (m r^2), 0 where the inverse mass is 0.
void spin_component(double* w, const double* torque, const double* inverse_mass, const double* radius, double dt,
                    std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) w[i] += dt * 2.5 * inverse_mass[i] / (radius[i] * radius[i]) * torque[i];
}

void drift_component(double* x, const double* v, double dt, std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) x[i] += dt * v[i];
}

}  // namespace

namespace {

void kick_range(Particles& p, double dt, std::size_t a, std::size_t b) {
  const double *m = p.inverse_mass.data(), *r = p.radius.data();
  kick_component(p.velocity.x.data(), p.force.x.data(), m, dt, a, b);
  kick_component(p.velocity.y.data(), p.force.y.data(), m, dt, a, b);
  kick_component(p.velocity.z.data(), p.force.z.data(), m, dt, a, b);
  spin_component(p.angular_velocity.x.data(), p.torque.x.data(), m, r, dt, a, b);
  spin_component(p.angular_velocity.y.data(), p.torque.y.data(), m, r, dt, a, b);
  spin_component(p.angular_velocity.z.data(), p.torque.z.data(), m, r, dt, a, b);
}

}  // namespace

void kick(Particles& p, double dt) {
  parallel_for_even_chunks(p.size(), kChunk, [&](std::size_t a, std::size_t b) { kick_range(p, dt, a, b); });
}

void kick_and_drift(Particles& p, double kick_dt, double drift_dt) {
  parallel_for_even_chunks(p.size(), kChunk, [&](std::size_t a, std::size_t b) {
    kick_range(p, kick_dt, a, b);
    drift_component(p.position.x.data(), p.velocity.x.data(), drift_dt, a, b);
    drift_component(p.position.y.data(), p.velocity.y.data(), drift_dt, a, b);
    drift_component(p.position.z.data(), p.velocity.z.data(), drift_dt, a, b);
  });
}

}  // namespace lahar::dem
