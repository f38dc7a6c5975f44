// Parameters of the procedures, what they refuse, and their executables.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "cases/energy_dissipator/describe.h"
#include "cases/energy_dissipator/report.h"
#include "cases/procedure/parameters.h"
#include "cases/procedure/procedure.h"
#include "cases/ring_pull/describe.h"
#include "cases/ring_pull/report.h"
#include "cases/rockfall/describe.h"
#include "cases/rockfall/report.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

using scene::case_file;
using scene::file_text;
using scene::ScratchFolder;

template <class Parameters>
Parameters from_file(const std::string& name) {
  return load_parameters<Parameters>(case_file(name), {});
}

TEST(ProcedureParameters, FilesBesideTheCasesAreTheDefaults) {
  EXPECT_EQ(from_file<RingPull>("ring_pull/ring_pull.toml"), RingPull{});
  EXPECT_EQ(from_file<EnergyDissipator>("energy_dissipator/energy_dissipator.toml"), EnergyDissipator{});
  EXPECT_EQ(from_file<Rockfall>("rockfall/rockfall.toml"), Rockfall{});
}

TEST(ProcedureParameters, ResolvedTextLoadsAsTheSame) {
  Rockfall changed;
  changed.ball_mass = 500, changed.tied = true;
  const ScratchFolder folder;
  folder.write("again.toml", parameters_text(changed));
  EXPECT_EQ(load_parameters<Rockfall>(folder.path() / "again.toml", {}), changed);
}

TEST(ProcedureParameters, EveryMistakeIsReportedInOneGo) {
  try {
    (void)load_parameters<RingPull>(std::nullopt, {"ring.bond_radius_m=0", "ring.perimeter=1", "loading.samples=1"});
    FAIL() << "nothing was refused";
  } catch (const InputError& e) {
    ASSERT_EQ(e.mistakes().size(), 3u) << e.what();
    EXPECT_NE(std::string(e.what()).find("did you mean \"perimeter_m\"?"), std::string::npos) << e.what();
  }
}

TEST(ProcedureParameters, MistakesStandWhereTheirKeyIsWritten) {
  const ScratchFolder folder;
  folder.write("steps.toml", "[run]\ntime_step_s = 1.0\n\n[ball]\ndiameter_m = 0.2\n");
  try {
    (void)load_parameters<Rockfall>(folder.path() / "steps.toml", {});
    FAIL() << "nothing was refused";
  } catch (const InputError& e) {
    ASSERT_EQ(e.mistakes().size(), 2u) << e.what();
    EXPECT_EQ(e.mistakes()[0].file, (folder.path() / "steps.toml").string());
    EXPECT_EQ(e.mistakes()[0].line, 2) << e.what();
    EXPECT_EQ(e.mistakes()[1].line, 5) << e.what();
  }
}

template <class Parameters>
std::size_t mistakes_in(const Parameters& parameters) {
  scene::Findings findings("test");
  check(parameters, findings);
  return findings.mistakes().size();
}

TEST(Procedures, RefuseWhatMakesNoSense) {
  RingPull odd;
  odd.beads = 61;
  EXPECT_THROW((void)pull_ring(odd), InputError);
  EXPECT_EQ(mistakes_in(EnergyDissipator{}), 0u);
  EnergyDissipator brake;
  brake.force_limit = {78e3};
  EXPECT_EQ(mistakes_in(brake), 1u);
  EXPECT_THROW((void)stretch(brake), InputError);
  brake = {};
  brake.force_limit = {98e3, 78e3};
  EXPECT_EQ(mistakes_in(brake), 1u);
  brake = {};
  brake.unloading = BrakeUnloading::plastic;
  brake.stiffness[2] = 2 * brake.stiffness[0];
  EXPECT_EQ(mistakes_in(brake), 1u);
  EXPECT_EQ(mistakes_in(Rockfall{}), 0u);
  Rockfall rockfall;
  rockfall.ball_diameter = 0.2;
  EXPECT_EQ(mistakes_in(rockfall), 1u);
  rockfall = {};
  rockfall.net_width = 1.0;  // no whole rings fill it
  EXPECT_EQ(mistakes_in(rockfall), 1u);
}

