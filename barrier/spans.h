#pragma once
// A barrier of several spans: ring nets of one size side by side in a line, posts between them and at both ends,
// what else hangs on the posts (elements.h).
//
// Each span is a net of its own in its four cables. What a single net fixes is tied to the posts here: the ends of the
// upper and lower cables to the posts at their sides, every fixed place of a lateral cable to the post that it runs
// along. A tie is a link (link.h) from a bead of the cable to the nearest bead of the post, as stiff as a bond of the
// cable: a shackle. Cables do not run through the heads (decision 0027).
#include "barrier/elements.h"
#include "barrier/net.h"

namespace lahar::barrier {

struct SpansSpec {
  RingNetSpec net;  ///< the first span; its frame's lower left corner is net.origin
  int spans = 1;
  double post_height = 0;    ///< m, top of the posts above the net's lower edge
  double post_diameter = 0;  ///< m
  PostSection section;
  FootJoint foot = FootJoint::fixed;
  Elements elements;
};

/// Room between the side of a frame and the surface of the post beside it, m.
[[nodiscard]] double post_clearance(const RingNetSpec& net);
/// Distance between the axes of neighbouring posts, m.
[[nodiscard]] double post_distance(const SpansSpec& spec);
/// Where post k (0 .. spans) stands on the line of the net's lower edge, m.
[[nodiscard]] Vec3 post_base(const SpansSpec& spec, int k);
/// The post without its place among the others, held at its base, where the centre of its first bead is; its last bead
/// ends at the post height.
[[nodiscard]] PostSpec post_spec(const SpansSpec& spec, int k);

/// Builds all at rest and free of stress. Throws InputError for what build_net, add_post and the elements refuse, for
/// posts lower than the net, and for upper and lower cables fixed nearer to an end than a wire's diameter.
Net build_spans(const SpansSpec& spec, dem::Particles& particles, dem::Bonds& bonds);

}  // namespace lahar::barrier
