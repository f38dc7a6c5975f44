#pragma once
// Two local bounds on the viscous stress of a collision with central moments (BGK and TRT are left as their authors
// made them). They act where the surface breaks up and the flow is not resolved; at tau -> 1/2 nothing else takes out
// energy.
//
// Largest strain rate: the stress that a collision hands on is at most that of a strain rate |D| = sqrt(D_ab D_ab) of
// 0.09 per step. A shear flow reaches this at a velocity difference of 0.13 lu from one cell to the next, more than the
// fastest flow that a time step is chosen for: a resolved flow never meets the bound. In kind a limiter of
// non-equilibrium (Brownlee, Gorban & Levesley 2008), with the stress as its measure. Such cells are counted
// (LiquidAccount::limited).
//
// Largest relaxation rate: interface cells with gas on half of their links or more relax with omega <= 1, a viscosity
// of at least 1/6. Over a link to gas anti-bounce-back turns the sign of the stress, and at omega = 2 the collision
// turns it back: in a cell with gas on most sides the stress is undamped and feeds on the motion (a falling drop of 8
// cells reached three times the speed of free fall). Counted too (LiquidAccount::exposed).
// In interface cells less than half full, whose centre lies in the gas, the same sets still water in motion where the
// surface stays in a cell that lies on a layer of liquid: omega <= 2 - (1/2 - F)^2 (1 - |dF| / 0.001), F the fill level
// and dF what a step adds to it, but not in bodies; a viscosity of 0.024 at most (docs/decisions/0102).
#include <algorithm>

#include "lbm/collision/cell_state.h"
#include "lbm/rheology/rheology.h"

namespace lahar::lbm {

inline constexpr double kLargestStrain = 0.09;      ///< lu, strain rate whose stress is handed on in full
inline constexpr double kLargestRate = 2.0;         ///< omega without viscosity: no bound
inline constexpr double kLargestExposedRate = 1.0;  ///< omega in cells with gas on half of their links
inline constexpr double kCalmGain = 0.001;          ///< of a cell, that comes or goes in a step where the surface moves
inline constexpr double kRateLostBelow = 1.0;       ///< of omega, per square of the cells that the surface lies low

/// |S| / rho of the largest strain rate: |S| = 2/3 rho tau |D|.
inline double stress_limit(double tau) { return 2.0 / 3.0 * tau * kLargestStrain; }

/// The same for a flow law: |S| / rho = sqrt(2)/3 tau g at the largest shear rate g = sqrt(2) |D|.
inline double stress_limit(const RheologyParameters& p) {
  return std::sqrt(2.0) / 3 * loading(p, std::sqrt(2.0) * kLargestStrain);
}

/// Share of a stress S (the deviator of the second central moments) that may be handed on.
template <class V>
[[gnu::always_inline]] inline V limited_stress_share(const Symmetric<V>& s, const V& inverse_density, const V& limit) {
  return limit / max(limit, V(sqrt(square(s)) * inverse_density));
}

}  // namespace lahar::lbm
