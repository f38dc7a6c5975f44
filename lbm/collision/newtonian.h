#pragma once
// What a collision asks of the viscosity: the rate at which the viscous moments relax. A model is a small struct with
//   constant              whether the rate is the same in all cells, known before the collision
//   flow_law              whether it takes SweepParameters::rheology
//   rate(S, 1/rho)        the rate of a cell from its second central moments; rate() where it is constant
//   of(parameters)        the model of a sweep (lbm/step/sweep.h)
// Models: Newtonian, Smagorinsky (smagorinsky.h), Bingham and HerschelBulkley (lbm/rheology). The sweep is compiled
// once per model, so that none pays for another.
#include "lbm/collision/cell_state.h"

namespace lahar::lbm {

template <class V>
struct Newtonian {
  static constexpr bool constant = true, flow_law = false;
  V tau;

  template <class Parameters>
  static Newtonian of(const Parameters& p) {
    return {number<V>(p.tau)};
  }
  V rate() const { return V(1) / tau; }
};

/// The rate of a cell with these second central moments, whether it depends on them or not.
template <class Viscosity, class V>
[[gnu::always_inline]] inline V rate_of(const Viscosity& viscosity, const Symmetric<V>& s, const V& inverse_density) {
  if constexpr (Viscosity::constant)
    return viscosity.rate();
  else
    return viscosity.rate(s, inverse_density);
}

}  // namespace lahar::lbm
