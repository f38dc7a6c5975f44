#pragma once
// The slope of 35 degrees that several entries ask about.
#include <cmath>
#include <numbers>

#include "core/vector.h"

namespace lahar::validate {

inline constexpr double kSlopeAngle = 35 * std::numbers::pi / 180;  ///< rad

/// Gravity where the bed is level in the lattice and x points down the slope.
inline Vec3 down_slope(double gravity) { return gravity * Vec3(std::sin(kSlopeAngle), 0, -std::cos(kSlopeAngle)); }

}  // namespace lahar::validate
