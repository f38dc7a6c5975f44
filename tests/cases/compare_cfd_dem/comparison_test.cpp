// What is compared of a case, the table and the trends.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "cases/assembly/load.h"
#include "cases/compare_cfd_dem/published_flows.h"
#include "cases/compare_cfd_dem/trends.h"
#include "tests/cases/compare_cfd_dem/made_up_case.h"

namespace lahar::study {
namespace {

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

/// What passes the plane of the net: only rows with at least a litre a second count. Half a second at rest ends the
/// run.
TEST(Comparison, WhatAveragingHides) {
  CaseRun run;
  run.study_case = {"matched", "coarse", "resolved", "study", 4.1, 1};
  run.grain_mass = 1000;
  run.metrics = {{"e_in_kJ", 50},
                 {"e_out_kJ", 8},
                 {"liquid_mass_start_kg", 500},
                 {"liquid_passed_kg", 400},
                 {"e_out_liquid_kinetic_kJ", 3},
                 {"e_out_liquid_potential_kJ", 2},
                 {"e_out_grains_kinetic_kJ", 1},
                 {"e_out_grains_potential_kJ", 2}};
  run.series.time_s = {0, 0.5, 1, 1.5, 1.6};
  run.series.columns = {{"net_discharge_m3_s", "m^3/s", "", {0, 0.3, 0.1, 0.0005, 0}},
                        {"net_liquid_area_m2", "m^2", "", {0.4, 0.1, 0.1, 0.3, 0}},
                        {"net_grains_area_m2", "m^2", "", {0, 0.1, 0.5, 0.3, 0.3}},
                        {"barrier_force_sum_N", "N", "", {9000, 9000, 9000, 4000, 2000}},
                        {"liquid_mass_kg", "kg", "", {500, 400, 300, 120, 100}},
                        {"grains_passed_kg", "kg", "", {0, 0, 10, 60, 80}}};
  const CaseResult result = result_of(run);
  EXPECT_NEAR(result.value("velocity_through_net"), 2, 1e-12);  // 0.4 m^3/s through 0.2 m^2
  EXPECT_NEAR(result.value("clogging"), 0.75, 1e-12);           // 0.6 of 0.8 m^2
  EXPECT_NEAR(result.value("water_inside"), 100, 1e-12);
  EXPECT_NEAR(result.value("barrier_sum_at_rest"), 3, 1e-12);
  EXPECT_NEAR(result.value("e_d"), 42, 1e-12);
  const double deeper = 9.81 * 0.746 / 1000;  // kJ/kg
  EXPECT_NEAR(result.value("e_d_lower"), 42 + deeper * (1500 - 480), 1e-9);
  EXPECT_NEAR(result.value("outflow_liquid_share_kinetic"), 0.75, 1e-12);
  EXPECT_NEAR(result.value("outflow_liquid_share"), (5 + 400 * deeper) / (8 + 480 * deeper), 1e-9);
}

/// Forces are means since the row before: one that grows as 2 kN/s x t has that of the middle, and one that begins with
/// the second counts from its first row on. One grain runs ahead of the others: 0.2 of 1000 kg.
TEST(Comparison, IntegratesForcesOverTheSecondAfterGrainsArrive) {
  CaseRun run;
  run.study_case = {"matched", "coarse", "resolved", "study", 4.1, 1};
  run.metrics = {{"particle_arrival_s", 0.5}};
  run.grain_mass = 1000;
  run.series.time_s = {0, 0.5, 0.75, 1.25, 1.75, 2};
  run.series.columns = {{"barrier_contact_force_x_N", "N", "", {0, 500, 1250, 2000, 3000, 3750}},
                        {"grains_fluid_force_x_N", "N", "", {0, 0, 0, 300, 300, 300}},
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
  run.series.columns.insert(run.series.columns.begin(), {"barrier_fluid_force_x_N", "N", "", {0, 0, 0, 100, 100, 0}});
  EXPECT_NEAR(result_of(run).value("water_momentum_out"), 1 + weight + 0.13 - 0.5 - 0.3 - 0.1, 1e-5);
  std::vector<double>& crossing = run.series.columns.back().values;
  crossing = {0, 40, 0, 0, 0, 0};
  EXPECT_NEAR(result_of(run).value("net_impulse_grains"), 2.0625, 1e-12) << "it ends between two rows";
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
  for (CaseResult& c : results) c.commit = "aaa";
  const std::string csv = comparison_csv(results);
  EXPECT_NE(csv.find("e_in,kJ,matched-L4.10-coarse-resolved-seed1,54.361,50,-0.0802"), std::string::npos) << csv;
  EXPECT_NE(csv.find("eta,1,matched-L4.10-coarse-resolved-seed1,0.784,0.8,"), std::string::npos);
  EXPECT_NE(csv.find("zeta,1,matched-L4.10-coarse-resolved-seed1,0.067,0.025,"), std::string::npos);
  results.push_back(made_up(4.1, 60, 10, 2));
  results.back().commit = "aaa";
  EXPECT_NE(comparison_csv(results).find("seed1,54.361,50,-0.080223,0.0909091"), std::string::npos);
  results.push_back(made_up(4.1, 90, 10, 1));  // another reading of the net is no spread
  results.back().study_case.variant = "rockfall_dissipators", results.back().commit = "aaa";
  EXPECT_NE(comparison_csv(results).find("seed1,54.361,50,-0.080223,0.0909091"), std::string::npos);
  EXPECT_NE(comparison_csv(results).find("seed1-rockfall_dissipators,54.361,90,0.655599,,\"aaa\"\n"), std::string::npos)
      << comparison_csv(results);
  results.pop_back();
  // What was run with changes that no commit holds may be of two programs.
  for (CaseResult& c : results) c.commit += "-dirty";
  EXPECT_NE(comparison_csv(results).find("seed1,54.361,50,-0.080223,,\"aaa-dirty\"\n"), std::string::npos);
  for (CaseResult& c : results) c.commit = "aaa";
  std::size_t agree = 0;
  const std::vector<Trend> found = trends(results);
  for (const Trend& t : found) agree += t.agrees == Agreement::yes;
  EXPECT_EQ(found.size(), 16u);
  EXPECT_EQ(agree, 3u);  // retained mass and zeta fall, eta rises; of forces and of what passed nothing is known
  EXPECT_NE(
      trends_csv(found).find("\"eta rises (4.4), about the bed at the net\",matched,resolved,coarse,3,1,1.00,yes\n"),
      std::string::npos)
      << trends_csv(found);
  EXPECT_NE(trends_csv(found).find("whole barrier rises (4.3)\",matched,resolved,coarse,0,0,nan,-\n"),
            std::string::npos);
}

/// Of a strip neither energies nor forces are the paper's: it stands beside others of its width alone.
TEST(Comparison, HoldsNoStripAgainstThePaper) {
  std::vector<CaseResult> results{made_up(1.85, 5, 1), made_up(4.1, 8, 1), made_up(8.6, 16, 1)};
  for (CaseResult& c : results) c.study_case.preset = "strip", c.commit = "aaa";
  results.push_back(results.back());
  results.back().study_case.coupling = "averaged";
  EXPECT_NE(comparison_csv(results).find("e_in,kJ,matched-L4.10-strip-resolved-seed1,,8,,,\"aaa\"\n"),
            std::string::npos)
      << comparison_csv(results);
  EXPECT_TRUE(nearness(results).empty());
  EXPECT_TRUE(trends(results).empty());
  for (const Compared& q : compared_quantities()) EXPECT_FALSE(theirs_of(q, results.front().study_case)) << q.name;
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
  EXPECT_EQ(agreement({2, 1, 3}), std::pair(Agreement::no, 1.0 / 3));  // as every third order of three flows
  EXPECT_EQ(agreement({1, 1, 1}), std::pair(Agreement::no, 0.0));
}

/// Retained shares of both sizes fall in the paper; the peak of the whole barrier has two readings.
TEST(Comparison, TrendsOfBothSizesAndOfBothPeaks) {
  std::vector<CaseResult> results{made_up(1.85, 30, 10), made_up(4.1, 50, 10), made_up(8.6, 100, 10)};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto x = static_cast<double>(k);
    results[k].values["retained_large"] = 0.999 - 0.01 * x, results[k].values["retained_small"] = 0.6 + 0.1 * x;
    results[k].values["barrier_sum"] = 5 - x, results[k].values["barrier_sum_mean"] = 4 + x;
  }
  const auto agreement = [&](const char* part) {
    for (const Trend& t : trends(results))
      if (t.statement.find(part) != std::string::npos) return t.agrees;
    return Agreement::unknown;
  };
  EXPECT_EQ(agreement("large grains that is retained falls"), Agreement::yes);
  EXPECT_EQ(agreement("small grains that is retained falls"), Agreement::no);
  EXPECT_EQ(agreement("whole barrier rises (4.3)"), Agreement::no);
  EXPECT_EQ(agreement("largest mean over 0.2 s"), Agreement::yes);
}

/// The parts of what the barrier holds, from the first row to the last, add up to all of it.
TEST(Comparison, PartsOfTheBarriersEnergy) {
  CaseRun run;
  run.study_case = {"matched", "coarse", "resolved", "study", 4.1, 1};
  run.metrics = {{"barrier_energy_start_J", 14}, {"barrier_energy_end_J", 105}, {"peak_right_cable_end_kN", 4.5}};
  run.series.time_s = {0, 1, 2};
  run.series.columns = {{"barrier_axial_J", "J", "", {10, 200, 80}},
                        {"barrier_shear_J", "J", "", {1, 2, 4}},
                        {"barrier_bending_J", "J", "", {2, 9, 16}},
                        {"barrier_torsion_J", "J", "", {3, 3, 3}},
                        {"barrier_potential_J", "J", "", {-2, 0, 2}}};
  const CaseResult result = result_of(run);
  EXPECT_NEAR(result.value("e_b_axial"), 0.070, 1e-12);
  EXPECT_NEAR(result.value("e_b_potential"), 0.004, 1e-12);
  EXPECT_NEAR(result.value("e_b_axial") + result.value("e_b_shear") + result.value("e_b_bending") +
                  result.value("e_b_torsion") + result.value("e_b_potential"),
              result.value("e_b"), 1e-12);
  EXPECT_EQ(result.value("right_cable_end"), 4.5);
  EXPECT_TRUE(std::isnan(result.value("left_cable_end")));
}

/// By the bars of the study, which are stricter than the run's; what a run does not check has not passed.
TEST(Comparison, JudgesByTheBarsOfTheStudy) {
  const auto judged = [](const std::string& summary) {
    CaseResult c;
    take_summary(c, summary, "summary.json");
    std::map<std::string, Outcome> outcomes;
    for (const CaseCheck& check : c.checks) outcomes[check.name] = check.outcome;
    return outcomes;
  };
  const auto good = judged(R"({"wall_seconds": 1, "checks": [
      {"name": "liquid_mass_ledger", "value": 9e-6, "tolerance": 1e-4, "pass": true},
      {"name": "solids_energy_ledger", "value": 0.015, "tolerance": 0.02, "pass": true},
      {"name": "momentum_audit", "value": 1e-7, "tolerance": 1e-6, "pass": true},
      {"name": "ring_links_changed", "value": 0, "tolerance": 0, "pass": true},
      {"name": "grains_behind_walls", "value": 0, "tolerance": 0, "pass": true}],
      "metrics": {"solids_energy_gap_max_J": 499, "e_in_kJ": 50}})");
  EXPECT_EQ(good.size(), 6u);
  for (const auto& [name, outcome] : good) EXPECT_EQ(outcome, Outcome::passed) << name;
  const auto bad = judged(R"({"wall_seconds": 1, "checks": [
      {"name": "liquid_mass_ledger", "value": -2e-5, "tolerance": 1e-4, "pass": true},
      {"name": "momentum_audit", "value": null, "tolerance": 1e-6, "pass": false},
      {"name": "ring_links_changed", "value": 1, "tolerance": 0, "pass": false},
      {"name": "grains_behind_walls", "value": 2, "tolerance": 0, "pass": false},
      {"name": "another", "value": 1, "tolerance": 2, "pass": true}],
      "metrics": {"solids_energy_gap_max_J": 501, "e_in_kJ": 50}})");
  EXPECT_EQ(bad.at("liquid_mass_ledger"), Outcome::failed) << "enough for the run, not for the study";
  EXPECT_EQ(bad.at("momentum_audit"), Outcome::failed);
  EXPECT_EQ(bad.at("ring_links_changed"), Outcome::failed);
  EXPECT_EQ(bad.at("grains_behind_walls"), Outcome::failed);
  EXPECT_EQ(bad.at("solids_energy_of_e_in"), Outcome::failed);
  EXPECT_EQ(bad.at("solids_energy_ledger"), Outcome::absent);
  EXPECT_EQ(bad.at("another"), Outcome::passed);
  for (const auto& [name, outcome] : judged(R"({"wall_seconds": 1, "checks": []})"))
    EXPECT_EQ(outcome, Outcome::absent) << name;
  CaseResult c = made_up(4.1, 50, 10);
  take_summary(c, R"({"wall_seconds": 1, "checks": [], "metrics": {"solids_energy_gap_max_J": 250, "e_in_kJ": 50}})",
               "summary.json");
  const std::string csv = checks_csv({c});
  EXPECT_NE(csv.find("matched-L4.10-coarse-resolved-seed1,solids_energy_of_e_in,0.005,0.01,passed\n"),
            std::string::npos)
      << csv;
  EXPECT_NE(csv.find("seed1,momentum_audit,,1e-06,absent\n"), std::string::npos) << csv;
}

