// compare_cfd_dem: the paper's debris flows, resolved and averaged, beside what the paper reports.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cases/assembly/load.h"
#include "cases/compare_cfd_dem/jobs.h"
#include "cases/compare_cfd_dem/over_seeds.h"
#include "cases/compare_cfd_dem/record.h"
#include "cases/compare_cfd_dem/report.h"
#include "cases/compare_cfd_dem/trends.h"
#include "cases/files/output_file.h"
#include "cases/files/text_file.h"
#include "cases/runner/check.h"
#include "cases/runner/interrupt.h"
#include "cases/runner/machine.h"
#include "cases/runner/messages.h"
#include "cases/runner/options.h"
#include "cases/runner/output_folder.h"
#include "cases/runner/progress.h"

namespace lahar::study {
namespace {

struct Arguments {
  Selection selection;
  std::string records;
  int at_once = 1;
  bool list = false, estimate = false, report_only = false;
  cases::CommonOptions common;
};

std::filesystem::path own_folder() { return std::filesystem::read_symlink("/proc/self/exe").parent_path(); }

std::string program_of(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "summary.json";
  CaseResult result;
  take_summary(result, cases::read_text_file(file), file);
  return result.commit.empty() ? "an unknown commit" : "commit " + result.commit;
}

constexpr const char* kToDo = "to do";

std::string standing_text(const StudyCase& c, const std::filesystem::path& folder) {
  try {
    const Standing s = standing_of(c, folder);
    return s == Standing::done      ? "done, by " + program_of(folder)
           : s == Standing::begun   ? "begun"
           : s == Standing::foreign ? "in its folder is something else"
           : s == Standing::refused ? "in its folder is a scene that this program refuses"
                                    : kToDo;
  } catch (const cases::FileError& error) {
    return error.what();
  }
}

/// Threads of each of the runs at once.
int threads_of_a_run(const Arguments& a) { return std::max(1, cases::threads_or_all(a.common.threads) / a.at_once); }

/// What `lahar check` says that a case will take.
std::string estimate_text(const StudyCase& c, int threads) {
  try {
    const cases::CheckReport report = cases::check_scene(scene::load(c.scene_file(), c.changes()), threads);
    const double bytes = report.fluid ? report.fluid->expected_bytes : 0;
    return fmt::format("about {}, memory of the fluid up to about {:.3g} GB", cases::time_text(report.run_time),
                       bytes * 1e-9);
  } catch (const InputError& error) {  // more than this machine's memory, say
    return error.mistakes().front().message;
  }
}

void list(const std::vector<StudyCase>& study_cases, const Arguments& a) {
  const int threads = threads_of_a_run(a);
  for (const StudyCase& c : study_cases) {
    const std::string standing = standing_text(c, std::filesystem::path(a.common.out) / c.name());
    const bool estimated = a.estimate && standing == kToDo;
    fmt::print("{}: {}{}\n", c.name(), standing, estimated ? ", " + estimate_text(c, threads) : "");
    std::fflush(stdout);
  }
}

/// Whether a case that nobody asked for is done, with these values, or has files that its reader will complain of. Its
/// folder may be of other values.
bool may_be_done(const StudyCase& there, const std::filesystem::path& folder) {
  try {
    const Standing s = standing_of(there, folder);
    return s == Standing::done || s == Standing::refused;
  } catch (const InputError&) {  // these values are none for it
    return false;
  } catch (const cases::FileError&) {
    return true;
  }
}

/// What is done of the cases asked for and of those that are in the folder besides. Those whose files cannot be read
/// are left out, and said to be: they do not cost the others their page.
std::vector<CaseResult> results_in(const std::filesystem::path& folder, std::vector<StudyCase> asked,
                                   const std::vector<std::string>& further) {
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (const auto there = case_named(entry.path().filename().string(), further);
        there && entry.is_directory() && std::find(asked.begin(), asked.end(), *there) == asked.end() &&
        may_be_done(*there, entry.path()))
      asked.push_back(*there);
  std::vector<CaseResult> results;
  for (const StudyCase& c : asked) try {
      const Standing s = standing_of(c, folder / c.name());
      if (s == Standing::done) results.push_back(read_case(c, folder / c.name()));
      if (s == Standing::refused)
        cases::tell(fmt::format("warning: {} is left out: this program refuses its scene.resolved.toml\n", c.name()));
    } catch (const cases::FileError& error) {
      cases::tell(fmt::format("warning: {} is left out: {}\n", c.name(), error.what()));
    }
  return results;
}

bool holds(const std::vector<CaseResult>& results, const StudyCase& study_case) {
  return std::any_of(results.begin(), results.end(), [&](const CaseResult& c) { return c.study_case == study_case; });
}

/// What is done, and the page about it.
void report(const std::vector<StudyCase>& study_cases, const Arguments& a) {
  const std::filesystem::path folder = a.common.out;
  std::vector<CaseResult> results = results_in(folder, study_cases, a.selection.further);
  if (!a.records.empty()) results = share(std::move(results), a.records);
  std::sort(results.begin(), results.end(),
            [](const CaseResult& x, const CaseResult& y) { return comes_before(x.study_case, y.study_case); });
  Sitting sitting{cases::commit(), cases::today(), {}};
  for (const StudyCase& c : study_cases)
    if (!holds(results, c)) sitting.missing.push_back(c.name());
  write_report(results, sitting, folder);
  if (a.records.empty()) return;
  const std::filesystem::path records = a.records;
  cases::replace_text_file(records / kComparisonTable, comparison_csv(results));
  cases::replace_text_file(records / "trends.csv", trends_csv(trends(results)));
  cases::replace_text_file(records / "nearness.csv", nearness_csv(nearness(results)));
  cases::replace_text_file(records / "checks.csv", checks_csv(results));
  cases::replace_text_file(records / "over_seeds.csv", over_seeds_csv(over_seeds(results)));
}

int run(const Arguments& a) {
  const std::vector<StudyCase> study_cases = cases_of(a.selection);
  if (!a.records.empty() && !a.selection.further.empty())
    cases::refuse_command_line(
        "--records with --set or --precision: records are of the study's own values, expected one of the two");
  check_changes(study_cases);
  require_study_folder(a.common.out, "--out");
  if (a.list || a.estimate) return list(study_cases, a), cases::exit_done;
  if (!a.records.empty()) require_study_folder(a.records, "--records");
  if (a.report_only && a.records.empty() && !std::filesystem::exists(a.common.out))
    throw InputError(std::vector<InputMistake>{
        {"--out " + a.common.out, 1, 1, "does not exist, expected a folder with cases to report of, or --records"}});
  cases::create_folder(a.common.out);
  if (!a.records.empty()) cases::create_folder(a.records, "--records");
  int code = cases::exit_done;
  if (!a.report_only) {
    const JobOptions options{own_folder() / "lahar", a.common.out, a.at_once, threads_of_a_run(a)};
    for (const StudyCase& c : study_cases) (void)command_of(c, options.lahar, options.folder / c.name(), 1);
    cases::watch_for_interrupt();
    const auto tell = [&](const std::string& line) {
      if (a.common.quiet) return;
      fmt::print("{}\n", line);
      std::fflush(stdout);
    };
    for (const JobResult& job : run_all(study_cases, options, cases::interrupted, tell)) {
      if (job.exit_code == cases::exit_done) continue;
      code = job.exit_code;
      if (code != cases::exit_interrupted)
        cases::tell(fmt::format("error: {} ended with exit code {}: {} says why\n", job.study_case.name(), code,
                                log_of(job.study_case, options.folder).string()));
    }
    if (cases::interrupted()) code = cases::exit_interrupted;
  }
  report(study_cases, a);
  if (!a.common.quiet) fmt::print("report: {}\n", (std::filesystem::path(a.common.out) / "report.html").string());
  return code;
}

std::string choices_text(const std::vector<Choice>& all) {
  std::string text;
  for (const Choice& c : all) text += fmt::format("\n  {}: {}", c.name, c.meaning);
  return text;
}

}  // namespace
}  // namespace lahar::study

