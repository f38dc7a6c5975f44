#pragma once
// Free slip off walls that lie along the lattice: mirror reflection.
//
// What a cell x sends into the wall along c = (t, -1), t along the wall, comes out again at x' = x + t as (t, +1): the
// flow on the wall is that of a fluid whose mirror image lies behind it. No momentum along the wall changes hands,
// whatever tau is, and the links carry their share (a sixth) of the flux along the wall from cell to cell. Sending them
// back to x instead holds that share back: liquid in the layer at the wall then moves by a sixth less than its velocity
// says (docs/decisions/0013).
//
// Between wet cells the link by way of the wall is thus a link from x to x', and an interface cell's mass changes over
// it as over any other (free_surface/surface_exchange.h):
//   dm = k (f_opposite(c) coming in - f_c that went out), k by the types of x and x'.
// In a corner (x' is a wall) two mirrors send the population back where it came from. Where x' is gas the link by way
// of the wall ends at the gas, and gets what any link to gas gets (anti-bounce-back at the gas pressure). Which links
// lead where is settled after the conversion of cells, and holds for the coming step.
#include "lbm/fluid_grid.h"

namespace lahar::lbm {

/// Whether a wall cell's links are mirrored.
bool is_mirror(const WallCell& wall);

/// Sets what comes back to a wet cell from a mirror, and notes the links that lead to another cell.
template <class Real>
void mirror(FluidGrid<Real>& grid, CellPlace place, WallCell& wall, const std::uint8_t* links, Parity parity);

/// Before a step: mass of a block's interface cells over mirrored links.
template <class Real>
void exchange_over_mirrors(FluidGrid<Real>& grid, BlockIndex b, Parity parity);

extern template void mirror<float>(FluidGrid<float>&, CellPlace, WallCell&, const std::uint8_t*, Parity);
extern template void mirror<double>(FluidGrid<double>&, CellPlace, WallCell&, const std::uint8_t*, Parity);
extern template void exchange_over_mirrors<float>(FluidGrid<float>&, BlockIndex, Parity);
extern template void exchange_over_mirrors<double>(FluidGrid<double>&, BlockIndex, Parity);

}  // namespace lahar::lbm
