#pragma once
// Small records of cases that are done, so that cases of many sittings stand in one report and a repository can hold
// them.
#include <filesystem>
#include <string>
#include <vector>

#include "cases/compare_cfd_dem/comparison.h"

namespace lahar::study {

/// Writes NAME.json of a case into a folder, which is made: its summary, the compared values and the shown curves, a
/// row every 10 ms. Throws cases::FileError.
void write_record(const CaseResult& result, const std::filesystem::path& folder);

/// The case whose record a file is. Throws cases::FileError.
CaseResult read_record(const StudyCase& study_case, const std::filesystem::path& file);

/// The records in a folder, in the order of tables; other files are left alone. Throws cases::FileError.
std::vector<CaseResult> read_records(const std::filesystem::path& folder);

}  // namespace lahar::study
