#pragma once
// Moves the beads of some wires until all wires have room, by position-based dynamics (Mueller et al. 2007, J. Vis.
// Commun. Image Represent. 18): geometric constraints are met one after the other, again and again. No wire passes
// through another as long as none moves by more than its diameter in one pass.
#include <vector>

#include "barrier/polyline.h"

namespace lahar::barrier {

struct SettleOptions {
  double spacing = 0;         ///< m, wanted between neighbouring beads of the movable wires
  double second_spacing = 0;  ///< m, wanted between second neighbours: evens out the curvature
  double apart = 0;           ///< m, wanted between centre-lines of different wires
  int passes = 1200;          ///< two thirds to bring the present spacing slowly to the wanted one; the last fifth
                              ///< without regard to curvature
};

/// Settles the movable wires among the others. Deterministic. The caller checks what was reached.
void settle(std::vector<Polyline>& wires, const std::vector<bool>& movable, const SettleOptions& options);

}  // namespace lahar::barrier
