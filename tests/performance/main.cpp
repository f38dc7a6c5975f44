// benchmark: the speed ladder. Measures the machine's memory rate and then its own speed, in one run. Exit code 1 if an
// entry falls short of its bar.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cases/files/output_file.h"
#include "cases/runner/interrupt.h"
#include "cases/runner/machine.h"
#include "cases/runner/options.h"
#include "cases/runner/output_folder.h"
#include "cases/scene/names.h"
#include "core/parallel.h"
#include "tests/performance/benchmark.h"
#include "tests/performance/stream.h"

namespace lahar::performance {

double Session::value_of(const std::string& name) const {
  for (const Figure& f : figures)
    if (f.name == name) return f.value;
  return 0;
}

double best_seconds(int repeats, const std::function<void()>& body) {
  using Clock = std::chrono::steady_clock;
  double best = 1e300;
  for (int r = 0; r < repeats; ++r) {
    const auto start = Clock::now();
    body();
    best = std::min(best, std::chrono::duration<double>(Clock::now() - start).count());
  }
  return best;
}

std::vector<Benchmark> all_benchmarks() {
  std::vector<Benchmark> all;
  for (auto group : {fluid_benchmarks, bodies_benchmarks, solids_benchmarks, debris_flow_benchmarks})
    for (Benchmark& b : group()) all.push_back(std::move(b));
  return all;
}

namespace {

constexpr std::size_t kStreamBytes = std::size_t{512} << 20;  // far beyond every cache

struct Arguments {
  std::vector<std::string> names;
  std::string json;
  bool list = false;
  int repeats = 3;
  cases::CommonOptions common;
};

std::string group_of(const Benchmark& b) { return b.name.substr(0, b.name.find('.')); }

bool asks_for(const std::string& name, const Benchmark& b) { return name == b.name || name == group_of(b); }

/// What the names ask for, and what that needs.
std::vector<Benchmark> select(const std::vector<Benchmark>& all, const std::vector<std::string>& names) {
  std::vector<std::string> wanted, known;
  for (const Benchmark& b : all) {
    known.push_back(b.name);
    known.push_back(group_of(b));
  }
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      const std::string nearest = scene::nearest_name(name, known);
      cases::refuse_command_line("no benchmark is called '" + name + "'" +
                                 (nearest.empty() ? "" : ", did you mean '" + nearest + "'?"));
    }
    for (const Benchmark& b : all)
      if (asks_for(name, b)) {
        wanted.push_back(b.name);
        wanted.insert(wanted.end(), b.needs.begin(), b.needs.end());
      }
  }
  std::vector<Benchmark> chosen;
  for (const Benchmark& b : all)
    if ((names.empty() && !b.by_name_only) || std::find(wanted.begin(), wanted.end(), b.name) != wanted.end())
      chosen.push_back(b);
  return chosen;
}

void measure_limits(MachineLimits& limits, int repeats) {
  {
    const ThreadLimit one(1);
    limits.stream_one = std::max(limits.stream_one, stream_rate(kStreamBytes, repeats));
  }
  limits.stream_all = std::max(limits.stream_all, stream_rate(kStreamBytes, repeats));
}

std::string line_of(const Figure& f) {
  if (!f.measured())
    return fmt::format("-     {:<22} {:>10.4g} {:<7} ratio not measured ({})\n", f.name, f.value, f.unit, f.missing);
  return fmt::format("{} {:<22} {:>10.4g} {:<7} ratio {:>6.3f}  bar {} {:<5.3g} ({})\n", f.pass() ? "pass " : "SHORT",
                     f.name, f.value, f.unit, f.ratio, f.at_least ? ">=" : "<=", f.bar, f.against);
}

/// "fluid.sweep 15 %, fluid.surface 9 %", largest first.
std::string shares_text(const Figure& f) {
  std::vector<std::pair<double, std::string>> parts;
  for (const auto& [name, share] : f.shares) parts.emplace_back(share, name);
  std::sort(parts.rbegin(), parts.rend());
  std::string text;
  for (const auto& [share, name] : parts)
    text += fmt::format("{}{} {:.0f} %", text.empty() ? "      " : ", ", name, 100 * share);
  return text.empty() ? text : text + "\n";
}

