#pragma once
// Spheres.
#include <numbers>

namespace lahar {

/// Volume of a sphere, m^3, from its radius in m.
[[nodiscard]] inline double sphere_volume(double radius) {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

}  // namespace lahar
