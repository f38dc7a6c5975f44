#pragma once
// What the cases of a study found beside what the paper reports.
#include <filesystem>
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

/// What is shown of a case that reached its end.
struct CaseResult {
  StudyCase study_case;
  std::map<std::string, double> values;  ///< of the compared quantities that it has
  cases::Series curves;                  ///< of the shown columns; may be empty
  std::string summary;                   ///< text of summary.json
  std::vector<std::string> failed_checks;
  double wall_seconds = 0;
  std::filesystem::path folder;  ///< of its pictures; empty where they are not at hand

  /// NaN where there is none.
  [[nodiscard]] double value(const std::string& quantity) const;
};

/// The values and curves of a run; what stands in its summary is left empty.
CaseResult result_of(const CaseRun& run);
/// The metrics in a summary. Throws cases::FileError, which names `file`, if it is none.
std::map<std::string, double> metrics_of(const std::string& summary, const std::filesystem::path& file);
/// Sets summary, failed_checks and wall_seconds. Throws cases::FileError, which names `file`, if it is no summary.
void take_summary(CaseResult& result, const std::string& summary, const std::filesystem::path& file);
/// Reads summary.json, series.h5 and the scene. Throws cases::FileError.
CaseResult read_case(const StudyCase& study_case, const std::filesystem::path& folder);

/// The paper's Table 5 by release distance.
struct Flow {
  double release, froude, e_in, e_out, e_d, e_b, eta, zeta;  ///< m, 1, kJ, kJ, kJ, kJ, 1, 1
};
/// Of li2020_table5.csv.
const std::vector<Flow>& published_flows();
/// The flow of a release distance, if the paper has it.
const Flow* published(double release);

/// A quantity of the comparison.
struct Compared {
  std::string name, unit, meaning;
  std::function<double(const CaseRun&)> ours;
  std::function<std::optional<double>(double release)> theirs;  ///< nothing where the paper gives no number
  std::string where;                                            ///< in the paper
};
const std::vector<Compared>& compared_quantities();

/// A column of a run's series that is shown over time.
struct ShownColumn {
  std::string name, title, unit;
  double factor = 1;       ///< from the column's unit to the shown one
  std::string where = {};  ///< in the paper
};
const std::vector<ShownColumn>& shown_columns();

/// The table's name and columns.
inline constexpr const char* kComparisonTable = "comparison.csv";
inline constexpr const char* kComparisonColumns = "quantity,unit,case,theirs,ours,difference,spread";

/// A comment, the columns, the rows. The difference is over theirs; the spread is half the range of ours over the
/// seeds, presets, time steps and stiffnesses that the study has of the same flow and coupling, over their mean
/// (`counts_in_spread`).
std::string comparison_csv(const std::vector<CaseResult>& results);

}  // namespace lahar::study
