#include "cases/assembly/drawn_out_dissipators.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "barrier/dissipator.h"
#include "barrier/wire.h"
#include "dem/time_step.h"
#include "tests/cases/assembly/rejections.h"
#include "tests/cases/runner/warns.h"

namespace lahar::cases {
namespace {

using scene::case_file;
using scene::expect_rejection;
using scene::load;

constexpr double kRadius = 0.00305;  // m

/// A straight cable of four beads that touch, with a dissipator at one of its three bonds.
struct Cable {
  dem::Particles particles;
  dem::Bonds bonds;
  std::size_t dissipator;
  double limit;  // s, of a bond at rest

  Cable(std::size_t at, std::vector<std::size_t> fixed) : dissipator(at) {
    barrier::WireSpec spec;
    spec.properties = {2 * kRadius, 7800};
    spec.sort = bonds.add_sort(barrier::wire_bond(8e11, kRadius));
    spec.dissipator_sort = bonds.add_sort(barrier::dissipator_bond(8e11, 8e8, 2000, kRadius));
    spec.dissipator_bonds = {at};
    spec.fixed_beads = std::move(fixed);
    for (int k = 0; k < 4; ++k) spec.line.points.push_back(Vec3(0, 2 * kRadius * k, 0));
    barrier::add_wire(spec, particles, bonds);
    limit = dem::bond_time_step(bonds.sorts[0], spec.properties.bead_mass());
  }
  [[nodiscard]] DrawnOutDissipators drawn_out() const { return {{dissipator}, particles, bonds}; }
};

/// What stops a run is the limit of all bonds where they are.
TEST(DrawnOutDissipators, AllowTheStepOfBondsAsLongAsThey) {
  for (const Cable& cable : {Cable(1, {}), Cable(0, {0}), Cable(2, {3})})
    for (const double elongation : {0.0, 0.003, 0.02, 0.5}) {
      dem::Particles moved = cable.particles;
      for (std::size_t k = cable.dissipator + 1; k < 4; ++k) moved.position.add(k, Vec3(0, elongation, 0));
      EXPECT_NEAR(cable.drawn_out().time_step(elongation) / dem::bond_time_step(cable.bonds, moved), 1, 1e-12)
          << cable.dissipator << ", " << elongation;
    }
}

/// Shear of a bond of length l turns a bead by n k (l/2)^2, n = 1 towards a fixed end and 2 towards a free one, besides
/// the 2 k r^2 of its other bond; at rest in a chain it is 4 k r^2.
TEST(DrawnOutDissipators, AreDrawnOutAsFarAsTheLeverAllows) {
  const double share = 0.8, squared = 4 / (share * share) - 2;
  const auto elongation = [&](const Cable& cable) { return cable.drawn_out().elongation(share * cable.limit, 0.1); };
  EXPECT_NEAR(elongation(Cable(1, {})), 2 * kRadius * (std::sqrt(squared / 2) - 1), 1e-9);  // 2.8 mm
  EXPECT_NEAR(elongation(Cable(0, {0})), 2 * kRadius * (std::sqrt(squared) - 1), 1e-9);     // 6.5 mm
  const Cable free(1, {});
  EXPECT_EQ(free.drawn_out().elongation(share * free.limit, 0.002), 0.002);
  EXPECT_LT(free.drawn_out().elongation(1.01 * free.limit, 0.1), 1e-12);
}

TEST(DrawnOutDissipators, NoneAllowAnyStep) {
  const Cable cable(1, {});
  const DrawnOutDissipators none({}, cable.particles, cable.bonds), held = Cable(1, {1, 2}).drawn_out();
  EXPECT_EQ(none.time_step(1), std::numeric_limits<double>::infinity());
  EXPECT_EQ(held.time_step(1), std::numeric_limits<double>::infinity());
  EXPECT_EQ(none.elongation(1e-3, 0.1), 0.1);
}

TEST(DrawnOutDissipators, TwoDigitsDown) {
  EXPECT_DOUBLE_EQ(two_digits_down(0.6291), 0.62);
  EXPECT_DOUBLE_EQ(two_digits_down(3.19e-6), 3.1e-6);
  EXPECT_DOUBLE_EQ(two_digits_down(0.01), 0.01);
}

const std::string kSoft = "barrier.bonds.dissipator_stiffness_N_m3=[8e11, 8e8]";

/// The step is that of the barrier as built. With a second stage of a thousandth of the stiffness it holds for 3 mm, 3
/// % above the activation force.
TEST(DrawnOutDissipators, AStepThatEndsSoonAfterTheyActivateIsWarnedOf) {
  const auto spans = [](std::vector<std::string> set) {
    set.push_back(kSoft);
    return check_scene(load(case_file("two_spans/scene.toml"), set));
  };
  const CheckReport own = spans({});
  EXPECT_TRUE(warns(own, "holds until a dissipator is drawn out by 0.002")) << testing::PrintToString(own.warnings);
  EXPECT_TRUE(warns(own, "solids.bond_safety of 0.6")) << testing::PrintToString(own.warnings);
  EXPECT_TRUE(warns(own, "up to 0.0062 m, of 0.12 up to 0.061 m")) << testing::PrintToString(own.warnings);
  EXPECT_FALSE(warns(spans({"solids.bond_safety=0.6"}), "drawn out"));
  EXPECT_TRUE(warns(spans({"solids.time_step_s=3e-6"}), "solids.time_step_s of 2."));
}

/// Their dissipators bear twice the activation force, or are drawn out by a bond's length, with steps as they are.
TEST(DrawnOutDissipators, ScenesOfTheCasesAreNotWarnedOf) {
  for (const char* file : {"two_spans/scene.toml", "hanging_net/scene.toml", "tutorial/net.toml"})
    EXPECT_FALSE(warns(check_scene(load(case_file(file))), "drawn out")) << file;
  EXPECT_FALSE(warns(check_scene(scene::debris_flow()), "drawn out"));
}

/// A step that ends before they activate is a mistake, one that the scene asks for a warning.
TEST(DrawnOutDissipators, AStepThatEndsBeforeTheyActivateIsAMistake) {
  const auto net = case_file("hanging_net/scene.toml");
  const std::string strong = "barrier.bonds.dissipator_force_limit_N=[4000.0]";
  EXPECT_NEAR(activation_elongation(load(net)), 2000 / (8e9 * M_PI * kRadius * kRadius), 1e-9);
  expect_rejection(net, {{strong}, "solids.bond_safety is 0.8", "drawn out by 0.0171 m, where they activate"});
  EXPECT_TRUE(scene::mistakes_in(net, {strong, "solids.bond_safety=0.35"}).empty());
  EXPECT_TRUE(warns(check_scene(load(net, {strong, "solids.time_step_s=2e-5"})),
                    "holds until a dissipator is drawn out by 0.01"));
}

}  // namespace
}  // namespace lahar::cases