/// The one mistake is told at `key`.
template <class Parameters>
void expect_refused(const std::string& key, const Parameters& parameters) {
  scene::Findings findings("test");
  check(parameters, findings);
  ASSERT_EQ(findings.mistakes().size(), 1u) << key;
  EXPECT_FALSE(findings.sound({key})) << findings.mistakes()[0].message;
}

/// A net of 2 x 2 rings, flat when the ball comes.
Rockfall small_rockfall() {
  Rockfall small;
  small.net_width = 2 * small.ring_pitch, small.ball_diameter = 0.4, small.ball_mass = 60;
  small.settling_time = 0;
  return small;
}

TEST(Procedures, ARockfallRefusesPlasticDissipatorsThatDoNotSoften) {
  Rockfall r = small_rockfall();
  r.plastic_unloading = true;
  EXPECT_EQ(mistakes_in(r), 0u);
  r.dissipator_stiffness[1] = r.dissipator_stiffness[0];
  expect_refused("bonds.plastic_unloading", r);
  r.plastic_unloading = false;
  EXPECT_EQ(mistakes_in(r), 0u);
}

TEST(Procedures, ARockfallRefusesCablesThatEndInTheirGuides) {
  Rockfall r = small_rockfall();
  r.cable_extension = 1.5 * r.wire_diameter;
  EXPECT_EQ(mistakes_in(r), 0u);
  r.cable_extension = 0.5 * r.wire_diameter;
  expect_refused("net.cable_extension_m", r);
}

TEST(Procedures, ARockfallRefusesRowsCloserThanItsSteps) {
  Rockfall r = small_rockfall();
  r.sample_interval = r.time_step;
  EXPECT_EQ(mistakes_in(r), 0u);
  r.sample_interval = 0.5 * r.time_step;
  expect_refused("run.sample_interval_s", r);
}

TEST(Procedures, ADissipatorIsNotPulledByMoreThanAPointInAStep) {
  EnergyDissipator fast;
  fast.speed = 1000, fast.samples = 100000;
  expect_refused("loading.speed_m_s", fast);
}

TEST(Procedures, ARockfallEndsWithItsDuration) {
  const auto go_on = [](double) { return true; };
  Rockfall r = small_rockfall();
  r.duration = 2.5e-3, r.sample_interval = 1e-3;
  const RockfallResult result = SettledNet(r, go_on).strike(r, go_on);
  ASSERT_EQ(result.series.time.size(), 4u);
  EXPECT_NEAR(result.series.time.back(), r.duration, 1.01 * r.time_step);
}

TEST(Procedures, RefuseAnAbsurdTimeStep) {
  const auto go_on = [](double) { return true; };
  Rockfall small;
  small.net_width = 2 * small.ring_pitch, small.ball_diameter = 0.4;
  small.time_step = 1e-3;  // above the limit of the bonds
  EXPECT_THROW(SettledNet(small, go_on), InputError);
  small.time_step = 0, small.cable_stiffness = 1e18;
  EXPECT_THROW(SettledNet(small, go_on), InputError);
}

TEST(RockfallReadings, OneDissipatorACableIsOneAtOneEndOfEach) {
  const auto go_on = [](double) { return true; };
  Rockfall small = small_rockfall();
  small.duration = 0.03, small.activation_force = 1;
  const RockfallResult both = SettledNet(small, go_on).strike(small, go_on);
  EXPECT_EQ(both.active_brakes, 8);
  EXPECT_LT(both.worst_overlap, 0.1);  // the ball begins on the flat net, not in it
  small.dissipators_per_cable = 1;
  EXPECT_EQ(SettledNet(small, go_on).strike(small, go_on).active_brakes, 4);
}

