#pragma once
// A standing wave of small amplitude on deep water, from rest, in lattice units. The amplitude of 0.01 wavelengths is
// less than a cell: a surface that is known only to the cell does not feel it.
#include <vector>

#include "lbm/step/fluid.h"

namespace lahar::validate {

struct StandingWave {
  int wavelength = 64;       ///< cells
  double wave_speed = 0.03;  ///< lu; compression changes the period by about the square of its Mach number, 0.3 %
  double reynolds = 100;     ///< omega_0 / (nu k^2)
  lbm::CollisionOperator collision = lbm::CentralMoments{};
  double smagorinsky = 0;

  [[nodiscard]] double wave_number() const;  ///< lu
  [[nodiscard]] double gravity() const;      ///< lu
  [[nodiscard]] double frequency() const;    ///< without viscosity, lu
  [[nodiscard]] double period() const;       ///< lu
};

inline constexpr int kWaveQuarters = 16;  ///< of a period, at each of which the amplitude is known

/// a / a_0 at every step for so many periods.
template <class Real>
std::vector<double> run_standing_wave(const StandingWave& wave, double periods);

/// a / a_0 at each quarter of a period: Prosperetti 1981 (Physics of Fluids 24, 1217), the initial-value problem with
/// viscosity. Throws InputError for a Reynolds number that is not in the table.
std::vector<double> exact_amplitude(int reynolds);

/// RMS of the difference of a / a_0 over the first quarters of a period.
double amplitude_error(const std::vector<double>& series, const StandingWave& wave, int quarters);

}  // namespace lahar::validate
