// speed_error: what each knob costs and buys, on problems with known answers. Exit code 1 if a scene of a trial is
// refused.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "cases/runner/interrupt.h"
#include "cases/runner/machine.h"
#include "cases/runner/options.h"
#include "cases/runner/table_folder.h"
#include "cases/speed_error/report.h"
#include "core/check.h"
#include "core/parallel.h"

namespace lahar::validate {
namespace {

struct Arguments {
  std::vector<std::string> names;
  bool list = false, quick = false;
  cases::CommonOptions common;
};

[[noreturn]] void refuse(const std::string& why) {
  throw InputError(std::vector<InputMistake>{{"command line", 1, 1, why}});
}

std::vector<Problem> chosen_by(const Arguments& a) {
  if (!a.common.set.empty())
    refuse("--set " + a.common.set.front() +
           ": the study turns its own knobs, expected names of problems (see --list)");
  if (!a.common.precision.empty()) refuse("--precision: the study turns this knob itself");
  try {
    return select_problems(a.names, a.quick);
  } catch (const std::invalid_argument& e) {
    refuse(e.what());
  }
}

int run(const Arguments& a) {
  const std::vector<Problem> problems = chosen_by(a);
  if (a.list) {
    for (const Problem& p : problems) {
      fmt::print("{}: {}, against {} values; defaults: {}\n", p.name, p.error, p.against, p.defaults);
      for (const Trial& t : p.trials) fmt::print("  {}\n", t.name());
    }
    return cases::exit_done;
  }
  const std::filesystem::path folder = a.common.out.empty() ? "results/speed_error" : a.common.out;
  cases::prepare_table_folder(folder, kSpeedErrorTable, kSpeedErrorColumns, a.common.overwrite);
  Sitting sitting{
      cases::machine_name(), cases::commit(), fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::chrono::system_clock::now())),
      a.common.threads > 0 ? a.common.threads : static_cast<int>(std::thread::hardware_concurrency()), a.quick};
  const ThreadLimit limit(sitting.threads);
  cases::watch_for_interrupt();
  std::vector<ProblemResult> results;
  std::string refusals;
  for (const Problem& p : problems) {
    if (cases::interrupted()) break;
    results.push_back(run_problem(p, fixed_work()));
    if (!a.common.quiet) fmt::print("{}", result_text(results.back()));
    std::fflush(stdout);
    refusals += refusals_text(results.back());
    write_results(results, sitting, folder);
  }
  if (!a.common.quiet) fmt::print("report: {}\n", (folder / "report.html").string());
  fmt::print(stderr, "{}", refusals);
  if (cases::interrupted()) return cases::exit_interrupted;
  return refusals.empty() ? cases::exit_done : 1;
}

}  // namespace
}  // namespace lahar::validate

int main(int argc, char** argv) {
  using namespace lahar;
  CLI::App app("Runs problems with known answers with one knob turned at a time: error against time", "speed_error");
  app.set_version_flag("--version", "speed_error " + cases::version() + " (" + cases::commit() + ")");
  validate::Arguments arguments;
  app.add_option("problems", arguments.names, "Problems (default: all)")->type_name("NAME");
  app.add_flag("--list", arguments.list, "List the problems and their trials, and do not run them");
  app.add_flag("--quick", arguments.quick, "Coarser grids and fewer trials");
  cases::add_common_options(app, arguments.common);
  return cases::parse_and_run(app, argc, argv, [&] { return validate::run(arguments); });
}
