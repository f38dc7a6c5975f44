#include "dem/energy.h"

#include "core/parallel.h"

namespace lahar::dem {

namespace {

/// Kinetic, rotational, gravitational.
Vec3 motion_terms(const Particles& p, std::size_t i, const Vec3& gravity) {
  if (p.state[i] == ParticleState::removed) return Vec3::Zero();
  return {0.5 * p.mass[i] * p.velocity[i].squaredNorm(), 0.5 * p.inertia[i] * p.angular_velocity[i].squaredNorm(),
          -p.gravitational_mass[i] * gravity.dot(p.position[i])};
}

}  // namespace

std::array<std::pair<std::string_view, double>, 18> EnergyLedger::terms() const {
  return {{{"kinetic", kinetic},
           {"rotational", rotational},
           {"gravitational", gravitational},
           {"contact, normal", elastic_normal},
           {"contact, tangential", elastic_tangential},
           {"contact, rolling", elastic_rolling},
           {"bond, axial", bonds.axial},
           {"bond, shear", bonds.shear},
           {"bond, bending", bonds.bending},
           {"bond, torsion", bonds.torsion},
           {"contact damping", contact_damping},
           {"friction", friction},
           {"rolling", rolling},
           {"bond damping", bonds.damping},
           {"plastic", bonds.plastic},
           {"breakage", bonds.breakage},
           {"removed", removed},
           {"external work", -external_work}}};
}

EnergyLedger motion_energy(const Particles& particles, const Vec3& gravity) {
  const Vec3 sum = ordered_sum<Vec3>(
      particles.size(), [&](std::size_t id) { return motion_terms(particles, particles.index(id), gravity); }, 1024,
      Vec3::Zero());
  EnergyLedger ledger;
  ledger.kinetic = sum[0], ledger.rotational = sum[1], ledger.gravitational = sum[2];
  return ledger;
}

double motion_energy(const Particles& particles, std::size_t i, const Vec3& gravity) {
  return motion_terms(particles, i, gravity).sum();
}

double external_work(const Particles& p, double dt) {
  return dt * ordered_sum<double>(
                  p.size(),
                  [&](std::size_t id) {
                    const ParticleIndex i = p.index(id);
                    return p.external_force.x[i] * p.velocity.x[i] + p.external_force.y[i] * p.velocity.y[i] +
                           p.external_force.z[i] * p.velocity.z[i] + p.external_torque.x[i] * p.angular_velocity.x[i] +
                           p.external_torque.y[i] * p.angular_velocity.y[i] +
                           p.external_torque.z[i] * p.angular_velocity.z[i];
                  },
                  4096);
}

Vec3 momentum(const Particles& p) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t id = 0; id < p.size(); ++id)
    if (const ParticleIndex i = p.index(id); p.inverse_mass[i] > 0) sum += p.mass[i] * p.velocity[i];
  return sum;
}

Vec3 angular_momentum(const Particles& p) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t id = 0; id < p.size(); ++id)
    if (const ParticleIndex i = p.index(id); p.inverse_mass[i] > 0)
      sum += p.mass[i] * p.position[i].cross(p.velocity[i]) + p.inertia[i] * p.angular_velocity[i];
  return sum;
}

}  // namespace lahar::dem
