#pragma once
// Velocity Verlet as half kick, drift, half kick. Spheres need no orientation: angular velocity is enough, and what
// turns with a particle (bond moments, contact springs) turns in its own law.
#include "dem/particles.h"

namespace lahar::dem {

/// Velocities advance by `dt` (s) under the present forces and torques. Fixed and removed particles keep theirs.
void kick(Particles& particles, double dt);

/// A kick by `kick_dt` (s), then positions advance by `drift_dt` (s) with the new velocities; one pass over the
/// particles.
void kick_and_drift(Particles& particles, double kick_dt, double drift_dt);

}  // namespace lahar::dem
