#pragma once
// The barrier hangs before the flow comes.
#include "barrier/net.h"
#include "cases/scene/scene.h"
#include "dem/bonds/bonds.h"
#include "dem/particles.h"

namespace lahar::cases {

/// The scene in which the barrier settles: without grains and fluid, with the beads' own mass.
scene::Scene barrier_alone(scene::Scene scene);

/// Moves the beads of a barrier that was just built, and loads its bonds, as they hang under gravity after
/// scene.barrier.settle_time: without grains and water, at rest. Whenever the kinetic energy of the barrier passes a
/// peak all motion is stopped, which ends near equilibrium without a drag to be chosen (kinetic damping; Barnes 1999,
/// Int. J. Space Structures 14:89). Springs of contacts are not handed over: contacts begin without tangential force,
/// and what friction held may move a little. Throws NumericalFailure where rings go through each other as they settle.
void settle_barrier(const scene::Scene& scene, const barrier::Net& net, dem::Particles& particles, dem::Bonds& bonds);

}  // namespace lahar::cases
