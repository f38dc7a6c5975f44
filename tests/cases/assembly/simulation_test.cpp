#include "cases/assembly/simulation.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "barrier/response.h"
#include "cases/assembly/build.h"
#include "core/check.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

class BothPrecisions : public testing::TestWithParam<const char*> {
 protected:
  scene::Scene scene_ = scene::load(scene::source_folder() / "tests/integration/small_debris_flow.toml",
                                    {std::string("run.precision=") + GetParam()});
};

TEST_P(BothPrecisions, HasAllPartsAndAdvances) {
  const auto simulation = build_simulation(scene_);
  ASSERT_TRUE(simulation->fluid() && simulation->solids() && simulation->net());
  const double box = 1000 * 0.3 * 0.25976 * 0.2;  // kg; grains take a part of it
  EXPECT_GT(simulation->fluid()->liquid_mass(), 0.4 * box);
  EXPECT_LT(simulation->fluid()->liquid_mass(), box);
  simulation->advance();
  EXPECT_EQ(simulation->time(), simulation->time_step());
  EXPECT_EQ(simulation->fluid()->steps(), 1);
  EXPECT_GT(simulation->seconds().at("fluid"), 0);
  EXPECT_GT(simulation->seconds().at("solids.contact"), 0);
}

TEST_P(BothPrecisions, BeforeACheckpointItHoldsNoLiquid) {
  const auto simulation = build_simulation(scene_, Beginning::checkpoint);
  EXPECT_EQ(simulation->fluid()->wet_cells(), 0u);
  EXPECT_EQ(simulation->solids()->particles().size(), build_simulation(scene_)->solids()->particles().size());
}

/// A barrier that has settled hangs below where it was built, loaded by its weight, and hardly moves any more; grains
/// are where they would be without.
TEST(Simulation, ABarrierHangsBeforeTheRunBegins) {
  const auto file = scene::source_folder() / "tests/integration/small_debris_flow.toml";
  const auto built = build_simulation(scene::load(file));
  const auto hung = build_simulation(scene::load(file, {"barrier.settle_time_s=0.3"}));
  const dem::Particles &a = built->solids()->particles(), &b = hung->solids()->particles();
  const barrier::Net& net = *hung->net();
  const Vec3 down = hung->solids()->options().gravity.normalized();
  double sag = 0;
  for (dem::ParticleId id = 0; id < b.size(); ++id) {
    const Vec3 moved = b.position[b.index(id)] - a.position[a.index(id)];
    if (id < net.first_bead)
      EXPECT_EQ(moved, Vec3(Vec3::Zero()));
    else
      sag = std::max(sag, moved.dot(down));
    EXPECT_EQ(b.velocity[b.index(id)], Vec3(Vec3::Zero()));
  }
  EXPECT_GT(sag, 0.002);
  const auto swing = [](Simulation& s) {
    const barrier::BarrierResponse start = barrier::response(*s.net(), s.solids()->particles(), s.solids()->bonds());
    double most = 0;
    while (s.time() < 0.05) {
      s.advance();
      most = std::max(most, barrier::response(*s.net(), s.solids()->particles(), s.solids()->bonds()).kinetic_energy);
    }
    return std::pair{most, start[barrier::Component::barrier].force_sum};
  };
  const auto [swing_built, load_built] = swing(*built);
  const auto [swing_hung, load_hung] = swing(*hung);
  EXPECT_LT(swing_hung, 0.02 * swing_built);
  EXPECT_LT(load_built, 1e-6);  // N, of rounding
  EXPECT_GT(load_hung, 1);
}

/// A grain right below the net as it was built, into which the net sags.
TEST(Simulation, ABarrierThatSagsIntoAGrainIsRefused) {
  const auto file = scene::source_folder() / "tests/integration/small_debris_flow.toml";
  const BuiltSolids built = build_solids(scene::load(file)),
                    hung = build_solids(scene::load(file, {"barrier.settle_time_s=0.3"}));
  const dem::Particles &a = built.solids.particles(), &b = hung.solids.particles();
  const Vec3 down = hung.solids.options().gravity.normalized();
  Vec3 place = Vec3::Zero();
  double sag = 0;
  for (std::size_t i = built.net->first_bead; i < b.size(); ++i)
    if (const double moved = (Vec3(b.position[i]) - Vec3(a.position[i])).dot(down); moved > sag)
      sag = moved, place = Vec3(b.position[i]) + (b.radius[i] + 0.01 - 0.0005) * down;
  const std::string text =
      scene::file_text(file) + fmt::format(
                                   "\n[[grains.sphere]]\nposition_m = [{}, {}, {}]\ndiameter_m = 0.02\n"
                                   "density_kg_m3 = 2500\nmaterial = \"rock\"\nfixed = true\n",
                                   place.x(), place.y(), place.z());
  EXPECT_NO_THROW(build_solids(scene::load_text(text)));
  try {
    build_solids(scene::load_text(text, {"barrier.settle_time_s=0.3"}));
    FAIL() << "the net sags by " << sag << " m";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("grains.sphere[0] reaches into the barrier"), std::string::npos) << e.what();
    EXPECT_GT(e.mistakes().front().line, 1) << "the place of the sphere";
  }
}

