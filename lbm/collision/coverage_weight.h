#pragma once
// How much of a collision the bodies of a cell take over, B, from the drag that was written into it:
//   B = min(largest, alpha g / (gamma + beta g)),   g = min(drag, cap).
// All weightings have this form (docs/coupling.md, docs/decisions/0020):
//   solid_fraction      g = eps   B = eps
//   noble_torczynski    g = eps   B = eps t / ((1 - eps) + t), t = tau - 1/2
//   wall_distance       g = h     k = nu h is the drag that the cell needs, B = k / (1 + k/2): with the velocity
//                                 half-way through the step, (u + u')/2, the exchange is then k times the slip exactly
#include <algorithm>

#include "core/simd_math.h"

namespace lahar::lbm {

/// How the coverage weight B follows from the bodies in a cell.
enum class BodyWeighting {
  solid_fraction,    ///< B = eps
  noble_torczynski,  ///< B = eps (tau - 1/2) / ((1 - eps) + (tau - 1/2)), Noble & Torczynski 1998
  wall_distance,     ///< from the distance of the cell's centre to the surface (coupling/grains/wall_drag.h)
};

/// What B puts in place of the fluid's collision (numbering of Rettinger & Rude 2017).
enum class SolidOperator {
  damped_nonequilibrium,       ///< equilibrium at u_s, the non-equilibrium part is damped by 1 - B
  equilibrium_difference,      ///< f_eq(u_s) - f_eq(u) on top of the fluid's own collision: SC2
  nonequilibrium_bounce_back,  ///< bounce-back of the non-equilibrium part, Noble & Torczynski 1998: SC1
  wall_velocity_bounce_back,   ///< bounce-back at the wall's velocity, Holdych 2003: SC3
};

/// The defaults of the library and of scenes (docs/decisions/0020).
inline constexpr BodyWeighting kBodyWeighting = BodyWeighting::wall_distance;
inline constexpr SolidOperator kSolidOperator = SolidOperator::equilibrium_difference;

inline bool bounces_back(SolidOperator s) {
  return s == SolidOperator::nonequilibrium_bounce_back || s == SolidOperator::wall_velocity_bounce_back;
}

struct CoverageWeightLaw {
  double alpha = 1, beta = 0, gamma = 1, cap = 1, largest = 1;
};

inline CoverageWeightLaw coverage_weight_law(BodyWeighting weighting, double tau) {
  switch (weighting) {
    case BodyWeighting::noble_torczynski: {
      const double r = 1 / (tau - 0.5);
      return {1, -r, 1 + r, 1, 1};
    }
    case BodyWeighting::wall_distance: {
      // In a covered cell B = 2 would be bounce-back: no slip exactly half-way through the step, but undamped. B = 1
      // leaves a slip of the order of nu/2, so it may stay at 1 where the viscosity is small.
      const double nu = (tau - 0.5) / 3;
      return {nu, nu / 2, 1, 1e30, 1 + std::min(0.25, 2 * (tau - 0.5))};
    }
    case BodyWeighting::solid_fraction:
      break;
  }
  return {};
}

/// B of the drag that the bodies of a cell exert together.
template <class V>
[[gnu::always_inline]] inline V coverage_weight(const V& drag, const V& alpha, const V& beta, const V& gamma,
                                                const V& cap, const V& largest) {
  const V g = min(drag, cap);
  return min(largest, V(alpha * g / (gamma + beta * g)));
}

inline double coverage_weight(double drag, const CoverageWeightLaw& law) {
  return coverage_weight(drag, law.alpha, law.beta, law.gamma, law.cap, law.largest);
}

}  // namespace lahar::lbm