int main(int argc, char** argv) {
  using namespace lahar;
  CLI::App app(
      "Runs the ten debris flows of Li, Zhao & Kwan 2020, resolved and averaged, and compares. What is done is not run "
      "again; what was interrupted goes on.",
      "compare_cfd_dem");
  cases::add_version(app);
  study::Arguments a;
  a.common.out = "results/compare_cfd_dem";
  study::Selection& s = a.selection;
  app.add_option("--sweep", s.sweeps, "as_printed, matched; default both" + study::choices_text(study::sweeps()));
  app.add_option("--release", s.releases, "Distances of the net from the mixture's upstream end, m; default all ten");
  app.add_option("--preset", s.presets, "default coarse" + study::choices_text(study::presets()));
  app.add_option("--coupling", s.couplings, "default resolved and averaged" + study::choices_text(study::couplings()));
  app.add_option("--seed", s.seeds, "Seeds of the packing; default 1");
  app.add_option("--variant", s.variants, "default study" + study::choices_text(study::variants()));
  app.add_option("--records", a.records,
                 "Folder of small records of cases: those of this study are written there, and what it holds of others "
                 "is in the report too");
  app.add_option("--at-once", a.at_once, "Runs at once, which share the threads")->check(CLI::Range(1, 64));
  app.add_flag("--list", a.list, "Say of each case whether it is done, and run nothing");
  app.add_flag("--estimate", a.estimate,
               "As --list, and for each case that is to do what lahar check says that it will take: a second a case");
  app.add_flag("--report", a.report_only, "Only write the report, of all cases in the folder that are done");
  cases::add_common_options(app, a.common,
                            {.out = "Folder of the study (default results/compare_cfd_dem)", .overwrite = false});
  app.get_option("--set")->description("Change a value of every scene: key.path=value (repeatable)");
  app.get_option("--threads")->description("Threads of all runs together (default: all)");
  return cases::parse_and_run(app, argc, argv, [&] {
    s.further = cases::overrides_of(a.common);
    return study::run(a);
  });
}
