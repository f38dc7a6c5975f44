#pragma once
// The film between two close grains, which the cells no longer resolve. Squeezing:
//   F = -6 pi mu (a b / (a + b))^2 (1/h - 1/h_c) v_n,   h < h_c
// (Kim & Karrila 1991, sec. 11.2, leading term; Nguyen & Ladd 2002, Phys. Rev. E 66:046708, eq. 16 for the difference
// to what the lattice gives by itself), a, b the radii, h the gap, v_n the speed of approach along the line of centres.
// The gap counts as at least kSmoothest of the harmonic radius: real grains are rough.
//
// Shearing and rolling: leading terms of Jeffrey & Onishi 1984, J. Fluid Mech. 139:261 (Kim & Karrila, sec. 11.2.2),
// all in L = ln(h_t / h), h < h_t. Seen from the line of centres, which turns with W = n x (u_b - u_a) / R, the centres
// do not slip past each other, and what is left of the spins across n, w' = w - W, makes the torques
//   T_a = -(C_aa w'_a + C_ab w'_b),   T_b = -(C_ab w'_a + C_bb w'_b)
//   C_aa = 16/5 pi mu a^3 b / (a + b) L   (8 pi mu a^3 Y^C_11)
//   C_ab =  4/5 pi mu a^2 b^2 / (a + b) L (pi mu (a + b)^3 Y^C_12)
// The forces are those that balance them, F_b = n x (T_a + T_b) / R = -F_a. They are the leading terms of Y^A and Y^B;
// a pair that turns like a rigid body feels nothing, momentum and angular momentum are kept, and since C_aa C_bb =
// 16 C_ab^2 no motion gains energy. Twisting about n has no singular term and is left out.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "dem/particles.h"

namespace lahar::coupling {

inline constexpr double kFilmCutOff = 2.0 / 3.0;  ///< h_c in cells, Nguyen & Ladd 2002
/// h_t in cells, that of sliding in Nguyen & Ladd 2002 (they take 0.43 for rolling; one value for both keeps rigid
/// turns free of forces).
inline constexpr double kShearCutOff = 0.5;
inline constexpr double kSmoothest = 1e-3;  ///< least gap over a b / (a + b)

/// Force over speed of approach, N s/m; 0 beyond the cut-off. `viscosity` in Pa s, lengths in m.
inline double squeeze_resistance(double a, double b, double gap, double cut_off, double viscosity) {
  const double reduced = a * b / (a + b), h = std::max(gap, kSmoothest * reduced);
  if (h >= cut_off) return 0;
  return 6 * std::numbers::pi * viscosity * reduced * reduced * (1 / h - 1 / cut_off);
}

/// Torques over spins as seen from the line of centres, N m s.
struct ShearResistance {
  double aa = 0, ab = 0, bb = 0;
};

/// 0 beyond the cut-off. `viscosity` in Pa s, lengths in m.
inline ShearResistance shear_resistance(double a, double b, double gap, double cut_off, double viscosity) {
  const double h = std::max(gap, kSmoothest * a * b / (a + b));
  if (h >= cut_off) return {};
  const double unit = 4.0 / 5.0 * std::numbers::pi * viscosity * a * b / (a + b) * std::log(cut_off / h);
  return {4 * unit * a * a, unit * a * b, 4 * unit * b * b};
}

/// Adds forces and torques of the film to all grains closer than kFilmCutOff cells where `is_wet` holds in the middle
/// of the gap. In a step they at most stop the approach and the motion past each other. Returns the number of films.
std::size_t add_lubrication(dem::Particles& particles, double cell_size, double viscosity, double time_step,
                            const std::function<bool(const Vec3&)>& is_wet);

}  // namespace lahar::coupling
