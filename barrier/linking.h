#pragma once
// Gauss linking number: how often one closed curve winds around another. It is an integer that no motion without
// passing through can change.
#include "barrier/polyline.h"

namespace lahar::barrier {

/// Linking number of two closed polylines that do not touch. Exact up to rounding (integers within about 1e-12): the
/// directions between the points of two segments cover a spherical quadrilateral, whose signed area is taken as two
/// triangles (Van Oosterom & Strackee 1983, IEEE Trans. Biomed. Eng. 30, Eq. 8), and all areas sum to 4 pi times the
/// number (Banchoff 1976, Indiana Univ. Math. J. 25; Klenin & Langowski 2000, Biopolymers 54).
[[nodiscard]] double linking_number(const Polyline& a, const Polyline& b);

/// linking_number rounded to the integer. Throws std::logic_error if it is not one within 1e-3: the curves touch.
[[nodiscard]] int links(const Polyline& a, const Polyline& b);

/// Linking number of a closed ring with an open thread whose ends are held: the thread is closed by straight lines on
/// from its ends, away from the middle, to a far loop. Counts as long as no ring comes behind the anchors.
[[nodiscard]] int links_with_thread(const Polyline& ring, const Polyline& thread);

/// The thread as a closed polyline that goes on straight from both ends to `reach` metres and closes there, on the side
/// given by `around` (any direction across the thread).
[[nodiscard]] Polyline closed_far_away(const Polyline& thread, double reach, const Vec3& around);

}  // namespace lahar::barrier
