#pragma once
// A rigid wall or slit barrier, for comparison with a flexible one: boxes that stand across the flow.
#include "cases/scene/findings.h"
#include "cases/scene/scene.h"

namespace lahar::scene {

/// Turns [rigid_barrier] into walls named rigid_barrier_0, rigid_barrier_1, ... from the lowest y up, and switches it
/// off: what follows, and the resolved scene, know walls only. With a fluid, and in place of a net, its upstream face
/// is the measured section where the scene gives none. Finds slits that leave nothing of it.
void build_rigid_barrier(Scene& scene, Findings& findings);

}  // namespace lahar::scene