/// E_out of 1.85 and 4.10 m is 8.562 and 11.734 kJ in the paper. Flows without a pair do not count.
TEST(Comparison, CountsWhichCouplingIsNearer) {
  const auto of = [](double release, const char* coupling, double e_out, const char* commit, int seed = 1) {
    CaseResult c = made_up(release, 50, 10, seed);
    c.study_case.coupling = coupling, c.commit = commit;
    c.values = {{"e_out_lower", e_out}, {"e_out", e_out}, {"depth", 0.2}};
    return c;
  };
  std::vector<CaseResult> results{
      of(1.85, "resolved", 4.281, "aaa"), of(1.85, "averaged", 17.124, "aaa"), of(4.1, "resolved", 5.867, "aaa"),
      of(4.1, "averaged", 8.8005, "bbb"), of(8.6, "resolved", 19, "aaa"),      of(4.1, "averaged_ergun", 11.734, "bbb"),
  };
  const std::vector<Nearness> found = nearness(results);
  ASSERT_EQ(found.size(), 1u) << "of another datum, or without a number of the paper";
  const Nearness& n = found[0];
  EXPECT_EQ(n.quantity, "e_out_lower");
  EXPECT_EQ(n.sweep, "matched");
  EXPECT_EQ(n.preset, "coarse");
  EXPECT_EQ(n.flows, 2u);
  EXPECT_EQ(n.of_one_program, 1u);
  EXPECT_EQ(n.resolved_nearer, 1u);
  EXPECT_EQ(n.averaged_nearer, 1u);
  EXPECT_NEAR(n.resolved_over_theirs, 0.5, 1e-9);
  EXPECT_NEAR(n.averaged_over_theirs, (2 + 0.75) / 2, 1e-9);
  EXPECT_NE(nearness_csv(found).find("e_out_lower,matched,coarse,2,1,1,1,0.5,1.375\n"), std::string::npos)
      << nearness_csv(found);
  // Of seeds the lowest that both have; what is as near is neither's.
  results.push_back(of(8.6, "resolved", 19.762, "aaa", 2));
  results.push_back(of(8.6, "averaged", 19.762, "aaa", 2));
  EXPECT_EQ(nearness(results).at(0).flows, 3u);
  EXPECT_EQ(nearness(results).at(0).resolved_nearer + nearness(results).at(0).averaged_nearer, 2u);
  for (CaseResult& c : results) c.study_case.variant = "as_built";
  EXPECT_TRUE(nearness(results).empty()) << "not the study's reading";
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

/// A front at 5 m/s, 0.2 m deep, on a bed of 35 degrees.
TEST(Comparison, FroudeNumberOfTheFront) {
  CaseRun run;
  run.study_case = {"matched", "coarse", "resolved", "study", 4.1, 1};
  run.metrics = {{"depth_at_inflow_m", 0.2}};
  run.series.columns = {{"front_x_m", "m", "", {}}};
  for (int k = 0; k <= 20; ++k) {
    run.series.time_s.push_back(0.01 * k);
    run.series.columns[0].values.push_back(3.21 + 0.05 * k);
  }
  EXPECT_NEAR(result_of(run).value("froude_front"), 5 / std::sqrt(9.81 * 0.2 * 0.8191520), 1e-3);
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

}  // namespace
}  // namespace lahar::study
