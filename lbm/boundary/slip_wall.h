#pragma once
// Free slip off walls that lie along the lattice: mirror reflection.
//
// What a cell x sends into the wall along c = (t, -1), t along the wall, comes out again at x' = x + t as (t, +1): the
// flow on the wall is that of a fluid whose mirror image lies behind it. No momentum along the wall changes hands,
// whatever tau is, and the links carry their share (a sixth) of the flux along the wall from cell to cell. Sending them
// back to x instead holds that share back: liquid in the layer at the wall then moves by a sixth less than its velocity
// says (docs/decisions/0013).
//
// Between wet cells the link by way of the wall is thus a link from x to x' through the face between them. An interface
// cell's mass changes over it where x' is liquid; what goes to another interface cell is in the flux between the two
// (free_surface/face_sums.h).
// In a corner (x' is a wall) two mirrors send the population back where it came from. Where x' is gas the link by way
// of the wall ends at the gas, and gets what any link to gas gets (anti-bounce-back at the gas pressure). Which links
// lead where is settled after the conversion of cells, and holds for the coming step. The reflection itself is that of
// rows (row_reflection.h).
#include "lbm/grid/fluid_grid.h"

namespace lahar::lbm {

/// Whether a unit vector with this component along an axis lies along it, either way.
bool is_along_axis(float component);

/// Axis of a wall's normal, -1 if it does not lie along one.
int normal_axis(const WallCell& wall);

/// Whether a wall stands at an angle to the lattice, which cuts it into steps.
inline bool is_in_steps(const WallCell& wall) { return normal_axis(wall) < 0; }

/// Whether liquid slips along a wall in steps, freely or by a wall model, and crosses their faces.
inline bool slips_along_steps(const WallCell& wall) {
  return wall.slip != WallSlip::no_slip && is_in_steps(wall) && !wall.even;
}

/// Whether a wall cell's links are mirrored.
bool is_mirror(const WallCell& wall);

/// Whether a wall is no-slip and at rest: it sends back what it got.
inline bool stands_still(const WallCell& wall) {
  return wall.slip == WallSlip::no_slip && wall.wall_velocity == std::array<float, 3>{0, 0, 0};
}

/// A velocity into a wall, taken apart.
struct MirrorLink {
  int into;      ///< its part across the wall
  int along;     ///< its part along the wall, 0 if it has none
  int mirrored;  ///< into less along: the velocity that its way back has in the mirror
};

/// Velocity i for a wall across an axis.
const MirrorLink& mirror_link(int i, int axis);

/// The populations of one velocity at a cell.
template <class Real>
struct LinkPopulations {
  Real* sent;  ///< f_i that went out
  Real* back;  ///< f_opposite(i) that comes in
};

template <class Real>
LinkPopulations<Real> link_populations(FluidGrid<Real>& grid, CellPlace place, int i, Parity parity) {
  const bool forward = i % 2 == 1;
  const auto pair = grid.access(place, forward ? i : i - 1, parity);
  if (forward) return {pair.outgoing_a, pair.incoming_b};
  return {pair.outgoing_b, pair.incoming_a};
}

/// Before a step: mass of a block's interface cells over mirrored links to liquid.
template <class Real>
void exchange_over_mirrors(FluidGrid<Real>& grid, BlockIndex b, Parity parity);

extern template void exchange_over_mirrors<float>(FluidGrid<float>&, BlockIndex, Parity);
extern template void exchange_over_mirrors<double>(FluidGrid<double>&, BlockIndex, Parity);

}  // namespace lahar::lbm
