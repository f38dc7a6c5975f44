#pragma once
// Small records of cases that are done, so that cases of many sittings stand in one report and a repository can hold
// them.
#include <filesystem>
#include <string>
#include <vector>

#include "cases/compare_cfd_dem/comparison.h"

namespace lahar::study {

/// Writes NAME.json of a case into a folder, which is made: when it ended, its summary, the compared values and the
/// shown curves, a row every 10 ms. Throws cases::FileError.
void write_record(const CaseResult& result, const std::filesystem::path& folder);

/// The case whose record a file is. Throws cases::FileError.
CaseResult read_record(const StudyCase& study_case, const std::filesystem::path& file);

/// The records in a folder, in the order of tables; other files are left alone. Throws cases::FileError.
std::vector<CaseResult> read_records(const std::filesystem::path& folder);

/// Writes the records of what is done here and returns it with what else the folder holds. Where a record is of another
/// commit the later of the two stays, with a warning; the run where nobody knows. Throws cases::FileError.
std::vector<CaseResult> share(std::vector<CaseResult> results, const std::filesystem::path& folder);

}  // namespace lahar::study
