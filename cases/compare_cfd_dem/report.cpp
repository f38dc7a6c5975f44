#include "cases/compare_cfd_dem/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "cases/compare_cfd_dem/published_flows.h"
#include "cases/compare_cfd_dem/trends.h"
#include "cases/files/html_image.h"
#include "cases/files/html_text.h"
#include "cases/files/output_file.h"

namespace lahar::study {

namespace {

const Compared& quantity(const char* name) {
  const auto& all = compared_quantities();
  return *std::find_if(all.begin(), all.end(), [&](const Compared& q) { return q.name == name; });
}

/// What one curve of a figure over the flows holds together.
struct Curve {
  std::string sweep, preset, coupling;
  int seed;
  [[nodiscard]] std::string label() const {
    std::string text = fmt::format("{}, {}, {}", sweep, coupling, preset);
    if (seed != 1) text += ", another seed";
    std::replace(text.begin(), text.end(), '_', ' ');
    return text;
  }
  [[nodiscard]] bool holds(const StudyCase& c) const {
    return c.sweep == sweep && c.preset == preset && c.coupling == coupling && c.seed == seed &&
           c.variant == variants().front().name;
  }
};

std::vector<Curve> curves_of(const std::vector<CaseResult>& results) {
  std::set<int> seeds;
  for (const CaseResult& c : results) seeds.insert(c.study_case.seed);
  std::vector<Curve> curves;
  for (const Choice& sweep : sweeps())
    for (const Choice& preset : presets())
      for (const Choice& coupling : couplings())
        for (const int seed : seeds) {
          const Curve curve{sweep.name, preset.name, coupling.name, seed};
          if (std::any_of(results.begin(), results.end(),
                          [&](const CaseResult& c) { return curve.holds(c.study_case); }))
            curves.push_back(curve);
        }
  return curves;
}

/// One colour in all figures for a sweep in one coupling: dark the resolved flows, light the averaged ones. Beads by
/// the law of grains, which few flows have, are as black as the paper's.
cases::ChartColour colour_of(const std::string& sweep, const std::string& coupling) {
  using enum cases::ChartColour;
  const bool matched = sweep == "matched";
  if (coupling == "averaged_beads") return black;
  if (coupling == "resolved") return matched ? vermilion : blue;
  if (coupling == "averaged") return matched ? amber : sky;
  return matched ? purple : green;
}

/// Of one colour presets and packings differ by their points. The paper's are circles.
cases::PointShape shape_of(const Curve& c) {
  using enum cases::PointShape;
  if (c.coupling == "averaged_beads") return c.sweep == "matched" ? diamond : square;
  if (c.preset != presets().front().name) return c.preset == "standard" ? triangle_down : triangle;
  return c.seed == 1 ? square : diamond;
}

/// And by their dashes.
cases::Dash dash_of(const std::string& preset, int seed) {
  using enum cases::Dash;
  if (preset != presets().front().name) return preset == "standard" ? dashed : dash_dot;
  return seed == 1 ? solid : dotted;
}

/// Many packings have one name in the legend.
void add_curve(cases::Chart& chart, cases::ChartSeries curve) {
  const auto& all = chart.series;
  if (std::any_of(all.begin(), all.end(), [&](const auto& other) { return other.name == curve.name; })) curve.name = "";
  chart.series.push_back(std::move(curve));
}

/// Theirs over their Froude number, and ours at the flow of the same release distance. No line joins flows that were
/// run by different programs (commits).
cases::Chart over_flows(const char* name, const std::vector<CaseResult>& results) {
  using namespace cases;
  const Compared& q = quantity(name);
  Chart chart;
  chart.title = q.meaning;
  chart.x = {.label = "Froude number of the paper's flow"};
  chart.y = {.label = q.name, .unit = q.unit == "1" ? "" : q.unit};
  chart.width = 480, chart.height = 300;
  ChartSeries theirs{.name = "Li et al. 2020",
                     .mark = Mark::line_and_points,
                     .colour = ChartColour::black,
                     .shape = PointShape::circle};
  for (const Flow& f : published_flows())
    if (const auto value = q.theirs(f.release)) theirs.x.push_back(f.froude), theirs.y.push_back(*value);
  if (q.theirs_largest) chart.y_guides.push_back({*q.theirs_largest, "Li et al. 2020, largest"});
  if (theirs.x.size() < 3) theirs.mark = Mark::points;  // ends of a range: what lies between is not known
  if (!theirs.x.empty()) chart.series.push_back(theirs);
  for (const Curve& curve : curves_of(results)) {
    std::vector<std::tuple<double, double, std::string>> points;
    for (const CaseResult& c : results)
      if (const Flow* flow = published(c.study_case.release);
          flow && curve.holds(c.study_case) && std::isfinite(c.value(q.name)))
        points.emplace_back(flow->froude, c.value(q.name), c.commit);
    if (points.empty()) continue;
    std::sort(points.begin(), points.end());
    ChartSeries ours{.name = curve.label(),
                     .mark = Mark::line_and_points,
                     .dash = dash_of(curve.preset, curve.seed),
                     .colour = colour_of(curve.sweep, curve.coupling),
                     .shape = shape_of(curve)};
    for (std::size_t n = 0; n < points.size(); ++n) {
      const auto& [x, y, commit] = points[n];
      if (n > 0 && commit != std::get<2>(points[n - 1])) ours.x.push_back(x), ours.y.push_back(std::nan(""));
      ours.x.push_back(x), ours.y.push_back(y);
    }
    if (points.size() < 4) ours.mark = Mark::points;  // what lies between is not known
    add_curve(chart, ours);
  }
  return chart;
}

/// A column of the series over time, of all couplings at one distance.
cases::Chart over_time(const ShownColumn& shown, double release, const std::string& sweep,
                       const std::vector<CaseResult>& results) {
  using namespace cases;
  Chart chart;
  chart.title =
      fmt::format("{}, L = {:.2f} m, {}", shown.title, release, sweep == "matched" ? "matched inflow" : "as printed");
  chart.x = {.label = "time", .unit = "s"};
  chart.y = {.label = shown.title, .unit = shown.unit};
  chart.width = 480, chart.height = 300;
  for (const CaseResult& c : results) {
    const StudyCase& s = c.study_case;
    const auto* values = c.curves.find(shown.name);
    if (s.release != release || s.sweep != sweep || s.variant != variants().front().name || !values) continue;
    ChartSeries line{.name = fmt::format("{}, {}{}", s.coupling, s.preset, s.seed == 1 ? "" : ", another seed"),
                     .x = c.curves.time_s,
                     .y = values->values,
                     .dash = dash_of(s.preset, s.seed),
                     .colour = colour_of(s.sweep, s.coupling)};
    std::replace(line.name.begin(), line.name.end(), '_', ' ');
    for (double& y : line.y) y *= shown.factor;
    add_curve(chart, line);
  }
  return chart;
}

}  // namespace

std::vector<Figure> figures_of(const std::vector<CaseResult>& results) {
  std::vector<Figure> figures;
  const auto keep = [&](const std::string& file, const std::string& caption, cases::Chart chart) {
    if (!chart.series.empty()) figures.push_back({file, caption, std::move(chart)});
  };
  if (results.empty()) return figures;
  const std::pair<const char*, const char*> of_flows[] = {{"retained_mass", "as Fig. 10"},
                                                          {"retained_large", "as Fig. 10"},
                                                          {"retained_small", "as Fig. 10"},
                                                          {"lower_cable_sum", "as Fig. 14"},
                                                          {"upper_cable_sum", "as Fig. 14"},
                                                          {"left_cable_sum", "as Fig. 14"},
                                                          {"right_cable_sum", "as Fig. 14"},
                                                          {"barrier_sum", "as Fig. 14"},
                                                          {"barrier_sum_mean", "ours alone"},
                                                          {"e_in", "Table 5"},
                                                          {"e_in_lower", "Table 5"},
                                                          {"e_out", "Table 5"},
                                                          {"e_out_lower", "Table 5"},
                                                          {"e_d_lower", "Table 5"},
                                                          {"e_b", "Table 5"},
                                                          {"eta", "as Fig. 15"},
                                                          {"outflow_liquid_share", "ours alone"},
                                                          {"outflow_liquid_share_kinetic", "ours alone"},
                                                          {"out_liquid_kinetic", "as Fig. 16"},
                                                          {"out_liquid_potential", "as Fig. 16"},
                                                          {"out_grains_kinetic", "as Fig. 16"},
                                                          {"out_grains_potential", "as Fig. 16"},
                                                          {"eta_lower", "as Fig. 15"},
                                                          {"zeta", "as Fig. 17"},
                                                          {"zeta_lower", "as Fig. 17"},
                                                          {"froude_front", "Table 5"},
                                                          {"froude_deepest", "Table 5"},
                                                          {"elongation", "section 4.4"},
                                                          {"net_impulse_grains", "ours alone"},
                                                          {"grains_impulse_water", "ours alone"},
                                                          {"water_share", "ours alone"},
                                                          {"velocity_through_net", "ours alone"},
                                                          {"clogging", "ours alone"},
                                                          {"ring_travel", "ours alone"}};
  for (const auto& [name, where] : of_flows)
    keep(std::string("flows_") + name, fmt::format("{} ({})", quantity(name).meaning, where),
         over_flows(name, results));
  for (const Choice& sweep : sweeps())
    for (const ShownColumn& shown : shown_columns())
      keep(fmt::format("time_{}_{}", sweep.name, shown.name),
           fmt::format("{} at L = 4.10 m{}", shown.title, shown.where), over_time(shown, 4.1, sweep.name, results));
  return figures;
}

namespace {

std::string shown(double x) { return std::isfinite(x) ? fmt::format("{:.4g}", x) : std::string("-"); }

/// Rows: quantities; columns: theirs and the cases of one flow.
std::string table_of_flow(const std::string& sweep, double release, const std::vector<CaseResult>& results) {
  std::vector<const CaseResult*> here;
  for (const CaseResult& c : results)
    if (c.study_case.sweep == sweep && c.study_case.release == release) here.push_back(&c);
  std::string html = "<table><tr><th>quantity</th><th>unit</th><th>Li et al.</th>";
  for (const CaseResult* c : here)
    html += fmt::format("<th>{}<br>{}{}{}</th>", c->study_case.coupling, c->study_case.preset,
                        c->study_case.seed == 1 ? "" : fmt::format(", seed {}", c->study_case.seed),
                        c->study_case.variant == variants().front().name ? "" : "<br>" + c->study_case.variant);
  html += "</tr>\n";
  for (const Compared& q : compared_quantities()) {
    html += fmt::format("<tr><td title=\"{}\">{}</td><td>{}</td><td>{}</td>", q.meaning, q.name, q.unit,
                        shown(q.theirs(release).value_or(std::nan(""))));
    for (const CaseResult* c : here) html += fmt::format("<td>{}</td>", shown(c->value(q.name)));
    html += "</tr>\n";
  }
  html += "<tr><td>wall time</td><td>min</td><td></td>";
  for (const CaseResult* c : here) html += fmt::format("<td>{:.1f}</td>", c->wall_seconds / 60);
  html += "</tr>\n<tr><td>machine</td><td></td><td></td>";
  for (const CaseResult* c : here) html += fmt::format("<td>{}</td>", cases::html_text(c->machine));
  html += "</tr>\n<tr><td>commit</td><td></td><td></td>";
  for (const CaseResult* c : here) html += fmt::format("<td>{}</td>", cases::html_text(c->commit));
  return html + "</tr></table>\n";
}

/// A few numbered pictures of a run whose names begin with `stem`, beside each other.
std::string pictures_of(const CaseResult& c, const char* stem) {
  std::vector<std::filesystem::path> files;
  if (c.folder.empty()) return {};
  for (const auto& entry : std::filesystem::directory_iterator(c.folder))
    if (entry.path().filename().string().starts_with(stem) && entry.path().extension() == ".png")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  if (files.empty()) return {};
  std::string html = fmt::format("<h3>{}</h3>\n<div class=\"pictures\">", c.study_case.name());
  constexpr std::size_t kShown = 4;
  for (std::size_t k = 1; k <= std::min(kShown, files.size()); ++k) {
    const auto& file = files[(files.size() - 1) * k / std::min(kShown, files.size())];
    html += cases::html_image(file);
  }
  return html + "</div>\n";
}

std::string trend_table(const std::vector<CaseResult>& results) {
  const std::vector<Trend> all = trends(results);
  if (all.empty()) return "<p>Too few flows for trends.</p>\n";
  std::string html =
      "<p>Measure: of what rises or falls the rank correlation with the release distance, of what levels off the slope "
      "from L = 6.35 m on over that before, of the greater part its least share. Of flows of several programs "
      "(commits) "
      "a trend may be what changed between these.</p>\n"
      "<table><tr><th>trend in the paper</th><th>sweep</th><th>coupling</th><th>preset</th><th>flows</th>"
      "<th>programs</th><th>measure</th><th>agrees</th></tr>\n";
  for (const Trend& t : all)
    html += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
        t.statement, t.sweep, t.coupling, t.preset, t.flows, t.programs,
        std::isfinite(t.measure) ? fmt::format("{:.2f}", t.measure) : "-", name_of(t.agrees));
  return html + "</table>\n";
}

std::string ledger_lines(const std::vector<CaseResult>& results) {
  if (results.empty()) return {};
  std::string html;
  for (const CaseResult& c : results)
    for (const std::string& check : c.failed_checks)
      html += fmt::format("<li>{}: {} did not pass</li>\n", c.study_case.name(), cases::html_text(check));
  return html.empty() ? "<p>All checks of all runs passed: ledgers of liquid and of the particles' energy, exchange of "
                        "momentum, "
                        "links of rings.</p>\n"
                      : "<ul>" + html + "</ul>\n";
}

}  // namespace

