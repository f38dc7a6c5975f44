#pragma once
// What is compared of a run with the paper and between couplings, and how it follows from what the run wrote.
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cases/compare_cfd_dem/study_case.h"
#include "cases/files/series_reader.h"

namespace lahar::study {

/// What a run left in its folder, as far as the comparison asks for it.
struct CaseRun {
  StudyCase study_case;
  std::map<std::string, double> metrics;    ///< of summary.json
  double grain_mass = 0, grain_volume = 0;  ///< kg, m^3, of the scene
  cases::Series series;

  /// NaN where there is none.
  [[nodiscard]] double metric(const std::string& name) const;
};

/// A quantity of the comparison.
struct Compared {
  std::string name, unit, meaning;
  std::function<double(const CaseRun&)> ours;
  std::function<std::optional<double>(double release)> theirs;  ///< nothing where the paper gives no number
  std::string where;                                            ///< in the paper
  std::optional<double> theirs_largest =
      {};  ///< of all flows and of all that are alike, where it does not say of which
};
const std::vector<Compared>& compared_quantities();
/// The paper's number for a case; none of a strip, whose width and net are not the paper's.
[[nodiscard]] std::optional<double> theirs_of(const Compared& quantity, const StudyCase& study_case);
/// kg, all mass that is there while the flow arrives, by its energy about the bed at the net and about the lower one,
/// kJ.
[[nodiscard]] double mass_by_energies(double e_in, double e_in_lower);

/// A column of a run's series that is shown over time.
struct ShownColumn {
  std::string name, title, unit;
  double factor = 1;       ///< from the column's unit to the shown one
  std::string where = {};  ///< in the paper
  bool mean = false;       ///< since the row before, not of the row's time
};
const std::vector<ShownColumn>& shown_columns();
/// Of a column of a run's series: whether a shown one is a mean since the row before.
[[nodiscard]] bool is_mean(const std::string& column);

}  // namespace lahar::study
