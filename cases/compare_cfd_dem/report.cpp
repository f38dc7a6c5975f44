#include "cases/compare_cfd_dem/report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "cases/compare_cfd_dem/over_seeds.h"
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

/// Other readings have no figures, and strips no place beside flows of the whole width.
bool is_drawn(const StudyCase& c) { return c.variant == variants().front().name && !is_strip(c); }

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
    return c.sweep == sweep && c.preset == preset && c.coupling == coupling && c.seed == seed && is_drawn(c);
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

bool has_paper_cells(const std::string& preset) { return preset == "paper_cells"; }

/// Of one colour presets and packings differ by their points. The paper's are circles, and those of its cells.
cases::PointShape shape_of(const Curve& c) {
  using enum cases::PointShape;
  const bool matched = c.sweep == "matched";
  if (c.coupling == "averaged_beads" && has_paper_cells(c.preset)) return matched ? triangle : triangle_down;
  if (c.coupling == "averaged_beads") return matched ? diamond : square;
  if (has_paper_cells(c.preset)) return circle;
  if (c.preset != presets().front().name) return c.preset == "standard" ? triangle_down : triangle;
  return c.seed == 1 ? square : diamond;
}

/// And by their dashes.
cases::Dash dash_of(const std::string& preset, int seed) {
  using enum cases::Dash;
  if (preset != presets().front().name) return preset == "standard" ? dashed : dash_dot;
  return seed == 1 ? solid : dotted;
}

