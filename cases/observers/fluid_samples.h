#pragma once
// What gauges read of the fluid at a point.
#include "lbm/step/fluid.h"

namespace lahar::cases {

/// Depth of liquid over a point, m: sum of the fill levels of the cells above it, up to `top` (m), along z.
template <class Real>
double depth_over(const lbm::Fluid<Real>& fluid, const Vec3& point, double top);

/// Pressure above ambient at a point, Pa: interpolated between the centres of the eight cells around it. Air counts as
/// 0, wall cells do not count. A point in or at a wall is first moved along the wall's normal to half a cell off it:
/// what a gauge flush with the wall reads is the pressure in the cells next to it.
template <class Real>
double pressure_at(const lbm::Fluid<Real>& fluid, const Vec3& point);

extern template double depth_over<float>(const lbm::Fluid<float>&, const Vec3&, double);
extern template double depth_over<double>(const lbm::Fluid<double>&, const Vec3&, double);
extern template double pressure_at<float>(const lbm::Fluid<float>&, const Vec3&);
extern template double pressure_at<double>(const lbm::Fluid<double>&, const Vec3&);

}  // namespace lahar::cases
