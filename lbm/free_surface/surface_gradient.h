#pragma once
// The gradient of pressure at the surface, from the densities around an interface cell. It stands for the effective
// gravity g - Du/Dt: it is g in water at rest and 0 in free fall, and it is normal to the surface.
#include "lbm/cell_moments.h"
#include "lbm/fluid_grid.h"

namespace lahar::lbm {

/// rho - 1 of a wet cell: of the last sweep where the block holds it, else from the populations.
template <class Real>
Real wet_density(FluidGrid<Real>& grid, CellPlace place, Parity parity) {
  const Block<Real>& block = grid.block(place.block);
  return block.surface ? block.surface->density[place.cell] : outgoing_moments(grid, place, parity).drho;
}

/// Solves M x = b for a symmetric positive M = (xx, yy, zz, xy, xz, yz).
template <class Real>
void solve_symmetric(const Real (&m)[6], const Real (&b)[3], Real (&x)[3]) {
  const Real l10 = m[3] / m[0], l20 = m[4] / m[0];
  const Real d1 = m[1] - l10 * m[3], e21 = m[5] - l20 * m[3], l21 = e21 / d1;
  const Real d2 = m[2] - l20 * m[4] - l21 * e21;
  const Real y1 = b[1] - l10 * b[0], y2 = b[2] - l20 * b[0] - l21 * y1;
  x[2] = y2 / d2;
  x[1] = y1 / d1 - l21 * x[2];
  x[0] = b[0] / m[0] - l10 * x[1] - l20 * x[2];
}

/// grad p / rho, lu, by weighted least squares over the wet cells two links away (one where the second is not wet):
///   sum_i w_i c_i (c_i . a - (rho_far - rho_here) / (3 n_i)) = 0,  n_i = 1 or 2,
/// exact where the pressure is linear. Two links, because a sound wave of two cells, which differences over one link
/// see best, is then not seen at all: the surface fed such waves until they drowned a gravity wave
/// (docs/decisions/0007).
template <class Real>
void pressure_gradient(FluidGrid<Real>& grid, CellPlace place, Parity parity, Real (&a)[3]) {
  constexpr Real kNoSlope = Real(1e-6);  // in directions without wet cells the gradient is 0
  const Real here = wet_density(grid, place, parity);
  Real m[6] = {kNoSlope, kNoSlope, kNoSlope, 0, 0, 0}, b[3] = {0, 0, 0};
  for (int i = 1; i < D3Q19::q; ++i) {
    const CellPlace near = grid.neighbour(place, i);
    if (!is_wet(grid.type(near))) continue;
    const CellPlace far = grid.neighbour(near, i);
    const bool twice = is_wet(grid.type(far));
    const Real difference = wet_density(grid, twice ? far : near, parity) - here;
    const Real w = static_cast<Real>(D3Q19::w(i)), slope = difference / Real(twice ? 6 : 3);
    const Real c[3] = {static_cast<Real>(D3Q19::c[i][0]), static_cast<Real>(D3Q19::c[i][1]),
                       static_cast<Real>(D3Q19::c[i][2])};
    for (int k = 0; k < 3; ++k) {
      b[k] += w * c[k] * slope;
      m[k] += w * c[k] * c[k];
    }
    m[3] += w * c[0] * c[1];
    m[4] += w * c[0] * c[2];
    m[5] += w * c[1] * c[2];
  }
  solve_symmetric(m, b, a);
}

}  // namespace lahar::lbm
