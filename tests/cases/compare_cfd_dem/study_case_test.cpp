// Which runs a study consists of.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

#include "cases/assembly/estimates.h"
#include "cases/assembly/load.h"
#include "cases/compare_cfd_dem/study_case.h"
#include "cases/files/case_file.h"
#include "core/check.h"
#include "tests/cases/compare_cfd_dem/study_program.h"
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
  // Nothing is softened there.
  const auto all = cases_of({.presets = {"coarse", "standard"},
                             .couplings = {"resolved"},
                             .variants = {"study", "stiff_rock", "light_beads"},
                             .releases = {4.1}});
  EXPECT_EQ(std::count_if(all.begin(), all.end(), [](const StudyCase& c) { return c.preset == "coarse"; }), 6);
  EXPECT_EQ(std::count_if(all.begin(), all.end(), [](const StudyCase& c) { return c.preset == "standard"; }), 2);
  try {
    (void)cases_of({.presets = {"standard"}, .variants = {"stiff_rock"}});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(e.mistakes().at(0).message.find("--preset standard, expected coarse"), std::string::npos) << e.what();
  }
}

/// Wider than the grains, they are for averaged couplings alone.
TEST(StudyCases, CellsOfThePaperAreForAveragedCouplings) {
  const auto load = [](const StudyCase& c) { return scene::load(c.scene_file(), c.changes()); };
  const std::vector<StudyCase> all = cases_of({.presets = {"paper_cells"}});
  EXPECT_EQ(all.size(), 20u);
  for (const StudyCase& c : all) EXPECT_EQ(c.coupling, "averaged");
  const scene::Scene wide = load(all.back());
  EXPECT_EQ(wide.coupling.averaging_length, 0.15);
  StudyCase coarse = all.back();
  coarse.preset = "coarse";
  scene::Scene same = load(coarse);
  same.fluid.cell_size = 0.15, same.identity = wide.identity;
  EXPECT_TRUE(same == wide) << "otherwise as coarse";
  for (const char* coupling : {"averaged_ergun", "averaged_beads"}) {
    const StudyCase c{"as_printed", "paper_cells", coupling, "study", 1.85, 1};
    EXPECT_NO_THROW(load(c)) << coupling;
    EXPECT_EQ(case_named(c.name(), {}), c);
  }
  const auto refused = [](const Selection& selection) {
    try {
      (void)cases_of(selection);
    } catch (const InputError& e) {
      return e.mistakes().at(0).message.find("--preset paper_cells with --coupling resolved") != std::string::npos;
    }
    return false;
  };
  EXPECT_TRUE(refused({.presets = {"paper_cells"}, .couplings = {"resolved"}}));
  EXPECT_TRUE(refused({.presets = {"paper_cells"}, .couplings = {"resolved", "averaged"}}));
  EXPECT_TRUE(refused({.presets = {"coarse", "paper_cells"}, .couplings = {"resolved"}}));
  const auto both = cases_of({.presets = {"coarse", "paper_cells"}, .couplings = {"resolved", "averaged"}});
  EXPECT_EQ(both.size(), 60u);
  EXPECT_FALSE(case_named("matched-L4.10-paper_cells-resolved-seed1", {}).has_value());
  try {
    (void)cases_of({.presets = {"paper_cells"}, .variants = {"short_averages"}});  // shorter than a cell
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(e.mistakes().at(0).message.find("says nothing with --preset paper_cells, expected another"),
              std::string::npos)
        << e.what();
  }
  EXPECT_FALSE(count_in_one_spread(all.back(), coarse));
  const cases::TestFolder folder;
  EXPECT_EQ(run_study("--list --preset paper_cells --coupling resolved --out '" + (folder / "out").string() + "'",
                      folder / "messages"),
            2);
  EXPECT_NE(content_of(folder / "messages").find("which cannot be resolved"), std::string::npos);
}

