#pragma once
// The film between two close grains, which the cells no longer resolve. Only the squeezing part is added:
//   F = -6 pi mu (a b / (a + b))^2 (1/h - 1/h_c) v_n,   h < h_c
// (Kim & Karrila 1991, sec. 11.2, leading term; Nguyen & Ladd 2002, Phys. Rev. E 66:046708, eq. 16 for the difference
// to what the lattice gives by itself), a, b the radii, h the gap, v_n the speed of approach along the line of centres.
// Shear and rolling of the film grow only with log(1/h) and are left out. The gap counts as at least kSmoothest of the
// harmonic radius: real grains are rough.
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "dem/particles.h"

namespace lahar::coupling {

inline constexpr double kFilmCutOff = 2.0 / 3.0;  ///< h_c in cells, Nguyen & Ladd 2002
inline constexpr double kSmoothest = 1e-3;        ///< least gap over a b / (a + b)

/// Force over speed of approach, N s/m; 0 beyond the cut-off. `viscosity` in Pa s, lengths in m.
inline double squeeze_resistance(double a, double b, double gap, double cut_off, double viscosity) {
  const double reduced = a * b / (a + b), h = std::max(gap, kSmoothest * reduced);
  if (h >= cut_off) return 0;
  return 6 * std::numbers::pi * viscosity * reduced * reduced * (1 / h - 1 / cut_off);
}

/// Adds the force of the film to all grains closer than kFilmCutOff cells where `is_wet` holds in the middle of the
/// gap. The force of a step is at most what stops the approach in it. Returns the number of films.
std::size_t add_lubrication(dem::Particles& particles, double cell_size, double viscosity, double time_step,
                            const std::function<bool(const Vec3&)>& is_wet);

}  // namespace lahar::coupling
