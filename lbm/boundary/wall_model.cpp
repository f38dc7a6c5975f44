#include "lbm/boundary/wall_model.h"

#include <algorithm>
#include <cmath>

namespace lahar::lbm {

double spalding_distance(double u_plus) {
  const double k = kKarman * u_plus;
  return u_plus + std::exp(-kKarman * kSmoothConstant) * (std::exp(k) - 1 - k * (1 + k / 2 * (1 + k / 3)));
}

namespace {

/// u+ with u+ y+(u+) = Re, the Reynolds number of speed and distance. The left side is convex, so Newton's method falls
/// to the root from a point above it: u+^2 = Re is one (y+ >= u+), and so is what the logarithmic law gives at y+ = Re.
double smooth_speed(double reynolds) {
  double u = std::min(std::sqrt(reynolds), std::log(1 + reynolds) / kKarman + kSmoothConstant + 1);
  for (int step = 0; step < 20; ++step) {
    const double k = kKarman * u, y = spalding_distance(u);
    const double slope = 1 + std::exp(-kKarman * kSmoothConstant) * kKarman * (std::exp(k) - 1 - k * (1 + k / 2));
    const double change = (u * y - reynolds) / (y + u * slope);
    u -= change;
    if (std::abs(change) < 1e-10 * u) break;
  }
  return u;
}

}  // namespace

double wall_stress(double speed, double distance, double viscosity, double roughness) {
  if (speed <= 0) return 0;
  const double friction = speed / smooth_speed(speed * distance / viscosity);
  const double rough = roughness > 0 ? speed * kKarman / std::log1p(30 * distance / roughness) : 0;
  return std::max(friction * friction, rough * rough);
}

}  // namespace lahar::lbm