/// Beads that do not touch allow a shorter step than single bonds say. The run has one; the net settles with one of its
/// own (it was thrown apart at 200 m/s).
TEST(Simulation, ANetOfWideBeadsSettles) {
  const auto simulation = build_simulation(
      scene::load(scene::case_file("hanging_net/scene.toml"),
                  {"barrier.net.beads_per_ring=26", "barrier.bonds.cable_stiffness_N_m3=3e11",
                   "barrier.bonds.dissipator_stiffness_N_m3=[]", "barrier.bonds.dissipator_force_limit_N=[]",
                   "solids.bond_stiffness_scale=1", "solids.time_step_s=4e-6", "barrier.settle_time_s=0.004"}));
  const dem::Particles& p = simulation->solids()->particles();
  for (std::size_t i = 0; i < p.size(); ++i) EXPECT_LT(std::abs(p.position.x[i]), 0.05);
  simulation->advance();
}

INSTANTIATE_TEST_SUITE_P(Simulation, BothPrecisions, testing::Values("float", "double"));

TEST(Simulation, PartsThatTheSceneLacksAreNull) {
  const auto simulation = build_simulation(scene::load_text(scene::small_scene));
  EXPECT_EQ(simulation->fluid(), nullptr);
  EXPECT_EQ(simulation->net(), nullptr);
  EXPECT_NE(simulation->solids(), nullptr);
}

/// More grains than a random packing can hold: found when they are packed, and said where they are written.
TEST(Simulation, PackingsThatDoNotFitAreLocated) {
  const scene::Scene scene = scene::load_text(scene::small_scene + R"([[grains.packing]]
lower_m = [0, 0, 0]
upper_m = [0.2, 0.2, 0.2]
sizes = [{ diameter_m = 0.04, density_kg_m3 = 2500, count = 167, material = "rock" }]
)");
  try {
    (void)build_simulation(scene);
    FAIL();
  } catch (const InputError& e) {
    const InputMistake& m = e.mistakes().at(0);
    EXPECT_TRUE(m.file.ends_with("scene.toml")) << m.text();
    EXPECT_EQ(m.line, 16);
    EXPECT_NE(m.message.find("grains.packing[0]: packing: the settled spheres stand"), std::string::npos) << m.text();
  }
}

std::string packing(const char* lower, const char* upper) {
  return std::string("[[grains.packing]]\nlower_m = ") + lower + "\nupper_m = " + upper +
         "\nsizes = [{ diameter_m = 0.04, density_kg_m3 = 2500, count = 40, material = \"rock\" }]\n";
}

TEST(Simulation, PackingsInEachOtherAreLocated) {
  const scene::Scene scene = scene::load_text(scene::small_scene + packing("[0, 0, 0]", "[0.2, 0.2, 0.2]") +
                                              packing("[0.1, 0, 0]", "[0.3, 0.2, 0.2]"));
  try {
    (void)build_simulation(scene);
    FAIL();
  } catch (const InputError& e) {
    const InputMistake& m = e.mistakes().at(0);
    EXPECT_EQ(m.line, 20) << m.text();
    EXPECT_NE(m.message.find("grains.packing[1]: a grain at ("), std::string::npos) << m.text();
    EXPECT_NE(m.message.find("lies in one of grains.packing[0]"), std::string::npos) << m.text();
  }
}

/// The same grains in boxes of one size do not lie alike.
TEST(Simulation, PackingsAreNoCopiesOfEachOther) {
  const scene::Scene scene = scene::load_text(scene::small_scene + packing("[0, 0, 0]", "[0.2, 0.2, 0.2]") +
                                              packing("[0.2, 0, 0]", "[0.4, 0.2, 0.2]"));
  const auto simulation = build_simulation(scene);
  const dem::Particles& p = simulation->solids()->particles();
  ASSERT_EQ(p.size(), 81u);
  double moved = 0;
  for (std::size_t k = 0; k < 40; ++k) moved += (p.position[k + 40] - p.position[k] - Vec3(0.2, 0, 0)).norm();
  EXPECT_GT(moved / 40, 0.01);
}

}  // namespace
}  // namespace lahar::cases
