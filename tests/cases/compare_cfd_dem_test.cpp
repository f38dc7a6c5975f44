// The study of the paper's flows: which runs, what is done and what goes on, the table and the page.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <sstream>

#include "cases/assembly/estimates.h"
#include "cases/assembly/load.h"
#include "cases/compare_cfd_dem/jobs.h"
#include "cases/compare_cfd_dem/published_flows.h"
#include "cases/compare_cfd_dem/record.h"
#include "cases/compare_cfd_dem/report.h"
#include "cases/compare_cfd_dem/trends.h"
#include "cases/files/output_file.h"
#include "cases/files/png_file.h"
#include "cases/runner/options.h"
#include "cases/scene/writer.h"
#include "core/check.h"
#include "tests/cases/files/test_folder.h"

namespace lahar::study {
namespace {

TEST(StudyCases, AreBothSweepsOfTenFlowsByDefault) {
  const std::vector<StudyCase> all = cases_of({});
  EXPECT_EQ(all.size(), 40u);
  std::set<std::string> names;
  for (const StudyCase& c : all) EXPECT_TRUE(names.insert(c.name()).second) << c.name();
  EXPECT_TRUE(names.contains("matched-L4.10-coarse-averaged-seed1"));
}

TEST(StudyCases, NamesThatAreNoneAreRefused) {
  try {
    (void)cases_of({.couplings = {"resolve"}});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(e.mistakes().at(0).message.find("resolved, averaged"), std::string::npos);
  }
  EXPECT_THROW(cases_of({.releases = {0.5}}), InputError);
  EXPECT_EQ(cases_of({.sweeps = {"matched"}, .couplings = {"resolved"}, .releases = {4.1, 4.1}}).size(), 1u);
  EXPECT_THROW(cases_of({.releases = {4.123}}), InputError);  // names and scenes hold centimetres
  EXPECT_THROW(cases_of({.seeds = {1, -1}}), InputError);     // as scenes do
  EXPECT_NO_THROW(cases_of({.seeds = {0}}));
}

TEST(StudyCases, LeaveOutVariantsThatSayNothing) {
  const auto couplings_of = [](const Selection& selection) {
    std::set<std::string> names;
    for (const StudyCase& c : cases_of(selection)) names.insert(c.coupling);
    return names;
  };
  EXPECT_EQ(couplings_of({.variants = {"short_averages"}}), std::set<std::string>{"averaged"});
  EXPECT_EQ(couplings_of({.variants = {"rigid_grains"}}), std::set<std::string>{"resolved"});
  EXPECT_EQ(couplings_of({.variants = {"half_speed"}}), (std::set<std::string>{"averaged", "resolved"}));
  try {
    (void)cases_of({.couplings = {"averaged", "averaged_ergun"}, .variants = {"study", "rigid_grains"}});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(e.mistakes().at(0).message.find("--variant rigid_grains"), std::string::npos);
  }
}

/// Also where the step adapts: what it aims at is half as fast.
TEST(StudyCases, HalfSpeedHalvesTheTimeStep) {
  for (const char* preset : {"coarse", "standard"}) {
    const StudyCase study{"matched", preset, "resolved", "study", 4.1, 1, {}};
    StudyCase half = study;
    half.variant = "half_speed";
    const scene::Scene a = scene::load(study.scene_file(), study.changes()),
                       b = scene::load(half.scene_file(), half.changes());
    EXPECT_NEAR(cases::fluid_time_step(b) / cases::fluid_time_step(a), 0.5, 1e-12) << preset;
    EXPECT_EQ(b.fluid.lattice_velocity, 0.5 * a.fluid.lattice_velocity) << preset;
  }
}

/// Each choice of each axis makes a scene that can be run, and that holds what was chosen.
TEST(StudyCases, MakeScenes) {
  const auto load = [](const StudyCase& c) { return scene::load(c.scene_file(), c.changes()); };
  const StudyCase plain{"as_printed", "standard", "resolved", "study", 4.1, 1};
  const scene::Scene printed = load(plain);
  EXPECT_EQ(printed.barrier.anchors.bottom_cable, scene::BottomCable::along_bed);
  EXPECT_GT(printed.barrier.settle_time, 0);
  EXPECT_EQ(printed.contacts.at(1).friction, 0.7);
  StudyCase c = plain;
  c.sweep = "matched", c.release = 8.6, c.seed = 3;
  const scene::Scene matched = load(c);
  EXPECT_EQ(matched.contacts.at(1).friction, 0);
  EXPECT_EQ(matched.contacts.at(0).friction, 0.7);
  EXPECT_EQ(matched.barrier.net.origin.x(), 8.6);
  EXPECT_EQ(matched.sections.at(0).point.x(), 8.6);
  EXPECT_NEAR(matched.domain.upper.x(), 10.1, 1e-12);
  EXPECT_EQ(matched.run.seed, 3);
  for (const Choice& preset : presets()) {
    c = plain, c.preset = preset.name;
    EXPECT_NO_THROW(load(c)) << preset.name;
  }
  for (const Choice& variant : variants()) {
    c = plain, c.variant = variant.name;
    if (!variant.coupling.empty()) c.coupling = variant.coupling;
    EXPECT_NO_THROW(load(c)) << variant.name;
  }
  for (const Choice& coupling : couplings()) {
    c = plain, c.coupling = coupling.name;
    EXPECT_EQ(load(c).coupling.grains == scene::GrainFluid::averaged, coupling.name != "resolved");
  }
}

TEST(StudyCases, AreKnownByTheirNames) {
  for (const StudyCase& c : cases_of({.seeds = {1, 12}})) EXPECT_EQ(case_named(c.name(), {}), c);
  StudyCase c{"matched", "standard", "averaged_ergun", "half_speed", 7.1, 2, {"run.duration_s=1"}};
  EXPECT_EQ(case_named(c.name(), c.further), c);
  for (const char* name : {"", "report.html", "matched-L4.10-coarse-averaged", "matched-L4.1-coarse-averaged-seed1",
                           "matched-L4.10-coarse-averaged-seed01", "matched-L4.10-coarse-average-seed1",
                           "matched-L4.10-coarse-averaged-seed1-study", "matched-L4.10-coarse-averaged-seed1.log"})
    EXPECT_FALSE(case_named(name, {}).has_value()) << name;
}

TEST(StudyCases, StandInTablesByFlow) {
  const StudyCase first{"as_printed", "coarse", "averaged", "study", 1.85, 2},
      second{"as_printed", "standard", "resolved", "study", 1.85, 1},
      third{"as_printed", "coarse", "resolved", "study", 4.1, 1};
  EXPECT_TRUE(comes_before(first, second) && comes_before(second, third) && !comes_before(third, first));
}

/// The paper's table is consistent in itself, to a hundredth of a kJ.
TEST(PublishedFlows, AreWhole) {
  for (const Flow& f : published_flows()) {
    EXPECT_NEAR(f.e_d, f.e_in - f.e_out, 0.01);
    EXPECT_NEAR(f.eta, f.e_d / f.e_in, 0.0006);
    EXPECT_NEAR(f.zeta, f.e_b / f.e_d, 0.0006);
  }
  EXPECT_EQ(published(4.1)->froude, 3.111);
  EXPECT_EQ(published(4.2), nullptr);
}

CaseResult made_up(double release, double e_in, double e_out, int seed = 1) {
  CaseRun run;
  run.study_case = {"matched", "coarse", "resolved", "study", release, seed};
  run.metrics = {{"e_in_kJ", e_in},
                 {"e_out_kJ", e_out},
                 {"barrier_energy_start_J", 100},
                 {"barrier_energy_end_J", 1100},
                 {"retained_mass_ratio", 1 - 0.01 * release}};
  return result_of(run);
}

/// Of 100 J that the flow wins until the water is at the net the grains rub off 20 J; the water wins 40 J of them,
/// keeps 15 J, gives 5 J to the grains and loses the rest.
TEST(Comparison, SaysWhoLosesTheEnergyOfTheWay) {
  CaseRun run;
  run.study_case = {"matched", "coarse", "resolved", "study", 4.1, 1};
  run.metrics = {{"front_arrival_s", 0.2}};
  run.series.time_s = {0, 0.1, 0.2, 0.3};
  run.series.columns = {
      {"grains_potential_J", "J", "", {70, 40, 10, 0}}, {"fluid_potential_J", "J", "", {5, -9, -35, -50}},
      {"solids_friction_J", "J", "", {1, 4, 13, 14}},   {"solids_damping_J", "J", "", {0, 3, 8, 9}},
      {"fluid_kinetic_J", "J", "", {0, 8, 15, 16}},     {"solids_work_J", "J", "", {0, 1, 5, 6}}};
  const CaseResult result = result_of(run);
  EXPECT_NEAR(result.value("grains_loss"), 0.20, 1e-12);
  EXPECT_NEAR(result.value("water_loss"), 0.20, 1e-12);
  run.metrics["front_arrival_s"] = 0.4;
  EXPECT_TRUE(std::isnan(result_of(run).value("water_loss"))) << "the run ends before";
}

/// A force that grows as 2 kN/s x t and one that is steady. One grain runs ahead of the others: 0.2 of 1000 kg.
TEST(Comparison, IntegratesForcesOverTheSecondAfterGrainsArrive) {
  CaseRun run;
  run.study_case = {"matched", "coarse", "resolved", "study", 4.1, 1};
  run.metrics = {{"particle_arrival_s", 0.5}};
  run.grain_mass = 1000;
  run.series.time_s = {0, 0.5, 0.75, 1.25, 1.75, 2};
  run.series.columns = {{"barrier_contact_force_x_N", "N", "", {0, 1000, 1500, 2500, 3500, 4000}},
                        {"grains_fluid_force_x_N", "N", "", {300, 300, 300, 300, 300, 300}},
                        {"fluid_momentum_gap_x_Ns", "Ns", "", {0, 10, 20, 60, 150, 170}},
                        {"fluid_momentum_x_Ns", "Ns", "", {0, 900, 1000, 800, 500, 400}},
                        {"liquid_mass_kg", "kg", "", {400, 400, 400, 400, 400, 400}},
                        {"net_grains_kg_s", "kg/s", "", {0, 0.4, 40, 60, 0, 0}}};
  EXPECT_EQ(result_of(run).value("grains_arrival"), 0.75);
  EXPECT_EQ(result_of(run).value("first_grain"), 0.5);
  EXPECT_NEAR(result_of(run).value("net_impulse_grains"), 2.5, 1e-12);
  EXPECT_NEAR(result_of(run).value("water_momentum_made"), 0.13, 1e-12);
  EXPECT_NEAR(result_of(run).value("grains_impulse_water"), 0.3, 1e-12);
  EXPECT_NEAR(result_of(run).value("water_momentum"), 1, 1e-12);
  EXPECT_NEAR(result_of(run).value("water_momentum_kept"), 0.5, 1e-12);
  const double weight = 400 * 9.81 * std::sin(35 * M_PI / 180) / 1000;
  EXPECT_NEAR(result_of(run).value("water_momentum_weight"), weight, 1e-5);
  EXPECT_TRUE(std::isnan(result_of(run).value("net_impulse_water"))) << "no such column";
  EXPECT_TRUE(std::isnan(result_of(run).value("water_momentum_out"))) << "of all that it is made of";
  run.series.columns.insert(run.series.columns.begin(), {"barrier_fluid_force_x_N", "N", "", {0, 0, 100, 100, 100, 0}});
  EXPECT_NEAR(result_of(run).value("water_momentum_out"), 1 + weight + 0.13 - 0.5 - 0.3 - 0.1, 1e-5);
  std::vector<double>& crossing = run.series.columns.back().values;
  crossing = {0, 40, 0, 0, 0, 0};
  EXPECT_NEAR(result_of(run).value("net_impulse_grains"), 2, 1e-12) << "it ends between two rows";
  crossing = {0, 0, 0, 40, 0, 0};
  EXPECT_TRUE(std::isnan(result_of(run).value("grains_impulse_water"))) << "the run ends before";
}

/// A peak that lasts 0.1 s among steady forces, in rows that are not even: the best window of 0.2 s holds all of it.
TEST(Comparison, LargestMeanHoldsTheWholePeak) {
  CaseRun run;
  run.study_case = {"matched", "coarse", "resolved", "study", 4.1, 1};
  run.series.time_s = {0, 0.5, 0.6, 0.65, 0.7, 0.8, 1.0, 1.2};
  run.series.columns = {{"barrier_force_sum_N", "N", "", {1000, 1000, 1000, 9000, 1000, 1000, 1000, 1000}}};
  EXPECT_NEAR(result_of(run).value("barrier_sum_mean"), (1 * 0.2 + 8 * 0.05) / 0.2, 1e-9);
  run.series.time_s = {0, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07};
  EXPECT_TRUE(std::isnan(result_of(run).value("barrier_sum_mean"))) << "shorter than the mean";
}

/// The constants of the comparison are those of the scene.
TEST(Comparison, CountsInTheScenesGravity) {
  const StudyCase study_case{"as_printed", "coarse", "resolved", "study", 4.1, 1};
  const scene::Scene s = scene::load(study_case.scene_file(), {});
  EXPECT_EQ(s.gravity.magnitude, 9.81);
  EXPECT_EQ(s.gravity.slope_deg, 35);
  EXPECT_EQ(s.fluid.density, 1000);
}

TEST(Comparison, HoldsTheirsAndOurs) {
  std::vector<CaseResult> results{made_up(1.85, 30, 10), made_up(4.1, 50, 10), made_up(8.6, 100, 10)};
  const std::string csv = comparison_csv(results);
  EXPECT_NE(csv.find("e_in,kJ,matched-L4.10-coarse-resolved-seed1,54.361,50,-0.0802"), std::string::npos) << csv;
  EXPECT_NE(csv.find("eta,1,matched-L4.10-coarse-resolved-seed1,0.784,0.8,"), std::string::npos);
  EXPECT_NE(csv.find("zeta,1,matched-L4.10-coarse-resolved-seed1,0.067,0.025,"), std::string::npos);
  results.push_back(made_up(4.1, 60, 10, 2));
  EXPECT_NE(comparison_csv(results).find("seed1,54.361,50,-0.080223,0.0909091"), std::string::npos);
  results.push_back(made_up(4.1, 90, 10, 1));  // another reading of the net is no spread
  results.back().study_case.variant = "rockfall_dissipators";
  EXPECT_NE(comparison_csv(results).find("seed1,54.361,50,-0.080223,0.0909091"), std::string::npos);
  EXPECT_NE(comparison_csv(results).find("seed1-rockfall_dissipators,54.361,90,0.655599,\n"), std::string::npos)
      << comparison_csv(results);
  results.pop_back();
  std::size_t agree = 0;
  const std::vector<Trend> found = trends(results);
  for (const Trend& t : found) agree += t.agrees == Agreement::yes;
  EXPECT_EQ(found.size(), 13u);
  EXPECT_EQ(agree, 3u);  // retained mass and zeta fall, eta rises; of forces and of what passed nothing is known
  EXPECT_NE(
      trends_csv(found).find("\"eta rises (4.4), about the bed at the net\",matched,resolved,coarse,3,1.00,yes\n"),
      std::string::npos)
      << trends_csv(found);
  EXPECT_NE(trends_csv(found).find("whole barrier rises (4.3)\",matched,resolved,coarse,0,nan,-\n"), std::string::npos);
}

/// Three flows of which two are alike, then one that turns back: only what goes on from flow to flow agrees.
TEST(Comparison, TrendsThatTurnAgreeMostly) {
  std::vector<CaseResult> results{made_up(1.85, 30, 10), made_up(4.1, 50, 10), made_up(8.6, 100, 10)};
  const auto agreement = [&](std::vector<double> sums) {
    for (std::size_t k = 0; k < 3; ++k) results[k].values["barrier_sum"] = sums[k];
    for (const Trend& t : trends(results))
      if (t.statement.find("whole barrier") != std::string::npos) return std::pair(t.agrees, t.measure);
    return std::pair(Agreement::unknown, 0.0);
  };
  EXPECT_EQ(agreement({1, 2, 3}), std::pair(Agreement::yes, 1.0));
  EXPECT_EQ(agreement({1, 1, 3}), std::pair(Agreement::mostly, 2.0 / 3));
  EXPECT_EQ(agreement({2, 1, 3}), std::pair(Agreement::mostly, 1.0 / 3));
  EXPECT_EQ(agreement({1, 1, 1}), std::pair(Agreement::no, 0.0));
}

/// The paper's own numbers by our measures: they rise, level off and are mainly fluid as it says.
TEST(Comparison, TrendsOfThePaperAgreeWithIt) {
  std::vector<CaseResult> results;
  for (const Flow& f : published_flows()) {
    results.push_back(made_up(f.release, f.e_in, f.e_out));
    results.back().values = {
        {"eta_lower", f.eta}, {"zeta_lower", f.zeta}, {"e_b", f.e_b}, {"outflow_liquid_share", 0.9 - 0.01 * f.release}};
  }
  const auto agreement = [&](const char* part) {
    for (const Trend& t : trends(results))
      if (t.statement.find(part) != std::string::npos && t.flows > 0) return t.agrees;
    return Agreement::unknown;
  };
  EXPECT_EQ(agreement("E_b rises"), Agreement::yes);
  EXPECT_EQ(agreement("eta rises"), Agreement::mostly);  // it levels off
  EXPECT_EQ(agreement("eta levels off"), Agreement::yes);
  EXPECT_EQ(agreement("zeta falls"), Agreement::yes);
  EXPECT_EQ(agreement("mainly fluid"), Agreement::yes);
  for (CaseResult& c : results) c.values["eta_lower"] = 0.7 + 0.01 * c.study_case.release;
  EXPECT_EQ(agreement("eta levels off"), Agreement::no);
  for (CaseResult& c : results) c.values["eta_lower"] = 0.9 - 0.01 * std::min(c.study_case.release, 6.35);
  EXPECT_EQ(agreement("eta levels off"), Agreement::no) << "it falls before";
  for (CaseResult& c : results) c.values["outflow_liquid_share"] = 0.9 - 0.06 * c.study_case.release;
  EXPECT_EQ(agreement("mainly fluid"), Agreement::mostly);  // below a half from L = 7.10 m on
  std::erase_if(results, [](const CaseResult& c) { return c.study_case.release > 6.4; });
  EXPECT_EQ(agreement("eta levels off"), Agreement::unknown) << "one flow beyond the bend";
}

/// 2 t of grains of 2 t/m^3 in 1 t of liquid: liquid in their place would have half of their energy.
TEST(Comparison, PartsOfWhatLeavesAreThoseOfTheWhole) {
  CaseRun run;
  run.study_case = {"matched", "coarse", "resolved", "study", 4.1, 1};
  run.grain_mass = 2000, run.grain_volume = 1;
  run.metrics = {{"e_in_kJ", 50},
                 {"e_out_kJ", 4},
                 {"e_out_liquid_kinetic_kJ", 3},
                 {"e_out_liquid_potential_kJ", -1},
                 {"e_out_grains_kinetic_kJ", 2.5},
                 {"e_out_grains_potential_kJ", -0.5},
                 {"liquid_mass_start_kg", 1000},
                 {"liquid_passed_kg", 900}};
  run.series.time_s = {0, 1, 2};
  run.series.columns = {{"grains_passed_kg", "kg", "", {0, 100, 300}},
                        {"front_x_m", "m", "", {1, 3.95, 4.2}},
                        {"grains_kinetic_J", "J", "", {0, 9000, 20000}},
                        {"grains_potential_J", "J", "", {20000, 11000, 0}}};
  const CaseResult result = result_of(run);
  const auto value = [&](const char* name) { return result.value(name); };
  const double lower = 9.81 * 0.746 / 1000;  // kJ/kg between the two beds
  EXPECT_NEAR(value("e_in_lower"), 50 + 3000 * lower, 1e-9);
  EXPECT_NEAR(value("e_out_lower"), 4 + 1200 * lower, 1e-9);
  EXPECT_NEAR(value("out_liquid_kinetic"), 3 / value("e_in_lower"), 1e-12);
  EXPECT_NEAR(value("out_grains_potential"), (-0.5 + 300 * lower) / value("e_in_lower"), 1e-12);
  EXPECT_NEAR(value("out_liquid_kinetic") + value("out_liquid_potential") + value("out_grains_kinetic") +
                  value("out_grains_potential"),
              1 - value("eta_lower"), 1e-12);
  EXPECT_NEAR(value("e_in_full_cells"), 50 + 10, 1e-9);
  EXPECT_NEAR(value("e_out_full_cells"), 4 + 1, 1e-9);
  run.series.columns.erase(run.series.columns.begin());
  EXPECT_TRUE(std::isnan(result_of(run).value("eta_lower"))) << "what passed is not known";
}

/// A record gives back what is shown of a case; other files beside it are left alone.
TEST(Record, HoldsWhatIsShown) {
  const cases::TestFolder folder;
  CaseResult c = made_up(4.1, 50, 10, 3);
  take_summary(c, R"({"wall_seconds": 90, "commit": "abc", "metrics": {}, "checks": [{"name": "a", "pass": false}]})",
               "a.json");
  const std::string name = shown_columns().at(1).name;
  c.curves.time_s = {0, 0.004, 0.0099999999, 0.012, 0.0301, 0.033};
  c.curves.columns = {{name, "N", "a force", {1, 2, std::nan(""), 4, 1.23456789e6, 6}}};
  write_record(c, folder.path());
  std::ofstream(folder.path() / "comparison.csv") << "quantity";
  std::ofstream(folder.path() / "notes.json") << "{}";
  const std::vector<CaseResult> found = read_records(folder.path());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].study_case, c.study_case);
  EXPECT_EQ(found[0].values, c.values);
  EXPECT_EQ(found[0].wall_seconds, 90);
  EXPECT_EQ(found[0].failed_checks, std::vector<std::string>{"a"});
  EXPECT_EQ(found[0].curves.time_s, (std::vector<double>{0, 0.01, 0.0301, 0.033}));
  const auto* column = found[0].curves.find(name);
  ASSERT_NE(column, nullptr);
  EXPECT_TRUE(std::isnan(column->values.at(1)));
  EXPECT_EQ(column->values.at(2), 1.2346e6);
  write_record(found[0], folder.path() / "again");
  EXPECT_EQ(read_records(folder.path() / "again").at(0).curves.time_s, found[0].curves.time_s);
  EXPECT_EQ(comparison_csv(found), comparison_csv({c}));
}

