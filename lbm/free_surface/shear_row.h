#pragma once
// The viscous stress next to a row of interface cells (surface_shear.h).
#include "lbm/grid/block.h"

namespace lahar::lbm {

/// The liquid next to eight interface cells: means over the liquid neighbours of each, 0 without any.
template <class Real>
struct ShearRow {
  alignas(64) Real stress[6][kBlockWidth];  ///< sigma: xx, yy, zz, xy, xz, yz, lu
  alignas(64) Real way[3][kBlockWidth];     ///< to where that stress is, from the cell's centre
  alignas(64) Real rate[kBlockWidth];       ///< least rate at which it relaxes
};

}  // namespace lahar::lbm
