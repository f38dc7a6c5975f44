#pragma once
// Drag on a grain among others by the mean flow past it, for fluids that do not resolve grains.
//
// The force on a grain is  beta (u - v) + rho V (Du/Dt - g): drag, and what the pressure of the undisturbed flow does
// to the grain's place. u is the mean velocity of the liquid between the grains, v that of the grain, eps = 1 - phi the
// share of liquid. Laws that book a part of the pressure drop of the bed as buoyancy ("model A") are divided by eps, so
// that all give the whole pressure drop (Enwald, Peirano & Almstedt 1996, Int. J. Multiphase Flow 22:21, section 3).
#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupling/coupling_options.h"

namespace lahar::coupling {

/// The flow past a grain, SI.
struct BedFlow {
  double diameter = 0;        ///< m
  double solid_fraction = 0;  ///< phi, of all grains around
  double speed = 0;           ///< m/s, |u - v|
  double density = 0;         ///< kg/m^3, of the liquid
  double viscosity = 0;       ///< m^2/s, kinematic
  /// Of the flow's mean over liquid and grains.
  [[nodiscard]] double reynolds() const { return (1 - solid_fraction) * speed * diameter / viscosity; }
};

/// Di Felice 1994 (Int. J. Multiphase Flow 20:153): the drag of a lone sphere (Dallavalle 1948) at the mean velocity,
/// times eps^-chi, which fits settling and fluidization from phi = 0 to 0.6.
inline double di_felice_drag(const BedFlow& f) {
  const double re = f.reynolds(), a = 1.5 - std::log10(std::max(re, 1e-10));
  const double chi = 3.7 - 0.65 * std::exp(-a * a / 2), root = 0.63 * std::sqrt(re) + 4.8;
  return std::numbers::pi / 8 * f.density * f.viscosity * f.diameter * root * root *
         std::pow(1 - f.solid_fraction, -chi);
}

/// Gidaspow 1994 (Multiphase Flow and Fluidization): Ergun's packed bed from phi = 0.2 on, below it Wen & Yu 1966; they
/// do not meet at 0.2.
inline double gidaspow_drag(const BedFlow& f) {
  const double eps = 1 - f.solid_fraction, d = f.diameter;
  if (f.solid_fraction >= 0.2) {
    const double volume = std::numbers::pi / 6 * d * d * d;
    return volume * f.density *
           (150 * f.solid_fraction * f.viscosity / (eps * eps * d * d) + 1.75 * f.speed / (eps * d));
  }
  const double re = f.reynolds();
  const double cd_re = re < 1000 ? 24 * (1 + 0.15 * std::pow(re, 0.687)) : 0.44 * re;
  return std::numbers::pi / 8 * f.density * f.viscosity * d * cd_re * std::pow(eps, -3.65);
}

/// Beetstra, van der Hoef & Kuipers 2007 (AIChE J. 53:489), eq. 17: a fit to resolved flow through random arrays, phi
/// to 0.6, Re to 1000. Of equal spheres: their factor for mixtures of sizes is left out.
inline double beetstra_drag(const BedFlow& f) {
  const double phi = f.solid_fraction, eps = 1 - phi, re = std::max(f.reynolds(), 1e-10);
  const double creeping = 10 * phi / (eps * eps) + eps * eps * (1 + 1.5 * std::sqrt(phi));
  const double fast = 0.413 * re / (24 * eps * eps) * (1 / eps + 3 * phi * eps + 8.4 * std::pow(re, -0.343)) /
                      (1 + std::pow(10, 3 * phi) * std::pow(re, -(1 + 4 * phi) / 2));
  return 3 * std::numbers::pi * f.density * f.viscosity * f.diameter * (creeping + fast);
}

/// beta, kg/s.
inline double bed_drag(BedDrag law, const BedFlow& flow) {
  switch (law) {
    case BedDrag::di_felice:
      return di_felice_drag(flow);
    case BedDrag::gidaspow:
      return gidaspow_drag(flow);
    case BedDrag::beetstra:
      return beetstra_drag(flow);
  }
  return 0;
}

}  // namespace lahar::coupling
