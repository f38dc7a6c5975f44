#pragma once
// The viscous stress at the surface: of second order in its place.
//
// With anti-bounce-back (surface_exchange.h) what crosses a link to the gas adds up, in steady flow, to
//   f_i out + f_opposite(i) in = 2 f_i^eq+ + (2 - 1/tau) f_i^neq+ = 2 f_i^eq+ - 9 w_i (c_i c_i - I/3) : sigma,
// the parts even in c at the link's middle; sigma = -(1 - 1/(2 tau)) S is the viscous stress and S the
// deviator of the second central moments (Ginzburg, Verhaeghe & d'Humieres 2008, Commun. Comput. Phys. 3, 427 for such
// closures). The rule that sets the sum to 2 f_i^eq+ thus makes the shear stress vanish half a link out, wherever the
// surface lies. It has to vanish on the surface; along the normal n it is linear there, so that at the middle of a link
//   t(middle) = t(inside) depth(middle) / depth(inside),   t = sigma n - n (n sigma n),
// depths under the surface, negative outside, and the missing population gets
//   -9 w_i c_i c_i : (n t + t n) = -18 w_i (c_i . n) (c_i . t(middle)).
// Normal and in-plane stresses stay as the rule has them. The stress inside is the mean over the liquid neighbours of
// the cell, from what is about to collide there: exact for any flow law, at least half a cell deep, so that nothing is
// divided by a small number. Without liquid neighbours (spray, films of one cell) t is 0: the plain rule.
//
// The ratio of depths is bounded by 1 inside the liquid, where the stress is no more than the measured one, and outside
// by 2, which it has where a cell is all but empty over a level liquid; either way by 4/tau: what the surface cell gets
// of the stress comes back to it through the stress. By the eigenvalues of a layer of 8
// cells that is stable up to a ratio of 10 or more for tau from 0.5 to 1, 2.9 at tau = 2, 1.15 at 4, 0.32 at 18.5
// (docs/decisions/0042).
#include <algorithm>
#include <vector>

#include "lbm/collision/cell_state.h"
#include "lbm/free_surface/shear_row.h"
#include "lbm/grid/fluid_grid.h"
#include "lbm/step/sweep.h"

namespace lahar::lbm {

/// tau - 1/2 from which on the stress is looked for: below it the layer of a wave of a thousand steps or so is thinner
/// than half a cell, and what the surface stress does is not resolved.
inline constexpr double kLeastViscousTau = 1e-3;

/// Whether the viscous stress at the surface counts in a run; always with a flow law of mud.
inline bool feels_surface_shear(const SweepParameters& p) {
  return p.rheology.law != FlowLaw::newtonian || p.tau - 0.5 >= kLeastViscousTau;
}

/// One entry per row with interface cells, in the order of the rows. Reads populations that come into liquid cells,
/// which an exchange over the surface does not write, and those of others in rows with them: to be called for all
/// blocks before the exchange of the first.
template <class Real>
void measure_shear(const FluidGrid<Real>& grid, BlockIndex b, const SweepParameters& p,
                   std::vector<ShearRow<Real>>& rows);

extern template void measure_shear<float>(const FluidGrid<float>&, BlockIndex, const SweepParameters&,
                                          std::vector<ShearRow<float>>&);
extern template void measure_shear<double>(const FluidGrid<double>&, BlockIndex, const SweepParameters&,
                                           std::vector<ShearRow<double>>&);

/// The shear traction under the surface of eight interface cells.
template <class V>
struct SurfaceTraction {
  V normal[3];      ///< unit, into the liquid
  V inside[3];      ///< t(inside), lu
  V depth;          ///< of the cells' centres
  V inverse_depth;  ///< 1 / depth(inside)
  V largest;        ///< bound on the ratio of depths

  /// What a missing population gets that would come from the gas along -c, or along c from the other side (`sign` -1).
  template <int CX, int CY, int CZ>
  [[gnu::always_inline]] V missing(double weight, double sign) const {
    const V cx = number<V>(CX), cy = number<V>(CY), cz = number<V>(CZ);
    const V down = cx * normal[0] + cy * normal[1] + cz * normal[2];
    const V along = cx * inside[0] + cy * inside[1] + cz * inside[2];
    const V lever = (depth + number<V>(0.5 * sign) * down) * inverse_depth;
    const V bounded = min(max(lever, V(-largest)), V(min(largest, V(1))));
    return number<V>(-18 * weight) * bounded * down * along;
  }
};

/// From the stress inside, its place and its relaxation rate, the gradient of pressure `a` and a . (centre - surface)
/// (surface_exchange.h). The normal is that of a: t fades where a is less than a tenth of gravity and turns with the
/// noise (free fall). `gravity`: lu.
template <class V>
[[gnu::always_inline]] inline SurfaceTraction<V> surface_traction(const Symmetric<V>& s, const V (&way)[3],
                                                                  const V& rate, const V (&a)[3], const V& depth,
                                                                  const V& gravity) {
  const V size = max(V(sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])), number<V>(1e-18));
  const V inverse = V(1) / size, fade = min(V(number<V>(10) * size / gravity), V(1));
  SurfaceTraction<V> t;
  for (int k = 0; k < 3; ++k) t.normal[k] = a[k] * inverse;
  const V(&n)[3] = t.normal;
  const V pull[3] = {s.xx * n[0] + s.xy * n[1] + s.xz * n[2], s.xy * n[0] + s.yy * n[1] + s.yz * n[2],
                     s.xz * n[0] + s.yz * n[1] + s.zz * n[2]};
  const V across = pull[0] * n[0] + pull[1] * n[1] + pull[2] * n[2];
  for (int k = 0; k < 3; ++k) t.inside[k] = fade * (pull[k] - across * n[k]);
  t.depth = depth * inverse;
  const V there = t.depth + way[0] * n[0] + way[1] * n[1] + way[2] * n[2];
  t.inverse_depth = V(1) / max(there, number<V>(0.5));
  t.largest = min(number<V>(2), V(number<V>(4) * rate));
  return t;
}

}  // namespace lahar::lbm