/// What is asked for since a record was made is taken of its curves and metrics; what it holds stays.
TEST(Record, GivesWhatIsAskedForSince) {
  const cases::TestFolder folder;
  CaseResult c = made_up(4.1, 50, 10);
  take_summary(c, R"({"wall_seconds": 90, "metrics": {"e_in_kJ": 60, "liquid_left_kg": 3}, "checks": []})", "a.json");
  c.curves.time_s = {0, 0.1, 0.2, 0.3};
  c.curves.columns = {{"barrier_force_sum_N", "N", "", {0, 1000, 2000, 3000}}};
  write_record(c, folder.path());
  const CaseResult found = read_records(folder.path()).at(0);
  EXPECT_EQ(found.value("water_left"), 3);
  EXPECT_NEAR(found.value("barrier_sum_mean"), 2, 1e-12);
  EXPECT_EQ(found.value("e_in"), 50);
  EXPECT_TRUE(std::isnan(found.value("grains_arrival"))) << "the mass of the grains is not kept";
}

TEST(Record, FilesThatAreNoneAreNamed) {
  const cases::TestFolder folder;
  EXPECT_TRUE(read_records(folder.path() / "none").empty());
  const std::filesystem::path file = folder.path() / (made_up(4.1, 50, 10).study_case.name() + ".json");
  for (const char* text :
       {"", "{}", R"({"summary": {"wall_seconds": 1, "checks": []}, "values": {}, "curves": {"time_s": [0],
           "barrier_elongation_m": [1, 2]}})"}) {
    std::ofstream(file) << text;
    try {
      (void)read_records(folder.path());
      FAIL() << text;
    } catch (const cases::FileError& e) {
      EXPECT_EQ(e.path(), file);
    }
  }
}

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

