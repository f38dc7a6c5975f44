// Particles and their solver as a scene describes them. The fluid's part: fluid_options_test.cpp.
#include "cases/assembly/build.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "cases/assembly/estimates.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

dem::SolidsOptions options_of(const scene::Scene& scene) { return build_solids(scene).solids.options(); }

TEST(Build, ASphereBeginsAsTheSceneSays) {
  const BuiltSolids built =
      build_solids(scene::load_text(scene::small_scene, {"grains.sphere[0].velocity_m_s=[1, 2, 3]",
                                                         "grains.sphere[0].angular_velocity_rad_s=[4, -5, 6]"}));
  const dem::Particles& p = built.solids.particles();
  ASSERT_EQ(p.size(), 1u);
  EXPECT_EQ(Vec3(p.position[0]), Vec3(0.5, 0.5, 0.5));
  EXPECT_EQ(Vec3(p.velocity[0]), Vec3(1, 2, 3));
  EXPECT_EQ(Vec3(p.angular_velocity[0]), Vec3(4, -5, 6));
  EXPECT_FALSE(built.net.has_value());
}

/// Without a tangential stiffness the law has its own, 2/7 of the normal one, which it writes as 0.
TEST(Build, LinearContactsHaveTheStiffnessesOfTheScene) {
  std::vector<std::string> set{"solids.contact_law=linear", "solids.normal_stiffness_N_m=2e5"};
  const auto law = [&] {
    return std::get<dem::LinearSpringDashpot>(options_of(scene::load_text(scene::small_scene, set)).contact_law);
  };
  EXPECT_EQ(law(), (dem::LinearSpringDashpot{2e5, 0}));
  set.emplace_back("solids.tangential_stiffness_N_m=3e4");
  EXPECT_EQ(law(), (dem::LinearSpringDashpot{2e5, 3e4}));
}

/// In the small debris flow stiff cables need 137 particle steps in one of the fluid; its grains, by a fifth of their
/// Rayleigh time, one of 5.03 times that length.
TEST(Build, TwoRatesLetGrainsTakeLongSteps) {
  const scene::Scene scene =
      scene::load(scene::source_folder() / "tests/integration/small_debris_flow.toml", {"solids.two_rates=true"});
  const dem::SolidsOptions options = options_of(scene);
  EXPECT_EQ(options.long_step, 5);
  EXPECT_DOUBLE_EQ(options.time_step, 0.1 * 0.02 / 3 / 137);
  EXPECT_LE(5 * options.time_step, grain_time_step(scene));
  EXPECT_GT(6 * options.time_step, grain_time_step(scene));
  using Change = void (*)(scene::Scene&);
  const std::pair<const char*, Change> one_rate[] = {{"one rate", [](scene::Scene& s) { s.solids.two_rates = false; }},
                                                     {"no fluid", [](scene::Scene& s) { s.fluid.enabled = false; }},
                                                     {"no barrier", [](scene::Scene& s) { s.barrier.enabled = false; }},
                                                     {"no grains", [](scene::Scene& s) { s.grains.packings.clear(); }}};
  for (const auto& [what, change] : one_rate) {
    scene::Scene changed = scene;
    change(changed);
    EXPECT_EQ(options_of(changed).long_step, 1) << what;
  }
}

}  // namespace
}  // namespace lahar::cases
