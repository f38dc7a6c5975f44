#pragma once
// The film between two close grains or a grain and a wall, which the cells no longer resolve. Squeezing:
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
//
// A wall is a sphere of infinite radius that does not turn: with u_w - u_a = u its velocity past the grain's centre,
// across n, and n from the grain to the wall,
//   F = -6 pi mu R^2 (1/h - 1/h_c) v_n,   R^2 = 2 / ((k + k') sqrt(k k')),
//   F_t = 16/5 pi mu a L u + 4/5 pi mu a^2 L n x w,   T = 4/5 pi mu a^2 L n x u - 16/5 pi mu a^3 L w,
// the leading terms of Goldman, Cox & Brenner 1967 (Chem. Eng. Sci. 22:637): 8/15, 2/15 and 2/5 of L over 6 pi mu a,
// 6 pi mu a^2 and 8 pi mu a^3. k and k' are the principal curvatures of the gap: 1/a both at a plane, then R = a; with
// those of the wall where this is a ball, a cylinder or a bore. (Reynolds' equation, div(h^3 grad p) = -12 mu v_n, has
// p = 6 mu v_n / ((k + k') h^2) in a gap h + k x^2 / 2 + k' y^2 / 2.) Shearing and rolling take every wall as plane.
//
// Films are looked for once in a step of the fluid and felt at every step of the particles: a gap closes by orders of
// magnitude within a step of the fluid. A sphere of Stokes number St = rho_s d v / (9 mu) loses ln(h_c / h_min) of it
// on its way to the wall, h_min the least gap that counts, and as much on its way back.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "core/geometry.h"
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
  if (gap < 0 || h >= cut_off) return 0;
  return 6 * std::numbers::pi * viscosity * reduced * reduced * (1 / h - 1 / cut_off);
}

/// The same towards a wall, with R^2 of the gap (m^2).
inline double squeeze_resistance_at_wall(double a, double squeezed, double gap, double cut_off, double viscosity) {
  const double h = std::max(gap, kSmoothest * a);
  if (gap < 0 || h >= cut_off) return 0;
  return 6 * std::numbers::pi * viscosity * squeezed * (1 / h - 1 / cut_off);
}

/// R^2 of the gap between a sphere of radius a (m) and a wall, m^2.
double squeezed_at_wall(const Shape& wall, double a);

/// L = ln(h_t / h), 0 beyond the cut-off; `reduced` is the harmonic radius, that of the grain at a wall.
inline double film_logarithm(double reduced, double gap, double cut_off) {
  return std::log(std::max(1.0, cut_off / std::max(gap, kSmoothest * reduced)));
}

/// Torques over spins as seen from the line of centres, N m s.
struct ShearResistance {
  double aa = 0, ab = 0, bb = 0;
};

/// 0 beyond the cut-off. `viscosity` in Pa s, lengths in m.
inline ShearResistance shear_resistance(double a, double b, double gap, double cut_off, double viscosity) {
  const double reduced = a * b / (a + b);
  const double unit = 4.0 / 5.0 * std::numbers::pi * viscosity * reduced * film_logarithm(reduced, gap, cut_off);
  return {4 * unit * a * a, unit * a * b, 4 * unit * b * b};
}

/// Films of a step of the fluid.
class LubricationFilms {
 public:
  /// Lengths in m, viscosity in Pa s.
  LubricationFilms(double cell_size, double viscosity);

  /// Looks for the films of all grains that are, or within `time_step` (s) may come, closer than kFilmCutOff cells to a
  /// grain or a wall, where `is_wet` holds around the gap: at two of four places or more where it is a cell wide (in
  /// the middle of a narrow gap cells are covered and hold no liquid). Forgets those of before.
  void find(const dem::Particles& particles, const Walls& walls, double time_step,
            const std::function<bool(const Vec3&)>& is_wet);

  /// Adds their forces and torques to external_force and external_torque of the grains as they are now. In a step of
  /// this length (s) they at most stop the approach and the motion past each other, all films of a grain together.
  /// Returns the number of films that act. What walls get is not kept.
  std::size_t add(dem::Particles& particles, const Walls& walls, double time_step) const;

  [[nodiscard]] bool empty() const { return pairs_.empty() && at_walls_.empty(); }

 private:
  struct Pair {
    dem::ParticleIndex i, j;
  };
  struct AtWall {
    dem::ParticleIndex grain;
    std::size_t wall;
  };
  double cell_size_, cut_off_, shear_cut_off_, viscosity_;
  std::vector<Pair> pairs_;  ///< in an order that does not depend on where particles stand in their arrays
  std::vector<AtWall> at_walls_;
};

}  // namespace lahar::coupling
