// The page of a study.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "cases/compare_cfd_dem/report.h"
#include "cases/files/png_file.h"
#include "tests/cases/compare_cfd_dem/made_up_case.h"
#include "tests/cases/compare_cfd_dem/study_program.h"
#include "tests/cases/files/test_folder.h"

namespace lahar::study {
namespace {

/// A record of before a quantity was asked for is no curve in its figure.
TEST(Report, FiguresHoldWhatCasesHave) {
  CaseResult with = made_up(4.1, 50, 10), without = made_up(8.6, 100, 10);
  without.study_case.coupling = "averaged";
  with.values["grains_impulse_water"] = 4;
  std::map<std::string, std::size_t> curves;
  for (const Figure& f : figures_of({with, without})) curves[f.file] = f.chart.series.size();
  EXPECT_EQ(curves.at("flows_grains_impulse_water"), 1u);
  EXPECT_EQ(curves.at("flows_e_in"), 3u);  // theirs, resolved, averaged
  EXPECT_FALSE(curves.contains("flows_net_impulse_grains"));
}

/// What two programs found may differ by what changed between them: their points stand alone.
TEST(Report, NoLineJoinsFlowsOfTwoPrograms) {
  std::vector<CaseResult> results;
  for (const double release : {1.85, 2.60, 3.35, 4.10}) {
    results.push_back(made_up(release, 50, 10));
    results.back().commit = release < 3 ? "aaa" : "bbb";
  }
  const auto ours = [&] {
    for (const Figure& f : figures_of(results))
      if (f.file == "flows_e_in") return f.chart.series.back().y;
    return std::vector<double>();
  };
  ASSERT_EQ(ours().size(), 5u);
  EXPECT_TRUE(std::isnan(ours()[2]));
  for (CaseResult& c : results) c.commit = "aaa";
  EXPECT_EQ(ours(), (std::vector<double>{50, 50, 50, 50}));
}

/// In the figures a sixth of the width would stand beside the whole; tables over seeds have it.
TEST(Report, StripsStandInTablesOverSeeds) {
  std::vector<CaseResult> results{made_up(4.1, 8, 1), made_up(4.1, 9, 1, 2)};
  for (CaseResult& c : results) c.study_case.preset = "strip", c.commit = "aaa", c.folder.clear();
  for (const Figure& f : figures_of(results))
    for (const cases::ChartSeries& series : f.chart.series) EXPECT_EQ(series.name, "Li et al. 2020") << f.file;
  for (const auto& [seed, e_in] : {std::pair{1, 9.0}, {2, 10.0}}) {
    results.push_back(made_up(4.1, e_in, 1, seed));
    results.back().study_case.preset = "strip", results.back().study_case.coupling = "averaged";
    results.back().commit = "aaa";
  }
  std::map<std::string, cases::Chart> charts;
  for (const Figure& f : figures_of(results)) charts[f.file] = f.chart;
  EXPECT_FALSE(charts.contains("changes_barrier_sum_mean")) << "not known";
  const auto& changes = charts.at("changes_e_in").series;
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_NEAR(changes[0].y.at(0), 100 * (9.5 / 8.5 - 1), 1e-9);
  EXPECT_GT(changes[0].error.at(0), 0);
  const cases::TestFolder folder;
  write_report(results, {"aaa", "2026-01-31", {}}, folder.path());
  const std::string page = content_of(folder / "report.html");
  EXPECT_NE(page.find("<h3>matched, L = 4.10 m, strip, resolved: 2 seeds</h3>"), std::string::npos);
  EXPECT_NE(page.find("<td>e_in</td><td>kJ</td><td>8.5</td><td>0.7071</td><td>-</td>"), std::string::npos);
}

/// Further seeds share a name: twenty of them leave room for the figure.
TEST(Report, FurtherSeedsAreNamedOnce) {
  std::vector<CaseResult> results;
  for (int seed = 1; seed <= 20; ++seed) {
    results.push_back(made_up(4.1, 50, 10));
    results.back().study_case.seed = seed;
  }
  for (const Figure& f : figures_of(results))
    if (f.file == "flows_e_in") {
      EXPECT_EQ(f.chart.series.size(), 21u);  // theirs, too
      EXPECT_EQ(
          std::count_if(f.chart.series.begin(), f.chart.series.end(), [](const auto& s) { return !s.name.empty(); }),
          3);
      return;
    }
  FAIL() << "no figure of the energy that arrives";
}

/// The largest of all its flows is no point of one of them.
TEST(Report, LargestOfThePaperIsALevel) {
  CaseResult c = made_up(8.6, 100, 10);
  c.values["elongation"] = 0.5;
  for (const Figure& f : figures_of({c}))
    if (f.file == "flows_elongation") {
      EXPECT_EQ(f.chart.series.size(), 1u);
      ASSERT_EQ(f.chart.y_guides.size(), 1u);
      EXPECT_EQ(f.chart.y_guides[0].at, 0.263);
      return;
    }
  FAIL() << "no figure of the elongation";
}

/// Points without a line are told apart by colour and shape alone, lines by colour and dash.
TEST(Report, CurvesOfTheStudyLookDifferent) {
  std::vector<CaseResult> results;
  for (const Choice& sweep : sweeps())
    for (const Choice& coupling : couplings())
      for (const auto& [preset, seed] : std::vector<std::pair<std::string, int>>{
               {"coarse", 1}, {"coarse", 2}, {"standard", 1}, {"fine", 1}, {"paper_cells", 1}}) {
        if (preset == "paper_cells" && coupling.name == "resolved") continue;
        if (coupling.name == "averaged_beads" && (preset != "coarse" || seed != 1)) continue;
        results.push_back(made_up(4.1, 50, 10));
        StudyCase& c = results.back().study_case;
        c.sweep = sweep.name, c.coupling = coupling.name, c.preset = preset, c.seed = seed;
        results.back().curves.time_s = {0, 1};
        results.back().curves.columns = {{shown_columns().at(0).name, "", "", {1, 2}}};
      }
  for (const Figure& f : figures_of(results)) {
    std::set<std::tuple<cases::ChartColour, int>> looks;
    for (const cases::ChartSeries& s : f.chart.series)
      looks.emplace(s.colour.value(),
                    s.mark == cases::Mark::line ? static_cast<int>(s.dash) : 100 + static_cast<int>(s.shape.value()));
    EXPECT_EQ(looks.size(), f.chart.series.size()) << f.file;
  }
}

/// A page of nothing does not say that all is well.
TEST(Report, OfNothingSaysNothing) {
  const cases::TestFolder folder;
  write_report({}, {"commit", "today", {"a-case"}}, folder.path());
  std::ostringstream html;
  html << std::ifstream(folder.path() / "report.html").rdbuf();
  EXPECT_NE(html.str().find("0 runs"), std::string::npos);
  EXPECT_EQ(html.str().find("All checks"), std::string::npos);
}

std::string page_of(const std::vector<CaseResult>& results) {
  const cases::TestFolder folder;
  write_report(results, {"commit", "today", {}}, folder.path());
  std::ostringstream html;
  html << std::ifstream(folder.path() / "report.html").rdbuf();
  return html.str();
}

/// What stands at the top is counted of the cases.
TEST(Report, BeginsWithASummary) {
  std::vector<CaseResult> results;
  for (const auto& [release, e_in] : std::vector<std::pair<double, double>>{{1.85, 30}, {4.1, 50}, {8.6, 100}})
    for (const char* coupling : {"resolved", "averaged"}) {
      CaseResult c = made_up(release, e_in, 10);
      c.study_case.coupling = coupling;
      c.values["e_out_lower"] = coupling == std::string("resolved") ? 10 : release == 4.1 ? 11 : 5;
      results.push_back(c);
    }
  std::string html = page_of(results);
  const std::size_t plan = planned_cases().size();
  EXPECT_NE(html.find("6 cases. Of the " + std::to_string(plan) + " of the whole study " + std::to_string(plan - 6) +
                      " are missing"),
            std::string::npos)
      << html;
  EXPECT_NE(html.find("as_printed-L1.85-coarse-resolved-seed1, "), std::string::npos);
  EXPECT_NE(html.find("Trends of the paper, matched, resolved, coarse: 3 of "), std::string::npos);
  // Retained mass and e_b are alike in both, of e_out_lower one flow in three is nearer averaged.
  EXPECT_NE(html.find("matched, coarse: resolved in 1 of "), std::string::npos);
  EXPECT_NE(html.find("<td>e_out_lower</td><td>matched</td><td>coarse</td><td>3</td><td>0</td><td>2</td><td>1</td>"),
            std::string::npos);
  EXPECT_LT(html.find("<h2>Summary</h2>"), html.find("<h2>Trends</h2>"));
  results.pop_back();
  html = page_of(results);
  EXPECT_NE(html.find("5 cases."), std::string::npos);
}

/// Only checks that were there have passed.
TEST(Report, NamesChecksThatWereThere) {
  std::vector<CaseResult> results{made_up(1.85, 30, 10), made_up(4.1, 50, 10)};
  take_summary(results[0], R"({"wall_seconds": 1, "checks": [
      {"name": "liquid_mass_ledger", "value": 1e-6, "tolerance": 1e-4, "pass": true}]})",
               "summary.json");
  take_summary(results[1], R"({"wall_seconds": 1, "checks": [
      {"name": "liquid_mass_ledger", "value": 1e-6, "tolerance": 1e-4, "pass": true},
      {"name": "momentum_audit", "value": 1e-7, "tolerance": 1e-6, "pass": true}]})",
               "summary.json");
  std::string html = page_of(results);
  EXPECT_NE(html.find("<p>All checks passed: liquid_mass_ledger, momentum_audit.</p>"), std::string::npos) << html;
  EXPECT_NE(html.find("<li>momentum_audit: absent in 1 of 2 runs</li>"), std::string::npos);
  EXPECT_NE(html.find("<li>ring_links_changed: absent in 2 of 2 runs</li>"), std::string::npos);
  EXPECT_NE(html.find("3 passed, 0 failed, 9 absent"), std::string::npos);
  take_summary(results[0], R"({"wall_seconds": 1, "checks": [
      {"name": "liquid_mass_ledger", "value": 5e-5, "tolerance": 1e-4, "pass": true}]})",
               "summary.json");
  html = page_of(results);
  EXPECT_EQ(html.find("All checks passed"), std::string::npos);
  EXPECT_NE(html.find("matched-L1.85-coarse-resolved-seed1: liquid_mass_ledger did not pass: 5e-05, at most 1e-05"),
            std::string::npos)
      << html;
}

