// hard_cases: runs the scenes that break codes of this kind. Exit code 1 if one falls short.
#include <fmt/format.h>

#include <filesystem>

#include "cases/files/output_file.h"
#include "cases/hard_cases/hard_cases.h"
#include "cases/runner/interrupt.h"
#include "cases/runner/options.h"
#include "cases/runner/table_folder.h"
#include "core/parallel.h"

namespace lahar::validate {
namespace {

struct Arguments {
  std::vector<std::string> ids;
  bool list = false, quick = false;
  cases::CommonOptions common;
};

std::vector<HardCase> chosen_by(const Arguments& a) {
  cases::refuse_changes(a.common, "hard cases have no keys to set, expected their ids (see --list)");
  return cases::ask_by_name([&] { return select_hard_cases(a.ids); });
}

std::string list_text(const std::vector<HardCase>& cases) {
  std::string text;
  for (const HardCase& c : cases)
    text +=
        fmt::format("{:<4} {}\n     passed: {}\n     {}\n", c.id, c.question, c.criterion, fmt::join(c.entries, ", "));
  return text;
}

int run(const Arguments& a) {
  const std::vector<HardCase> cases = chosen_by(a);
  if (a.list) {
    fmt::print("{}", list_text(cases));
    return cases::exit_done;
  }
  Context context;
  context.quick = a.quick;
  if (a.common.precision == "float") context.precision = Precision::float32;
  const std::filesystem::path folder = a.common.out.empty() ? "results/hard_cases" : a.common.out;
  cases::prepare_table_folder(folder, kHardCasesTable, kHardCasesColumns, a.common.overwrite);
  const std::string date = cases::today();
  const ThreadLimit limit(cases::threads_or_all(a.common.threads));
  cases::watch_for_interrupt();
  std::vector<HardCaseResult> results;
  std::size_t passed = 0;
  for (const HardCase& c : cases) {
    if (cases::interrupted()) break;
    results.push_back(run_hard_case(c, context));
    passed += results.back().pass();
    if (!a.common.quiet) fmt::print("{}", result_text(results.back()));
    std::fflush(stdout);
    cases::replace_text_file(folder / kHardCasesTable, results_csv(results, context, date));
  }
  if (!a.common.quiet)
    fmt::print("{} of {} hard cases are passed; every figure: {}\n", passed, results.size(),
               (folder / kHardCasesTable).string());
  if (cases::interrupted()) return cases::exit_interrupted;
  return passed == results.size() ? cases::exit_done : 1;
}

}  // namespace
}  // namespace lahar::validate

int main(int argc, char** argv) {
  using namespace lahar;
  CLI::App app("Runs the scenes that break codes of this kind", "hard_cases");
  cases::add_version(app);
  validate::Arguments arguments;
  app.add_option("ids", arguments.ids, "Cases, such as H3 (default: all)")->type_name("ID");
  app.add_flag("--list", arguments.list, "List the cases and when they count as passed, and do not run them");
  app.add_flag("--quick", arguments.quick, "Coarser grids and fewer steps, fewer bars");
  cases::add_common_options(app, arguments.common, {.out = "Folder for the table (default results/hard_cases)"});
  return cases::parse_and_run(app, argc, argv, [&] { return validate::run(arguments); });
}
