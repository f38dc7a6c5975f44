#pragma once
// How much of a collision the bodies of a cell take over, B, from what was written into it and the slip w, the speed of
// the liquid past the bodies:
//   k = alpha min(drag, cap (1 + stiff / w)) + inertial eps^3 w,   B = min(largest, k / (gamma + beta k)).
// All weightings have this form (docs/coupling.md, docs/decisions/0020, 0061):
//   solid_fraction      drag = eps   B = eps
//   noble_torczynski    drag = eps   B = eps t / ((1 - eps) + t), t = tau - 1/2
//   wall_distance       drag = h     k = nu h,  B = k / (1 + k/2): with the velocity half-way through the step,
//                                    (u + u')/2, the exchange is then k times the slip
//   inertial            drag = h     k = nu min(h, H (1 + nu / w)) + C eps^3 w,  B as above
// By wall_distance the cells within a body take its velocity at once. By inertial they do where the slip is slow beside
// the viscosity; where it is fast their drag is quadratic in the slip, so that it depends neither on the time step nor
// on how fast body and liquid move together through the lattice.
#include <algorithm>

#include "core/simd_math.h"

namespace lahar::lbm {

/// How the coverage weight B follows from the bodies in a cell.
enum class BodyWeighting {
  solid_fraction,    ///< B = eps
  noble_torczynski,  ///< B = eps (tau - 1/2) / ((1 - eps) + (tau - 1/2)), Noble & Torczynski 1998
  wall_distance,     ///< from the distance of the cell's centre to the surface (coupling/grains/wall_drag.h)
  inertial,          ///< the same, with a quadratic drag within bodies in fast flow
};

/// Weightings by the distance of a cell's centre from the surface.
inline bool by_wall_distance(BodyWeighting w) {
  return w == BodyWeighting::wall_distance || w == BodyWeighting::inertial;
}

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

/// H: what a cell within a body resists with, in nu per cell^2: liquid reaches 1 / sqrt(H) of a cell into it.
inline constexpr double kRigidDrag = 100;
/// C, per cell: of a pack of solid fraction 0.4 to 0.6 of grains of 4 and 8 cells in water (docs/decisions/0061).
inline constexpr double kInertialDrag = 22;

struct CoverageWeightLaw {
  double alpha = 1, beta = 0, gamma = 1, cap = 1, largest = 1, stiff = 0, inertial = 0;
};

inline CoverageWeightLaw coverage_weight_law(BodyWeighting weighting, double tau) {
  switch (weighting) {
    case BodyWeighting::noble_torczynski: {
      const double r = 1 / (tau - 0.5);
      return {1, -r, 1 + r, 1, 1};
    }
    case BodyWeighting::wall_distance:
    case BodyWeighting::inertial: {
      // In a covered cell B = 2 would be bounce-back: no slip exactly half-way through the step, but undamped. B = 1
      // leaves a slip of the order of nu/2, so it may stay at 1 where the viscosity is small.
      const double nu = (tau - 0.5) / 3;
      const double largest = 1 + std::min(0.25, 2 * (tau - 0.5));
      if (weighting == BodyWeighting::wall_distance) return {nu, 0.5, 1, 1e30, largest};
      return {nu, 0.5, 1, kRigidDrag, largest, nu, kInertialDrag};
    }
    case BodyWeighting::solid_fraction:
      break;
  }
  return {};
}

/// CoverageWeightLaw for numbers or rows of them.
template <class V>
struct CoverageWeights {
  V alpha, beta, gamma, cap, largest, stiff, inertial;

  explicit CoverageWeights(const CoverageWeightLaw& law)
      : alpha(number<V>(law.alpha)),
        beta(number<V>(law.beta)),
        gamma(number<V>(law.gamma)),
        cap(number<V>(law.cap)),
        largest(number<V>(law.largest)),
        stiff(number<V>(law.stiff)),
        inertial(number<V>(law.inertial)) {}

  /// B of the drag that the bodies of a cell exert together, of the fraction of it that they fill and the slip, lu.
  [[gnu::always_inline]] V of(const V& drag, const V& fraction, const V& slip) const {
    const V filled = min(V(1), fraction), most = cap + cap * stiff / max(slip, number<V>(1e-12));
    const V k = alpha * min(drag, most) + inertial * slip * (filled * filled * filled);
    return min(largest, V(k / (gamma + beta * k)));
  }
};

}  // namespace lahar::lbm
