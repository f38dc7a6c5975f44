#include "dem/time_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/sphere.h"

namespace lahar::dem {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Explicit damping lowers the limit of an oscillator of ratio e by sqrt(1 + e^2) - e. A bond of ratio d is damped for
/// the two masses at its ends; in the fastest motion of a chain four times its damper stands against one mass and four
/// times its stiffness, so that e = sqrt(2) d there.
double lowered_by(double d) {
  const double e = std::numbers::sqrt2 * d;
  return std::sqrt(1 + e * e) - e;
}

/// The stiffest branch that a force can reach, N/m^3.
double stiffest_branch(const AxialLaw& law) {
  double stiffest = law.stiffness[0];
  for (std::size_t branch = 0; branch < 2; ++branch)
    if (std::isfinite(law.force_limit[branch])) stiffest = std::max(stiffest, law.stiffness[branch + 1]);
  return stiffest;
}

/// Against a shift of one end, along the bond or across, N/m^3.
double stiffest_shift(const BondSort& sort) { return std::max(stiffest_branch(sort.axial), sort.shear_stiffness); }

/// What holds a bead, summed over its bonds: against a shift, N/m, against turning by the shear of bonds times their
/// levers, and by their bending and torsion, N m/rad. The highest frequency of a bead's neighbourhood is below
/// sqrt(sum / inertia) when a bond counts twice whose other end is free as well (Gershgorin; exact for a long chain).
struct BeadStiffness {
  double shift = 0, shear = 0, bending = 0, damping = 0;

  /// Adds a bond `count` times whose shear acts with the lever `lever` (m): half of the bond's length.
  void add(const BondSort& sort, double lever, double count) {
    const double area = std::numbers::pi * sort.bond_radius * sort.bond_radius;
    const double second_moment = 0.25 * area * sort.bond_radius * sort.bond_radius;
    shift += count * stiffest_shift(sort) * area;
    shear += count * sort.shear_stiffness * area * lever * lever;
    bending += count * std::max(sort.axial.stiffness[0], 2 * sort.shear_stiffness) * second_moment;
    damping = std::max(damping, sort.damping_ratio);
  }
  void at_least(const BeadStiffness& other) {
    shift = std::max(shift, other.shift), shear = std::max(shear, other.shear);
    bending = std::max(bending, other.bending);
  }
  [[nodiscard]] double time_step(double mass, double inertia) const {
    const double squared = std::max(shift / mass, std::max(shear, bending) / inertia);  // 1/s^2
    return squared > 0 ? 2 / std::sqrt(squared) * lowered_by(damping) : kInfinity;
  }
};

}  // namespace

double rayleigh_time_step(double radius, double density, const Material& material) {
  const double nu = material.poisson_ratio, shear_modulus = material.youngs_modulus / (2 * (1 + nu));
  return std::numbers::pi * radius * std::sqrt(density / shear_modulus) / (0.1631 * nu + 0.8766);
}

double rayleigh_time_step(const Particles& particles, const Materials& materials) {
  double least = kInfinity;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (particles.state[i] == ParticleState::removed) continue;
    const double r = particles.radius[i], density = particles.mass[i] / sphere_volume(r);
    least = std::min(least, rayleigh_time_step(r, density, materials[particles.material[i]]));
  }
  return least;
}

double linear_contact_time(double effective_mass, double stiffness) {
  return std::numbers::pi * std::sqrt(effective_mass / stiffness);
}

double bond_time_step(const BondSort& sort, double mass, double inertia_scale) {
  const double area = std::numbers::pi * sort.bond_radius * sort.bond_radius, shifted = stiffest_shift(sort);
  const double translation = shifted > 0 ? std::sqrt(mass / (shifted * area)) : kInfinity;
  const double rotation =
      sort.shear_stiffness > 0 ? std::sqrt(inertia_scale * 0.4 * mass / (sort.shear_stiffness * area)) : kInfinity;
  return std::min(translation, rotation) * lowered_by(sort.damping_ratio);
}

double bond_time_step(const Bonds& bonds, const Particles& particles) {
  // A bead is never taken as held less than one in the middle of a chain of its stiffest bond, at rest: there a bond
  // counts four times, two bonds with both ends free.
  std::vector<BeadStiffness> now(particles.size()), at_rest(particles.size());
  for (std::size_t b = 0; b < bonds.size(); ++b) {
    if (!bonds.intact[b]) continue;
    const BondSort& sort = bonds.sorts[static_cast<std::size_t>(bonds.sort[b])];
    const ParticleIndex i = bonds.i[b], j = bonds.j[b];
    const double length = (particles.position[j] - particles.position[i]).norm();
    const double both = particles.inverse_mass[i] > 0 && particles.inverse_mass[j] > 0 ? 2 : 1;
    BeadStiffness in_chain;
    in_chain.add(sort, 0.5 * bonds.rest_length[b], 4);
    for (const ParticleIndex end : {i, j}) {
      now[end].add(sort, 0.5 * length, both);
      at_rest[end].at_least(in_chain);
    }
  }
  double least = kInfinity;
  for (std::size_t p = 0; p < particles.size(); ++p) {
    if (particles.inverse_mass[p] == 0) continue;
    now[p].at_least(at_rest[p]);
    least = std::min(least, now[p].time_step(1 / particles.inverse_mass[p], particles.inertia[p]));
  }
  return least;
}

}  // namespace lahar::dem
