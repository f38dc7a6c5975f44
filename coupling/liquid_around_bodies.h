#pragma once
// Liquid at the start, where bodies stand out of it.
#include <vector>

#include "dem/particles.h"
#include "lbm/step/fluid.h"

namespace lahar::coupling {

/// Liquid was filled as if no body stood in it, and bodies were written into the cells. The mass of an interface cell
/// includes its bodies' share, also of what stands out of the liquid (docs/decisions/0003): that part is added. Of
/// grains it is counted at points within them, in no region; of wires, and at periodic faces, it is what of the cell is
/// not filled. Cells that a body covers are whole already.
template <class Real>
void add_bodies_out_of_liquid(lbm::FluidGrid<Real>& grid, const dem::Particles& particles,
                              const std::vector<lbm::LiquidRegion>& regions);

extern template void add_bodies_out_of_liquid<float>(lbm::FluidGrid<float>&, const dem::Particles&,
                                                     const std::vector<lbm::LiquidRegion>&);
extern template void add_bodies_out_of_liquid<double>(lbm::FluidGrid<double>&, const dem::Particles&,
                                                      const std::vector<lbm::LiquidRegion>&);

}  // namespace lahar::coupling