TEST(StudyCases, AreOfAPlan) {
  std::set<std::string> names;
  for (const StudyCase& c : planned_cases()) EXPECT_TRUE(names.insert(c.name()).second) << c.name();
  for (const StudyCase& c : cases_of({})) EXPECT_TRUE(names.contains(c.name())) << c.name();
  for (const char* name :
       {"as_printed-L8.60-standard-resolved-seed1", "matched-L4.10-standard-averaged-seed1",
        "matched-L4.10-coarse-averaged-seed2", "as_printed-L4.10-coarse-resolved-seed1-stiff_rock",
        "matched-L4.10-coarse-resolved-seed1-cells_15mm", "matched-L4.10-fine-resolved-seed1",
        "as_printed-L4.10-coarse-resolved-seed1-cable_at_ends", "as_printed-L1.85-strip-averaged-seed4"})
    EXPECT_TRUE(names.contains(name)) << name;
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

/// Of the preset coarse: cells alone are other ones, all of them whole across the channel, so that no wall moves.
TEST(StudyCases, OtherCellsAreOtherwiseCoarse) {
  const StudyCase study{"matched", "coarse", "resolved", "study", 4.1, 1, {}};
  const scene::Scene coarse = scene::load(study.scene_file(), study.changes());
  for (const auto& [name, size] : {std::pair{"cells_15mm", 0.015}, {"cells_10mm", 0.01}}) {
    StudyCase c = study;
    c.variant = name;
    scene::Scene other = scene::load(c.scene_file(), c.changes());
    EXPECT_EQ(other.fluid.cell_size, size);
    const double across = (other.domain.upper.y() - other.domain.lower.y()) / size;
    EXPECT_NEAR(across, std::round(across), 1e-9) << name;
    other.fluid.cell_size = coarse.fluid.cell_size, other.identity = coarse.identity;
    EXPECT_TRUE(other == coarse) << name;
    EXPECT_TRUE(count_in_one_spread(c, study)) << name;
  }
  EXPECT_THROW(cases_of({.presets = {"standard"}, .variants = {"cells_10mm"}}), InputError);
}

/// A sixth of the flow: as many of its grains and of its water, a net from side to side, otherwise as coarse.
TEST(StudyCases, StripsArePartsOfTheFlow) {
  const auto load = [](const StudyCase& c) { return scene::load(c.scene_file(), c.changes()); };
  for (const char* sweep : {"as_printed", "matched"}) {
    const StudyCase whole{sweep, "coarse", "averaged", "study", 8.6, 2},
        strip{sweep, "strip", "averaged", "study", 8.6, 2};
    EXPECT_TRUE(is_strip(strip) && !is_strip(whole));
    EXPECT_EQ(case_named(strip.name(), {}), strip);
    const scene::Scene a = load(whole);
    scene::Scene b = load(strip);
    const auto across = [](const scene::Scene& s) { return s.domain.upper.y(); };
    EXPECT_NEAR(across(b), across(a) / 6, 1e-12);
    EXPECT_EQ(b.barrier.net.width, across(b));
    EXPECT_EQ(b.sections.at(0).point.y(), 0.5 * across(b));
    EXPECT_EQ(b.sections.at(0).point.x(), 8.6);
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_NEAR(b.grains.packings.at(0).sizes.at(k).count, a.grains.packings.at(0).sizes.at(k).count / 6.0, 0.5);
    EXPECT_EQ(b.contacts.at(1).friction, a.contacts.at(1).friction) << "on the bed";
    b.fluid.regions = a.fluid.regions;
    EXPECT_TRUE(b.fluid == a.fluid && b.solids == a.solids && b.coupling == a.coupling && b.measure == a.measure);
    EXPECT_GT(b.run.duration, 2.7) << "a second after grains arrive";
  }
  const StudyCase strip{"matched", "strip", "resolved", "study", 4.1, 1};
  StudyCase other = strip;
  other.seed = 4;
  EXPECT_TRUE(count_in_one_spread(strip, other));
  other.preset = "coarse";
  EXPECT_FALSE(count_in_one_spread(strip, other));
  other = strip, other.variant = "rockfall_dissipators";
  EXPECT_FALSE(count_in_one_spread(strip, other));
}

/// A scene of its own, as lists of walls cannot be changed in part: only its bed is other than that of the strip.
TEST(StudyCases, StripThatRubsAtTheNetIsOtherwiseTheMatchedOne) {
  const StudyCase study_case{"matched", "strip", "resolved", "study", 4.1, 1};
  const scene::Scene smooth = scene::load(study_case.scene_file(), study_case.changes());
  scene::Scene rubs = scene::load(cases::case_file("compare_cfd_dem/strip_rubs_at_net.toml"), {});
  ASSERT_EQ(rubs.walls.size(), smooth.walls.size() + 1);
  EXPECT_EQ(rubs.walls[0].material, "smooth");
  EXPECT_EQ(rubs.walls[1].material, "wall");
  EXPECT_EQ(rubs.walls[0].upper.x(), rubs.walls[1].lower.x());
  EXPECT_EQ(rubs.walls[0].upper.z(), 0);
  EXPECT_EQ(rubs.walls[1].upper.z(), 0);
  for (std::size_t k = 1; k < smooth.walls.size(); ++k) EXPECT_TRUE(rubs.walls[k + 1] == smooth.walls[k]) << k;
  EXPECT_EQ(rubs.contacts.at(1).friction, 0.7) << "rock on wall, as Table 4 says";
  EXPECT_EQ(rubs.contacts.at(2).friction, 0) << "rock on smooth";
  rubs.walls = smooth.walls, rubs.contacts = smooth.contacts, rubs.materials = smooth.materials;
  rubs.probes.clear(), rubs.identity = smooth.identity, rubs.domain.slip = smooth.domain.slip;
  EXPECT_TRUE(rubs == smooth);
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
    if (!preset.coupling.empty()) c.coupling = preset.coupling;
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

}  // namespace
}  // namespace lahar::study
