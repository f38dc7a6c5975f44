#pragma once
// Blocks of one cell size, what they are computed with, and in which units: all that a pass over a level needs.
#include "core/units.h"
#include "lbm/grid/fluid_grid.h"
#include "lbm/step/sweep.h"

namespace lahar::lbm {

template <class Real>
struct FluidLevel {
  FluidGrid<Real> grid;
  LatticeUnits units;
  SweepParameters parameters;

  /// Of the coming sweep.
  [[nodiscard]] Parity parity() const { return parameters.parity; }
};

}  // namespace lahar::lbm
