#pragma once
// Damping ratio that gives a wanted coefficient of restitution.
#include <algorithm>
#include <cmath>
#include <numbers>

namespace lahar::dem {

/// Smallest restitution that dampers can reproduce here; anything below acts like this value (nearly dead impact).
inline constexpr double kLeastRestitution = 0.01;

/// Restitution of a contact with damping ratio `ratio` that ends when the force would become attractive.
///
/// The Hertz contact F = k x^1.5 with damper proportional to x^(1/4) maps onto the linear oscillator by y ~ x^(5/4)
/// (Antypov & Elliott 2011, Europhys. Lett. 94:50004), and that mapping keeps the instant where the force vanishes, so
/// both laws share this curve. Without attraction the oscillator leaves at sin(a) = ratio after the phase pi - 2a
/// (Schwager & Poeschel 2007, Granular Matter 9:465): e = exp(-(pi - 2a) tan a); over-damped, with cosh(h) = ratio,
/// e = exp(-2h coth h).
inline double restitution_of_damping(double ratio) {
  if (ratio < 1) {
    const double a = std::asin(ratio);
    return std::exp(-(std::numbers::pi - 2 * a) * std::tan(a));
  }
  const double h = std::acosh(ratio);
  return h < 1e-6 ? std::exp(-2.0) : std::exp(-2 * h / std::tanh(h));
}

/// Inverse of `restitution_of_damping`. The usual beta = -ln e / sqrt(ln^2 e + pi^2) (Tsuji et al. 1992, Powder
/// Technol. 71:239) assumes that the contact pulls before it parts; with the pull cut off it returns too much energy
/// (0.32 instead of 0.2), hence this exact curve instead. Both agree as e -> 1.
/// @param restitution  0..1, values below kLeastRestitution act like it
inline double damping_ratio(double restitution) {
  if (restitution >= 1) return 0;
  const double wanted = std::max(restitution, kLeastRestitution);
  double low = 0, high = 16;
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double middle = 0.5 * (low + high);
    (restitution_of_damping(middle) > wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace lahar::dem
