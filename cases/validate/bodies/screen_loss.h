#pragma once
// Pressure loss of screens of round wire, K = dp / (1/2 rho U^2) with U the velocity of the approach.
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace lahar::validate {

/// screen_net.csv: K = beta(Re) (1 - a^2)/a^2, a = 1 - solidity (Blevins 1984, as tabulated in the Python package
/// fluids), between the tabulated Reynolds numbers by the logarithm. Trusted to 20 %. Re is taken with the wire's
/// diameter: only then is K -> Cd S for a wide screen (2 beta is within 10 % of Cd from Re = 40 on, 25 % at 20).
inline double screen_loss(double solidity, double reynolds) {
  constexpr double re[] = {20, 30, 40, 60, 80, 100, 200, 400}, beta[] = {1.3, 1.1, 0.95, 0.83, 0.75, 0.7, 0.6, 0.52};
  std::size_t k = 0;
  while (k < 6 && reynolds > re[k + 1]) ++k;
  const double share = std::clamp(std::log(reynolds / re[k]) / std::log(re[k + 1] / re[k]), 0.0, 1.0);
  const double open = 1 - solidity;
  return (beta[k] + share * (beta[k + 1] - beta[k])) * (1 - open * open) / (open * open);
}

}  // namespace lahar::validate