TEST(RockfallReadings, PeaksDoNotDependOnTheSampleInterval) {
  const auto go_on = [](double) { return true; };
  const auto strike = [&](double sample_interval) {
    Rockfall r = small_rockfall();
    r.duration = 0.004, r.sample_interval = sample_interval;
    return SettledNet(r, go_on).strike(r, go_on);
  };
  const RockfallResult fine = strike(0.5e-3), coarse = strike(4e-3);
  ASSERT_EQ(fine.steps, coarse.steps);
  EXPECT_GT(fine.worst_overlap, 0);
  EXPECT_EQ(fine.worst_overlap, coarse.worst_overlap);
  EXPECT_GT(fine.largest_tension, 0);
  EXPECT_EQ(fine.largest_tension, coarse.largest_tension);
}

/// Without damping all that bonds lose is plastic, and the dissipators', which hold the rest of their energy.
TEST(RockfallReadings, PlasticDissipatorsKeepWhatTheyDissipatedAsTheBallRebounds) {
  const auto go_on = [](double) { return true; };
  Rockfall r = small_rockfall();
  r.ball_mass = 20, r.drop_height = 2, r.duration = 0.2;
  r.plastic_unloading = true, r.activation_force = 1e3, r.bond_damping_ratio = 0;
  r.youngs_modulus *= 0.01, r.ball_modulus *= 0.01, r.ring_stiffness *= 0.1, r.cable_stiffness *= 0.1;
  r.time_step = 1e-5;
  const RockfallSeries s = SettledNet(r, go_on).strike(r, go_on).series;
  ASSERT_GT(s.bond_loss.back(), 10);
  ASSERT_LT(s.brake_elongation.back(), 0.9 * *std::ranges::max_element(s.brake_elongation));
  for (std::size_t k = 0; k < s.time.size(); ++k) {
    const double stored = s.brake_energy[k] - s.bond_loss[k], rounding = 1e-9 * s.brake_energy[k];
    EXPECT_GE(stored, -rounding) << s.time[k];
    EXPECT_LE(stored, s.bond_energy[k] + rounding) << s.time[k];
  }
}

TEST(RingPullScaling, KeepsTheWireAndTheMassOfTheRing) {
  RingPull ring;
  ring.beads = 120;
  const WireStiffness fine = wire_stiffness(ring), coarse = wire_stiffness(RingPull{});
  EXPECT_NEAR(fine.axial / coarse.axial, 1, 1e-12);
  EXPECT_NEAR(fine.bending / coarse.bending, 1, 1e-12);
  EXPECT_NEAR(fine.shear / coarse.shear, 1, 1e-12);
  const auto mass = [](const RingPull& r) {
    return r.density * static_cast<double>(r.beads) * std::pow(r.bead_diameter(), 3);
  };
  EXPECT_NEAR(mass(ring.scaled()) / mass(RingPull{}), 1, 1e-12);
  EXPECT_NEAR(coarse.axial, 3.95e6, 0.01e6);  // section 3.1 of the paper, by hand
  EXPECT_NEAR(coarse.bending, 61, 0.2);
}

/// A pull whose speed rises over its first millimetre, and rows of 2 mm.
TEST(RingPullCurve, RowsAreMeansOverTheirPartOfTheWay) {
  RingPull ring;
  ring.stroke = 0.04, ring.samples = 20;
  const PullCurve curve = pull_ring(ring);
  // Mean over the way: 1 mm at 31.25 m/s^2 (T = 8 ms, integral of t dx = a T^3 / 3), 1 mm at 0.25 m/s around 10 ms.
  EXPECT_NEAR(curve.time.front(), (31.25 * std::pow(0.008, 3) / 3 + 1e-3 * 0.01) / 2e-3, 2e-5);
  EXPECT_NEAR(curve.time.back(), curve.displacement.back() / ring.speed + 0.004, 2e-5);
  // The wire holds the work of the pull up to the middle of the row; at the end of the row it would hold a tenth more.
  const std::size_t k = 10;
  const double before = std::accumulate(curve.force.begin(), curve.force.begin() + k, 0.0);
  EXPECT_NEAR((curve.axial[k] + curve.shear[k] + curve.bending[k]) / ((before + 0.5 * curve.force[k]) * 2e-3), 1, 0.04);
}

