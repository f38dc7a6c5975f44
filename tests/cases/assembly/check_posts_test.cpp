#include <gtest/gtest.h>

#include "cases/assembly/net_spec.h"
#include "tests/cases/assembly/rejections.h"

namespace lahar::scene {
namespace {

class PostsMistake : public testing::TestWithParam<Rejection> {};

TEST_P(PostsMistake, IsTheOneMistake) { expect_rejection(case_file("two_spans/scene.toml"), GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    CrossChecks, PostsMistake,
    testing::Values(
        Rejection{{"barrier.posts.height_m=0.19"}, "barrier.posts.height_m", "shorter than the net"},
        Rejection{{"barrier.posts.height_m=220"}, "barrier.posts.height_m", "220 m above the domain"},
        Rejection{{"barrier.posts.height_m=0.9"}, "barrier.posts.height_m", "at most its height, 0.5 m"},
        Rejection{{"barrier.posts.diameter_m=0.05"}, "barrier.posts.diameter_m", "too thick for a beam"},
        Rejection{{"barrier.posts.area_m2=0"}, "barrier.posts.area_m2", "above 0"},
        Rejection{{"barrier.posts.second_moment_m4=0"}, "barrier.posts.second_moment_m4", "above 0"},
        Rejection{{"barrier.posts.foot=hinge"}, "barrier.posts.foot", "did you mean \"hinged\""},
        Rejection{{"barrier.posts.spans=0"}, "barrier.posts.spans", "from 1 to 1000"},
        Rejection{{"barrier.posts.spans=5"}, "barrier.net.width_m", "outside the domain"},
        Rejection{{"domain.lower_m=[-0.4, -0.01, -0.1]", "barrier.posts.retaining=[]"},
                  "barrier.posts.spans",
                  "stands outside the domain"},
        Rejection{{"barrier.posts.youngs_modulus_Pa=1e18"}, "barrier.posts.youngs_modulus_Pa", "need a time step"},
        Rejection{{"barrier.posts.retaining[1].post=3"}, "barrier.posts.retaining[1].post", "expected 0 to 2"},
        Rejection{{"barrier.posts.retaining[0].anchor_offset_m=[-0.01, 0, 0]"},
                  "barrier.posts.retaining[0].anchor_offset_m",
                  "away from the post's axis"},
        Rejection{{"barrier.posts.retaining[0].anchor_offset_m=[-0.2, 0, -0.05]"},
                  "barrier.posts.retaining[0].anchor_offset_m",
                  "below the ground"},
        Rejection{
            {"barrier.posts.retaining[0].anchor_offset_m=[-0.2, 0, -0.012]"}, "barrier.posts: ", "deep in a wall"},
        Rejection{{"barrier.anchors.cable_places=[]"}, "barrier.anchors.cable_places", "lacks 0"},
        Rejection{{"barrier.anchors.cable_places=[0, 0.99]"}, "barrier.anchors.cable_places", "lacks 1"},
        Rejection{{"barrier.anchors.cable_places=[0, 0.001, 1]"}, "barrier.posts: ", "which hangs on a post"},
        Rejection{{"barrier.posts.retaining[0].anchor_offset_m=[-0.6, 0, 0]"},
                  "barrier.posts.retaining[0].anchor_offset_m",
                  "outside the domain"},
        Rejection{{"barrier.posts.retaining[0].anchor_offset_m=[-0.2, 0, 0.3]"},
                  "barrier.posts.retaining[0].anchor_offset_m",
                  "above the head"},
        Rejection{{"barrier.posts.retaining[1].anchor_offset_m=[0, 0.2, 0]"}, "barrier.posts: ", "through the net"},
        Rejection{{"barrier.net.width_m=0.225"}, "barrier.net: ", "would do"},
        Rejection{{"barrier.posts.retaining[0].dissipator_places=[1.5]"},
                  "barrier.posts.retaining[0].dissipator_places",
                  "from 0 to 1"},
        Rejection{{"barrier.posts.retaining[0].dissipator_places=[0, 0.001]"}, "barrier.posts: ", "farther apart"}));

class MeshMistake : public testing::TestWithParam<Rejection> {};

TEST_P(MeshMistake, IsTheOneMistake) { expect_rejection(case_file("hexagonal_net/scene.toml"), GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    CrossChecks, MeshMistake,
    testing::Values(
        Rejection{{"barrier.net.kind=hexagon"}, "barrier.net.kind", "did you mean \"hexagonal\""},
        Rejection{{"barrier.net.single_force_N=[1431, 2192]"}, "barrier.net.single_force_N", "has 2 entries"},
        Rejection{{"barrier.net.single_force_N=[1431, 1000, 3240]"}, "barrier.net.single_force_N", "does not rise"},
        Rejection{{"barrier.net.twist_strain=[0.01, 0.011, 0.14]"}, "barrier.net.twist_force_N", "steeper"},
        Rejection{{"barrier.net.twist_length_m=0.12"}, "barrier.net.twist_length_m", "below mesh_height_m"},
        Rejection{{"barrier.net.node_diameter_m=0.05"}, "barrier.net: nodes", "touch"},
        Rejection{{"barrier.net.width_m=0.175"}, "barrier.net: ", "would do"},
        Rejection{{"barrier.net.ring_pitch_m=0.06"}, "barrier.net.ring_pitch_m", "kind = \"rings\""},
        Rejection{{"barrier.bonds.ring_stiffness_N_m3=3e11"}, "barrier.bonds.ring_stiffness_N_m3", "rings"},
        Rejection{{"barrier.bonds.ring_shear_strength_Pa=1e9"}, "barrier.bonds.ring_shear_strength_Pa", "rings"}));

/// Heads may stand above the domain, as far as it is high.
TEST(CheckPosts, PostsMayReachOutOfTheDomain) {
  EXPECT_EQ(mistakes_in(case_file("two_spans/scene.toml"), {"barrier.posts.height_m=0.8"}), std::vector<std::string>{});
}

TEST(CheckPosts, SpansSpecHoldsWhatTheSceneSays) {
  const Scene scene = load(case_file("two_spans/scene.toml"), {"solids.bond_stiffness_scale=0.5"});
  const barrier::SpansSpec spec = make_spans_spec(scene);
  EXPECT_EQ(spec.spans, 2);
  EXPECT_EQ(spec.foot, barrier::FootJoint::hinged);
  EXPECT_DOUBLE_EQ(spec.section.youngs_modulus, 105e9);
  const auto& retaining = spec.elements.of<barrier::RetainingCable>();
  ASSERT_EQ(retaining.size(), 3u);
  EXPECT_EQ(retaining[1].post, 0);
  EXPECT_EQ(retaining[0].dissipators_at, std::vector<double>{0});
  dem::Particles particles;
  dem::Bonds bonds;
  EXPECT_EQ(build_barrier(scene, particles, bonds).posts.size(), 3u);
}

TEST(CheckPosts, SofterBondsStretchTheLawOfAMesh) {
  const Scene scene = load(case_file("hexagonal_net/scene.toml"), {"solids.bond_stiffness_scale=0.5"});
  const barrier::HexagonalMesh mesh = *make_net_spec(scene).mesh;
  EXPECT_DOUBLE_EQ(mesh.single.strain[2], 0.7);
  EXPECT_DOUBLE_EQ(mesh.single.force[2], 3240);
}

}  // namespace
}  // namespace lahar::scene
