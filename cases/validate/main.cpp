// validate: runs the ladder of questions with known answers. Exit code 1 if one falls short.
#include <fmt/format.h>

#include "cases/files/output_file.h"
#include "cases/runner/interrupt.h"
#include "cases/runner/options.h"
#include "cases/runner/output_folder.h"
#include "cases/validate/entry.h"
#include "core/parallel.h"

namespace lahar::validate {
namespace {

struct Arguments {
  std::vector<std::string> names;
  std::string json;
  bool list = false, quick = false;
  cases::CommonOptions common;
};

std::vector<Entry> chosen_by(const Arguments& a) {
  cases::refuse_changes(a.common, "the entries have no keys to set, expected names of entries (see --list)");
  return cases::ask_by_name([&] { return select_entries(all_entries(), a.names); });
}

/// Makes the folder of charts.
Context context_of(const Arguments& a) {
  Context context;
  if (a.common.precision == "float") context.precision = Precision::float32;
  context.quick = a.quick;
  if (!a.common.out.empty()) {
    context.plots = a.common.out;
    cases::create_folder(context.plots);
  }
  if (!a.json.empty()) cases::require_record(a.json, "--json", "validate", is_outcomes_json);
  return context;
}

int run(const Arguments& a) {
  const std::vector<Entry> entries = chosen_by(a);
  if (a.list) {
    for (const Entry& e : entries)
      fmt::print("{:<44} {:<28} {}\n", e.name, e.alias.empty() ? "" : "(" + e.alias + ")", e.source.line());
    return cases::exit_done;
  }
  const Context context = context_of(a);
  const ThreadLimit limit(cases::threads_or_all(a.common.threads));
  cases::watch_for_interrupt();
  std::vector<Outcome> outcomes;
  for (const Entry& e : entries) {
    if (cases::interrupted()) break;
    outcomes.push_back(run_entry(e, context));
    if (!a.common.quiet) fmt::print("{}", outcome_text(outcomes.back()));
    std::fflush(stdout);
    if (!a.json.empty()) cases::replace_text_file(a.json, outcomes_json(outcomes, context));
  }
  std::size_t reached = 0;
  for (const Outcome& o : outcomes) reached += o.pass();
  if (!a.common.quiet) fmt::print("{} of {} entries reach their bars\n", reached, outcomes.size());
  if (cases::interrupted()) return cases::exit_interrupted;
  return reached == outcomes.size() ? cases::exit_done : 1;
}

}  // namespace
}  // namespace lahar::validate

int main(int argc, char** argv) {
  using namespace lahar;
  CLI::App app("Runs Lahar against known answers", "validate");
  cases::add_version(app);
  validate::Arguments arguments;
  app.add_option("names", arguments.names, "Entries or groups (default: all)")->type_name("NAME|GROUP");
  app.add_flag("--list", arguments.list, "List the entries, their aliases and sources, and do not run them");
  app.add_flag("--quick", arguments.quick, "Coarser grids and fewer steps: minutes instead of hours, fewer bars");
  app.add_option("--json", arguments.json, "Write the results there")->type_name("FILE");
  cases::add_common_options(app, arguments.common,
                            {.out = "Folder for charts (default: none are drawn)", .overwrite = false});
  return cases::parse_and_run(app, argc, argv, [&] { return validate::run(arguments); });
}
