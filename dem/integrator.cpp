#include "dem/integrator.h"

#include <array>

#include "core/parallel.h"

namespace lahar::dem {

namespace {

constexpr std::size_t kChunk = 512;

void kick_component(double* v, const double* force, const double* inverse_mass, double dt, std::size_t first,
                    std::size_t last) {
  for (std::size_t i = first; i < last; ++i) v[i] += dt * inverse_mass[i] * force[i];
}

void drift_component(double* x, const double* v, double dt, std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) x[i] += dt * v[i];
}

void kick_range(Particles& p, double dt, std::size_t a, std::size_t b) {
  const double *m = p.inverse_mass.data(), *inertia = p.inertia.data();
  kick_component(p.velocity.x.data(), p.force.x.data(), m, dt, a, b);
  kick_component(p.velocity.y.data(), p.force.y.data(), m, dt, a, b);
  kick_component(p.velocity.z.data(), p.force.z.data(), m, dt, a, b);
  // 1/I, 0 where the inverse mass is 0. Divided once for all three components.
  std::array<double, kChunk> inverse_inertia;
  for (std::size_t i = a; i < b; ++i) inverse_inertia[i - a] = m[i] > 0 ? 1 / inertia[i] : 0.0;
  const auto spin = [&](std::vector<double>& rate, const std::vector<double>& torque) {
    double* w = rate.data() + a;
    const double* t = torque.data() + a;
    for (std::size_t k = 0; k < b - a; ++k) w[k] += dt * inverse_inertia[k] * t[k];
  };
  spin(p.angular_velocity.x, p.torque.x);
  spin(p.angular_velocity.y, p.torque.y);
  spin(p.angular_velocity.z, p.torque.z);
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
