#pragma once
// What the cases of a study found beside what the paper reports.
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cases/compare_cfd_dem/compared_quantities.h"
#include "cases/compare_cfd_dem/study_case.h"
#include "cases/files/series_reader.h"

namespace lahar::study {

/// What is shown of a case that reached its end.
struct CaseResult {
  StudyCase study_case;
  std::map<std::string, double> values;  ///< of the compared quantities that it has
  cases::Series curves;                  ///< of the shown columns; may be empty
  std::string summary;                   ///< text of summary.json
  std::string commit, machine;           ///< that it was run with
  std::vector<std::string> failed_checks;
  double wall_seconds = 0;
  std::filesystem::path folder;  ///< of its pictures; empty where they are not at hand
  std::string ended;             ///< UTC, 2026-01-31T23:59:59Z; empty in records of before

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

/// The table's name and columns.
inline constexpr const char* kComparisonTable = "comparison.csv";
inline constexpr const char* kComparisonColumns = "quantity,unit,case,theirs,ours,difference,spread,commit";

/// A comment, the columns, the rows. The difference is over theirs; the spread is half the range of ours over the
/// seeds, presets, time steps and stiffnesses that the study has of the same flow, coupling and commit, over their mean
/// (`counts_in_spread`); programs with changes that no commit holds are no two alike.
std::string comparison_csv(const std::vector<CaseResult>& results);

}  // namespace lahar::study