std::string json_of(const Session& session) {
  nlohmann::json entries = nlohmann::json::array();
  for (const Figure& f : session.figures)
    entries.push_back({{"name", f.name},
                       {"value", f.value},
                       {"unit", f.unit},
                       {"ratio", f.ratio},
                       {"against", f.against},
                       {"bar", f.bar},
                       {"at_least", f.at_least},
                       {"pass", f.pass()}});
  for (std::size_t k = 0; k < session.figures.size(); ++k) {
    const Figure& f = session.figures[k];
    if (!f.measured()) entries[k]["not_measured"] = f.missing;
    if (!f.shares.empty()) entries[k]["shares"] = f.shares;
  }
  return nlohmann::json({{"machine",
                          {{"name", cases::machine_name()},
                           {"stream_gb_s_1", session.limits.stream_one},
                           {"stream_gb_s_all", session.limits.stream_all}}},
                         {"commit", cases::commit()},
                         {"entries", entries}})
             .dump(2) +
         "\n";
}

/// Whether a text is what json_of writes.
bool is_session_json(const std::string& text) {
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("entries") || !json["entries"].is_array()) return false;
  const auto is_figure = [](const nlohmann::json& e) { return e.is_object() && e.contains("ratio"); };
  return json.contains("machine") && json.contains("commit") &&
         std::all_of(json["entries"].begin(), json["entries"].end(), is_figure);
}

/// Entries keep runs in FOLDER/GROUP, and replace them.
void check_kept(const std::filesystem::path& folder, const std::vector<Benchmark>& chosen) {
  for (const Benchmark& b : chosen)
    if (const std::filesystem::path kept = folder / group_of(b); std::filesystem::is_directory(kept))
      for (const auto& entry : std::filesystem::directory_iterator(kept)) cases::require_run_or_nothing(entry.path());
}

int run(const Arguments& a) {
  cases::refuse_changes(a.common, "benchmarks have no keys to set");
  if (!a.common.precision.empty()) cases::refuse_command_line("--precision: each entry has its own, expected its name");
  const auto chosen = select(all_benchmarks(), a.names);
  if (a.list) {
    for (const Benchmark& b : a.names.empty() ? all_benchmarks() : chosen)
      fmt::print("{}{}\n", b.name, b.by_name_only ? " (by name only)" : "");
    return cases::exit_done;
  }
  Session session;
  session.repeats = a.repeats;
  session.folder = a.common.out.empty() ? "results/benchmark" : a.common.out;
  check_kept(session.folder, chosen);
  if (!a.json.empty()) cases::require_record(a.json, "--json", "benchmark", is_session_json);
  if (!a.common.out.empty()) cases::create_folder(session.folder);
  const ThreadLimit limit(cases::threads_or_all(a.common.threads));
  cases::watch_for_interrupt();
  bool all_pass = true;
  for (const Benchmark& b : chosen) {
    if (cases::interrupted()) return cases::exit_interrupted;
    measure_limits(session.limits, a.repeats);
    const double before = session.limits.stream_all;
    Figure figure = b.run(session);
    measure_limits(session.limits, a.repeats);
    if (figure.of_memory_rate) figure.ratio *= before / session.limits.stream_all;
    session.figures.push_back(figure);
    all_pass = all_pass && session.figures.back().pass();
    if (!a.common.quiet) fmt::print("{}{}", line_of(figure), shares_text(figure));
    std::fflush(stdout);
    if (!a.json.empty()) cases::replace_text_file(a.json, json_of(session));
  }
  if (!a.common.quiet)
    fmt::print("in-place stream rate: {:.2f} GB/s on one thread, {:.2f} GB/s on all\n", session.limits.stream_one,
               session.limits.stream_all);
  if (cases::interrupted()) return cases::exit_interrupted;
  return all_pass ? cases::exit_done : 1;
}

}  // namespace
}  // namespace lahar::performance

int main(int argc, char** argv) {
  using namespace lahar;
  CLI::App app("Measures Lahar's speed against what the machine can do", "benchmark");
  cases::add_version(app);
  performance::Arguments arguments;
  app.add_option("names", arguments.names, "Entries or groups (default: all but those that only run by name)")
      ->type_name("NAME|GROUP");
  app.add_flag("--list", arguments.list, "List the entries and do not run them");
  app.add_option("--repeats", arguments.repeats, "Best of so many (default 3)")
      ->check(CLI::Range(1, 100))
      ->type_name("N");
  app.add_option("--json", arguments.json, "Write the results there")->type_name("FILE");
  cases::add_common_options(
      app, arguments.common,
      {.out = "Folder for runs that entries keep (default results/benchmark)", .overwrite = false});
  return cases::parse_and_run(app, argc, argv, [&] { return performance::run(arguments); });
}
