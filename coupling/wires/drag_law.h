#pragma once
// Drag of a long circular cylinder per length, by the components of the relative velocity; what a screen of cylinders
// adds to it; and how a cylinder that is spread over cells disturbs the velocity that is sampled at it.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/vector.h"
#include "coupling/wires/wire_crowding.h"
#include "coupling/yield_drag.h"
#include "lbm/rheology/shear_law.h"

namespace lahar::coupling {

/// Normal drag coefficient, force per length = 1/2 rho d Cd u_n^2 (Sucker & Brauer 1975, Waerme- und Stoffuebertragung
/// 8:149, a fit to experiments for 1e-4 < Re < 2e5). Below that range the force is linear.
inline double normal_drag_coefficient(double reynolds) {
  constexpr double lowest = 1e-4;
  const double re = std::clamp(reynolds, lowest, 2e5);
  const double cd = 1.18 + 6.8 / std::pow(re, 0.89) + 1.96 / std::sqrt(re) - 0.0004 * re / (1 + 3.64e-7 * re * re);
  return reynolds < lowest ? cd * lowest / std::max(reynolds, 1e-12) : cd;
}

/// Tangential coefficient, force per length = 1/2 rho d Ct u_t^2. In a stream at an angle the force is linear in u_t,
/// pi mu (0.55 Re_n^(1/2) + 0.084 Re_n^(2/3)) u_t with Re_n of the normal velocity (Choo & Casarella 1971, J.
/// Hydronautics 5:126; Tsukrov et al. 2003, Ocean Eng. 30:251). Where the stream runs along the wire that is too
/// little: at least the friction of a turbulent boundary layer, 0.005 of the surface, and half of what a creeping
/// stream across it does (slender bodies, Cox 1970, J. Fluid Mech. 44:791; the first part of the normal law).
inline double tangential_drag_coefficient(double normal_reynolds, double tangential_reynolds) {
  const double re_t = std::max(tangential_reynolds, 1e-12), root = std::cbrt(normal_reynolds);
  const double askew = 2 * std::numbers::pi * (0.55 * std::sqrt(normal_reynolds) + 0.084 * root * root) / re_t;
  return std::max(askew, 0.005 * std::numbers::pi + 3.4 / std::pow(re_t, 0.89));
}

/// Three-point kernel of Roma, Peskin & Berger 1999, J. Comput. Phys. 153:509; r in cells. Sums to 1, and its squares
/// to 1/2, for any offset.
inline double roma_kernel(double r) {
  const double a = std::abs(r);
  if (a <= 0.5) return (1 + std::sqrt(1 - 3 * r * r)) / 3;
  if (a <= 1.5) return (5 - 3 * a - std::sqrt(1 - 3 * (1 - a) * (1 - a))) / 6;
  return 0;
}

inline constexpr double kRomaSquares = 0.5;  ///< sum of squares of the kernel, any offset

/// How many times wider than three cells the kernel of a wire is, so that what it takes from the cells stays a small
/// part of their momentum: 1 up to a diameter of one cell, then one per cell of diameter up to 5.
inline double kernel_scale(double diameter_cells) { return std::clamp(diameter_cells, 1.0, 5.0); }

/// Drag per length of a cylinder in a screen over that of a lone one in the same approach flow. The loss of a screen of
/// solidity S, open share a = 1 - S, is K = beta(Re) (1 - a^2)/a^2 (Blevins 1984). With beta = Cd/2, which makes it Cd
/// S for S -> 0 as it must be, that is Cd S (1 - S/2)/(1 - S)^2; wires of total area s >= S (crossings counted twice)
/// share it.
inline double screen_factor(const Crowding& screen) {
  const double s = screen.solidity;
  return s <= 0 ? 1.0 : (1 - s / 2) / ((1 - s) * (1 - s)) * s / screen.area;
}

/// Part of the inviscid self-induced velocity that is left at a kernel Reynolds number s = U sigma/nu, sigma the
/// standard deviation of the Gaussian that stands for the kernel: 1 for s -> infinity. From the Oseen equations with a
/// Gaussian force, sampled with the same Gaussian:
///   D = F'/(2 pi rho U) int_0^inf exp(-k^2 sigma^2) (sqrt(1 + q^2) - q) dk,   q = k nu/U
///     = F'/(4 sqrt(pi) sigma rho U) times the value returned, 2/sqrt(pi) [s/4 e^z (K0(z) + K1(z)) - 1/(2s)], z =
///     s^2/2.
inline double oseen_share(double s) {
  constexpr double scale = 2 * std::numbers::inv_sqrtpi;
  if (s > 6) {  // e^z (K0 + K1) by its asymptotic series
    const double z = s * s / 2;
    return 1 + (1 / 8.0 - 3 / (128 * z)) / z - scale / (2 * s);
  }
  const double small = std::max(s, 1e-3), z = small * small / 2;  // below: in proportion, as the drag is
  return std::min(1.0, s / small) * scale *
         (small / 4 * std::exp(z) * (std::cyl_bessel_k(0.0, z) + std::cyl_bessel_k(1.0, z)) - 1 / (2 * small));
}

/// A wire as the cells see it.
struct WireInCells {
  double diameter = 0;        ///< m
  double diameter_cells = 0;  ///< the same in cells
  lbm::ShearLaw fluid = {};
  Crowding screen = {};  ///< that it is part of

