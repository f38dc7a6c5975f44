#pragma once
// What gauges read of the fluid at a point.
#include <functional>

#include "cases/assembly/fluid_view.h"

namespace lahar::cases {

/// Velocity of the liquid at a cell, m/s: of Simulation::liquid_velocity. Where averaged grains are in a cell, its own
/// is that of the mixture.
using LiquidVelocity = std::function<Vec3(const lbm::WetCell&)>;

/// Depth of liquid over a point, m: sum of the fill levels of the cells above it, up to `top` (m), along z. Liquid
/// above two empty cells in a row or more is not counted: drops in the air, a roof that spray wets.
double depth_over(const FluidView& fluid, const Vec3& point, double top);

/// Pressure above ambient at a point, Pa: interpolated between the centres of the eight cells around it. Air counts as
/// 0, wall cells do not count. A point in or at a wall is first moved along the wall's normal to half a cell off it:
/// what a gauge flush with the wall reads is the pressure in the cells next to it.
double pressure_at(const FluidView& fluid, const Vec3& point);

/// The mean of it over a sensor: a disc of this diameter (m) around a point, parallel to the wall or face of the domain
/// that is nearest; places half a cell apart.
double pressure_on_disc(const FluidView& fluid, const Vec3& point, double diameter);

/// Velocity of the liquid at a point, m/s: interpolated between the centres of those of the eight cells around it that
/// hold liquid, which those inside resolved grains do not; NaN where none does.
Vec3 velocity_at(const FluidView& fluid, const LiquidVelocity& velocity, const Vec3& point);

}  // namespace lahar::cases
