#include "cases/runner/output_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "cases/files/text_file.h"
#include "cases/runner/interrupt.h"
#include "cases/scene/writer.h"
#include "core/check.h"

namespace lahar::cases {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& place, const std::string& why, const std::string& option = "--out") {
  throw InputError(std::vector<InputMistake>{{option + " " + place.string(), 1, 1, why}});
}

void refuse_file(const fs::path& folder, const std::string& option = "--out") {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    refuse(folder, "is a file, expected a folder or a new name", option);
}

/// A chart of a run or of a procedure, of which each is written in three forms.
bool is_chart(const fs::path& name) {
  static constexpr std::array<std::string_view, 6> charts{"cable_forces",    "energy_dissipator",
                                                          "ring_pull",       "ring_pull_first_stage",
                                                          "rockfall_energy", "rockfall_displacement"};
  const fs::path ending = name.extension();
  return (ending == ".png" || ending == ".svg" || ending == ".pdf") &&
         std::find(charts.begin(), charts.end(), name.stem().string()) != charts.end();
}

/// A series or particle file that was damaged and set aside: NAME.damaged.h5, NAME.damaged2.h5, ...
bool is_set_aside(std::string_view name) {
  for (const std::string_view stem : {"series.damaged", "particles.damaged"}) {
    if (!name.starts_with(stem) || !name.ends_with(".h5")) continue;
    const std::string_view number = name.substr(stem.size(), name.size() - stem.size() - 3);
    return std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; });
  }
  return false;
}

/// Names of section 1 of the contract with the user, images, and what a killed run left of them half written.
bool written_by_run(const std::string& name) {
  static constexpr std::array<std::string_view, 10> names{
      "summary.json",      "scene.resolved.toml", "series.h5", "series.h5.open", "particles.h5",
      "particles.h5.open", "particles.xmf",       "bonds.xmf", "checkpoint.h5",  "run.log"};
  constexpr std::string_view half_written = ".part";
  if (name.ends_with(half_written)) return written_by_run(name.substr(0, name.size() - half_written.size()));
  if (std::find(names.begin(), names.end(), name) != names.end() || is_chart(name) || is_set_aside(name)) return true;
  return number_of_file(name, "fluid_", ".vdb") || number_of_file(name, "image_", ".png") ||
         number_of_file(name, "forces_", ".png");
}

constexpr const char* kAside = ".former_run";          // all of a former run
constexpr const char* kOnTheWay = ".former_run.part";  // what of it is not back in the folder; no new run has begun
constexpr const char* kGoing = ".former_run.gone";     // what is being removed

std::vector<fs::path> files_of_run(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && written_by_run(entry.path().filename().string())) files.push_back(entry.path());
  return files;
}

bool log_tells_of_steps(const fs::path& folder) {
  std::ifstream log(folder / "run.log");
  for (std::string line; std::getline(log, line);)
    if (line.ends_with(kStepsBeginMark)) return true;
  return false;
}

/// What a run writes before its first step says nothing that the next run does not.
bool holds_results(const fs::path& folder) {
  if (log_tells_of_steps(folder)) return true;
  const std::vector<fs::path> files = files_of_run(folder);
  return std::any_of(files.begin(), files.end(), [](const fs::path& file) {
    return file.filename() != "scene.resolved.toml" && file.filename() != "run.log";
  });
}

/// The first file of a run, where it was stopped before that was whole.
void remove_lone_beginning(const fs::path& folder) {
  const fs::path beginning = folder / "scene.resolved.toml.part";
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path() != beginning || !entry.is_regular_file()) return;
  fs::remove(beginning);
}

}  // namespace

bool holds_run(const fs::path& folder) {
  std::ifstream in(folder / "scene.resolved.toml");
  std::string first;
  return std::getline(in, first) && first.starts_with(scene::resolved_mark);
}

void create_folder(const fs::path& folder, const std::string& option) {
  const std::string expected = "), expected a folder that can be written to";
  refuse_file(folder, option);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) refuse(folder, "cannot be created (" + error.message() + expected, option);
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    refuse(folder, std::string("cannot be written to (") + std::strerror(errno) + expected, option);
}

