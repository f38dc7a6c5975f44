#pragma once
// A net of hexagonal mesh in its four cables: the counterpart of the ring net, with the same frame, cables, anchors and
// dissipators.
#include "barrier/net.h"

namespace lahar::barrier {

/// Fills the frame of a spec with spec.mesh: as many whole meshes as fit, stretched in either direction by up to 8 %
/// (as the pitch of rings is). Cables run along the frame, each node of the panel's edge is tied by a link to the
/// nearest bead of the cable beside it, as stiff as a bond of the cable. Throws InputError for a frame that no whole
/// meshes fill, with sizes that do, and for what add_hexagonal_mesh refuses.
Net build_mesh_net(const RingNetSpec& spec, dem::Particles& particles, dem::Bonds& bonds);

}  // namespace lahar::barrier
