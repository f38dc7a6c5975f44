#pragma once
// The table, the charts and the page of a speed-error study.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cases/speed_error/problem.h"

namespace lahar::validate {

struct TrialResult {
  std::string name;  ///< of the trial
  bool defaults = false;
  Measurement found;     ///< error and time; not a number where the trial failed
  std::string failure;   ///< why, or empty
  bool refused = false;  ///< whether it failed because its scene was refused: then it says nothing of the knob
};

struct ProblemResult {
  Problem problem;
  double work = 0;  ///< s, of the fixed piece of work in the same sitting: the unit of time
  std::vector<TrialResult> trials;

  [[nodiscard]] std::vector<Measurement> measurements() const;
};

/// Runs the trials of a problem in turn; after each, `go_on` is asked with what there is so far, and ends it there with
/// false.
ProblemResult run_problem(
    const Problem& problem, double work,
    const std::function<bool(const ProblemResult&)>& go_on = [](const auto&) { return true; });

/// Wall time of the fixed piece of work, s: 200 steps of 64^3 cells of plain liquid. The shortest of three.
double fixed_work();

/// By how much another trial beats the defaults (see beaten_by); at most 1 on the Pareto front.
double defaults_beaten_by(const ProblemResult& result);

/// Lines for the terminal: what a problem asks, what a trial found, which trials are on the front.
std::string heading_text(const Problem& problem);
std::string trial_text(const TrialResult& trial, double work);
std::string front_text(const ProblemResult& result);

/// A line for each trial whose scene was refused: which, and what was wrong. Empty where all ran.
std::string refusals_text(const ProblemResult& result);

/// Who ran it, and when; the first line of the table.
struct Sitting {
  std::string machine, commit, date;
  int threads = 1;
  bool quick = false;
  [[nodiscard]] std::string line() const;
};

/// The table's name and columns; time is in pieces of the fixed work.
inline constexpr const char* kSpeedErrorTable = "speed_error.csv";
inline constexpr const char* kSpeedErrorColumns = "problem,trial,error,seconds,time,beaten_by,front,failure";

/// The sitting, the columns, a row for each trial.
std::string results_csv(const std::vector<ProblemResult>& results, const Sitting& sitting);

/// Writes the table, NAME.png, .svg and .pdf of each problem, and report.html, which holds the charts; removes those of
/// other problems. Throws FileError.
void write_results(const std::vector<ProblemResult>& results, const Sitting& sitting,
                   const std::filesystem::path& folder);

}  // namespace lahar::validate
