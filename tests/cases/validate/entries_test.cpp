// The list of all entries: names, aliases, sources; and the quick form of entries that take seconds.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "cases/hard_cases/hard_cases.h"
#include "cases/validate/entry.h"
#include "cases/validate/grains_in_fluid/bed_flow.h"
#include "cases/validate/grains_in_fluid/closed_forms.h"
#include "cases/validate/reference_table.h"
#include "cases/validate/wires_in_fluid/wire_flows.h"
#include "tests/cases/validate/known_misses.h"

namespace lahar::validate {
namespace {

const std::filesystem::path kFolder = std::filesystem::path(LAHAR_SOURCE_DIR) / "cases/validate";

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// Names of what a file exports: `Entry name() {` at the start of a line.
std::vector<std::string> exported(const std::filesystem::path& file) {
  static const std::regex definition("(?:^|\\n)Entry (\\w+)\\(\\) \\{");
  const std::string text = text_of(file);
  std::vector<std::string> names;
  for (std::sregex_iterator found(text.begin(), text.end(), definition), end; found != end; ++found)
    names.push_back((*found)[1]);
  return names;
}

TEST(ValidateEntries, AreNamedAsTheirFiles) {
  std::set<std::string> names;
  for (const Entry& e : all_entries()) {
    EXPECT_TRUE(names.insert(e.name).second) << e.name << " twice";
    const std::size_t dot = e.name.find('.');
    const std::string group = e.name.substr(0, dot), name = e.name.substr(dot + 1);
    EXPECT_EQ(exported(kFolder / group / (name + ".cpp")), std::vector<std::string>{name}) << e.name;
  }
}

TEST(ValidateEntries, AreAllListed) {
  std::set<std::string> names;
  for (const Entry& e : all_entries()) names.insert(e.name);
  for (const auto& file : std::filesystem::recursive_directory_iterator(kFolder))
    for (const std::string& name : exported(file.path()))
      EXPECT_EQ(names.count(file.path().parent_path().filename().string() + "." + name), 1u) << file.path();
}

TEST(ValidateEntries, HaveAliasesOfTheirOwn) {
  std::set<std::string> names;
  for (const Entry& e : all_entries()) names.insert(e.name);
  for (const Entry& e : all_entries())
    EXPECT_TRUE(e.alias.empty() || names.insert(e.alias).second) << e.alias << " twice";
  const auto name_of = [](const char* alias) { return select_entries(all_entries(), {alias}).at(0).name; };
  EXPECT_EQ(name_of("fluid.hard_h20"), "free_surface.slope_in_staircase");
  EXPECT_EQ(name_of("bodies.wire"), "wires_in_fluid.wire_drag");
  EXPECT_EQ(name_of("solids.post"), "barrier.post");
  EXPECT_GT(select_entries(all_entries(), {"bodies"}).size(), 1u);
}

TEST(ValidateEntries, NameSourcesThatExist) {
  std::set<std::string> cited;
  for (const Entry& e : all_entries()) {
    EXPECT_FALSE(e.source.text.empty()) << e.name;
    for (const std::string& file : e.source.files) {
      cited.insert(file);
      EXPECT_NO_THROW({
        const ReferenceTable table = reference(file);
        EXPECT_GT(table.size(), 0u) << file;
        EXPECT_GT(table.provenance().at(0).size(), 20u) << file << " does not say where it is from";
      }) << e.name
         << " names " << file;
    }
  }
  for (const auto& file : std::filesystem::directory_iterator(kFolder / "reference"))
    EXPECT_EQ(cited.count(file.path().filename().string()), 1u) << file.path() << " is the source of no entry";
}

/// Some entries read no rows of what they name: they compute it, at more places than the table has.
TEST(ValidateEntries, ComputeWhatTheirTablesHold) {
  for (const auto& [reynolds, drag] : reference("cylinder_cd.csv").points("Re", "Cd"))
    EXPECT_NEAR(cylinder_law(reynolds), drag, 5e-4 * drag) << "Re " << reynolds;
  for (const auto& [density, depth] : reference("floating_sphere.csv").points("s", "h_over_D"))
    EXPECT_NEAR(immersed_share(density), depth, 5e-5) << "density ratio " << density;
  const ReferenceTable packs = reference("random_array_drag.csv");
  const std::vector<double> phi = packs.numbers("phi"), re = packs.numbers("Re"), drag = packs.numbers("F_Beetstra");
  for (std::size_t k = 0; k < packs.size(); ++k)
    EXPECT_NEAR(drag_of_pack(phi[k], re[k]), drag[k], 1e-4 * drag[k]) << "phi " << phi[k] << ", Re " << re[k];
}

/// Some entries state the study's settings as their own.
TEST(ValidateEntries, HaveTheSettingsOfTheStudy) {
  const std::string scene = text_of(kFolder / "../debris_flow/scene.toml");
  EXPECT_NE(scene.find("\nbody_weighting = \"inertial\""), std::string::npos);
  EXPECT_NE(scene.find(fmt::format("\nradius_shift_cells = {} ", coupling::kRadiusShiftFast)), std::string::npos);
  EXPECT_NE(scene.find(fmt::format("\nsmagorinsky = {}\n", debris_immersion().smagorinsky)), std::string::npos);
}

/// Those whose quick form takes seconds. Entries of hard cases run in tests/cases/hard_cases_test.cpp.
const std::vector<std::string> kQuick{"fluid.order_taylor_green",
                                      "fluid.order_poiseuille",
                                      "fluid.order_duct",
                                      "fluid.order_couette",
                                      "fluid.taylor_green_re1600",
                                      "fluid.cavity_re1000",
                                      "fluid.determinism",
                                      "fluid.slipping_box",
                                      "fluid.bingham_channel",
                                      "fluid.log_law_channel",
                                      "free_surface.gravity_wave",
                                      "free_surface.hydrostatic",
                                      "free_surface.martin_moyce",
                                      "free_surface.laplace_drop",
                                      "free_surface.mass_ledger",
                                      "free_surface.dam_break_no_slip",
                                      "free_surface.impact_on_wall",
                                      "free_surface.inflow_sheet",
                                      "grains_in_fluid.sphere_array",
                                      "grains_in_fluid.random_pack",
                                      "grains_in_fluid.fixed_sphere",
                                      "grains_in_fluid.sphere_in_mud",
                                      "grains_in_fluid.settling_sphere",
                                      "grains_in_fluid.wet_rebound",
                                      "grains_in_fluid.archimedes",
                                      "grains_in_fluid.momentum_audit",
                                      "grains_in_fluid.stream_into_bed",
                                      "grains_in_fluid.seepage_with_surface",
                                      "averaged_grains.bed_drag",
                                      "averaged_grains.hindered_settling",
                                      "averaged_grains.dilating_bed",
                                      "wires_in_fluid.wire_drag",
                                      "wires_in_fluid.wire_in_mud",
                                      "wires_in_fluid.resolved_wire_drag",
                                      "wires_in_fluid.screen_loss",
                                      "wires_in_fluid.ring_net_loss",
                                      "dem.elastic_impact_of_spheres",
                                      "dem.elastic_impact_on_plate",
                                      "dem.damped_impact",
                                      "dem.oblique_impact",
                                      "dem.sphere_on_incline",
                                      "dem.rolling_friction",
                                      "dem.restitution",
                                      "dem.cantilever",
                                      "dem.catenary",
                                      "dem.column_collapse",
                                      "barrier.post",
                                      "barrier.two_spans",
                                      "barrier.hexagonal_mesh",
                                      "barrier.wire_sliding",
                                      "barrier.ring_pull",
                                      "barrier.energy_dissipator",
                                      "barrier.rockfall",
                                      "barrier.net_at_rest"};

/// Those that the suite does not run, and why.
const std::map<std::string, std::string> kLeftOut{
    {"free_surface.bore_over_film", "its quick form, a reservoir of 10 cells, misses ten of its sixteen bars"},
    {"averaged_grains.fluidization", "its quick form takes minutes"}};

TEST(ValidateEntries, RunInTheSuiteOrAreLeftOutForAReason) {
  std::multiset<std::string> placed(kQuick.begin(), kQuick.end());
  for (const auto& [name, reason] : kLeftOut) placed.insert(name);
  std::set<std::string> of_hard_cases;
  for (const HardCase& c : hard_cases()) of_hard_cases.insert(c.entries.begin(), c.entries.end());
  placed.insert(of_hard_cases.begin(), of_hard_cases.end());
  for (const Entry& e : all_entries()) EXPECT_EQ(placed.count(e.name), 1u) << e.name;
  EXPECT_EQ(placed.size(), all_entries().size());
}

class QuickEntry : public testing::TestWithParam<std::string> {};

TEST_P(QuickEntry, MissesNothingNew) {
  const auto chosen = select_entries(all_entries(), {GetParam()});
  ASSERT_EQ(chosen.size(), 1u);
  const Outcome outcome = run_entry(chosen[0], {.quick = true, .plots = {}});
  EXPECT_EQ(outcome.failure, "");
  EXPECT_GT(outcome.asked(), 0u);
  for (const Row& row : outcome.rows) {
    EXPECT_TRUE(row.pass || is_known_miss(outcome.name, row)) << row.label << " " << row.value;
    EXPECT_TRUE(row.note || row.pass == (row.error <= row.tolerance)) << row.label << " is no row of entry.h";
  }
  for (const std::string& label : known_labels(outcome.name))
    EXPECT_TRUE(std::any_of(outcome.rows.begin(), outcome.rows.end(), [&](const Row& r) { return r.label == label; }))
        << "known_misses.h: no row " << label;
}

std::vector<std::string> quick_ones(const std::string& group) {
  std::vector<std::string> names;
  for (const std::string& name : kQuick)
    if (name.starts_with(group + ".")) names.push_back(name);
  return names;
}

std::string name_of(const testing::TestParamInfo<std::string>& info) {
  return info.param.substr(info.param.find('.') + 1);
}

INSTANTIATE_TEST_SUITE_P(Fluid, QuickEntry, testing::ValuesIn(quick_ones("fluid")), name_of);
INSTANTIATE_TEST_SUITE_P(FreeSurface, QuickEntry, testing::ValuesIn(quick_ones("free_surface")), name_of);
INSTANTIATE_TEST_SUITE_P(GrainsInFluid, QuickEntry, testing::ValuesIn(quick_ones("grains_in_fluid")), name_of);
INSTANTIATE_TEST_SUITE_P(AveragedGrains, QuickEntry, testing::ValuesIn(quick_ones("averaged_grains")), name_of);
INSTANTIATE_TEST_SUITE_P(WiresInFluid, QuickEntry, testing::ValuesIn(quick_ones("wires_in_fluid")), name_of);
INSTANTIATE_TEST_SUITE_P(Dem, QuickEntry, testing::ValuesIn(quick_ones("dem")), name_of);
INSTANTIATE_TEST_SUITE_P(Barrier, QuickEntry, testing::ValuesIn(quick_ones("barrier")), name_of);

}  // namespace
}  // namespace lahar::validate