/// Exit code of the executable, whose messages go into a file.
int run_study(const std::string& arguments, const std::filesystem::path& messages) {
  const int status = std::system(
      ("'" LAHAR_STUDIES "/compare_cfd_dem' " + arguments + " > /dev/null 2> '" + messages.string() + "'").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string content_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(StudyFolder, ForeignFilesAreNeverTouched) {
  const cases::TestFolder folder;
  std::filesystem::create_directory(folder / "thesis");
  for (const char* name : {"report.html", "comparison.csv", "matched-L4.10-notes.json"})
    std::ofstream(folder / "thesis" / name) << "years of work";
  const std::string thesis = "'" + (folder / "thesis").string() + "'", own = "'" + (folder / "own").string() + "'";
  EXPECT_EQ(run_study("--report --out " + thesis, folder / "messages"), 2);
  EXPECT_NE(content_of(folder / "messages").find("--out " + (folder / "thesis").string() + ":1:1: is not empty"),
            std::string::npos);
  EXPECT_EQ(run_study("--report --out " + own + " --records " + thesis, folder / "messages"), 2);
  EXPECT_NE(content_of(folder / "messages").find("--records "), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "own"));
  for (const char* name : {"report.html", "comparison.csv", "matched-L4.10-notes.json"})
    EXPECT_EQ(content_of(folder / "thesis" / name), "years of work");
}

TEST(StudyFolder, MayHoldCasesRecordsOrTheTable) {
  const cases::TestFolder folder;
  const std::string name = made_up(4.1, 50, 10).study_case.name();
  for (const char* kind : {"new", "empty", "cases", "logs", "records", "table"})
    if (kind != std::string("new")) std::filesystem::create_directory(folder / kind);
  std::filesystem::create_directory(folder / "cases" / name);
  std::ofstream(folder / "cases" / "notes.txt") << "mine";
  std::ofstream(folder / "logs" / (name + ".log")) << "killed";
  std::ofstream(folder / "records" / (name + ".json")) << "{}";
  std::ofstream(folder / "table" / kComparisonTable) << comparison_csv({});
  for (const char* kind : {"new", "empty", "cases", "logs", "records", "table"})
    EXPECT_NO_THROW(require_study_folder(folder / kind, "--out")) << kind;
}

/// Before anything is begun or listed, with the message of the scene.
TEST(StudyCases, RefuseChangesThatNoSceneTakes) {
  const cases::TestFolder folder;
  const std::string arguments = "--set foo.bar=5 --release 4.1 --out '" + (folder / "out").string() + "'";
  for (const char* option : {"", " --list", " --report"}) {
    EXPECT_EQ(run_study(arguments + option, folder / "messages"), 2) << option;
    EXPECT_NE(content_of(folder / "messages").find("foo"), std::string::npos) << option;
    EXPECT_FALSE(std::filesystem::exists(folder / "out")) << option;
  }
  Selection selection{.sweeps = {"matched"}, .couplings = {"resolved"}, .releases = {4.1}};
  selection.further = {"run.duration_s=1"};
  EXPECT_NO_THROW(check_changes(cases_of(selection)));
}

/// A study that is stopped leaves checkpoints and goes on; what is done is not run again; another scene is refused.
TEST(Jobs, GoOnAndAreNotRunTwice) {
  const cases::TestFolder folder;
  Selection selection{.sweeps = {"as_printed"}, .couplings = {"averaged"}, .releases = {1.85}};
  selection.further = {"run.duration_s=0.01", "run.image_interval_s=1", "barrier.settle_time_s=0"};
  const std::vector<StudyCase> one = cases_of(selection);
  const JobOptions options{LAHAR_EXECUTABLE, folder.path(), 1, 2};
  const std::filesystem::path place = folder.path() / one.at(0).name();
  std::vector<std::string> told;
  const auto tell = [&](const std::string& line) { told.push_back(line); };
  const auto stop = [&] { return std::filesystem::exists(place / "image_000000.png"); };  // it has begun
  EXPECT_EQ(run_all(one, options, stop, tell).at(0).exit_code, cases::exit_interrupted);
  EXPECT_EQ(standing_of(one[0], place), Standing::begun);
  EXPECT_EQ(run_all(
                one, options, [] { return false; }, tell)
                .at(0)
                .exit_code,
            cases::exit_done);
  EXPECT_EQ(standing_of(one[0], place), Standing::done);
  ASSERT_EQ(told.size(), 4u);
  EXPECT_NE(told[2].find("goes on"), std::string::npos);
  EXPECT_EQ(run_all(
                one, options, [] { return false; }, tell)
                .at(0)
                .exit_code,
            cases::exit_done);
  EXPECT_EQ(told.size(), 4u);
  const CaseResult result = read_case(one[0], place);
  EXPECT_TRUE(result.failed_checks.empty());
  EXPECT_GT(result.curves.time_s.size(), 1u);
  EXPECT_EQ(result.curves.columns.size(), shown_columns().size());
  selection.further.push_back("solids.contact_safety=0.25");
  selection.releases = {1.2, 1.85};
  const std::vector<StudyCase> two = cases_of(selection);
  EXPECT_THROW(run_all(
                   two, options, [] { return false; }, tell),
               InputError);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / two[0].name())) << "begun beside one that is refused";
}

