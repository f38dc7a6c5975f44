#include "cases/runner/output_folder.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

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

/// Names of section 1 of the contract with the user, and images.
bool written_by_run(const std::string& name) {
  static constexpr std::array<std::string_view, 16> names{
      "summary.json",      "scene.resolved.toml", "series.h5",         "series.h5.open",
      "series.damaged.h5", "particles.h5",        "particles.h5.open", "particles.damaged.h5",
      "particles.xmf",     "bonds.xmf",           "checkpoint.h5",     "report.html",
      "run.log",           "cable_forces.png",    "cable_forces.svg",  "cable_forces.pdf"};
  if (std::find(names.begin(), names.end(), name) != names.end()) return true;
  return (name.starts_with("fluid_") && name.ends_with(".vdb")) ||
         ((name.starts_with("image_") || name.starts_with("forces_")) && name.ends_with(".png"));
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

void prepare_output(const fs::path& folder, bool overwrite) {
  std::error_code error;
  refuse_file(folder);
  if (fs::is_directory(folder, error) && !fs::is_empty(folder, error)) {
    if (!holds_run(folder)) refuse(folder, "is not empty and holds no former run, expected a new or an empty folder");
    if (!overwrite) refuse(folder, "holds a former run, expected a new folder, or --overwrite to replace that run");
    std::vector<fs::path> old;
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.is_regular_file() && written_by_run(entry.path().filename().string())) old.push_back(entry.path());
    for (const fs::path& path : old) fs::remove(path);
  }
  create_folder(folder);
}

}  // namespace lahar::cases
