#pragma once
// Drag of a liquid that follows a particle within the step of the fluid.
//
// Held over a step of the fluid, a drag would push a bead between stiff bonds in time with its own vibration and shake
// it the more the thicker the liquid is (docs/decisions/0097). So the particle's own steps drag it. The liquid around
// it, of a mass M, follows:
//   m dv/dt = F + D,   M du/dt = M a - D,   D = K s + Y s/(|s| + c),   s = u - v,
// K and Y with values of their own along an axis and across it. A kick (dem/integrator.h) of dt takes off the slip s,
// which a and F drive by d = (a - F/m) dt,
//   (1 - e^-x) s + (1 - (1 - e^-x)/x) d,   x = K dt (1/m + 1/M),
// exact for a constant d, and what the friction stops of the rest: Y leaves its mark as a part of d does, and fades
// with the speed at the end. No kick is too long, no K too large. A body that turns may be dragged so, too, against
// liquid that turns on as it does: T = k (W - w).
#include <span>

#include "dem/particles.h"

namespace lahar::dem {

/// What a drag is along an axis and across it.
struct AlongAndAcross {
  double along = 0, across = 0;
};

/// A liquid_mass, kg, beside which that of any particle is nothing.
inline constexpr double kMovesOn = 1e100;

/// Drag on a particle, and the liquid around it.
struct LiquidDrag {
  ParticleIndex particle = 0;
  Vec3 axis = Vec3::UnitX();            ///< unit
  AlongAndAcross coefficient = {};      ///< K, kg/s
  AlongAndAcross friction = {};         ///< Y, N
  double creep_speed = 0;               ///< c, m/s: the friction fades below
  double liquid_mass = 0;               ///< M, kg, > 0; kMovesOn: u changes by a alone
  Vec3 acceleration = Vec3::Zero();     ///< a, m/s^2: what else changes the liquid's velocity
  Vec3 liquid = Vec3::Zero();           ///< u, m/s: follows
  Vec3 impulse = Vec3::Zero();          ///< N s, that the particle got so far
  double spin_coefficient = 0;          ///< k, kg m^2/s
  Vec3 liquid_spin = Vec3::Zero();      ///< W, rad/s
  Vec3 angular_impulse = Vec3::Zero();  ///< N m s, that the particle got so far
  // Of the steps under way:
  Vec3 force = Vec3::Zero();                   ///< N, contained in Particles::force
  Vec3 torque = Vec3::Zero();                  ///< N m, contained in Particles::torque
  const Rail* rail = nullptr;                  ///< that the particle is on
  Vec3 former_impulse = Vec3::Zero();          ///< N s, when they began
  Vec3 former_angular_impulse = Vec3::Zero();  ///< N m s, when they began
  double noted_kick = 0;                       ///< s, for which what decays was worked out
  AlongAndAcross decay = {};                   ///< share of the slip that K takes off in it,
  AlongAndAcross of_driven = {};               ///< and of what drives the slip
};

/// Before steps under these drags.
void begin_drags(std::span<LiquidDrag> drags, const Particles& particles);

/// Adds the drags of a kick by `kick` (s) to the forces, which are all others: velocities are those before the kick.
/// Returns the work on the particles, J.
double add_drags(std::span<LiquidDrag> drags, Particles& particles, double kick);

/// In place of the drags of the last kick, forces and external forces get the mean over `time` (s), since they began.
void note_mean_drags(std::span<LiquidDrag> drags, Particles& particles, double time);

}  // namespace lahar::dem