/// A stiffening curve, as if it were that of any ring.
PullCurve made_up_pull() {
  PullCurve curve;
  for (int k = 1; k <= 40; ++k) {
    const double d = 0.005 * k;
    curve.time.push_back(d), curve.displacement.push_back(d);
    curve.force.push_back(1e4 * d + 1e8 * std::pow(d, 6));
    curve.axial.push_back(d * d), curve.shear.push_back(0.1 * d), curve.bending.push_back(0);
  }
  curve.anchor_force = curve.force, curve.work = 1;
  return curve;
}

TEST(RingPullChecks, HoldOnlyThePapersRingAgainstThePaper) {
  const auto asks_the_paper = [](const RingPull& ring) {
    const std::vector<ResultCheck> checks = ring_pull_checks(made_up_pull(), ring);
    return std::any_of(checks.begin(), checks.end(), [](const ResultCheck& c) { return c.source.starts_with("Li"); });
  };
  RingPull ring;
  EXPECT_TRUE(asks_the_paper(ring));
  ring.samples = 100, ring.safety = 0.3;  // the same ring
  EXPECT_TRUE(asks_the_paper(ring));
  ring.bond_radius *= 2;
  EXPECT_FALSE(asks_the_paper(ring));
}

TEST(RockfallChecks, ThePapersFiguresBelongToThePapersParameters) {
  Rockfall rockfall;
  rockfall.duration = 0.6, rockfall.time_step = 1e-6;
  EXPECT_TRUE(as_in_paper(rockfall));
  rockfall.ball_mass = 100;
  EXPECT_FALSE(as_in_paper(rockfall));
}

TEST(Procedures, StopWhenTheyAreTold) {
  int asked = 0;
  const auto third = [&asked] { return ++asked < 3; };
  const PullCurve pull = pull_ring(RingPull{}, third);
  EXPECT_TRUE(pull.interrupted);
  EXPECT_EQ(pull.force.size(), 3u);
  asked = 0;
  const BrakeCurve brake = stretch(EnergyDissipator{}, third);
  EXPECT_TRUE(brake.interrupted);
  EXPECT_EQ(brake.loading.size(), 3u);
  EXPECT_TRUE(brake.unloading.empty());
  EXPECT_GT(brake.simulated, 0);
}

/// Nothing is said of a strike that never was.
TEST(Procedures, ARockfallThatIsStoppedWhileTheNetSettlesHasNoStrike) {
  Rockfall small;
  small.net_width = 2 * small.ring_pitch, small.ball_diameter = 0.4;
  const RockfallResult result = run_rockfall(small, [](double time) { return time < 0.001; });
  EXPECT_TRUE(result.interrupted);
  EXPECT_TRUE(result.series.time.empty());
  EXPECT_NEAR(result.simulated, 0.001, 1e-4);
  EXPECT_NEAR(static_cast<double>(result.steps) * result.time_step, result.simulated, 1e-9);
}

/// What failed stands in the summary although the run ends with an exception.
TEST(Procedures, AFailureAfterTheChecksLeavesThemInTheSummary) {
  const ScratchFolder folder;
  const Workplace place{folder.path() / "out", "made_up", 1, true};
  const auto fails = [](Summary& summary) -> bool {
    summary.checks = {{"rings_passed_through_each_other", 1, 0, 0, false, "linking numbers"}};
    throw NumericalFailure("ring net", 7, "wires passed through each other");
  };
  EXPECT_THROW((void)run_in_folder(place, false, parameters_text(Rockfall{}), fails), NumericalFailure);
  const auto summary = nlohmann::json::parse(file_text(place.out / "summary.json"));
  EXPECT_EQ(summary["case"], "made_up");
  EXPECT_EQ(summary["checks"][0]["pass"], false);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_DFL);
}

