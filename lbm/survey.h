#pragma once
// A look at every wet cell: the fastest, the strongest pressure, and whether all is finite.
#include "lbm/fluid_grid.h"

namespace lahar::lbm {

/// Extremes over the wet cells as they came out of the last step, lattice units.
struct Survey {
  double speed = 0;         ///< of the fastest cell; kNotFinite where numbers have gone wrong
  CellPlace fastest;        ///< the first such cell in the order of blocks and cells
  double compression = 0;   ///< largest |rho - 1|
  std::size_t limited = 0;  ///< cells at the largest speed of a collision (collision/cell_state.h)
  std::size_t wet = 0;
};
inline constexpr double kNotFinite = 1e30;

/// Does not depend on the number of threads.
template <class Real>
Survey survey_cells(const FluidGrid<Real>& grid, Parity parity);

extern template Survey survey_cells<float>(const FluidGrid<float>&, Parity);
extern template Survey survey_cells<double>(const FluidGrid<double>&, Parity);

}  // namespace lahar::lbm
