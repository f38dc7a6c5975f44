#pragma once
// A column of water twice as high as wide collapses over a dry bed, in lattice units: what several entries ask about.
#include <utility>
#include <vector>

#include "cases/validate/entry.h"

namespace lahar::validate {

struct DamBreak {
  int width = 40;                     ///< of the column, cells
  int length = 5;                     ///< of the tank, in widths
  double column = 0.05715;            ///< width of the column, m
  double lattice_velocity = 0.1;      ///< of the front, 1.319 sqrt(2 g a)
  bool slip = true;                   ///< whether the bed and the wall behind the column slip
  double kinematic_viscosity = 1e-6;  ///< m^2/s
  double smagorinsky = 0;
  double until = 3.38;    ///< T = n t sqrt(g/a), n^2 = 2
  double steps = 0;       ///< at least as many
  bool adaptive = false;  ///< whether the time step adapts, to 0.1 lu; the lattice velocity then sets the first one
};

/// Column of 0.23 m x 0.46 m, as many cells wide: a fall from its top gives 3 m/s.
inline DamBreak column_of_water(int cells) {
  DamBreak dam;
  dam.column = 0.23;
  dam.width = cells;
  return dam;
}

struct DamBreakRun {
  std::vector<double> time, front;  ///< T and Z = x/a, every step until the end of the tank is near
  std::vector<double> height;       ///< H of the column at the wall behind it, at the same times
  std::size_t steps = 0;
  double fastest = 0;                          ///< cell of all steps, lu of its step
  std::size_t limited_cells = 0;               ///< most in a step that the velocity limiter slowed
  double energy_rise = 0;                      ///< largest above the lowest before, of the initial energy
  double drift = 0;                            ///< largest, of the mass
  double rescaled = 0;                         ///< mass that changes of the time step brought in, of all
  std::int64_t changes = 0;                    ///< of the time step
  double shortest_step = 1, longest_step = 1;  ///< of the first
  /// Front at a time T; time at which the front passes Z, not a number if it does not.
  [[nodiscard]] double front_at(double t) const;
  [[nodiscard]] double time_at(double z) const;
};

template <class Real>
DamBreakRun run_dam_break(const DamBreak& dam);

/// Measured by Martin & Moyce 1952, n^2 = 2: the front Z = x/a at T = n t sqrt(g/a), and the height H = h/(n^2 a) of
/// the column at the wall behind it at T / n.
struct MeasuredColumn {
  std::vector<std::pair<double, double>> front, height;
};
MeasuredColumn measured_column();

/// T at which its front passes Z.
double measured_arrival(double z);

/// RMS of the relative error of Z, and slope dZ/dT from T = 1.43 on, against Martin & Moyce 1952, n^2 = 2.
struct FrontErrors {
  double rms = 0, slope = 0;
  double shifted_rms = 0, shift = 0;  ///< after the shift in T that fits best
  double height_rms = 0;              ///< of the relative error of H
};
FrontErrors compare_front(const DamBreakRun& run);
constexpr double kFrontSlope = 1.319, kSlopeFrom = 1.43;  ///< dZ/dT of theirs and the T from which on

}  // namespace lahar::validate
