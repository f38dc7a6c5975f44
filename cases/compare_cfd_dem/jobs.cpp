#include "cases/compare_cfd_dem/jobs.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "cases/assembly/load.h"
#include "cases/compare_cfd_dem/comparison.h"
#include "cases/files/output_file.h"
#include "cases/runner/options.h"
#include "cases/runner/output_folder.h"
#include "cases/runner/table_folder.h"
#include "core/check.h"

extern char** environ;

namespace lahar::study {

namespace {

/// s of flow that a run has reached.
double simulated_seconds(const std::filesystem::path& summary) {
  std::ifstream file(summary);
  try {
    return nlohmann::json::parse(file).at("simulated_seconds").get<double>();
  } catch (const nlohmann::json::exception&) {
    throw cases::FileError(summary, "not the summary of a run");
  }
}

/// Whether a study has made this: the folder of a case, its log or its record.
bool is_of_a_case(const std::filesystem::directory_entry& entry) {
  const std::filesystem::path name = entry.path().filename();
  if (entry.is_directory()) return case_named(name.string(), {}).has_value();
  return (name.extension() == ".log" || name.extension() == ".json") && case_named(name.stem().string(), {});
}

}  // namespace

void require_study_folder(const std::filesystem::path& folder, const std::string& option) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw InputError(std::vector<InputMistake>{
        {option + " " + folder.string(), 1, 1, "is a file, expected a folder or a new name"}});
  if (!fs::is_directory(folder, error) || fs::is_empty(folder, error)) return;
  if (std::any_of(fs::directory_iterator(folder), {}, is_of_a_case)) return;
  if (cases::holds_table(folder / kComparisonTable, kComparisonColumns)) return;
  throw InputError(std::vector<InputMistake>{
      {option + " " + folder.string(), 1, 1,
       fmt::format("is not empty and holds no case and no {} of a study, expected a new, an empty or such a folder",
                   kComparisonTable)}});
}

Standing standing_of(const StudyCase& c, const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder) || std::filesystem::is_empty(folder)) return Standing::to_do;
  if (!cases::holds_run(folder)) return Standing::foreign;
  const scene::Scene wanted = scene::load(c.scene_file(), c.changes());
  try {
    if (!(scene::load(folder / "scene.resolved.toml", {}) == wanted)) return Standing::foreign;
  } catch (const InputError&) {
    return Standing::refused;
  }
  if (std::filesystem::exists(folder / "summary.json") &&
      simulated_seconds(folder / "summary.json") >= wanted.run.duration * (1 - 1e-6))
    return Standing::done;
  return std::filesystem::exists(folder / "checkpoint.h5") ? Standing::begun : Standing::to_do;
}

std::filesystem::path log_of(const StudyCase& c, const std::filesystem::path& study) {
  return study / (c.name() + ".log");
}

std::vector<std::string> command_of(const StudyCase& c, const std::filesystem::path& lahar,
                                    const std::filesystem::path& folder, int threads) {
  const std::vector<std::string> common{"--threads", std::to_string(threads), "--quiet"};
  std::vector<std::string> command;
  switch (standing_of(c, folder)) {
    case Standing::done:
      return {};
    case Standing::foreign:
    case Standing::refused:
      throw InputError(std::vector<InputMistake>{
          {folder.string(), 1, 1,
           "holds something else than this case with these values, expected nothing or such a run: another --out"}});
    case Standing::begun:
      command = {lahar.string(), "resume", folder.string()};
      break;
    case Standing::to_do:
      command = {lahar.string(), "run", c.scene_file().string(), "--out", folder.string(), "--overwrite"};
      for (const std::string& change : c.changes()) command.insert(command.end(), {"--set", change});
      break;
  }
  command.insert(command.end(), common.begin(), common.end());
  return command;
}

namespace {

struct Running {
  pid_t pid;
  std::size_t job;  ///< index into the results
  std::chrono::steady_clock::time_point since;
};

/// What the run prints goes into a file beside its folder.
pid_t start(const std::vector<std::string>& command, const std::filesystem::path& log) {
  std::vector<char*> arguments;
  for (const std::string& a : command) arguments.push_back(const_cast<char*>(a.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
  posix_spawn_file_actions_adddup2(&files, STDOUT_FILENO, STDERR_FILENO);
  posix_spawnattr_t attributes;  // a group of its own: Ctrl-C reaches the study alone, which hands it on
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t pid = 0;
  const int failed = posix_spawn(&pid, arguments[0], &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (failed) throw cases::FileError(command[0], std::strerror(failed));
  return pid;
}

/// The runs under way. None outlives the study: where it ends by an error they are told to stop, and write checkpoints.
struct Runs : std::vector<Running> {
  Runs() = default;
  Runs(const Runs&) = delete;
  Runs& operator=(const Runs&) = delete;
  ~Runs() {
    stop();
    for (const Running& r : *this) waitpid(r.pid, nullptr, 0);
  }
  void stop() const {
    for (const Running& r : *this) kill(r.pid, SIGTERM);
  }
};

int exit_code_of(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); }

}  // namespace

std::vector<JobResult> run_all(const std::vector<StudyCase>& study_cases, const JobOptions& options,
                               const std::function<bool()>& stop, const std::function<void(const std::string&)>& tell) {
  using Clock = std::chrono::steady_clock;
  std::filesystem::create_directories(options.folder);
  signal(SIGCHLD, SIG_DFL);  // who started us may ignore it: then nobody could say how a run ended
  std::vector<JobResult> results;
  const auto command_for = [&](const StudyCase& c) {
    return command_of(c, options.lahar, options.folder / c.name(), options.threads);
  };
  for (const StudyCase& c : study_cases) (void)command_for(c);  // before the first is started: a folder may be refused
  Runs running;
  std::size_t next = 0;
  bool stopping = false;
  while (!running.empty() || (next < study_cases.size() && !stopping)) {
    while (!stopping && next < study_cases.size() && running.size() < static_cast<std::size_t>(options.at_once)) {
      const StudyCase& c = study_cases[next++];
      const std::vector<std::string> command = command_for(c);  // another study may have done it meanwhile
      results.push_back({c, 0});
      if (command.empty()) continue;
      tell(fmt::format("{}: {}", c.name(), command[1] == "resume" ? "goes on" : "begins"));
      running.push_back({start(command, log_of(c, options.folder)), results.size() - 1, Clock::now()});
    }
    if (!stopping && stop()) {
      stopping = true;
      running.stop();
    }
    for (std::size_t k = 0; k < running.size();) {
      int status = 0;
      const pid_t ended = waitpid(running[k].pid, &status, WNOHANG);
      if (ended == 0) {
        ++k;
        continue;
      }
      JobResult& result = results[running[k].job];
      result.exit_code = ended < 0 ? cases::exit_bug : exit_code_of(status);
      const double minutes = std::chrono::duration<double>(Clock::now() - running[k].since).count() / 60;
      tell(fmt::format("{}: {} after {:.1f} min", result.study_case.name(),
                       result.exit_code == cases::exit_done ? "done" : fmt::format("exit code {}", result.exit_code),
                       minutes));
      running.erase(running.begin() + static_cast<std::ptrdiff_t>(k));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return results;
}

}  // namespace lahar::study
