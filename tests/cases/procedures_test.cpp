// Parameters of the procedures, what they refuse, their executables, and the quick form of their entries.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cases/energy_dissipator/describe.h"
#include "cases/energy_dissipator/report.h"
#include "cases/procedure/parameters.h"
#include "cases/ring_pull/describe.h"
#include "cases/ring_pull/report.h"
#include "cases/rockfall/describe.h"
#include "cases/rockfall/report.h"
#include "cases/validate/entry.h"
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

TEST(Procedures, RefuseWhatMakesNoSense) {
  RingPull odd;
  odd.beads = 61;
  EXPECT_THROW((void)pull_ring(odd), InputError);
  EnergyDissipator brake;
  brake.force_limit = {78e3};
  EXPECT_THROW(check(brake), InputError);
  brake = {};
  brake.force_limit = {98e3, 78e3};
  EXPECT_THROW(check(brake), InputError);
  brake = {};
  brake.unloading = BrakeUnloading::plastic;
  brake.stiffness[2] = 2 * brake.stiffness[0];
  EXPECT_THROW(check(brake), InputError);
  Rockfall rockfall;
  rockfall.ball_diameter = 0.2;
  EXPECT_THROW(check(rockfall), InputError);
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
  Rockfall small;
  small.net_width = 2 * small.ring_pitch, small.ball_diameter = 0.4, small.ball_mass = 60;
  small.settling_time = 0, small.duration = 0.03, small.activation_force = 1;
  const RockfallResult both = SettledNet(small, go_on).strike(small, go_on);
  EXPECT_EQ(both.active_brakes, 8);
  EXPECT_LT(both.worst_overlap, 0.1);  // the ball begins on the flat net, not in it
  small.dissipators_per_cable = 1;
  EXPECT_EQ(SettledNet(small, go_on).strike(small, go_on).active_brakes, 4);
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

int run(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
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
  for (const char* name : {"out2", "out3"}) EXPECT_FALSE(std::filesystem::exists(folder.path() / name)) << name;
  EXPECT_EQ(run(exe + " --help > /dev/null"), 0);
}

class QuickCalibration : public testing::TestWithParam<const char*> {};

TEST_P(QuickCalibration, ReachesItsBars) {
  const auto chosen = validate::select_entries(validate::all_entries(), {GetParam()});
  ASSERT_EQ(chosen.size(), 1u);
  const validate::Outcome outcome = validate::run_entry(chosen[0], {.quick = true, .plots = {}});
  EXPECT_TRUE(outcome.pass()) << validate::outcome_text(outcome);
}

INSTANTIATE_TEST_SUITE_P(Barrier, QuickCalibration,
                         testing::Values("barrier.ring_pull", "barrier.energy_dissipator", "barrier.rockfall",
                                         "barrier.net_at_rest"),
                         [](const auto& param) { return std::string(param.param).substr(8); });

}  // namespace
}  // namespace lahar::cases
