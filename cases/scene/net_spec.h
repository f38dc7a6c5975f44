#pragma once
// The ring net that a scene describes.
#include "barrier/net.h"
#include "cases/scene/scene.h"

namespace lahar::scene {

/// What the barrier is built from: frame, rings, bonds with stiffness scale and damping, anchors. Cable ends are fixed
/// and have a dissipator next to them, but for a bottom cable that is fixed throughout. Without dissipator stiffnesses
/// the cables have none.
barrier::RingNetSpec make_net_spec(const Scene& scene);

}  // namespace lahar::scene
