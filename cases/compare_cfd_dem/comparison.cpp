#include "cases/compare_cfd_dem/comparison.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cases/assembly/grain_sizes.h"
#include "cases/assembly/load.h"
#include "cases/files/output_file.h"
#include "cases/files/text_file.h"

namespace lahar::study {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

}  // namespace

double CaseResult::value(const std::string& quantity) const {
  const auto found = values.find(quantity);
  return found == values.end() ? kNone : found->second;
}

CaseResult result_of(const CaseRun& run) {
  CaseResult result;
  result.study_case = run.study_case;
  for (const Compared& q : compared_quantities())
    if (const double value = q.ours(run); std::isfinite(value)) result.values[q.name] = value;
  result.curves.time_s = run.series.time_s;
  for (const ShownColumn& shown : shown_columns())
    if (const auto* column = run.series.find(shown.name)) result.curves.columns.push_back(*column);
  return result;
}

std::map<std::string, double> metrics_of(const std::string& summary, const std::filesystem::path& file) {
  try {
    return nlohmann::json::parse(summary).at("metrics").get<std::map<std::string, double>>();
  } catch (const nlohmann::json::exception&) {
    throw cases::FileError(file, "not the summary of a run");
  }
}

const char* name_of(Outcome outcome) {
  return outcome == Outcome::passed ? "passed" : outcome == Outcome::failed ? "failed" : "absent";
}

namespace {

/// NaN where it is absent or null.
double number_in(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : kNone;
}

/// A check of each run, and what the study asks of it; NaN: what the run asks.
struct Bar {
  const char* check;
  double most;
};
constexpr Bar kBars[] = {{"liquid_mass_ledger", 1e-5},
                         {"solids_energy_ledger", kNone},
                         {"momentum_audit", 1e-6},
                         {"ring_links_changed", 0},
                         {"grains_behind_walls", 0}};
constexpr double kMostOfEnergyIn = 0.01;

CaseCheck judged(const nlohmann::json& check, double most) {
  CaseCheck c{check.at("name").get<std::string>(), number_in(check, "value"), number_in(check, "tolerance"),
              check.at("pass").get<bool>() ? Outcome::passed : Outcome::failed};
  if (std::isnan(most)) return c;
  c.bar = most;
  if (!(std::abs(c.value) <= most)) c.outcome = Outcome::failed;
  return c;
}

/// What the energy ledger of grains and barrier lacks at most, of E_in about the bed at the net.
CaseCheck energy_of_e_in(const nlohmann::json& metrics) {
  const double value = number_in(metrics, "solids_energy_gap_max_J") / (1000 * number_in(metrics, "e_in_kJ"));
  return {"solids_energy_of_e_in", value, kMostOfEnergyIn,
          std::isnan(value)                    ? Outcome::absent
          : std::abs(value) <= kMostOfEnergyIn ? Outcome::passed
                                               : Outcome::failed};
}

std::vector<CaseCheck> checks_of(const nlohmann::json& summary) {
  std::vector<CaseCheck> all;
  const auto& run = summary.at("checks");
  for (const Bar& bar : kBars) {
    const auto found = std::find_if(run.begin(), run.end(), [&](const auto& c) { return c.at("name") == bar.check; });
    all.push_back(found == run.end() ? CaseCheck{bar.check, kNone, bar.most, Outcome::absent}
                                     : judged(*found, bar.most));
  }
  all.insert(all.begin() + 1, energy_of_e_in(summary.value("metrics", nlohmann::json::object())));
  for (const auto& check : run)
    if (std::none_of(all.begin(), all.end(), [&](const CaseCheck& c) { return check.at("name") == c.name; }))
      all.push_back(judged(check, kNone));
  return all;
}

}  // namespace

void take_summary(CaseResult& result, const std::string& summary, const std::filesystem::path& file) {
  try {
    const nlohmann::json read = nlohmann::json::parse(summary);
    result.checks = checks_of(read);
    result.wall_seconds = read.at("wall_seconds").get<double>();
    result.commit = read.value("commit", "");
    result.machine = read.value("machine", "");
    result.summary = summary;
  } catch (const nlohmann::json::exception&) {
    throw cases::FileError(file, "not the summary of a run");
  }
}

CaseResult read_case(const StudyCase& study_case, const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "summary.json";
  const std::string summary = cases::read_text_file(file);
  CaseRun run{study_case, metrics_of(summary, file), 0, 0, cases::read_series(folder / "series.h5")};
  for (const scene::GrainSize& g : scene::grain_sizes(scene::load(folder / "scene.resolved.toml", {}))) {
    const double volume = static_cast<double>(g.count) * std::numbers::pi / 6 * g.diameter * g.diameter * g.diameter;
    run.grain_volume += volume, run.grain_mass += volume * g.density;
  }
  CaseResult result = result_of(run);
  take_summary(result, summary, file);
  result.folder = folder;
  const auto written = std::filesystem::file_time_type::clock::to_sys(std::filesystem::last_write_time(file));
  result.ended = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                             fmt::gmtime(std::chrono::system_clock::to_time_t(
                                 std::chrono::time_point_cast<std::chrono::system_clock::duration>(written))));
  return result;
}