void write_report(const std::vector<CaseResult>& results, const Sitting& sitting, const std::filesystem::path& folder) {
  cases::replace_text_file(folder / kComparisonTable, comparison_csv(results));
  std::string html =
      "<!DOCTYPE html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>Debris flows on a ring net: resolved and "
      "averaged</title><style>body{font:16px/1.5 sans-serif;max-width:75em;margin:2em auto;padding:0 1em}"
      "table{border-collapse:collapse;margin:1em 0}td,th{padding:.1em .7em;text-align:right;border-bottom:1px solid "
      "#ddd}td:first-child,th:first-child{text-align:left}figure{display:inline-block;margin:.5em}"
      ".pictures img{width:24%}</style></head><body>\n<h1>Debris flows on a ring net: resolved and averaged</h1>\n";
  html += fmt::format("<p>{} runs. Theirs: Li, Zhao &amp; Kwan 2020, averaged CFD-DEM. This page: commit {}, {}.</p>\n",
                      results.size(), sitting.commit, sitting.date);
  if (!sitting.missing.empty()) {
    html += "<p>Without a result:";
    for (const std::string& name : sitting.missing) html += " " + name;
    html += "</p>\n";
  }
  html +=
      "<h2>Trends</h2>\n" + trend_table(results) + "<h2>Books</h2>\n" + ledger_lines(results) + "<h2>Figures</h2>\n";
  for (const Figure& figure : figures_of(results)) {
    const std::filesystem::path file = folder / (figure.file + ".svg");
    figure.chart.write_all(file);
    html += "<figure>" + cases::html_image(file) + "<figcaption>" + figure.caption + "</figcaption></figure>\n";
  }
  html += "<h2>Flow by flow</h2>\n";
  for (const Choice& sweep : sweeps()) {
    std::set<double> releases;
    for (const CaseResult& c : results)
      if (c.study_case.sweep == sweep.name) releases.insert(c.study_case.release);
    for (const double release : releases)
      html +=
          fmt::format("<h3>{}, L = {:.2f} m</h3>\n", sweep.name, release) + table_of_flow(sweep.name, release, results);
  }
  html += "<h2>Pictures</h2>\n";
  for (const CaseResult& c : results)
    if (c.study_case.release == 4.1) html += pictures_of(c, "image_");
  html +=
      "<h2>Forces in the net</h2>\n<p>Force in each bond, seen from downstream (as Fig. 12): the net's width, and with "
      "it the left cable, begins on the left.</p>\n";
  for (const CaseResult& c : results)
    if (c.study_case.release == 4.1) html += pictures_of(c, "forces_");
  cases::replace_text_file(folder / "report.html", html + "</body></html>\n");
}

}  // namespace lahar::study
