#include "lbm/step/survey.h"

#include <algorithm>
#include <cmath>

#include "lbm/collision/cell_state.h"
#include "lbm/step/cell_moments.h"

namespace lahar::lbm {

Survey survey_of(const std::vector<SweepNote>& notes, const std::vector<BlockIndex>& blocks) {
  Survey all;
  double fastest = 0;
  for (std::size_t k = 0; k < notes.size(); ++k) {
    const SweepNote& note = notes[k];
    all.wet += static_cast<std::size_t>(note.wet);
    all.held_back += static_cast<std::size_t>(note.held_back);
    all.limited += static_cast<std::size_t>(note.limited);
    all.exposed += static_cast<std::size_t>(note.exposed);
    if (note.speed_square <= fastest) continue;
    fastest = note.speed_square;
    all.fastest = blocks[k];
  }
  all.speed = std::isinf(fastest) ? kNotFinite : std::min(std::sqrt(fastest), kLargestSpeed);
  return all;
}

template <class Real>
CellPlace fastest_cell(FluidGrid<Real>& grid, BlockIndex b, Parity parity) {
  CellPlace place{b, 0};
  double fastest = -1;
  for (int n = 0; n < kBlockCells; ++n) {
    if (!is_wet(grid.type({b, n}))) continue;
    const auto m = outgoing_moments(grid, {b, n}, parity);
    const double square = static_cast<double>(m.u[0] * m.u[0] + m.u[1] * m.u[1] + m.u[2] * m.u[2]);
    if (square <= fastest) continue;
    place.cell = n;
    if (!std::isfinite(square)) break;
    fastest = square;
  }
  return place;
}

template CellPlace fastest_cell<float>(FluidGrid<float>&, BlockIndex, Parity);
template CellPlace fastest_cell<double>(FluidGrid<double>&, BlockIndex, Parity);

}  // namespace lahar::lbm
