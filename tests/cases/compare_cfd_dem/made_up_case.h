#pragma once
#include "cases/compare_cfd_dem/comparison.h"

namespace lahar::study {

/// A case of the matched sweep of which only a few numbers are known; energies in kJ.
inline CaseResult made_up(double release, double e_in, double e_out, int seed = 1) {
  CaseRun run;
  run.study_case = {"matched", "coarse", "resolved", "study", release, seed};
  run.metrics = {{"e_in_kJ", e_in},
                 {"e_out_kJ", e_out},
                 {"barrier_energy_start_J", 100},
                 {"barrier_energy_end_J", 1100},
                 {"retained_mass_ratio", 1 - 0.01 * release}};
  return result_of(run);
}

}  // namespace lahar::study
