#include "cases/procedure/procedure.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>

#include "cases/files/output_file.h"
#include "cases/runner/interrupt.h"
#include "cases/runner/machine.h"
#include "cases/runner/output_folder.h"
#include "core/check.h"
#include "core/parallel.h"

namespace lahar::cases {

namespace {

/// What is known whatever the procedure.
void complete(Summary& summary, const Workplace& place, double wall_seconds) {
  summary.case_name = place.name;
  summary.version = version();
  summary.commit = commit();
  summary.machine = machine_name();
  summary.threads = place.threads;
  summary.precision = "double";
  summary.wall_seconds = wall_seconds;
  summary.performance.peak_rss_bytes = peak_rss_bytes();
}

}  // namespace

int run_in_folder(const Workplace& place, bool overwrite, const std::string& resolved,
                  const std::function<bool(Summary&)>& body) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  PreparedFolder prepared = prepare_output(place.out, overwrite);
  prepared.former.remove();
  replace_text_file(place.out / "scene.resolved.toml", resolved);
  watch_for_interrupt();
  const ThreadLimit limit(place.threads);
  Summary summary;
  const auto write = [&] {
    complete(summary, place, std::chrono::duration<double>(Clock::now() - start).count());
    write_summary(place.out, summary);
  };
  bool finished = false;
  try {
    finished = body(summary);
  } catch (const NumericalFailure&) {
    if (!summary.checks.empty()) write();
    throw;
  }
  write();
  if (!place.quiet)
    fmt::print("{}{}results are in {}\n", results_table(summary), finished ? "" : "interrupted; ", place.out.string());
  return finished ? exit_done : exit_interrupted;
}

void add_procedure_options(CLI::App& app, ProcedureArguments& arguments) {
  add_version(app);
  app.add_option("parameters", arguments.file, "Parameter file (default: the paper's values)")
      ->type_name("PARAMETERS.toml");
  add_common_options(app, arguments.common, {.out = "Folder for results (default results/" + app.get_name() + ")"});
  app.get_option("--precision")->description("Taken like everywhere; solids are computed in double");
}

Workplace workplace_of(const ProcedureArguments& arguments, const std::string& name) {
  const CommonOptions& o = arguments.common;
  Workplace place{o.out, name, threads_or_all(o.threads), o.quiet};
  if (o.out.empty()) place.out = std::filesystem::path("results") / name;
  return place;
}

}  // namespace lahar::cases
