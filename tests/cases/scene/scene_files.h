#pragma once
// Scenes as text for tests.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "cases/assembly/load.h"
#include "core/check.h"

namespace lahar::scene {

/// A folder of its own for a test, gone afterwards.
class ScratchFolder {
 public:
  ScratchFolder() {
    static int number = 0;  // a test may have several
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test->test_suite_name()) + "_" + test->name() + "_" + std::to_string(getpid()) +
                       "_" + std::to_string(++number);
    for (char& c : name)
      if (c == '/') c = '_';
    path_ = std::filesystem::temp_directory_path() / name;
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

inline std::filesystem::path source_folder() { return LAHAR_SOURCE_DIR; }
inline std::filesystem::path case_file(const std::string& name) { return source_folder() / "cases" / name; }

inline std::string file_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// All scene files of the cases, by their path below cases/; files of parameters of procedures have no [scene].
inline std::vector<std::string> scene_files() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(case_file("")))
    if (entry.path().extension() == ".toml" && file_text(entry.path()).find("\n[scene]\n") != std::string::npos)
      names.push_back(std::filesystem::relative(entry.path(), case_file("")).string());
  std::sort(names.begin(), names.end());
  return names;
}

/// For tests of one file each: its path in letters, digits and `_`.
inline std::string name_of_test(const testing::TestParamInfo<std::string>& file) {
  std::string name = file.param;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
}

/// The scene of the debris flow. Loading it builds its net once to see that it can be built: a small one here, to save
/// time.
inline Scene debris_flow() {
  static const Scene loaded = [] {
    Scene scene = load(case_file("debris_flow/scene.toml"), {"barrier.net.width_m=0.38", "barrier.net.height_m=0.26"});
    scene.barrier.net.width = 1.8;
    scene.barrier.net.height = 0.96;
    return scene;
  }();
  return loaded;
}

/// The smallest scene: a sphere in a box.
inline const std::string small_scene = R"([scene]
name = "small"
[run]
duration_s = 1.0
[domain]
lower_m = [0, 0, 0]
upper_m = [1, 1, 1]
[materials.rock]
youngs_modulus_Pa = 1e9
poisson_ratio = 0.3
[[grains.sphere]]
position_m = [0.5, 0.5, 0.5]
diameter_m = 0.1
density_kg_m3 = 2500
material = "rock"
)";

/// What loading reports, file names without their folder: "scene.toml:4:5: ...".
inline std::vector<std::string> mistakes_in(const std::filesystem::path& file,
                                            const std::vector<std::string>& set = {}) {
  std::vector<std::string> all;
  try {
    load(file, set);
  } catch (const InputError& e) {
    for (InputMistake m : e.mistakes()) {
      if (!m.file.starts_with("--set")) m.file = std::filesystem::path(m.file).filename();
      all.push_back(m.text());
    }
  }
  return all;
}

inline std::vector<std::string> mistakes_in_text(const std::string& text, const std::vector<std::string>& set = {}) {
  const ScratchFolder scratch;
  return mistakes_in(scratch.write("scene.toml", text), set);
}

inline Scene load_text(const std::string& text, const std::vector<std::string>& set = {}) {
  const ScratchFolder scratch;
  return load(scratch.write("scene.toml", text), set);
}

}  // namespace lahar::scene
