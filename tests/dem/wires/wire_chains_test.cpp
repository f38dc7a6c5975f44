// Which beads form wires, in which order, and which never touch.
#include "dem/wires/wire_chains.h"

#include <gtest/gtest.h>

#include "tests/dem/wire_scenes.h"

namespace lahar::dem {
namespace {

using testing::WireScene;

TEST(WireChains, FollowCableAndRing) {
  WireScene s;
  s.add_wire(testing::straight(4, Vec3::Zero(), Vec3::UnitX()));
  s.add_wire(testing::circle(6, 0.006, {0, 0, 1}, Vec3::UnitX(), Vec3::UnitY()), true);
  const ParticleIndex grain = s.add_grain({0, 0, 2}, 0.01);
  WireChains chains;
  chains.build(s.bonds, s.particles);
  EXPECT_EQ(chains.before(0), WireChains::none);
  for (ParticleIndex k = 0; k < 3; ++k) EXPECT_EQ(chains.behind(k), k + 1);
  EXPECT_TRUE(chains.is_end(0) && chains.is_end(3));
  EXPECT_FALSE(chains.is_end(1) || chains.is_end(4));
  for (ParticleIndex k = 4; k < 10; ++k) {
    EXPECT_EQ(chains.before(chains.behind(k)), k);
    EXPECT_EQ(chains.covered()[k], 1);
  }
  EXPECT_EQ(chains.covered()[grain], 0);
}

TEST(WireChains, BrokenBondsPartThemAndLeavePlainBeads) {
  WireScene s;
  s.add_wire(testing::straight(6, Vec3::Zero(), Vec3::UnitX()));
  s.bonds.intact[2] = 0;  // 0-1-2 | 3-4-5
  s.bonds.intact[3] = 0;  // 3 stands alone
  WireChains chains;
  chains.build(s.bonds, s.particles);
  EXPECT_TRUE(chains.is_end(2) && chains.is_end(4));
  EXPECT_EQ(chains.covered()[3], 0);
  EXPECT_TRUE(chains.near(0, 2));
  EXPECT_FALSE(chains.near(2, 4)) << "stumps touch";
}

TEST(WireChains, MeshesAreNoWires) {
  WireScene s;
  s.add_wire(testing::straight(5, Vec3::Zero(), Vec3::UnitX()));
  s.add_wire({Vec3(0, 0.006, 0)});
  s.particles.body[5] = 0;
  s.bonds.add({2, 5, 0}, s.particles);  // the third bond of bead 2
  WireChains chains;
  chains.build(s.bonds, s.particles);
  for (ParticleIndex k = 0; k < 6; ++k) EXPECT_EQ(chains.covered()[k], 0);
}

}  // namespace
}  // namespace lahar::dem
