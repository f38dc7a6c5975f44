// lahar: runs and checks scenes.
#include <fmt/format.h>

#include "cases/assembly/load.h"
#include "cases/assembly/simulation.h"
#include "cases/observers/observer_list.h"
#include "cases/observers/quantity_tables.h"
#include "cases/runner/check.h"
#include "cases/runner/interrupt.h"
#include "cases/runner/options.h"
#include "cases/runner/resume.h"
#include "cases/runner/run.h"
#include "cases/scene/key_list.h"

namespace lahar::cases {
namespace {

struct Arguments {
  std::string scene_file, folder;
  CommonOptions common;
  bool patterns = false;
};

int run_with_options(const scene::Scene& scene, const RunOptions& options) {
  const RunResult result = run_to_folder(scene, options, run_scene);
  if (!options.quiet)
    fmt::print("{}{}results are in {}\n", results_table(result.summary), result.interrupted ? "interrupted; " : "",
               options.out.string());
  return result.interrupted ? exit_interrupted : exit_done;
}

int run(const Arguments& arguments) {
  const scene::Scene scene = scene::load(arguments.scene_file, overrides_of(arguments.common));
  return run_with_options(scene, run_options(arguments.common, scene));
}

int resume(const Arguments& arguments) {
  const scene::Scene scene = load_resumed(arguments.folder, overrides_of(arguments.common));
  RunOptions options = run_options(arguments.common, scene);
  options.out = arguments.folder;
  options.resume = true;
  return run_with_options(scene, options);
}

int check(const Arguments& arguments) {
  const scene::Scene scene = scene::load(arguments.scene_file, overrides_of(arguments.common));
  const CheckReport report = check_scene(scene, threads_or_all(arguments.common.threads));
  if (!arguments.common.quiet) fmt::print("{}", report_text(scene, report));
  return exit_done;
}

int quantities(const Arguments& arguments) {
  const scene::Scene scene = scene::load(arguments.scene_file, overrides_of(arguments.common));
  const auto simulation = build_simulation(scene, Beginning::checkpoint);
  const ObserverList observers(scene, *simulation);
  if (!arguments.common.quiet)
    fmt::print("{}", quantity_tables(observers.quantities(), arguments.patterns ? Naming::patterns : Naming::names));
  return exit_done;
}

int keys() {
  fmt::print("{}", scene::reference_page());
  return exit_done;
}

}  // namespace
}  // namespace lahar::cases

int main(int argc, char** argv) {
  using namespace lahar::cases;
  CLI::App app("Lahar: debris flow on flexible ring-net barriers", "lahar");
  add_version(app);
  app.require_subcommand(1);
  Arguments arguments;
  const auto add = [&](const char* name, const char* what, const Taken& taken) {
    CLI::App* command = app.add_subcommand(name, what);
    command->add_option("scene", arguments.scene_file, "Scene file (TOML)")->required()->type_name("SCENE.toml");
    add_common_options(*command, arguments.common, taken);
    return command;
  };
  const CLI::App* run_command = add("run", "Run a scene", {});
  CLI::App* resume_command = app.add_subcommand("resume", "Go on with a run from its last checkpoint");
  resume_command->add_option("folder", arguments.folder, "Folder of the run (its --out)")
      ->required()
      ->type_name("DIR")
      ->check([](const std::string& folder) { return folder.empty() ? "is empty" : ""; });
  add_common_options(*resume_command, arguments.common, {.out = "", .overwrite = false});  // a run goes on in its own
  const CLI::App* check_command = add("check", "Validate a scene and print what it will take",
                                      {.out = "As of the run to come; nothing is written", .overwrite = false});
  CLI::App* quantities_command = add("quantities", "Print what a run of a scene measures (Markdown)",
                                     {.out = "As of the run to come; nothing is written", .overwrite = false});
  quantities_command->add_flag("--patterns", arguments.patterns, "PROBE, SECTION, PART and AXIS in place of names");
  app.add_subcommand("keys", "Print the reference of all scene keys (Markdown)");
  return parse_and_run(app, argc, argv, [&] {
    if (*run_command) return run(arguments);
    if (*resume_command) return resume(arguments);
    if (*check_command) return check(arguments);
    if (*quantities_command) return quantities(arguments);
    return keys();
  });
}
