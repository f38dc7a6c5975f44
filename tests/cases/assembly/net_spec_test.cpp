#include "cases/assembly/net_spec.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "barrier/topology.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::scene {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(NetSpec, TheNetOfThePaper) {
  const barrier::RingNetSpec spec = make_net_spec(debris_flow());
  EXPECT_EQ(spec.origin, Vec3(4.1, 0, 0));
  EXPECT_EQ(spec.normal, Vec3(1, 0, 0));
  EXPECT_EQ(spec.ring.axial.stiffness[0], 3e11);
  EXPECT_EQ(spec.cable.shear_stiffness, 8e11);
  EXPECT_EQ(spec.dissipator.axial.stiffness, (std::array<double, 3>{8e11, 8e10, 8e10}));
  EXPECT_EQ(spec.dissipator.axial.force_limit, (std::array<double, 2>{2000, infinite}));
  EXPECT_EQ(spec.dissipator.bond_radius, 0.00305);
  EXPECT_EQ(spec.ring.damping_ratio, 0.02);
  EXPECT_TRUE(spec.lower.support.held_across && !spec.lower.support.fixed_all);
  EXPECT_TRUE(spec.lower.support.dissipators_at.empty());
  EXPECT_EQ(spec.left.support.fixed_at, (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(spec.upper.support.dissipators_at, (std::vector<double>{0, 1}));
}

TEST(NetSpec, BottomCableIsHeldAsTheSceneSays) {
  const auto bottom = [](const char* how) {
    return make_net_spec(
               load(case_file("debris_flow/scene.toml"), {std::string("barrier.anchors.bottom_cable=") + how}))
        .lower.support;
  };
  EXPECT_TRUE(bottom("fixed").fixed_all);
  const barrier::CableSupport along = bottom("along_bed"), places = bottom("at_places");
  EXPECT_TRUE(along.held_across && !along.fixed_all);
  EXPECT_EQ(along.fixed_at, (std::vector<double>{0, 1}));
  EXPECT_TRUE(along.dissipators_at.empty());
  EXPECT_FALSE(places.held_across || places.fixed_all);
  EXPECT_EQ(places.dissipators_at, (std::vector<double>{0, 1}));
}

TEST(NetSpec, ScaleActsOnEveryStiffnessAndNotOnForceLimits) {
  const barrier::RingNetSpec spec = make_net_spec(
      load(case_file("hanging_net/scene.toml"),
           {"solids.bond_stiffness_scale=0.5", "barrier.bonds.dissipator_stiffness_N_m3=[8e10, 2e9, 6e9]",
            "barrier.bonds.dissipator_force_limit_N=[100, 200]", "barrier.bonds.plastic_unloading=true"}));
  EXPECT_EQ(spec.ring.axial.stiffness[0], 1.5e11);
  EXPECT_EQ(spec.cable.shear_stiffness, 4e11);
  EXPECT_EQ(spec.dissipator.axial.stiffness, (std::array<double, 3>{4e10, 1e9, 3e9}));
  EXPECT_EQ(spec.dissipator.axial.force_limit, (std::array<double, 2>{100, 200}));
  EXPECT_TRUE(spec.dissipator.axial.plastic_unloading);
}

/// Each of the four strengths is that of its own bonds; where a scene gives none, as of dissipators always, nothing
/// breaks.
TEST(NetSpec, StrengthsOfRingsAndCables) {
  const auto strengths = [](const std::vector<std::string>& set) {
    const barrier::RingNetSpec spec = make_net_spec(load(case_file("hanging_net/scene.toml"), set));
    return std::vector<double>{spec.ring.tensile_strength,       spec.ring.shear_strength,
                               spec.cable.tensile_strength,      spec.cable.shear_strength,
                               spec.dissipator.tensile_strength, spec.dissipator.shear_strength};
  };
  const char* keys[] = {"ring_tensile_strength_Pa", "ring_shear_strength_Pa", "cable_tensile_strength_Pa",
                        "cable_shear_strength_Pa"};
  const std::vector<double> unbreakable(6, infinite);
  EXPECT_EQ(strengths({}), unbreakable);
  std::vector<std::string> all;
  for (int k = 0; k < 4; ++k) {
    all.push_back(std::string("barrier.bonds.") + keys[k] + "=" + std::to_string(k + 1) + "e8");
    std::vector<double> one = unbreakable;
    one[static_cast<std::size_t>(k)] = (k + 1) * 1e8;
    EXPECT_EQ(strengths({all.back()}), one) << keys[k];
  }
  EXPECT_EQ(strengths(all), (std::vector<double>{1e8, 2e8, 3e8, 4e8, infinite, infinite}));
}

/// The laws of single wires and of twists are their own. A softer mesh reaches the same forces at longer strains.
TEST(NetSpec, WiresOfAHexagonalMesh) {
  using Points = std::array<double, 3>;
  const auto mesh = [](const std::vector<std::string>& set) {
    return make_net_spec(load(case_file("hexagonal_net/scene.toml"), set)).mesh.value();
  };
  const barrier::HexagonalMesh as_written = mesh({}), soft = mesh({"solids.bond_stiffness_scale=0.5"});
  EXPECT_EQ(as_written.single.strain, (Points{0.00192, 0.05, 0.35}));
  EXPECT_EQ(as_written.single.force, (Points{1431, 2192, 3240}));
  EXPECT_EQ(as_written.twist.strain, (Points{0.00192, 0.02, 0.14}));
  EXPECT_EQ(as_written.twist.force, (Points{2862, 4384, 6480}));
  EXPECT_EQ(soft.single.strain, (Points{0.00384, 0.1, 0.7}));
  EXPECT_EQ(soft.single.force, as_written.single.force);
  EXPECT_EQ(soft.twist.strain, (Points{0.00384, 0.04, 0.28}));
  EXPECT_TRUE(as_written.plastic_unloading);
  EXPECT_FALSE(mesh({"barrier.net.wires_unload_plastically=false"}).plastic_unloading);
}

TEST(NetSpec, WithoutDissipatorsCablesAreWireThroughout) {
  const barrier::RingNetSpec spec =
      make_net_spec(load(case_file("hanging_net/scene.toml"),
                         {"barrier.bonds.dissipator_stiffness_N_m3=[]", "barrier.bonds.dissipator_force_limit_N=[]"}));
  EXPECT_TRUE(spec.upper.support.dissipators_at.empty());
  EXPECT_EQ(spec.upper.support.fixed_at, (std::vector<double>{0, 1}));
  EXPECT_FALSE(spec.lower.support.fixed_all);
}

TEST(NetSpec, CablesAreFixedAndBrakedWhereTheSceneSays) {
  const barrier::RingNetSpec spec =
      make_net_spec(load(case_file("hanging_net/scene.toml"),
                         {"barrier.bonds.dissipator_places=[0.1, 0.9]", "barrier.anchors.cable_places=[0, 0.3, 1]",
                          "barrier.anchors.lateral_cable_middles_fixed=true"}));
  EXPECT_EQ(spec.upper.support.dissipators_at, (std::vector<double>{0.1, 0.9}));
  EXPECT_EQ(spec.lower.support.fixed_at, (std::vector<double>{0, 0.3, 1}));
  EXPECT_EQ(spec.left.support.fixed_at, (std::vector<double>{0, 0.3, 0.5, 1}));
}

TEST(NetSpec, ALyingNet) {
  const barrier::RingNetSpec spec =
      make_net_spec(load(case_file("hanging_net/scene.toml"),
                         {"barrier.net.width_direction=[2, 0, 0]", "barrier.net.height_direction=[0, 3, 0]",
                          "domain.lower_m=[-1, -1, -1]", "domain.upper_m=[1, 1, 1]"}));
  EXPECT_EQ(spec.across, Vec3(1, 0, 0));
  EXPECT_EQ(spec.normal, Vec3(0, 0, 1));
}

TEST(NetSpec, NormalPointsDownTheFlowWhicheverWayTheWidthRuns) {
  const auto normal = [](const char* width, const char* height) {
    return make_net_spec(
               load(case_file("hexagonal_net/scene.toml"),
                    {std::string("barrier.net.width_direction=") + width,
                     std::string("barrier.net.height_direction=") + height, "barrier.net.origin_m=[0, 0.3, 0.1]",
                     "domain.lower_m=[-2, -2, -2]", "domain.upper_m=[2, 2, 2]"}))
        .normal;
  };
  EXPECT_EQ(normal("[0, 1, 0]", "[0, 0, 1]"), Vec3(1, 0, 0));
  EXPECT_EQ(normal("[0, -1, 0]", "[0, 0, 1]"), Vec3(1, 0, 0));
  EXPECT_LT((normal("[0, -1, 0]", "[-0.6, 0, 0.8]") - Vec3(0.8, 0, 0.6)).norm(), 1e-12);  // leans upstream
  EXPECT_EQ(normal("[1, 0, 0]", "[0, 0, 1]"), Vec3(0, -1, 0));                            // along the flow
}

/// A net is its own mirror image where the width runs the other way: as many rings and links.
TEST(NetSpec, RingsAreLinkedWhicheverWayTheWidthRuns) {
  const auto links = [](const std::vector<std::string>& set) {
    std::vector<std::string> all{"barrier.net.width_m=0.38", "barrier.net.height_m=0.26"};
    all.insert(all.end(), set.begin(), set.end());
    const Scene scene = load(case_file("hanging_net/scene.toml"), all);
    dem::Particles particles;
    dem::Bonds bonds;
    const barrier::Net net = build_barrier(scene, particles, bonds);
    std::vector<std::size_t> counts;  // by ring
    for (const auto& of_ring : barrier::find_topology(net, particles, bonds).links) counts.push_back(of_ring.size());
    return counts;
  };
  EXPECT_EQ(links({"barrier.net.width_direction=[0, -1, 0]", "barrier.net.origin_m=[0, 0.38, 0]"}), links({}));
}

}  // namespace
}  // namespace lahar::scene
