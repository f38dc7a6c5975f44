#include "cases/speed_error/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/files/html_image.h"
#include "cases/files/html_text.h"
#include "cases/files/output_file.h"
#include "cases/pictures/chart.h"
#include "cases/speed_error/pareto.h"
#include "cases/validate/entry.h"
#include "cases/validate/fluid/flows.h"
#include "core/check.h"

namespace lahar::validate {

std::vector<Measurement> ProblemResult::measurements() const {
  std::vector<Measurement> all;
  for (const TrialResult& t : trials) all.push_back(t.found);
  return all;
}

namespace {

std::string one_line(std::string text) {
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n')) text.replace(at, 1, "; ");
  return text;
}

}  // namespace

ProblemResult run_problem(const Problem& problem, double work, const std::function<bool(const ProblemResult&)>& go_on) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  ProblemResult result{problem, work, {}};
  for (const Trial& trial : problem.trials) {
    TrialResult t{trial.name(), trial.turned.empty(), {none, none}, {}};
    try {
      t.found = trial.run();
    } catch (const InputError& e) {
      t.failure = one_line(e.what());
      t.refused = true;
    } catch (const std::exception& e) {
      t.failure = e.what();
    }
    result.trials.push_back(t);
    if (!go_on(result)) break;
  }
  return result;
}

double fixed_work() {
  lbm::FluidOptions o = lattice_box(Vec3i::Constant(64), 0.01);
  lbm::Fluid<float> fluid(o);
  fluid.fill_everything([](const Vec3& p) { return Vec3(0.02 * std::sin(0.1 * p.y()), 0, 0); }, no_pressure);
  double shortest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k)
    shortest = std::min(shortest, timed([&] {
                                    advance(fluid, 200);
                                    return 0.0;
                                  }).seconds);
  return shortest;
}

double defaults_beaten_by(const ProblemResult& result) {
  const auto found =
      std::find_if(result.trials.begin(), result.trials.end(), [](const TrialResult& t) { return t.defaults; });
  return beaten_by(result.measurements(), static_cast<std::size_t>(found - result.trials.begin()));
}

std::string heading_text(const Problem& problem) {
  return fmt::format("{}: {}, against {} values\n  defaults: {}\n", problem.name, problem.error, problem.against,
                     problem.defaults);
}

std::string trial_text(const TrialResult& trial, double work) {
  return fmt::format("  {:<52} error {:>9.3g}  {:>8.2f} s  {:>8.2f} of the fixed work{}\n", trial.name,
                     trial.found.error, trial.found.seconds, trial.found.seconds / work,
                     trial.failure.empty() ? "" : "  stopped: " + trial.failure);
}

std::string front_text(const ProblemResult& result) {
  std::string names;
  for (const std::size_t k : pareto_front(result.measurements()))
    names += (names.empty() ? "" : "; ") + result.trials[k].name;
  return fmt::format("  on the Pareto front: {}\n", names.empty() ? "none" : names);
}

std::string refusals_text(const ProblemResult& result) {
  std::string text;
  for (const TrialResult& t : result.trials)
    if (t.refused) text += fmt::format("{}: {}: its scene was refused: {}\n", result.problem.name, t.name, t.failure);
  return text;
}

std::string Sitting::line() const {
  return fmt::format("{}, {} of its threads used, commit {}, {}, {} form", machine, threads, commit, date,
                     quick ? "quick" : "full");
}

