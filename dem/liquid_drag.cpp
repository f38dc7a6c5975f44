#include "dem/liquid_drag.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace lahar::dem {

namespace {

/// `per_mass`: 1/kg, of particle and liquid together.
void note_decay(LiquidDrag& drag, double per_mass, double kick) {
  const auto note = [&](double coefficient, double& decay, double& of_driven) {
    const double x = coefficient * per_mass * kick;
    decay = -std::expm1(-x);
    of_driven = x > 1e-4 ? 1 - decay / x : x / 2;
  };
  note(drag.coefficient.along, drag.decay.along, drag.of_driven.along);
  note(drag.coefficient.across, drag.decay.across, drag.of_driven.across);
  drag.noted_kick = kick;
}

/// `along` times the part of a vector along an axis, `across` times the rest.
Vec3 shares(const AlongAndAcross& share, const Vec3& axis, const Vec3& vector) {
  return share.across * vector + (share.along - share.across) * vector.dot(axis) * axis;
}

/// What a kick takes off the slip, m/s; `driven`: what else changes it.
Vec3 taken_off(const LiquidDrag& drag, const Vec3& slip, const Vec3& driven, double per_mass, double kick) {
  const Vec3 viscous = shares(drag.decay, drag.axis, slip) + shares(drag.of_driven, drag.axis, driven);
  if (drag.friction.across == 0 && drag.friction.along == 0) return viscous;
  const Vec3 rest = slip + driven - viscous;
  const double speed = rest.norm(), creep = drag.creep_speed;
  if (speed == 0) return viscous;
  // Friction is a drive, too, of which K leaves the same part.
  const AlongAndAcross friction = {drag.friction.along * per_mass * kick * (1 - drag.of_driven.along),
                                   drag.friction.across * per_mass * kick * (1 - drag.of_driven.across)};
  // The speed S at the end: S = speed - friction S/(S + c).
  const double mean = shares(friction, drag.axis, rest).norm() / speed, b = speed - mean - creep;
  const double end = 0.5 * (b + std::sqrt(b * b + 4 * speed * creep));
  const auto stopped = [&](double f) { return f > 0 ? std::min(1.0, f / (std::max(end, 0.0) + creep + f)) : 0.0; };
  return viscous + shares({stopped(friction.along), stopped(friction.across)}, drag.axis, rest);
}

/// N s, on the particle in a kick.
Vec3 impulse_of(LiquidDrag& drag, const Vec3& slip, const Vec3& driven, double per_mass, double kick) {
  if (drag.noted_kick != kick) note_decay(drag, per_mass, kick);
  return taken_off(drag, slip, driven, per_mass, kick) / per_mass;
}

/// The same of a particle on a rail, which is held across it.
Vec3 impulse_on_rail(LiquidDrag& drag, const Vec3& rail, const Vec3& slip, const Vec3& driven, double per_mass,
                     double kick) {
  const auto part = [&](const Vec3& slip_of_part, const Vec3& driven_of_part, double per_mass_of_part) {
    drag.noted_kick = 0;
    return impulse_of(drag, slip_of_part, driven_of_part, per_mass_of_part, kick);
  };
  const Vec3 along = slip.dot(rail) * rail, driven_along = driven.dot(rail) * rail;
  const Vec3 impulse = part(along, driven_along, per_mass);
  return impulse + part(slip - along, driven - driven_along, 1 / drag.liquid_mass);
}

/// Adds the drag of a kick on a particle's spin to its torque; returns the work, J.
double add_torque(LiquidDrag& drag, Particles& p, double kick) {
  const ParticleIndex i = drag.particle;
  const double of_particle = p.inverse_inertia(i);
  if (of_particle == 0) return 0;
  const double x = drag.spin_coefficient * of_particle * kick, decay = -std::expm1(-x);
  const double of_driven = x > 1e-4 ? 1 - decay / x : x / 2;
  const Vec3 spin = p.angular_velocity[i], driven = -kick * of_particle * Vec3(p.torque[i]);
  const Vec3 impulse = (decay * (drag.liquid_spin - spin) + of_driven * driven) / of_particle;
  drag.torque = impulse / kick;
  drag.angular_impulse += impulse;
  p.torque.add(i, drag.torque);
  return impulse.dot(spin + 0.5 * kick * of_particle * Vec3(p.torque[i]));
}

}  // namespace

void begin_drags(std::span<LiquidDrag> drags, const Particles& particles) {
  for (LiquidDrag& drag : drags) {
    drag.rail = particles.rail_of(drag.particle);
    drag.former_impulse = drag.impulse;
    drag.former_angular_impulse = drag.angular_impulse;
    drag.force = drag.torque = Vec3::Zero();
    drag.noted_kick = 0;
  }
}

double add_drags(std::span<LiquidDrag> drags, Particles& p, double kick) {
  return ordered_sum<double>(
      drags.size(),
      [&](std::size_t k) {
        LiquidDrag& drag = drags[k];
        const ParticleIndex i = drag.particle;
        const double of_particle = p.inverse_mass[i], of_both = of_particle + 1 / drag.liquid_mass;
        const Rail* const rail = drag.rail;
        const auto change = [&](const Vec3& force) {  // of the particle's velocity in the kick
          return Vec3(kick * of_particle * (rail ? Vec3(force.dot(rail->along) * rail->along) : force));
        };
        const Vec3 velocity = p.velocity[i], of_liquid = kick * drag.acceleration;
        const Vec3 slip = drag.liquid - velocity, driven = of_liquid - change(p.force[i]);
        const Vec3 impulse = rail ? impulse_on_rail(drag, rail->along, slip, driven, of_both, kick)
                                  : impulse_of(drag, slip, driven, of_both, kick);
        drag.force = impulse / kick;
        drag.liquid += of_liquid - impulse / drag.liquid_mass;
        drag.impulse += impulse;
        p.force.add(i, drag.force);
        const double work = of_particle > 0 ? impulse.dot(velocity + 0.5 * change(p.force[i])) : 0.0;
        return drag.spin_coefficient > 0 ? work + add_torque(drag, p, kick) : work;
      },
      256);
}

void note_mean_drags(std::span<LiquidDrag> drags, Particles& p, double time) {
  for (LiquidDrag& drag : drags) {
    const Vec3 mean = (drag.impulse - drag.former_impulse) / time;
    p.force.add(drag.particle, mean - drag.force);
    p.external_force.add(drag.particle, mean);
    drag.force = Vec3::Zero();
    if (drag.spin_coefficient == 0) continue;
    const Vec3 torque = (drag.angular_impulse - drag.former_angular_impulse) / time;
    p.torque.add(drag.particle, torque - drag.torque);
    p.external_torque.add(drag.particle, torque);
    drag.torque = Vec3::Zero();
  }
}

}  // namespace lahar::dem
