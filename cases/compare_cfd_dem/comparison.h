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

enum class Outcome { passed, failed, absent };
const char* name_of(Outcome outcome);

/// A check of a case. What the study asks for is stricter than what `lahar run` does.
struct CaseCheck {
  std::string name;
  double value, bar;  ///< NaN where there is none
  Outcome outcome;
};

/// What is shown of a case that reached its end.
struct CaseResult {
  StudyCase study_case;
  std::map<std::string, double> values;  ///< of the compared quantities that it has
  cases::Series curves;                  ///< of the shown columns; may be empty
  std::string summary;                   ///< text of summary.json
  std::string commit, machine;           ///< that it was run with
  std::vector<CaseCheck> checks;         ///< by the bars of the study, and by the run's own of what it checks besides
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
/// Sets summary, checks, wall_seconds and who ran it. Throws cases::FileError, which names `file`, if it is no summary.
void take_summary(CaseResult& result, const std::string& summary, const std::filesystem::path& file);
/// Reads summary.json, series.h5 and the scene. Throws cases::FileError.
CaseResult read_case(const StudyCase& study_case, const std::filesystem::path& folder);

/// The table's name and columns.
inline constexpr const char* kComparisonTable = "comparison.csv";
inline constexpr const char* kComparisonColumns = "quantity,unit,case,theirs,ours,difference,spread,commit";

/// A comment, the columns, the rows. The difference is over theirs; the spread is half the range of ours over the
/// seeds, presets, cells, time steps and stiffnesses that the study has of the same flow, coupling and commit, over
/// their mean (`count_in_one_spread`); programs with changes that no commit holds are no two alike.
std::string comparison_csv(const std::vector<CaseResult>& results);

/// case,check,value,bar,outcome. The study's bars, beside the run's own of what it checks besides: liquid 1e-5 of its
/// mass (`liquid_mass_ledger`), exchange of momentum 1e-6 (`momentum_audit`), energy of grains and barrier 1 % of E_in
/// about the bed at the net (`solids_energy_of_e_in`, of the metrics), no link of rings changed.
std::string checks_csv(const std::vector<CaseResult>& results);

/// How near to the paper's number the flows of a sweep are that were run both resolved and averaged (Di Felice's), of
/// one preset and seed (the lowest) and in the study's reading.
struct Nearness {
  std::string quantity, sweep, preset;
  std::size_t flows = 0;           ///< that have the quantity in both couplings and a number of the paper
  std::size_t of_one_program = 0;  ///< of them: both run by one commit
  std::size_t resolved_nearer = 0, averaged_nearer = 0;
  double resolved_over_theirs = 0, averaged_over_theirs = 0;  ///< means over the flows
};
/// Of quantities that the paper gives a number of for a flow, energies about the bed 1.30 m downstream; only those that
/// some flow has.
std::vector<Nearness> nearness(const std::vector<CaseResult>& results);
/// quantity,sweep,preset,flows,of_one_program,resolved_nearer,averaged_nearer,resolved_over_theirs,averaged_over_theirs
std::string nearness_csv(const std::vector<Nearness>& all);

}  // namespace lahar::study