TEST(Report, IsWholeAndNeedsNoOtherFile) {
  const cases::TestFolder folder;
  const std::vector<CaseResult> results{made_up(1.85, 30, 10), made_up(3, 40, 10), made_up(4.1, 50, 10)};
  std::vector<CaseResult> with_folder = results;
  take_summary(with_folder[1], R"({"wall_seconds": 90, "commit": "aaa", "machine": "bbb", "checks": []})", "summary");
  for (CaseResult& c : with_folder) c.folder = folder.path();
  write_report(with_folder, {"commit", "today", {"a-case"}}, folder.path());
  std::ostringstream html;
  html << std::ifstream(folder.path() / "report.html").rdbuf();
  EXPECT_NE(html.str().find("</html>"), std::string::npos);
  EXPECT_NE(html.str().find("src=\"data:image/svg+xml;base64,"), std::string::npos);
  EXPECT_NE(html.str().find("a-case"), std::string::npos);
  for (const char* of_the_case : {"<td>aaa</td>", "<td>bbb</td>"})
    EXPECT_NE(html.str().find(of_the_case), std::string::npos) << of_the_case;
  for (const char* flow : {"L = 1.85 m", "L = 3.00 m", "L = 4.10 m"})
    EXPECT_NE(html.str().find(flow), std::string::npos) << flow;
  EXPECT_EQ(html.str().find("src=\"image"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "flows_eta.png"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "comparison.csv"));
}

