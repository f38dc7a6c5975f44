#include "dem/time_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "dem/contact/damping.h"

namespace lahar::dem {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Explicit damping of ratio d lowers the limit of an oscillator by this factor.
double lowered_by(double d) { return std::sqrt(1 + d * d) - d; }

/// Bending and torsion of a bond against the moment of inertia of a bead. They bind only where the bond is thicker than
/// the bead: k I / (0.4 m r^2) is (R / r)^2 / 1.6 times k A / m.
double turning_time_step(const BondSort& sort, double inertia) {
  const double second_moment = 0.25 * std::numbers::pi * std::pow(sort.bond_radius, 4);
  const double stiffest = std::max(sort.axial.stiffness[0], 2 * sort.shear_stiffness) * second_moment;
  return stiffest > 0 ? std::sqrt(inertia / stiffest) * lowered_by(sort.damping_ratio) : kInfinity;
}

}  // namespace

double damped_share(double restitution) { return lowered_by(damping_ratio(restitution)); }

double rayleigh_time_step(double radius, double density, const Material& material) {
  const double nu = material.poisson_ratio, shear_modulus = material.youngs_modulus / (2 * (1 + nu));
  return std::numbers::pi * radius * std::sqrt(density / shear_modulus) / (0.1631 * nu + 0.8766);
}

double rayleigh_time_step(const Particles& particles, const Materials& materials) {
  double least = kInfinity;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (particles.state[i] == ParticleState::removed) continue;
    const double r = particles.radius[i], density = particles.mass[i] / (4.0 / 3.0 * std::numbers::pi * r * r * r);
    least = std::min(least, rayleigh_time_step(r, density, materials[particles.material[i]]));
  }
  return least;
}

double hertz_contact_time(double effective_mass, double effective_radius, double effective_modulus, double speed) {
  return 2.87 *
         std::pow(effective_mass * effective_mass / (effective_radius * effective_modulus * effective_modulus * speed),
                  0.2);
}

double linear_contact_time(double effective_mass, double stiffness) {
  return std::numbers::pi * std::sqrt(effective_mass / stiffness);
}

double bond_time_step(const BondSort& sort, double mass) {
  const double area = std::numbers::pi * sort.bond_radius * sort.bond_radius;
  double axial = sort.axial.stiffness[0];
  for (std::size_t branch = 0; branch < 2; ++branch)  // a later branch counts only if a force can reach it
    if (std::isfinite(sort.axial.force_limit[branch])) axial = std::max(axial, sort.axial.stiffness[branch + 1]);
  const double translation = axial > 0 ? std::sqrt(mass / (axial * area)) : kInfinity;
  const double rotation = sort.shear_stiffness > 0 ? std::sqrt(0.4 * mass / (sort.shear_stiffness * area)) : kInfinity;
  return std::min(translation, rotation) * lowered_by(sort.damping_ratio);
}

double bond_time_step(const Bonds& bonds, const Particles& particles) {
  double least = kInfinity;
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    if (!bonds.intact[b]) continue;
    const BondSort& sort = bonds.sorts[static_cast<std::size_t>(bonds.sort[b])];
    for (const ParticleIndex end : {bonds.i[b], bonds.j[b]}) {
      if (particles.inverse_mass[end] == 0) continue;
      least = std::min({least, bond_time_step(sort, 1 / particles.inverse_mass[end]),
                        turning_time_step(sort, particles.inertia[end])});
    }
  }
  return least;
}

}  // namespace lahar::dem
