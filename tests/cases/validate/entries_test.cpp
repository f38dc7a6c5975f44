// The list of all entries: names, aliases, sources; and the quick form of entries that take seconds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "cases/validate/entry.h"
#include "cases/validate/grains_in_fluid/closed_forms.h"
#include "cases/validate/reference_table.h"
#include "cases/validate/wires_in_fluid/wire_flows.h"

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

class QuickEntry : public testing::TestWithParam<const char*> {};

TEST_P(QuickEntry, ReachesItsBars) {
  const auto chosen = select_entries(all_entries(), {GetParam()});
  ASSERT_EQ(chosen.size(), 1u);
  const Outcome outcome = run_entry(chosen[0], {.quick = true, .plots = {}});
  EXPECT_TRUE(outcome.pass()) << outcome_text(outcome);
}

std::string name_of(const testing::TestParamInfo<const char*>& info) {
  const std::string name = info.param;
  return name.substr(name.find('.') + 1);
}

INSTANTIATE_TEST_SUITE_P(Fluid, QuickEntry,
                         testing::Values("fluid.order_taylor_green", "fluid.order_poiseuille", "fluid.order_duct",
                                         "fluid.order_couette", "fluid.taylor_green_re1600", "fluid.cavity_re1000",
                                         "fluid.determinism", "fluid.smagorinsky_constants", "fluid.shear_layer",
                                         "fluid.slipping_box"),
                         name_of);

INSTANTIATE_TEST_SUITE_P(FreeSurface, QuickEntry,
                         testing::Values("free_surface.adaptive_time_step", "free_surface.laplace_drop",
                                         "free_surface.impact_on_wall"),
                         name_of);

INSTANTIATE_TEST_SUITE_P(GrainsInFluid, QuickEntry,
                         testing::Values("grains_in_fluid.restart", "grains_in_fluid.random_pack",
                                         "grains_in_fluid.archimedes", "grains_in_fluid.sphere_across_blocks",
                                         "grains_in_fluid.water_entry_cavity", "grains_in_fluid.bouncing_sphere",
                                         "grains_in_fluid.momentum_audit", "grains_in_fluid.bed_permeability",
                                         "grains_in_fluid.wet_column_collapse", "grains_in_fluid.wet_rebound",
                                         "grains_in_fluid.stream_into_bed", "grains_in_fluid.seepage_with_surface",
                                         "grains_in_fluid.sphere_in_mud"),
                         name_of);

INSTANTIATE_TEST_SUITE_P(AveragedGrains, QuickEntry,
                         testing::Values("averaged_grains.bed_drag", "averaged_grains.hindered_settling"), name_of);

INSTANTIATE_TEST_SUITE_P(WiresInFluid, QuickEntry,
                         testing::Values("wires_in_fluid.wire_drag", "wires_in_fluid.wire_in_mud",
                                         "wires_in_fluid.resolved_wire_drag", "wires_in_fluid.screen_loss",
                                         "wires_in_fluid.ring_net_loss", "wires_in_fluid.jet_through_ring",
                                         "wires_in_fluid.crossing_wires"),
                         name_of);

INSTANTIATE_TEST_SUITE_P(Dem, QuickEntry,
                         testing::Values("dem.elastic_impact_of_spheres", "dem.elastic_impact_on_plate",
                                         "dem.damped_impact", "dem.sphere_on_incline", "dem.rolling_friction",
                                         "dem.restitution", "dem.bond_breakage", "dem.cantilever", "dem.catenary",
                                         "dem.column_collapse", "dem.energy_ledger"),
                         name_of);

INSTANTIATE_TEST_SUITE_P(Barrier, QuickEntry,
                         testing::Values("barrier.jammed_boulder", "barrier.net_in_free_fall", "barrier.post",
                                         "barrier.two_spans", "barrier.hexagonal_mesh", "barrier.wire_sliding"),
                         name_of);

}  // namespace
}  // namespace lahar::validate
