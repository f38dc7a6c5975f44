#pragma once
// Wall shear stress of a turbulent layer that the cells do not resolve, from the velocity at one distance from the
// wall.
//   smooth: Spalding 1961 (J. Appl. Mech. 28, 455), one law from the viscous sublayer to the logarithmic layer,
//     y+ = u+ + exp(-kappa B) [exp(kappa u+) - 1 - kappa u+ - (kappa u+)^2/2 - (kappa u+)^3/6];
//   rough: u / u_tau = ln(1 + y/z0) / kappa with z0 = k_s/30 (Nikuradse 1933); the 1 lets the wall begin at u = 0.
// The larger of the two stresses holds, so that a small roughness is smooth, and at small y+ the stress is nu u / y: a
// laminar flow feels a no-slip wall.
namespace lahar::lbm {

inline constexpr double kKarman = 0.41;
inline constexpr double kSmoothConstant = 5.2;  ///< B

/// Spalding's y+ at u+.
double spalding_distance(double u_plus);

/// Wall shear stress over density, u_tau^2. Speed along the wall and distance of the point, viscosity, and sand
/// roughness k_s (0: smooth), all in one system of units.
double wall_stress(double speed, double distance, double viscosity, double roughness);

}  // namespace lahar::lbm
