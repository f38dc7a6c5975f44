#include "dem/contact_bodies.h"

#include <limits>

#include "core/parallel.h"
#include "dem/triple.h"

namespace lahar::dem {

namespace {

Triple triple(const Vec3Field& f, std::size_t i) { return {f.x[i], f.y[i], f.z[i]}; }

}  // namespace

void ContactBodies::pack(const Particles& p, const ContactParties& parties, double dt, const MeanMotion* mean) {
  const Vec3Field& velocity = mean != nullptr ? mean->velocity : p.velocity;
  const Vec3Field& spin = mean != nullptr ? mean->spin : p.angular_velocity;
  lines_.resize(3 * parties.particle.size());
  const auto pack_one = [&](std::size_t place) {
    const std::size_t i = parties.particle[place];
    const double r = p.radius[i], inverse_mass = p.inverse_mass[i];
    const Triple x = triple(p.position, i), v = triple(velocity, i), w = triple(spin, i);
    const Triple v_end = triple(p.velocity, i) + (0.5 * dt * inverse_mass) * triple(p.force, i);
    const Triple w_end =
        triple(p.angular_velocity, i) + (0.5 * dt * 2.5 * inverse_mass / (r * r)) * triple(p.torque, i);
    const bool removed = p.state[i] == ParticleState::removed;
    const double x0 = removed ? std::numeric_limits<double>::quiet_NaN() : x.x;
    store_line(lines_[3 * place], Line{x0, x.y, x.z, v.x, v.y, v.z, v_end.x, v_end.y});
    store_line(lines_[3 * place + 1], Line{v_end.z, w.x, w.y, w.z, w_end.x, w_end.y, w_end.z, r});
    store_line(lines_[3 * place + 2],
               Line{r * w.x, r * w.y, r * w.z, r * w_end.x, r * w_end.y, r * w_end.z, inverse_mass, 1 / r});
  };
  parallel_for_even_chunks(parties.particle.size(), 512, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) pack_one(k);
  });
}

}  // namespace lahar::dem