/// What is left of other values or programs in the folder is none of this study.
TEST(StudyFolder, CasesThatCannotBeLoadedAreLeftOut) {
  const cases::TestFolder folder;
  Selection selection{.sweeps = {"matched"}, .couplings = {"resolved"}, .releases = {4.1}};
  const StudyCase resolved = cases_of(selection).at(0);
  const auto left = folder / "out" / resolved.name();
  std::filesystem::create_directories(left);
  std::ofstream(left / "scene.resolved.toml") << scene::to_toml(scene::load(resolved.scene_file(), resolved.changes()));
  EXPECT_EQ(run_study("--report --sweep matched --release 4.1 --coupling averaged --set "
                      "coupling.averaging_length_m=0.08 --out '" +
                          (folder / "out").string() + "'",
                      folder / "messages"),
            0)
      << content_of(folder / "messages");
  EXPECT_TRUE(std::filesystem::exists(folder / "out" / "report.html"));
}

/// One damaged case costs the others neither their page nor their list.
TEST(StudyFolder, DamagedCasesAreLeftOutAndNamed) {
  const cases::TestFolder folder;
  Selection selection{.sweeps = {"matched"}, .couplings = {"resolved"}, .releases = {4.1}};
  const StudyCase damaged = cases_of(selection).at(0);
  const auto left = folder / "out" / damaged.name();
  std::filesystem::create_directories(left);
  std::ofstream(left / "scene.resolved.toml") << scene::to_toml(scene::load(damaged.scene_file(), damaged.changes()));
  std::ofstream(left / "summary.json") << "{\"simulated_seconds\": 4";
  const std::string asked = " --sweep matched --release 4.1 --out '" + (folder / "out").string() + "'";
  for (const std::string coupling : {"averaged", "resolved"})
    EXPECT_EQ(run_study("--report --coupling " + coupling + asked, folder / "messages"), 0);
  EXPECT_NE(content_of(folder / "messages").find(damaged.name() + " is left out: "), std::string::npos)
      << content_of(folder / "messages");
  EXPECT_TRUE(std::filesystem::exists(folder / "out" / "report.html"));
  EXPECT_EQ(run_study("--list" + asked, folder / "messages"), 0) << content_of(folder / "messages");
}

