#pragma once
// Limits on the particle time step.
#include "dem/bonds/bonds.h"
#include "dem/material.h"
#include "dem/particles.h"

namespace lahar::dem {

/// Time that a Rayleigh wave takes around a sphere, s: pi R sqrt(rho / G) / (0.1631 nu + 0.8766)
/// (Thornton & Randall 1988; Li, Xu & Thornton 2005, Powder Technol. 160:219). Radius in m, density in kg/m^3. Contact
/// needs a time step of 0.1 to 0.3 of it, however strong its dampers (contact/normal_damper.h).
double rayleigh_time_step(double radius, double density, const Material& material);

/// The smallest Rayleigh time of all particles that are not removed, s; infinity if there are none.
double rayleigh_time_step(const Particles& particles, const Materials& materials);

/// Half a period of a linear contact, s: pi sqrt(m* / k). Effective mass in kg, stiffness in N/m.
double linear_contact_time(double effective_mass, double stiffness);

/// Limit of one bond between equal spheres of `mass` (kg), whose moment of inertia is `inertia_scale` times 0.4 m r^2,
/// s: the smaller of sqrt(m / K) for translation, K the larger of K_n and K_s, and sqrt(inertia_scale 0.4 m / K_s) for
/// rotation, K_n and K_s = stiffness per area x pi (bond radius)^2. Unbounded axial stiffening is covered: K_n uses the
/// stiffest branch. A damping ratio d lowers the limit by sqrt(1 + 2 d^2) - sqrt(2) d.
double bond_time_step(const BondSort& sort, double mass, double inertia_scale = 1);

/// The smallest limit of all free particles, s, each with all its intact bonds as long as they are now: in translation,
/// in rotation by shear (whose lever is half of the bond's length, so a dissipator that is drawn out lowers the limit)
/// and by bending and torsion (which bind where a bond is thicker than its beads). Infinity without bonds.
double bond_time_step(const Bonds& bonds, const Particles& particles);

}  // namespace lahar::dem
