#pragma once
// Velocity Verlet as half kick, drift, half kick. Spheres need no orientation: angular velocity is enough, and what
// turns with a particle (bond moments, contact springs) turns in its own law.
#include "dem/particles.h"

namespace lahar::dem {

/// Velocities advance by `dt` (s) under the present forces and torques. Fixed and removed particles keep theirs.
void kick(Particles& particles, double dt);

/// Positions advance by `dt` (s) with the present velocities.
void drift(Particles& particles, double dt);

}  // namespace lahar::dem
