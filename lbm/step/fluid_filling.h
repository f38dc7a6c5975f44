#pragma once
// Which liquid rests at the start.
#include <vector>

#include "lbm/step/fluid_options.h"

namespace lahar::lbm {

/// Of each region whether walls bear it: some of it fills a cell right above a wall, or it touches a region that is
/// borne, bodies by the boxes around them. What is not borne begins in free fall; where z is periodic no liquid is.
std::vector<bool> borne_regions(const Domain& domain, const std::vector<LiquidRegion>& regions);

}  // namespace lahar::lbm
