// speed_error: what each knob costs and buys, on problems with known answers. Exit code 1 if a scene of a trial is
// refused.
#include <fmt/format.h>

#include <filesystem>

#include "cases/runner/interrupt.h"
#include "cases/runner/machine.h"
#include "cases/runner/messages.h"
#include "cases/runner/options.h"
#include "cases/runner/table_folder.h"
#include "cases/speed_error/report.h"
#include "core/parallel.h"

namespace lahar::validate {
namespace {

struct Arguments {
  std::vector<std::string> names;
  bool list = false, quick = false;
  cases::CommonOptions common;
};

std::vector<Problem> chosen_by(const Arguments& a) {
  cases::refuse_changes(a.common, "the study turns its own knobs, expected names of problems (see --list)");
  if (!a.common.precision.empty()) cases::refuse_command_line("--precision: the study turns this knob itself");
  return cases::ask_by_name([&] { return select_problems(a.names, a.quick); });
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
  const Sitting sitting{cases::machine_name(), cases::commit(), cases::today(), cases::threads_or_all(a.common.threads),
                        a.quick};
  const ThreadLimit limit(sitting.threads);
  cases::watch_for_interrupt();
  std::vector<ProblemResult> results;
  std::string refusals;
  for (const Problem& p : problems) {
    if (cases::interrupted()) break;
    if (!a.common.quiet) fmt::print("{}", heading_text(p));
    results.emplace_back();
    run_problem(p, fixed_work(), [&](const ProblemResult& so_far) {
      if (!a.common.quiet) fmt::print("{}", trial_text(so_far.trials.back(), so_far.work));
      std::fflush(stdout);
      results.back() = so_far;
      write_results(results, sitting, folder);
      return !cases::interrupted();
    });
    if (!a.common.quiet) fmt::print("{}", front_text(results.back()));
    refusals += refusals_text(results.back());
  }
  if (!a.common.quiet) fmt::print("report: {}\n", (folder / "report.html").string());
  cases::tell(refusals);
  if (cases::interrupted()) return cases::exit_interrupted;
  return refusals.empty() ? cases::exit_done : 1;
}

}  // namespace
}  // namespace lahar::validate

int main(int argc, char** argv) {
  using namespace lahar;
  CLI::App app("Runs problems with known answers with one knob turned at a time: error against time", "speed_error");
  cases::add_version(app);
  validate::Arguments arguments;
  app.add_option("problems", arguments.names, "Problems (default: all)")->type_name("NAME");
  app.add_flag("--list", arguments.list, "List the problems and their trials, and do not run them");
  app.add_flag("--quick", arguments.quick, "Coarser grids and fewer trials");
  cases::add_common_options(app, arguments.common,
                            {.out = "Folder for table, charts and report (default results/speed_error)"});
  return cases::parse_and_run(app, argc, argv, [&] { return validate::run(arguments); });
}
