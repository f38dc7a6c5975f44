#pragma once
// The net, and the posts beside it, that a scene describes.
#include "barrier/spans.h"
#include "cases/scene/scene.h"

namespace lahar::scene {

/// What a net is built from, with posts that of the first span: frame, rings or mesh, bonds with stiffness scale and
/// damping, anchors. Cable ends are fixed and have a dissipator next to them, but for a bottom cable that is fixed
/// throughout. Without dissipator stiffnesses the cables have none. The normal points down the flow, along +x,
/// whichever way the width runs.
barrier::RingNetSpec make_net_spec(const Scene& scene);

/// The same with posts, which the scene must have.
barrier::SpansSpec make_spans_spec(const Scene& scene);

/// Builds the whole barrier. Throws InputError as build_net and build_spans do.
barrier::Net build_barrier(const Scene& scene, dem::Particles& particles, dem::Bonds& bonds);

}  // namespace lahar::scene