namespace {

/// Half the range of a quantity over the cases of the same flow, coupling and commit that count, over their mean; NaN
/// for a single one, and for one that does not count.
double spread(const Compared& quantity, const CaseResult& of, const std::vector<CaseResult>& results) {
  double low = INFINITY, high = -INFINITY, sum = 0, count = 0;
  for (const CaseResult& c : results) {
    if (c.commit != of.commit || !count_in_one_spread(c.study_case, of.study_case)) continue;
    if (c.commit.ends_with("-dirty")) continue;  // of changes that no commit holds: of nobody knows how many programs
    const double x = c.value(quantity.name);
    if (!std::isfinite(x)) continue;
    low = std::min(low, x), high = std::max(high, x), sum += x, count += 1;
  }
  return count > 1 && sum != 0 ? 0.5 * (high - low) / std::abs(sum / count) : kNone;
}

std::string number(double x) { return std::isfinite(x) ? fmt::format("{:.6g}", x) : std::string(); }

}  // namespace

std::string comparison_csv(const std::vector<CaseResult>& results) {
  std::string text =
      "# Theirs: Li, Zhao & Kwan 2020. difference: (ours - theirs) / theirs. spread: half the range over seeds, "
      "presets, cells, time steps and stiffnesses of the same flow, coupling and commit, over the mean.\n" +
      std::string(kComparisonColumns) + "\n";
  for (const Compared& q : compared_quantities())
    for (const CaseResult& c : results) {
      const double ours = c.value(q.name), theirs = theirs_of(q, c.study_case).value_or(kNone);
      text += fmt::format("{},{},{},{},{},{},{},\"{}\"\n", q.name, q.unit, c.study_case.name(), number(theirs),
                          number(ours), number(ours / theirs - 1), number(spread(q, c, results)), c.commit);
    }
  return text;
}

std::string checks_csv(const std::vector<CaseResult>& results) {
  std::string text = "case,check,value,bar,outcome\n";
  for (const CaseResult& c : results)
    for (const CaseCheck& check : c.checks)
      text += fmt::format("{},{},{},{},{}\n", c.study_case.name(), check.name, number(check.value), number(check.bar),
                          name_of(check.outcome));
  return text;
}

namespace {

/// About other levels: what counts from the bed downstream, which the paper's E_in asks for, stands for them.
constexpr const char* kOtherReadings[] = {"e_in", "e_in_full_cells", "e_out", "e_out_full_cells", "e_d", "eta", "zeta"};

struct Pair {
  const CaseResult *resolved = nullptr, *averaged = nullptr;
  [[nodiscard]] bool is_of_one_program() const {
    return resolved->commit == averaged->commit && !resolved->commit.empty() && !resolved->commit.ends_with("-dirty");
  }
};

std::vector<Pair> pairs_of(const std::string& sweep, const std::string& preset,
                           const std::vector<CaseResult>& results) {
  std::map<double, std::map<int, Pair>> flows;  // by distance and seed
  for (const CaseResult& c : results) {
    const StudyCase& s = c.study_case;
    if (s.sweep != sweep || s.preset != preset || s.variant != variants().front().name) continue;
    Pair& pair = flows[s.release][s.seed];
    if (s.coupling == "resolved") pair.resolved = &c;
    if (s.coupling == "averaged") pair.averaged = &c;
  }
  std::vector<Pair> pairs;
  for (const auto& [release, seeds] : flows) {
    const auto whole =
        std::find_if(seeds.begin(), seeds.end(), [](const auto& p) { return p.second.resolved && p.second.averaged; });
    if (whole != seeds.end()) pairs.push_back(whole->second);
  }
  return pairs;
}

Nearness nearness_of(const Compared& q, const std::vector<Pair>& pairs) {
  Nearness n;
  n.quantity = q.name;
  for (const Pair& pair : pairs) {
    const double theirs = theirs_of(q, pair.resolved->study_case).value_or(kNone);
    const double resolved = pair.resolved->value(q.name), averaged = pair.averaged->value(q.name);
    if (!std::isfinite(theirs) || !std::isfinite(resolved) || !std::isfinite(averaged)) continue;
    n.flows += 1, n.of_one_program += pair.is_of_one_program() ? 1 : 0;
    const double gap = std::abs(resolved - theirs) - std::abs(averaged - theirs);
    n.resolved_nearer += gap < 0 ? 1 : 0, n.averaged_nearer += gap > 0 ? 1 : 0;
    n.resolved_over_theirs += resolved / theirs, n.averaged_over_theirs += averaged / theirs;
  }
  n.resolved_over_theirs /= static_cast<double>(n.flows), n.averaged_over_theirs /= static_cast<double>(n.flows);
  return n;
}

}  // namespace

std::vector<Nearness> nearness(const std::vector<CaseResult>& results) {
  std::vector<Nearness> all;
  for (const Choice& sweep : sweeps())
    for (const Choice& preset : presets()) {
      const std::vector<Pair> pairs = pairs_of(sweep.name, preset.name, results);
      for (const Compared& q : compared_quantities()) {
        if (std::find(std::begin(kOtherReadings), std::end(kOtherReadings), q.name) != std::end(kOtherReadings))
          continue;
        Nearness n = nearness_of(q, pairs);
        n.sweep = sweep.name, n.preset = preset.name;
        if (n.flows > 0) all.push_back(std::move(n));
      }
    }
  return all;
}

std::string nearness_csv(const std::vector<Nearness>& all) {
  std::string text =
      "quantity,sweep,preset,flows,of_one_program,resolved_nearer,averaged_nearer,resolved_over_theirs,"
      "averaged_over_theirs\n";
  for (const Nearness& n : all)
    text += fmt::format("{},{},{},{},{},{},{},{},{}\n", n.quantity, n.sweep, n.preset, n.flows, n.of_one_program,
                        n.resolved_nearer, n.averaged_nearer, number(n.resolved_over_theirs),
                        number(n.averaged_over_theirs));
  return text;
}

}  // namespace lahar::study