int run(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(ProcedureExecutable, AFileThatMayNotGetSoLargeIsAnError) {
  const ScratchFolder folder;
  const std::string quick = " --set loading.speed_m_s=4 --set loading.stroke_m=0.05 --quiet --threads 1";
  const std::string files = " --out '" + (folder.path() / "out").string() + "' 2> '" + (folder.path() / "err").string();
  ASSERT_EQ(run("ulimit -f 40; '" LAHAR_RING_PULL "'" + quick + files + "'"), 1);  // blocks of 512 or 1024 bytes
  EXPECT_TRUE(file_text(folder.path() / "err").ends_with("File too large\n")) << file_text(folder.path() / "err");
}

TEST(ProcedureExecutable, WritesItsFilesAndRefusesBadInput) {
  const ScratchFolder folder;
  const std::string out = (folder.path() / "out").string(), exe = "'" LAHAR_RING_PULL "'";
  const std::string quick = " --set loading.speed_m_s=4 --set loading.stroke_m=0.05 --quiet --threads 1";
  ASSERT_EQ(run(exe + quick + " --out '" + out + "'"), 0);
  for (const char* name :
       {"summary.json", "scene.resolved.toml", "series.h5", "ring_pull.png", "ring_pull.svg", "ring_pull.pdf"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "out" / name)) << name;
  const auto summary = nlohmann::json::parse(file_text(folder.path() / "out" / "summary.json"));
  EXPECT_EQ(summary["case"], "ring_pull");
  EXPECT_GT(summary["metrics"]["largest_force_N"].get<double>(), 500);
  const std::string errors = " 2> '" + (folder.path() / "err").string() + "'";
  EXPECT_EQ(run(exe + quick + " --set ring.beads=61 --out '" + out + "2'" + errors), 2);
  EXPECT_EQ(run(exe + " --set ring.bond_radius_m=0 --out '" + out + "3'" + errors), 2);
  EXPECT_EQ(run(exe + quick + " --set loading.speed_m_s=1000 --out '" + out + "4'" + errors), 2);
  for (const char* name : {"out2", "out3", "out4"}) EXPECT_FALSE(std::filesystem::exists(folder.path() / name)) << name;
  EXPECT_EQ(run(exe + " --help > /dev/null"), 0);
}

/// Soon, with what there is until then.
TEST(ProcedureExecutable, AnInterruptedOneEndsWith130) {
  const ScratchFolder folder;
  const std::vector<std::pair<std::string, std::string>> long_ones{
      {"ring_pull", "--set loading.speed_m_s=0.02"},
      {"energy_dissipator", ""},
      {"rockfall", "--set net.width_m=0.557 --set ball.diameter_m=0.4 --set run.settling_time_s=1000"}};
  for (const auto& [name, options] : long_ones)
    for (const std::string signal : {"INT", "TERM"}) {
      const std::filesystem::path out = folder.path() / (name + signal);
      EXPECT_EQ(run("timeout --preserve-status -k 20 -s " + signal + " 1 '" LAHAR_STUDIES "/" + name + "' " + options +
                    " --quiet --threads 1 --out '" + out.string() + "'"),
                130)
          << name;
      const auto summary = nlohmann::json::parse(file_text(out / "summary.json"));
      EXPECT_GT(summary["simulated_seconds"].get<double>(), 0) << name;
      EXPECT_LT(summary["simulated_seconds"].get<double>(), 100) << name;
      EXPECT_TRUE(summary["checks"].empty() && summary["metrics"].empty()) << name;
      for (const auto& entry : std::filesystem::directory_iterator(out))
        EXPECT_NE(entry.path().extension(), ".png") << entry.path();
    }
}

}  // namespace
}  // namespace lahar::cases
