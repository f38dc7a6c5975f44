#include "cases/runner/resume.h"

#include <algorithm>

#include "cases/assembly/load.h"
#include "cases/runner/checkpoint.h"
#include "cases/runner/output_folder.h"
#include "cases/scene/one_line.h"
#include "core/check.h"
#include "core/number_text.h"

namespace lahar::cases {

namespace {

std::string list_text(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string key_of(const std::string& assignment) {
  const std::string key = assignment.substr(0, assignment.find('='));
  const auto from = key.find_first_not_of(" \t"), to = key.find_last_not_of(" \t");
  return from == std::string::npos ? "" : key.substr(from, to - from + 1);
}

}  // namespace

const std::vector<std::string>& resumable_keys() {
  static const std::vector<std::string> keys{
      "run.duration_s",           "run.series_interval_s",     "run.output_interval_s", "run.image_interval_s",
      "run.force_map_interval_s", "run.checkpoint_interval_s", "run.checkpoint_wall_s", "scene.title"};
  return keys;
}

scene::Scene load_resumed(const std::filesystem::path& folder, const std::vector<std::string>& overrides) {
  if (std::error_code none; std::filesystem::is_directory(folder, none)) {
    const FolderLock lock(folder);
    FormerRun::recover(folder);  // of a run that was to replace it and was stopped before it began
  }
  std::vector<InputMistake> mistakes;
  if (!holds_run(folder))
    mistakes.push_back({folder.string(), 1, 1, "holds no run, expected the --out folder of a run"});
  const auto& keys = resumable_keys();
  for (const std::string& text : overrides)
    // The precision may be named: one that is not that of the checkpoint is another scene.
    if (key_of(text) != "run.precision" && std::find(keys.begin(), keys.end(), key_of(text)) == keys.end())
      mistakes.push_back({"--set " + scene::on_one_line(text), 1, 1,
                          "cannot change in a run that goes on, expected one of " + list_text(keys)});
  if (!mistakes.empty()) throw InputError(mistakes);
  scene::Scene scene = scene::load(folder / "scene.resolved.toml", overrides);
  const CheckpointHead head = read_head(folder, scene);
  // A run ends with the first step that reaches its duration, at most a step beyond it: its own duration may be asked
  // for again.
  const auto shortened = std::find_if(overrides.begin(), overrides.end(),
                                      [](const std::string& text) { return key_of(text) == "run.duration_s"; });
  if (shortened != overrides.end() && scene.run.duration < head.time * (1 - 1e-9) &&
      scene.run.duration != scene::load(folder / "scene.resolved.toml").run.duration)
    throw InputError(
        std::vector<InputMistake>{{"--set " + scene::on_one_line(*shortened), 1, 1,
                                   "run.duration_s is " + number_text(scene.run.duration) + ", expected at least the " +
                                       number_text(head.time) + " s that the checkpoint has reached"}});
  return scene;
}

}  // namespace lahar::cases
