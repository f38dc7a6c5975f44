#pragma once
// A strip of the paper's debris flow (cases/debris_flow/strip.toml).
#include <string>
#include <vector>

#include "cases/speed_error/problem.h"

namespace lahar::validate {

/// What is compared. The net's are 0 where there is none.
struct StripFigures {
  double water = 0, grains = 0;               ///< m, that the centres of all water and all grains have moved
  double water_energy = 0, grain_energy = 0;  ///< J, kinetic, at the end
  double net_force = 0;                       ///< N, mean over time of the sum of all bond forces
  double elongation = 0;                      ///< m, largest
  double seconds = 0;                         ///< of wall time, without the preparation
};

/// Runs the strip to a time (s) with overrides of the scene's keys, on cells of 2 cm unless they say otherwise.
StripFigures run_strip(const std::vector<std::string>& overrides, double until);

/// RMS of the relative errors of those figures that the known run has.
double error_of(const StripFigures& found, const StripFigures& known);

/// A knob of a strip, by the scene's keys: {"fluid.cell_size_m=0.03"}. "threads=1" is one too.
using Overrides = std::vector<std::string>;

/// The defaults and a trial for each set of overrides, all with those that are `always` set, against the `finest`.
std::vector<Trial> strip_trials(const Overrides& always, double until, const Overrides& finest,
                                const std::vector<Overrides>& turned);

}  // namespace lahar::validate