void require_writable(const fs::path& file, const std::string& option) {
  std::error_code error;
  if (fs::is_directory(file, error)) refuse(file, "is a folder, expected a file", option);
  fs::path trial = file;
  trial += ".part";  // as replace_file does
  errno = 0;
  const bool opens = std::ofstream(trial, std::ios::binary).is_open();
  const std::string why = std::strerror(errno);
  if (!opens) refuse(file, "cannot be created (" + why + "), expected a file in a folder that is there", option);
  fs::remove(trial, error);
}

void require_record(const fs::path& file, const std::string& option, const std::string& program,
                    const std::function<bool(const std::string&)>& is_record) {
  require_writable(file, option);
  std::error_code error;
  if (!fs::exists(file, error) || fs::is_empty(file, error)) return;
  if (!is_record(read_text_file(file)))
    refuse(file, "is there and was not written by " + program + ", expected a new file or a former record", option);
}

void require_run_or_nothing(const fs::path& place, const std::string& option) {
  if (!fs::exists(place) || (fs::is_directory(place) && (fs::is_empty(place) || holds_run(place)))) return;
  refuse(place, "is there and holds no run, expected a run or nothing: another folder", option);
}

std::optional<std::int64_t> number_of_file(std::string_view name, std::string_view stem, std::string_view ending) {
  if (name.size() <= stem.size() + ending.size() || !name.starts_with(stem) || !name.ends_with(ending)) return {};
  const std::string_view digits = name.substr(stem.size(), name.size() - stem.size() - ending.size());
  std::int64_t number = 0;
  const bool read = std::from_chars(digits.data(), digits.data() + digits.size(), number).ec == std::errc();
  if (!read || number < 0 || digits != fmt::format("{:06}", number)) return {};
  return number;
}

FolderLock::FolderLock(const fs::path& folder) : handle_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (handle_ < 0 || ::flock(handle_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  ::close(handle_);
  throw InputError(std::vector<InputMistake>{
      {folder.string(), 1, 1, "a run is going on there, expected another folder, or the end of that run"}});
}

FolderLock::~FolderLock() {
  if (handle_ >= 0) ::close(handle_);
}

FormerRun::FormerRun(const fs::path& folder) : folder_(folder) {
  fs::create_directory(folder / kOnTheWay);
  for (const fs::path& file : files_of_run(folder)) fs::rename(file, folder / kOnTheWay / file.filename());
  fs::rename(folder / kOnTheWay, folder / kAside);
  say_at_interrupt("the former run is kept: lahar resume, or the next run, puts it back\n");
}

FormerRun::~FormerRun() {
  if (folder_.empty()) return;
  try {
    recover(folder_);
  } catch (const fs::filesystem_error&) {  // they stay aside, for the next command
  }
}

void FormerRun::remove() {
  if (!folder_.empty()) {
    fs::rename(folder_ / kAside, folder_ / kGoing);
    say_at_interrupt(nullptr);  // from here on it is not kept
    fs::remove_all(folder_ / kGoing);
  }
  folder_.clear();
}

void FormerRun::recover(const fs::path& folder) {
  if (!fs::is_directory(folder)) return;
  fs::remove_all(folder / kGoing);
  if (fs::is_directory(folder / kAside)) {
    for (const fs::path& file : files_of_run(folder)) fs::remove(file);
    fs::rename(folder / kAside, folder / kOnTheWay);
  }
  if (!fs::is_directory(folder / kOnTheWay)) return;
  for (const fs::path& file : files_of_run(folder / kOnTheWay)) fs::rename(file, folder / file.filename());
  fs::remove(folder / kOnTheWay);
}

PreparedFolder prepare_output(const fs::path& folder, bool overwrite) {
  create_folder(folder);
  FolderLock lock(folder);
  try {
    FormerRun::recover(folder);
    remove_lone_beginning(folder);
    if (fs::is_empty(folder)) return {std::move(lock), {}};
    if (!holds_run(folder)) refuse(folder, "is not empty and holds no former run, expected a new or an empty folder");
    if (!overwrite && holds_results(folder))
      refuse(folder, "holds a former run, expected a new folder, or --overwrite to replace that run");
    return {std::move(lock), FormerRun(folder)};
  } catch (const fs::filesystem_error& e) {
    refuse(folder, fmt::format("cannot be made ready ({}: {}), expected a folder that can be read and written to",
                               e.path1().string(), e.code().message()));
  }
}

}  // namespace lahar::cases