namespace {

std::string standing_of_defaults(const ProblemResult& result) {
  for (const TrialResult& t : result.trials)
    if (t.defaults && !t.failure.empty()) return "stopped";
  const double factor = defaults_beaten_by(result);
  return factor <= 1 ? "on the front" : fmt::format("beaten by {:.2f}", factor);
}

/// Error against time of all trials, those on the front joined.
cases::Chart chart_of(const ProblemResult& result) {
  using namespace cases;
  Chart chart;
  chart.title = result.problem.name;
  chart.x = {.label = "time, fixed work", .scale = AxisScale::logarithmic};
  chart.y = {.label = "error", .scale = AxisScale::logarithmic};
  chart.width = 480, chart.height = 300;
  ChartSeries others{.name = "one knob turned", .mark = Mark::points, .colour = ChartColour::sky};
  ChartSeries defaults{.name = "defaults", .mark = Mark::points, .colour = ChartColour::vermilion};
  for (const TrialResult& t : result.trials) {
    if (!std::isfinite(t.found.error)) continue;
    ChartSeries& series = t.defaults ? defaults : others;
    series.x.push_back(t.found.seconds / result.work), series.y.push_back(t.found.error);
  }
  ChartSeries front{.name = "Pareto front", .dash = Dash::dashed, .colour = ChartColour::black};
  const std::vector<Measurement> all = result.measurements();
  for (const std::size_t k : pareto_front(all))
    front.x.push_back(all[k].seconds / result.work), front.y.push_back(all[k].error);
  chart.series = {front, others, defaults};
  return chart;
}

std::string table_of(const ProblemResult& result) {
  const std::vector<Measurement> all = result.measurements();
  const std::vector<std::size_t> front = pareto_front(all);
  std::string html =
      "<table><tr><th>trial</th><th>error</th><th>time, s</th><th>time, fixed work</th><th>beaten by</th></tr>\n";
  for (std::size_t k = 0; k < all.size(); ++k) {
    const TrialResult& t = result.trials[k];
    const bool on_front = std::find(front.begin(), front.end(), k) != front.end();
    html += fmt::format(
        "<tr{}><td>{}</td><td>{:.3g}</td><td>{:.2f}</td><td>{:.2f}</td><td>{}</td></tr>\n",
        on_front ? " class=\"front\"" : "", t.name, t.found.error, t.found.seconds, t.found.seconds / result.work,
        t.failure.empty() ? (on_front ? "on the front" : fmt::format("{:.2f}", beaten_by(all, k))) : "stopped");
  }
  return html + "</table>\n";
}

/// Those of a former sitting's other problems: their rows are gone too.
void remove_other_charts(const std::vector<ProblemResult>& results, const std::filesystem::path& folder) {
  for (const Problem& p : all_problems(false)) {
    const auto is_its = [&](const ProblemResult& r) { return r.problem.name == p.name; };
    if (std::any_of(results.begin(), results.end(), is_its)) continue;
    for (const char* ending : {".png", ".svg", ".pdf"}) std::filesystem::remove(folder / (p.name + ending));
  }
}

}  // namespace

std::string results_csv(const std::vector<ProblemResult>& results, const Sitting& sitting) {
  std::string text = fmt::format("# {}\n{}\n", sitting.line(), kSpeedErrorColumns);
  for (const ProblemResult& result : results) {
    const std::vector<Measurement> all = result.measurements();
    const std::vector<std::size_t> front = pareto_front(all);
    for (std::size_t k = 0; k < all.size(); ++k) {
      const TrialResult& t = result.trials[k];
      text += fmt::format("{},{},{:.6g},{:.4g},{:.4g},{:.3g},{},{}\n", result.problem.name, csv_field(t.name),
                          t.found.error, t.found.seconds, t.found.seconds / result.work, beaten_by(all, k),
                          std::find(front.begin(), front.end(), k) != front.end(), csv_field(t.failure));
    }
  }
  return text;
}

void write_results(const std::vector<ProblemResult>& results, const Sitting& sitting,
                   const std::filesystem::path& folder) {
  cases::replace_text_file(folder / kSpeedErrorTable, results_csv(results, sitting));
  remove_other_charts(results, folder);
  std::string html =
      "<!DOCTYPE html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>Speed against error</title><style>"
      "body{font:16px/1.5 sans-serif;max-width:60em;margin:2em auto;padding:0 1em}"
      "table{border-collapse:collapse}td,th{padding:.1em .8em;text-align:right}"
      "td:first-child,th:first-child{text-align:left}.front{font-weight:bold}</style></head><body>\n"
      "<h1>Speed against error</h1>\n<p>" +
      cases::html_text(sitting.line()) +
      ". Times are pieces of a fixed work done in the same sitting. Bold: on the Pareto front; no other trial is both "
      "faster and nearer. \"Beaten by\" f: another takes at most 1/f of the time and has at most 1/f of the "
      "error.</p>\n";
  for (const ProblemResult& result : results) {
    const std::filesystem::path picture = folder / (result.problem.name + ".svg");
    chart_of(result).write_all(picture);
    html += fmt::format("<h2>{}</h2>\n<p>Error: {}, against {} values. Defaults: {}; {}.</p>\n", result.problem.name,
                        result.problem.error, result.problem.against, result.problem.defaults,
                        standing_of_defaults(result));
    html += cases::html_image(picture) + table_of(result);
  }
  cases::replace_text_file(folder / "report.html", html + "</body></html>\n");
}

}  // namespace lahar::validate
