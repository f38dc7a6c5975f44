#pragma once
// Runs of `lahar`, several at once: begun, gone on with, or left as they are where they are done.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cases/compare_cfd_dem/study_case.h"

namespace lahar::study {

enum class Standing {
  to_do,    ///< nothing there, or nothing to go on from
  begun,    ///< a checkpoint is there
  done,     ///< a summary is there, of a run that reached its end
  foreign,  ///< something else is in the folder, or a run of another scene
  refused,  ///< a run whose scene this program refuses: of another program
};

/// Of the folder of a case. Throws FileError if its summary cannot be read.
Standing standing_of(const StudyCase& study_case, const std::filesystem::path& folder);

/// Throws InputError where a folder that a command-line option names is not empty and holds nothing of a study: no
/// folder, log or record of a case, and no table of comparison. What is there stays as it is.
void require_study_folder(const std::filesystem::path& folder, const std::string& option);

/// The command that brings a case further; empty if it is done. Throws InputError where something foreign is in its
/// way.
std::vector<std::string> command_of(const StudyCase& study_case, const std::filesystem::path& lahar,
                                    const std::filesystem::path& folder, int threads);

/// What the runs of a case print, in the folder of the study.
std::filesystem::path log_of(const StudyCase& study_case, const std::filesystem::path& study);

struct JobResult {
  StudyCase study_case;
  int exit_code = 0;  ///< 0 also where it was done already
};

struct JobOptions {
  std::filesystem::path lahar;   ///< the executable
  std::filesystem::path folder;  ///< a folder for each case is made here
  int at_once = 1, threads = 1;  ///< runs; threads of each
};

/// Runs what is not done, in order. Where `stop` says so the runs under way are asked to end, which leaves checkpoints,
/// and no other begins. `tell` is called with a line for each that begins or ends.
std::vector<JobResult> run_all(const std::vector<StudyCase>& study_cases, const JobOptions& options,
                               const std::function<bool()>& stop, const std::function<void(const std::string&)>& tell);

}  // namespace lahar::study
