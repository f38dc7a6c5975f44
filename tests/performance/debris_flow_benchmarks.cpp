// Speed of the paper's case, cases/debris_flow: slices of it from three states that it reaches by itself. The states
// are made once and kept.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "cases/assembly/load.h"
#include "cases/files/case_file.h"
#include "cases/runner/checkpoint.h"
#include "cases/runner/interrupt.h"
#include "cases/runner/output_folder.h"
#include "cases/runner/resume.h"
#include "cases/runner/run.h"
#include "core/check.h"
#include "core/parallel.h"
#include "tests/performance/benchmark.h"

namespace lahar::performance {

namespace {

namespace fs = std::filesystem;
using Timers = std::map<std::string, double>;

struct State {
  std::string name;
  double time;  ///< s
};

/// Each is gone on from to make the next.
const std::vector<State> kStates{{"packed", 0.05}, {"in_flight", 0.5}, {"at_net", 1.25}};
constexpr double kSlice = 0.05;  ///< s

const fs::path kScene = cases::case_file("debris_flow/scene.toml");

std::string assignment(const char* key, double value) { return fmt::format("run.{}={}", key, value); }

/// Until a time (s), without pictures and volumes; a checkpoint at the end if their interval is not 0.
std::vector<std::string> settings(double end, double checkpoint_interval) {
  return {assignment("duration_s", end), assignment("output_interval_s", 0), assignment("image_interval_s", 0),
          assignment("checkpoint_interval_s", checkpoint_interval), assignment("checkpoint_wall_s", 0)};
}

fs::path folder_of(const Session& session, const std::string& name) { return session.folder / "debris_flow" / name; }

/// Whether a state was made of this scene by a program that writes the same checkpoints.
bool is_there(const fs::path& folder) {
  try {
    const scene::Scene scene = scene::load(kScene, {});
    cases::read_head(folder, scene);
    return fs::exists(folder / "summary.json");
  } catch (const InputError&) {
    return false;
  }
}

/// Throws InputError where something else stands than these benchmarks leave there.
void remove_run(const fs::path& folder) {
  cases::require_run_or_nothing(folder);
  fs::remove_all(folder);
}

/// What shows that it is a run comes first: a copy that is cut short can be removed too.
void copy_state(const fs::path& from, const fs::path& to) {
  remove_run(to);
  fs::create_directories(to);
  fs::copy(from / "scene.resolved.toml", to);
  fs::copy(from, to, fs::copy_options::recursive | fs::copy_options::skip_existing);
}

cases::RunResult run_quietly(const scene::Scene& scene, const fs::path& folder, bool resume) {
  cases::RunOptions options;
  options.out = folder;
  options.threads = thread_count();
  options.quiet = true;
  options.resume = resume;
  return cases::run_to_folder(scene, options, cases::run_scene);
}

/// The folder of the k-th state, made if it is not there; nothing if the user interrupts.
std::optional<fs::path> state(const Session& session, std::size_t k) {
  const fs::path folder = folder_of(session, kStates[k].name), part = folder_of(session, "in_the_making");
  if (is_there(folder)) return folder;
  std::optional<fs::path> former;
  if (k > 0 && !(former = state(session, k - 1))) return std::nullopt;
  fmt::print("      debris_flow: makes the state '{}' (t = {} s), kept in {}\n", kStates[k].name, kStates[k].time,
             folder.string());
  std::fflush(stdout);
  const std::vector<std::string> set = settings(kStates[k].time, 1e3);
  remove_run(part);
  if (former) copy_state(*former, part);
  const scene::Scene scene = former ? cases::load_resumed(part, set) : scene::load(kScene, set);
  if (run_quietly(scene, part, former.has_value()).interrupted) return std::nullopt;
  remove_run(folder);
  fs::create_directories(folder.parent_path());
  fs::rename(part, folder);
  return folder;
}

Timers timers_of_summary(const fs::path& folder) {
  std::ifstream file(folder / "summary.json");
  return nlohmann::json::parse(file).at("timers").get<Timers>();
}

/// Wall time of the slice after a state by section, s; nothing if the user interrupts.
std::optional<Timers> time_slice(const Session& session, const fs::path& from, double end) {
  const fs::path folder = folder_of(session, "slice");
  copy_state(from, folder);
  const scene::Scene scene = cases::load_resumed(folder, settings(end, 0));
  const cases::RunResult result = run_quietly(scene, folder, true);
  if (result.interrupted) return std::nullopt;
  Timers spent = result.summary.timers;
  for (const auto& [name, seconds] : timers_of_summary(folder_of(session, from.filename()))) spent[name] -= seconds;
  spent.erase("preparation"), spent.erase("checkpoints");
  fs::remove_all(folder);
  return spent;
}

/// A section that is divided further is the sum of those that begin with its name and a dot.
bool is_divided(const Timers& timers, const std::string& name) {
  const auto next = timers.upper_bound(name + ".");
  return next != timers.end() && next->first.starts_with(name + ".");
}

double whole(const Timers& timers) {
  double sum = 0;
  for (const auto& [name, seconds] : timers)
    if (!is_divided(timers, name)) sum += seconds;
  return sum;
}

/// Wall time of a simulated second that the 4 s of the scene may take on average: 35 minutes where memory streams at
/// 28 GB/s and LAMMPS does 5 million particle-steps a second on one core. Elsewhere the fluid's share of it, three
/// tenths, goes with the one, the rest with the other.
double allowance(double stream, double lammps) { return 35 * 60 / 4.0 * (0.3 * 28 / stream + 0.7 * 5 / lammps); }

/// Of LAMMPS, M/s, in solids.grains_5k; 0 if it was not measured.
double lammps_rate_of(const Session& session) {
  for (const Figure& f : session.figures)
    if (f.name == "solids.grains_5k" && f.measured()) return f.value / f.ratio;
  return 0;
}

Figure slice(std::size_t k, Session& session) {
  Figure figure{"debris_flow." + kStates[k].name, 0, "s/s", 0, "", 1, false};
  const std::optional<fs::path> from = state(session, k);
  Timers best;
  for (int r = 0; from && r < session.repeats; ++r) {
    const auto spent = time_slice(session, *from, kStates[k].time + kSlice);
    if (spent && (best.empty() || whole(*spent) < whole(best))) best = *spent;
  }
  if (best.empty()) {
    figure.missing = "interrupted";
    return figure;
  }
  const double seconds = whole(best), lammps = lammps_rate_of(session);
  figure.value = seconds / kSlice;
  for (const auto& [name, part] : best)
    if (part > 0.01 * seconds && !is_divided(best, name)) figure.shares[name] = part / seconds;
  if (lammps == 0) {
    figure.missing = "LAMMPS was not measured";
    return figure;
  }
  const double allowed = allowance(session.limits.stream_all, lammps);
  figure.ratio = figure.value / allowed;
  figure.against = fmt::format("{:.0f} s/s: 35 min for 4 s at 28 GB/s and 5 M/s, here {:.0f} and {:.2g}", allowed,
                               session.limits.stream_all, lammps);
  return figure;
}

}  // namespace

std::vector<Benchmark> debris_flow_benchmarks() {
  std::vector<Benchmark> all;
  for (std::size_t k = 0; k < kStates.size(); ++k)
    all.push_back({"debris_flow." + kStates[k].name, {"solids.grains_5k"}, [k](Session& s) { return slice(k, s); }});
  for (Benchmark& b : all) b.by_name_only = true;
  return all;
}

}  // namespace lahar::performance
