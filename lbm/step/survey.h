#pragma once
// What the sweeps of all blocks saw in a step, taken together: the fastest cell, how many were limited, whether all is
// finite.
#include "core/archive.h"
#include "lbm/grid/fluid_grid.h"
#include "lbm/step/sweep.h"

namespace lahar::lbm {

/// Extremes and counts over the wet cells of a step, lattice units.
struct Survey {
  double speed = 0;               ///< of the fastest cell as it left; kNotFinite where numbers have gone wrong
  BlockIndex fastest = kNoBlock;  ///< the first block, in their order, that holds such a cell
  std::size_t wet = 0;            ///< cells
  std::size_t held_back = 0;      ///< cells whose speed was limited (collision/cell_state.h)
  std::size_t limited = 0;        ///< cells whose stress was limited (collision/stress_limit.h)
  std::size_t exposed = 0;        ///< interface cells with a bound on their relaxation rate (same place)

  void transfer(Archive& archive) {
    archive.value("speed", speed);
    archive.value("fastest", fastest);
    archive.value("wet", wet);
    archive.value("held_back", held_back);
    archive.value("limited", limited);
    archive.value("exposed", exposed);
  }
};
inline constexpr double kNotFinite = 1e30;

/// `notes` by place in the list of blocks. Does not depend on the number of threads.
Survey survey_of(const std::vector<SweepNote>& notes, const std::vector<BlockIndex>& blocks);

/// The fastest wet cell of a block as it came out of the last step, or the first that is not finite.
template <class Real>
CellPlace fastest_cell(FluidGrid<Real>& grid, BlockIndex b, Parity parity);

extern template CellPlace fastest_cell<float>(FluidGrid<float>&, BlockIndex, Parity);
extern template CellPlace fastest_cell<double>(FluidGrid<double>&, BlockIndex, Parity);

}  // namespace lahar::lbm