  /// Of a part `u` of the relative velocity, in the viscosity that the whole of it, `speed` (m/s), makes beside the
  /// wire.
  [[nodiscard]] double reynolds(double u, double speed) const {
    return u * diameter / fluid.viscosity_at(speed / diameter);
  }
};

/// Drag per length without a yield stress, m^3/s^2 (over the liquid's density), at the undisturbed normal and the
/// tangential velocity.
inline Vec3 viscous_drag(const WireInCells& w, const Vec3& normal, const Vec3& tangential) {
  const double across = normal.norm(), along = tangential.norm(), speed = (normal + tangential).norm();
  const double re = w.reynolds(across, speed), re_along = w.reynolds(along, speed);
  return 0.5 * w.diameter *
         (normal_drag_coefficient(re) * screen_factor(w.screen) * across * normal +
          tangential_drag_coefficient(re, re_along) * along * tangential);
}

/// What the yield stress adds to the drag per length, over the liquid's density: at a slip s m^3/s^2 of
/// across s_across/(|s| + creep_speed) across the wire, along s_along/(|s| + creep_speed) along it.
struct YieldDrag {
  double along = 0, across = 0;  ///< m^3/s^2
  double creep_speed = 0;        ///< m/s: slower, the fluid creeps at its limit viscosity
};

/// At an undisturbed speed: coupling/yield_drag.h across the wire, yield stress on its skin along it. The direction of
/// the slip shares it.
inline YieldDrag yield_drag(const WireInCells& w, double speed) {
  const double rate = speed / w.diameter, yield = w.fluid.yield_stress * w.diameter;
  return {.along = yield * std::numbers::pi,
          .across = yield * cylinder_yield_coefficient(w.fluid.bingham(rate)),
          .creep_speed = w.fluid.yield_stress / w.fluid.limit * w.diameter};
}

/// Share of the undisturbed speed u that the wire takes from the velocity sampled at itself. Half of the momentum
/// deficit has built up where the wire is; to first order (Oseen) the share is
///   x = Cd d (sum phi^2 - s/d)/4 oseen_share(u sigma/nu),   d in cells.
/// s/d is what a row of wires of area s cancels: the flow through the plane of a screen is that of the approach
/// (continuity), so only what the wakes are beyond their mean is a deficit. Wires that cross take as much on average as
/// they cancel. To second order the deficit is carried off
/// by the slower flow in itself, u_c = u (1 - 2/3 g^2 share) with g = oseen_share: momentum theory has 1 for 2/3; 2/3
/// and the fading with g^2 are what the fluid itself shows around a force of known size (docs/decisions/0022). What
/// runs `along` the wire (m/s) shears the fluid too.
inline double self_induced_share(const WireInCells& w, double u, double along = 0) {
  const double width = kernel_scale(w.diameter_cells);
  const double excess = std::max(0.0, kRomaSquares / width - w.screen.parallel / w.diameter_cells);
  if (excess == 0) return 0;
  const double sigma = std::numbers::inv_sqrtpi * width / w.diameter_cells * w.diameter;
  const double speed = std::sqrt(u * u + along * along);
  double cd = normal_drag_coefficient(w.reynolds(u, speed)) * screen_factor(w.screen);
  double nu = w.fluid.viscosity_at(speed / w.diameter);
  if (w.fluid.yield_stress > 0 && u > 0) {
    const YieldDrag yield = yield_drag(w, speed);
    const double yielding = yield.across * u / (speed + yield.creep_speed);
    cd += 2 * yielding / (w.diameter * u * u);
    nu += yielding / u;  // what yields around the wire is about as viscous as its drag
  }
  const double s = u * sigma / nu, g = oseen_share(s);
  const double unit = cd * w.diameter_cells * excess / 4;
  double share = unit * g;
  for (int k = 0; k < 2; ++k) {
    const double carried = 1 - 2.0 / 3.0 * g * g * std::min(share, 1.0);
    share = unit * oseen_share(s * carried) / carried;
  }
  return std::min(share, 0.9);
}

/// Undisturbed normal speed from the speed sampled at the wire: u (1 - share(u)) = sampled, by the secant method; at
/// most 8 times what is sampled.
inline double undisturbed_speed(double sampled, const WireInCells& w, double along = 0) {
  if (sampled <= 0) return 0;
  const auto miss = [&](double u) { return u * (1 - self_induced_share(w, u, along)) - sampled; };
  double before = sampled, miss_before = miss(before);
  double u = sampled - 1.3 * miss_before;
  for (int k = 0; k < 8 && u != before; ++k) {
    const double now = miss(u);
    if (std::abs(now) < 1e-4 * sampled) break;
    const double slope = std::max((now - miss_before) / (u - before), 0.1);  // 1 without a disturbance
    before = u, miss_before = now;
    u = std::clamp(u - now / slope, sampled, 8 * sampled);
  }
  return u;
}

}  // namespace lahar::coupling
