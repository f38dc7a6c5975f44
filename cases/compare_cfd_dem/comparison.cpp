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

void take_summary(CaseResult& result, const std::string& summary, const std::filesystem::path& file) {
  try {
    const nlohmann::json read = nlohmann::json::parse(summary);
    result.failed_checks.clear();
    for (const auto& check : read.at("checks"))
      if (!check.at("pass").get<bool>()) result.failed_checks.push_back(check.at("name").get<std::string>());
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
    const StudyCase &a = c.study_case, &b = of.study_case;
    if (a.sweep != b.sweep || a.coupling != b.coupling || a.release != b.release || c.commit != of.commit) continue;
    if (c.commit.ends_with("-dirty")) continue;  // of changes that no commit holds: of nobody knows how many programs
    if (!counts_in_spread(a) || !counts_in_spread(b)) continue;
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
      "presets, time steps and stiffnesses of the same flow, coupling and commit, over the mean.\n" +
      std::string(kComparisonColumns) + "\n";
  for (const Compared& q : compared_quantities())
    for (const CaseResult& c : results) {
      const double ours = c.value(q.name), theirs = q.theirs(c.study_case.release).value_or(kNone);
      text += fmt::format("{},{},{},{},{},{},{},\"{}\"\n", q.name, q.unit, c.study_case.name(), number(theirs),
                          number(ours), number(ours / theirs - 1), number(spread(q, c, results)), c.commit);
    }
  return text;
}

}  // namespace lahar::study