/// Lines over time have no dash left for cells of the paper's size: these are circles, one in 50 ms.
void show_as_circles(cases::ChartSeries& line) {
  constexpr double apart = 0.05 * (1 - 1e-6);  // s
  std::vector<double> x, y;
  for (std::size_t k = 0; k < line.x.size(); ++k)
    if (x.empty() || line.x[k] >= x.back() + apart) x.push_back(line.x[k]), y.push_back(line.y[k]);
  line.x = std::move(x), line.y = std::move(y);
  line.mark = cases::Mark::points, line.shape = cases::PointShape::circle;
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

/// What averaging changes of a quantity, over the paper's flows, of strips with several seeds.
cases::Chart change_over_flows(const std::string& name, const std::vector<OverSeeds>& seeds) {
  using namespace cases;
  Chart chart;
  chart.title = "what averaging changes, strips of the flows";
  chart.x = {.label = "Froude number of the paper's flow"};
  chart.y = {.label = "change of " + name, .unit = "%"};
  chart.y_guides.push_back({0, ""});
  chart.width = 480, chart.height = 300;
  for (const Choice& sweep : sweeps())
    for (const Choice& coupling : couplings()) {
      ChartSeries line{.name = fmt::format("{}, {}", sweep.name, coupling.name),
                       .mark = Mark::line_and_points,
                       .colour = colour_of(sweep.name, coupling.name),
                       .shape = coupling.name == "averaged" ? PointShape::square : PointShape::diamond};
      std::replace(line.name.begin(), line.name.end(), '_', ' ');
      for (const OverSeeds& s : seeds)
        if (const Flow* flow = published(s.release); flow && s.quantity == name && s.preset == "strip" &&
                                                     s.sweep == sweep.name && s.coupling == coupling.name &&
                                                     std::isfinite(s.change)) {
          line.x.push_back(flow->froude), line.y.push_back(100 * s.change);
          line.error.push_back(100 * s.change_error);
        }
      if (line.x.size() < 4) line.mark = Mark::points;  // what lies between is not known
      if (!line.x.empty()) chart.series.push_back(std::move(line));
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
    if (s.release != release || s.sweep != sweep || !is_drawn(s) || !values) continue;
    ChartSeries line{.name = fmt::format("{}, {}{}", s.coupling, s.preset, s.seed == 1 ? "" : ", another seed"),
                     .x = c.curves.time_s,
                     .y = values->values,
                     .dash = dash_of(s.preset, s.seed),
                     .colour = colour_of(s.sweep, s.coupling)};
    std::replace(line.name.begin(), line.name.end(), '_', ' ');
    for (double& y : line.y) y *= shown.factor;
    if (has_paper_cells(s.preset)) show_as_circles(line);
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
  const std::vector<OverSeeds> seeds = over_seeds(results);
  for (const char* name : {"e_in", "grains_impulse_water", "net_impulse_grains", "net_impulse_water",
                           "barrier_sum_mean", "retained_mass", "retained_small"})
    keep(std::string("changes_") + name,
         fmt::format("{}: what averaging changes in strips, mean of seeds and its standard error",
                     quantity(name).meaning),
         change_over_flows(name, seeds));
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
    if (c.study_case.sweep == sweep && c.study_case.release == release && !is_strip(c.study_case)) here.push_back(&c);
  if (here.empty()) return {};
  std::string html = fmt::format("<h3>{}, L = {:.2f} m</h3>\n", sweep, release) +
                     "<table><tr><th>quantity</th><th>unit</th><th>Li et al.</th>";
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

/// How many of the checks have an outcome, and of which names.
struct Counted {
  std::size_t count = 0;
  std::set<std::string> names;
};
Counted count_of(Outcome outcome, const std::vector<CaseResult>& results) {
  Counted counted;
  for (const CaseResult& c : results)
    for (const CaseCheck& check : c.checks)
      if (check.outcome == outcome) ++counted.count, counted.names.insert(check.name);
  return counted;
}

/// What failed, run by run; what runs do not have; and if nothing failed, what was there.
std::string ledger_lines(const std::vector<CaseResult>& results) {
  std::string html;
  for (const CaseResult& c : results)
    for (const CaseCheck& check : c.checks)
      if (check.outcome == Outcome::failed)
        html += fmt::format("<li>{}: {} did not pass: {}, at most {}</li>\n", c.study_case.name(),
                            cases::html_text(check.name), shown(check.value), shown(check.bar));
  for (const std::string& name : count_of(Outcome::absent, results).names) {
    const auto lack = std::count_if(results.begin(), results.end(), [&](const CaseResult& c) {
      return std::any_of(c.checks.begin(), c.checks.end(),
                         [&](const CaseCheck& k) { return k.name == name && k.outcome == Outcome::absent; });
    });
    html += fmt::format("<li>{}: absent in {} of {} runs</li>\n", cases::html_text(name), lack, results.size());
  }
  if (!html.empty()) html = "<ul>" + html + "</ul>\n";
  const Counted passed = count_of(Outcome::passed, results);
  if (passed.count > 0 && count_of(Outcome::failed, results).count == 0)
    html += fmt::format("<p>All checks passed: {}.</p>\n",
                        cases::html_text(fmt::format("{}", fmt::join(passed.names, ", "))));
  return html;
}

/// What of the plan has no result, to be unfolded.
std::string plan_line(const std::vector<CaseResult>& results) {
  const std::vector<StudyCase> plan = planned_cases();
  std::vector<std::string> missing;
  for (const StudyCase& c : plan)
    if (std::none_of(results.begin(), results.end(),
                     [&](const CaseResult& r) { return r.study_case.name() == c.name(); }))
      missing.push_back(c.name());
  std::string html = fmt::format("<li>{} cases. Of the {} of the whole study {} are missing", results.size(),
                                 plan.size(), missing.size());
  if (!missing.empty()) html += fmt::format(":<details><summary>which</summary>{}</details>", fmt::join(missing, ", "));
  return html + "</li>\n";
}

std::string trend_lines(const std::vector<CaseResult>& results) {
  struct Agreed {
    std::size_t yes = 0, mostly = 0, known = 0;
  };
  std::vector<std::pair<std::string, Agreed>> columns;
  for (const Trend& t : trends(results)) {
    const std::string name = fmt::format("{}, {}, {}", t.sweep, t.coupling, t.preset);
    if (columns.empty() || columns.back().first != name) columns.emplace_back(name, Agreed{});
    Agreed& a = columns.back().second;
    a.yes += t.agrees == Agreement::yes ? 1 : 0, a.mostly += t.agrees == Agreement::mostly ? 1 : 0;
    a.known += t.agrees == Agreement::unknown ? 0 : 1;
  }
  std::string html;
  for (const auto& [name, a] : columns)
    html += fmt::format("<li>Trends of the paper, {}: {} of {} agree, {} more mostly</li>\n", name, a.yes, a.known,
                        a.mostly);
  return html;
}

std::string nearness_lines(const std::vector<Nearness>& all) {
  std::string html;
  for (const Choice& sweep : sweeps())
    for (const Choice& preset : presets()) {
      std::size_t quantities = 0, resolved = 0, averaged = 0;
      for (const Nearness& n : all) {
        if (n.sweep != sweep.name || n.preset != preset.name) continue;
        quantities += 1;
        resolved += n.resolved_nearer > n.averaged_nearer ? 1 : 0;
        averaged += n.averaged_nearer > n.resolved_nearer ? 1 : 0;
      }
      if (quantities > 0)
        html += fmt::format(
            "<li>Nearer to the paper in more of the flows, {}, {}: resolved in {} of {} quantities, averaged in "
            "{}</li>\n",
            sweep.name, preset.name, resolved, quantities, averaged);
    }
  return html;
}

std::string findings(const std::vector<CaseResult>& results) {
  return fmt::format(
             "<h2>Summary</h2>\n<ul>\n{}<li>Checks, by the study's bars: {} passed, {} failed, {} absent</li>\n",
             plan_line(results), count_of(Outcome::passed, results).count, count_of(Outcome::failed, results).count,
             count_of(Outcome::absent, results).count) +
         trend_lines(results) + nearness_lines(nearness(results)) + "</ul>\n";
}

std::string nearness_table(const std::vector<Nearness>& all) {
  if (all.empty()) return "<p>No flow was run both resolved and averaged.</p>\n";
  std::string html =
      "<p>Flows that were run resolved and averaged (Di Felice's drag). Energies count from the bed 1.30 m downstream. "
      "To be nearer is no proof: errors may cancel, and quantities hang together. Pairs of two programs (commits) "
      "count, too.</p>\n<table><tr><th>quantity</th><th>sweep</th><th>preset</th><th>flows</th><th>of one program</th>"
      "<th>resolved nearer</th><th>averaged nearer</th><th>resolved over theirs</th><th>averaged over theirs</th>"
      "</tr>\n";
  for (const Nearness& n : all)
    html += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
        "</tr>\n",
        n.quantity, n.sweep, n.preset, n.flows, n.of_one_program, n.resolved_nearer, n.averaged_nearer,
        shown(n.resolved_over_theirs), shown(n.averaged_over_theirs));
  return html + "</table>\n";
}

/// Means over seeds, flow by flow.
std::string seeds_tables(const std::vector<OverSeeds>& all) {
  std::string html =
      "<p>Mean over the seeds that one program ran and standard deviation of a run; what averaging changes, per cent "
      "of "
      "the resolved mean, with its standard error.</p>\n";
  std::string flow;
  for (const OverSeeds& s : all) {
    const std::string here =
        fmt::format("{}, L = {:.2f} m, {}, {}: {} seeds", s.sweep, s.release, s.preset, s.coupling, s.seeds);
    if (here != flow) {
      html += fmt::format(
          "{}<h3>{}</h3>\n<table><tr><th>quantity</th><th>unit</th><th>mean</th><th>deviation</th>"
          "<th>change, %</th></tr>\n",
          flow.empty() ? "" : "</table>\n", here);
      flow = here;
    }
    html += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n", s.quantity, s.unit, shown(s.mean),
        shown(s.deviation),
        std::isfinite(s.change) ? fmt::format("{:+.1f} &plusmn; {:.1f}", 100 * s.change, 100 * s.change_error) : "-");
  }
  return all.empty() ? "<p>No flow was run with several seeds by one program.</p>\n" : html + "</table>\n";
}

/// Whose pictures the page has.
bool is_pictured(const StudyCase& c) { return c.release == 4.1 && (!is_strip(c) || c.seed == 1); }

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
  html += findings(results) + "<h2>Nearer to the paper</h2>\n" + nearness_table(nearness(results)) +
          "<h2>Trends</h2>\n" + trend_table(results) + "<h2>Books</h2>\n" + ledger_lines(results) +
          "<h2>Figures</h2>\n";
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
    for (const double release : releases) html += table_of_flow(sweep.name, release, results);
  }
  html += "<h2>Over seeds</h2>\n" + seeds_tables(over_seeds(results)) + "<h2>Pictures</h2>\n";
  for (const CaseResult& c : results)
    if (is_pictured(c.study_case)) html += pictures_of(c, "image_");
  html +=
      "<h2>Forces in the net</h2>\n<p>Force in each bond, seen from downstream (as Fig. 12): the net's width, and with "
      "it the left cable, begins on the left.</p>\n";
  for (const CaseResult& c : results)
    if (is_pictured(c.study_case)) html += pictures_of(c, "forces_");
  cases::replace_text_file(folder / "report.html", html + "</body></html>\n");
}

}  // namespace lahar::study
