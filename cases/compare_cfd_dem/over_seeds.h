#pragma once
// What of a case is chance: the same flow with other packings.
#include <string>
#include <vector>

#include "cases/compare_cfd_dem/comparison.h"

namespace lahar::study {

/// A quantity of a flow in one coupling over the seeds that one program (commit) ran, in the study's reading.
struct OverSeeds {
  std::string quantity, unit, sweep, preset, coupling, commit;
  double release = 0;              ///< m
  std::size_t seeds = 0;           ///< that have the quantity; two at least
  double mean = 0, deviation = 0;  ///< standard deviation of a run, over seeds - 1
  /// Of the mean against that of the resolved runs of the same program, and its standard error, the couplings' runs
  /// taken to be independent, though one seed is one packing; NaN for resolved ones, and where these are not there.
  double change = 0, change_error = 0;
};

/// By flow, preset and coupling; where several programs ran seeds of it the one with the most. Programs with changes
/// that no commit holds are left out.
std::vector<OverSeeds> over_seeds(const std::vector<CaseResult>& results);
/// quantity,unit,sweep,preset,release_m,coupling,seeds,mean,deviation,change,change_error,commit
std::string over_seeds_csv(const std::vector<OverSeeds>& all);

}  // namespace lahar::study
