#pragma once
// What a knob buys: a problem with a known answer, run with its defaults and with one knob turned at a time, or two
// where they belong together.
#include <functional>
#include <string>
#include <vector>

namespace lahar::validate {

struct Knob {
  std::string name, value;
};

struct Measurement {
  double error = 0, seconds = 0;
};

struct Trial {
  std::vector<Knob> turned;          ///< what differs from the defaults; nothing for the defaults themselves
  std::function<Measurement()> run;  ///< what it throws counts as a failed trial

  /// "cells 16, collision trt"; "defaults"
  [[nodiscard]] std::string name() const;
};

struct Problem {
  std::string name;      ///< of its file
  std::string error;     ///< what the error is, as a fraction unless it says otherwise
  std::string against;   ///< exact, measured or finest-grid values
  std::string defaults;  ///< what the defaults are
  std::vector<Trial> trials;
};

/// The error that `ask` returns, and the wall time that it took.
Measurement timed(const std::function<double()>& ask);

/// All problems; with `quick` on coarser grids and with fewer trials. The file problems/NAME.cpp exports one.
std::vector<Problem> all_problems(bool quick);

/// Those of these names, all where there are none. Throws std::invalid_argument for a name that is none.
std::vector<Problem> select_problems(const std::vector<std::string>& names, bool quick);

}  // namespace lahar::validate
