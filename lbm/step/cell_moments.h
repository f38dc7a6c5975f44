#pragma once
// Density and velocity of a cell between steps, from what it sent out in the last one (post-collision, forces
// included) or from what comes in.
#include <utility>

#include "lbm/grid/fluid_grid.h"

namespace lahar::lbm {

template <class Real>
struct CellMoments {
  Real drho = 0;          ///< rho - 1
  Real u[3] = {0, 0, 0};  ///< lu
};

/// Of the populations that `both` picks from each pair; the cell's neighbours must exist (they do for wet cells).
template <class Real, class Both>
CellMoments<Real> moments_of_pairs(FluidGrid<Real>& grid, CellPlace place, Parity parity, const Both& both) {
  Real drho = grid.block(place.block).f(0)[place.cell];
  Real j[3] = {0, 0, 0};
  for (int a = 1; a < D3Q19::q; a += 2) {
    const auto [fa, fb] = both(grid.access(place, a, parity));
    drho += fa + fb;
    for (int k = 0; k < 3; ++k) j[k] += static_cast<Real>(D3Q19::c[a][k]) * (fa - fb);
  }
  const Real inverse = Real(1) / (Real(1) + drho);
  return {drho, {j[0] * inverse, j[1] * inverse, j[2] * inverse}};
}

template <class Real>
CellMoments<Real> outgoing_moments(FluidGrid<Real>& grid, CellPlace place, Parity parity) {
  return moments_of_pairs(grid, place, parity,
                          [](const auto& pair) { return std::pair(*pair.outgoing_a, *pair.outgoing_b); });
}

/// Of what is on its way to the cell, the coming force not included.
template <class Real>
CellMoments<Real> incoming_moments(FluidGrid<Real>& grid, CellPlace place, Parity parity) {
  return moments_of_pairs(grid, place, parity,
                          [](const auto& pair) { return std::pair(*pair.incoming_a, *pair.incoming_b); });
}

}  // namespace lahar::lbm