TEST(Jobs, ARunThatFailsIsNamedWithItsLog) {
  const cases::TestFolder folder;
  Selection selection{.sweeps = {"as_printed"}, .couplings = {"averaged"}, .releases = {1.85}};
  selection.further = {"run.duration_s=0.01"};
  const StudyCase one = cases_of(selection).at(0);
  std::filesystem::create_directories(folder / "study" / one.name());
  std::ofstream(folder / "study" / one.name() / "scene.resolved.toml")
      << scene::to_toml(scene::load(one.scene_file(), one.changes()));
  std::ofstream(folder / "study" / one.name() / "checkpoint.h5") << "of a program long ago";
  const std::string study = "'" + (folder / "study").string() + "'";
  EXPECT_EQ(run_study("--sweep as_printed --coupling averaged --release 1.85 --set run.duration_s=0.01 --quiet --out " +
                          study,
                      folder / "messages"),
            2);
  const std::filesystem::path log = log_of(one, folder / "study");
  EXPECT_NE(content_of(folder / "messages").find("ended with exit code 2: " + log.string()), std::string::npos)
      << content_of(folder / "messages");
  EXPECT_NE(content_of(log).find("checkpoint.h5"), std::string::npos) << content_of(log);
}

}  // namespace
}  // namespace lahar::study
