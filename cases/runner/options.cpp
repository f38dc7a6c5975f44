#include "cases/runner/options.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <thread>

#include "cases/runner/interrupt.h"
#include "cases/runner/machine.h"
#include "cases/runner/messages.h"
#include "cases/scene/names.h"
#include "cases/scene/one_line.h"
#include "core/check.h"

namespace lahar::cases {
namespace {

using scene::on_one_line;

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// Of a program of several commands, what is said of a word in the place of one; empty if there is none.
std::string unknown_command(const CLI::App& app) {
  const std::vector<std::string> words = app.remaining();
  if (app.get_require_subcommand_min() == 0 || !app.get_subcommands().empty() || words.empty()) return "";
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands(nullptr)) known.push_back(command->get_name());
  const std::string nearest = scene::nearest_name(words.front(), known);
  const std::string hint = nearest.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", nearest);
  return fmt::format("\"{}\" is no command{}, expected one of {}", words.front(), hint, fmt::join(known, ", "));
}

}  // namespace

void add_common_options(CLI::App& app, CommonOptions& o, const Taken& taken) {
  app.add_option("--set", o.set, "Change a scene value: key.path=value, e.g. fluid.cell_size_m=0.02 (repeatable)")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  if (!taken.out.empty())
    app.add_option("--out", o.out, taken.out)->type_name("DIR")->check([](const std::string& folder) {
      return folder.empty() ? "is empty" : "";
    });
  app.add_option("--threads", o.threads, "Number of threads (default: all)")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  if (taken.precision)
    app.add_option("--precision", o.precision, "Number format of the fluid")
        ->check(CLI::IsMember(scene::words<scene::Precision>()))
        ->type_name("float|double");
  app.add_flag("--quiet", o.quiet, "Print nothing but mistakes and warnings of the run");
  if (taken.overwrite) app.add_flag("--overwrite", o.overwrite, "Replace a former run in the output folder");
}

void add_version(CLI::App& app) {
  app.set_version_flag("--version", app.get_name() + " " + version() + " (" + commit() + ")");
}

std::vector<std::string> overrides_of(const CommonOptions& options) {
  std::vector<std::string> all = options.set;
  if (!options.precision.empty()) all.push_back("run.precision=" + options.precision);
  return all;
}

RunOptions run_options(const CommonOptions& o, const scene::Scene& scene) {
  std::filesystem::path out = o.out;
  if (out.empty()) out = std::filesystem::path("results") / scene.identity.name;
  return {.out = out, .threads = o.threads, .quiet = o.quiet, .overwrite = o.overwrite};
}

int threads_or_all(int threads) {
  return threads > 0 ? threads : static_cast<int>(std::thread::hardware_concurrency());
}

std::string today() { return fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::chrono::system_clock::now())); }

void refuse_command_line(const std::string& why) {
  throw InputError(std::vector<InputMistake>{{"command line", 1, 1, why}});
}

void refuse_changes(const CommonOptions& options, const std::string& why) {
  if (!options.set.empty()) refuse_command_line("--set " + options.set.front() + ": " + why);
}

int guarded(const std::function<int()>& command) {
  try {
    return command();
  } catch (const InputError& e) {
    for (const InputMistake& m : e.mistakes()) tell(on_one_line(m.text()) + "\n");
    return exit_bad_input;
  } catch (const NumericalFailure& e) {
    tell(fmt::format("numerical failure: {}\n", on_one_line(e.what())));
    return exit_numerical_failure;
  } catch (const std::bad_alloc&) {
    tell("error: there is not enough memory (lahar check says what a scene takes)\n");
    return exit_bug;
  } catch (const std::exception& e) {
    tell(fmt::format("error: {}\n", on_one_line(e.what())));
    return exit_bug;
  }
}

int parse_and_run(CLI::App& app, int argc, char** argv, const std::function<int()>& command) {
  end_at_interrupt();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
    const std::string unknown = unknown_command(app);
    tell(fmt::format("command line:1:1: {}\n",
                     on_one_line(unknown.empty() ? first_line(e.what()) + ", expected what --help shows" : unknown)));
    return exit_bad_input;
  }
  const int code = guarded(command);
  if (code != exit_done || (std::fflush(stdout) == 0 && std::ferror(stdout) == 0)) return code;
  tell(fmt::format("error: standard output: {}\n", std::strerror(errno)));
  return exit_bug;
}

}  // namespace lahar::cases