/// What a command prints.
std::string printed_by(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  for (int c = 0; pipe && (c = std::fgetc(pipe.get())) != EOF;) text += static_cast<char>(c);
  return text;
}

/// Opened from a file in a browser the page shows every drawing, picture and table, and asks for nothing else.
TEST(Report, OpensInABrowser) {
  if (printed_by("command -v chromium-headless-shell").empty()) GTEST_SKIP() << "no headless Chromium";
  const cases::TestFolder folder;
  std::vector<CaseResult> results{made_up(1.85, 30, 10), made_up(4.1, 50, 10)};
  for (CaseResult& c : results) c.folder = folder.path();
  for (const char* name : {"image_000000.png", "image_000001.png", "forces_000000.png", "forces_000001.png"})
    cases::write_png(folder.path() / name, cases::Image(40, 30, cases::Colour(0.2F, 0.5F, 0.7F)));
  write_report(results, {"commit", "today", {}}, folder.path());
  std::ofstream(folder.path() / "probe.html") << R"(<!DOCTYPE html><p id="found"></p><iframe src="report.html"
    width="1200" height="900" onload="
    const d = this.contentDocument, all = s => [...d.querySelectorAll(s)], drawings = all('figure > img');
    const asked = this.contentWindow.performance.getEntriesByType('resource').filter(r => !r.name.startsWith('data:'));
    document.getElementById('found').textContent = [
      'tables', all('table').length, 'drawings', drawings.length,
      'flat', drawings.filter(s => s.naturalWidth < 100).length, 'pictures', all('.pictures > img').length,
      'broken', all('.pictures > img').filter(i => i.naturalWidth != 40).length,
      'shared names', all('[id]').length, 'asked', asked.length].join(' ');
    "></iframe>)";
  const std::string dom = printed_by(
      "chromium-headless-shell --no-sandbox --disable-gpu --allow-file-access-from-files "
      "--virtual-time-budget=10000 --dump-dom 'file://" +
      (std::filesystem::absolute(folder.path()) / "probe.html").string() + "' 2>/dev/null");
  const std::size_t drawings = figures_of(results).size();
  EXPECT_GT(drawings, 5u);
  EXPECT_NE(
      dom.find("tables 2 drawings " + std::to_string(drawings) + " flat 0 pictures 4 broken 0 shared names 0 asked 0<"),
      std::string::npos)
      << dom;
}

}  // namespace
}  // namespace lahar::study
