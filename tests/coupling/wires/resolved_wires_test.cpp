#include "coupling/wires/resolved_wires.h"

#include <gtest/gtest.h>

#include "tests/coupling/chains.h"

namespace lahar::coupling {
namespace {

TEST(ResolvedWires, ChoosesByTheDiameter) {
  Chains c;
  c.add(circle(Vec3::Zero(), Vec3::UnitX(), 0.2, 20), 0.01, true);
  c.add(straight_line(Vec3(0.1, -0.2, 0), Vec3(0.1, 0.2, 0), 5), 0.1, false);
  EXPECT_EQ(ResolvedWires(c.particles, c.bonds, 0.005).bonds().size(), 24U);
  const ResolvedWires thick(c.particles, c.bonds, 0.05);
  EXPECT_EQ(std::vector(thick.bonds().begin(), thick.bonds().end()), (std::vector<std::uint32_t>{20, 21, 22, 23}));
  EXPECT_EQ(thick.beads().size(), 5U);
  EXPECT_EQ(thick.ends_at(0).size(), 1U);
  EXPECT_EQ(thick.ends_at(1).size(), 2U);
  EXPECT_TRUE(ResolvedWires(c.particles, c.bonds, 1).bonds().empty());
}

/// A tie between two wires is no wire, however thick its beads.
TEST(ResolvedWires, LeavesLinksOut) {
  Chains c;
  c.add(straight_line(Vec3::Zero(), Vec3(0, 0.4, 0), 5), 0.1, false);
  dem::BondSort tie;
  tie.axial.stiffness = {1, 1, 1};
  tie.bond_radius = 1e-5;
  c.bonds.add({0, 4, c.bonds.add_sort(tie)}, c.particles);
  EXPECT_EQ(ResolvedWires(c.particles, c.bonds, 0.05).bonds().size(), 4U);
}

TEST(ResolvedWires, PiecesShareThePlaneBetweenThem) {
  Chains c;
  c.add({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1.8, 0.6, 0), Vec3(1.8, 0.6, 1), Vec3(1.4, 0.6, 0)}, 0.5, false);
  const ResolvedWires wires(c.particles, c.bonds, 0.1);
  std::vector<WireEnd> ends;
  wires.find_ends(c.particles, c.bonds, Vec3::Zero(), ends);
  ASSERT_EQ(ends.size(), 8U);
  EXPECT_EQ(ends[0].side, 0);  // a free end is flat
  EXPECT_NEAR((ends[0].normal - Vec3(-1, 0, 0)).norm(), 0, 1e-15);
  EXPECT_EQ(ends[1].side, -1);  // the first joint
  EXPECT_EQ(ends[2].side, 1);
  EXPECT_EQ(ends[1].normal, ends[2].normal);
  EXPECT_NEAR(ends[1].normal.dot(Vec3(1, 0, 0)), ends[1].normal.dot(Vec3(0.8, 0.6, 0)), 1e-15);  // halves the angle
  EXPECT_EQ(ends[3].side, -1);                                                                   // a right angle
  EXPECT_EQ(ends[5].side, 0);                                                                    // bent back
  EXPECT_EQ(ends[6].side, 0);
}

TEST(ResolvedWires, GoesOnThroughAPeriodicFace) {
  Chains c;
  c.add(straight_line(Vec3(2, 2, 0), Vec3(2, 2, 8), 5), 0.5, false);
  const ResolvedWires wires(c.particles, c.bonds, 0.1);
  std::vector<WireEnd> ends;
  wires.find_ends(c.particles, c.bonds, Vec3(0, 0, 8), ends);
  EXPECT_EQ(ends.front().side * ends.back().side, -1);
  wires.find_ends(c.particles, c.bonds, Vec3(0, 0, 8.1), ends);
  EXPECT_EQ(ends.front().side, 0);
  EXPECT_EQ(ends.back().side, 0);
}

TEST(ResolvedWires, LetsBrokenBondsGo) {
  Chains c;
  c.add(straight_line(Vec3::Zero(), Vec3(0, 0.4, 0), 5), 0.1, false);
  ResolvedWires wires(c.particles, c.bonds, 0.05);
  EXPECT_FALSE(wires.update(c.particles, c.bonds));
  c.bonds.intact[1] = 0;
  EXPECT_TRUE(wires.update(c.particles, c.bonds));
  EXPECT_EQ(wires.is_mapped(), (std::vector<std::uint8_t>{1, 0, 1, 1}));
  EXPECT_EQ(wires.ends_at(1).size(), 1U);
  c.particles.remove(4);
  EXPECT_TRUE(wires.update(c.particles, c.bonds));
  EXPECT_EQ(wires.is_mapped(), (std::vector<std::uint8_t>{1, 0, 1, 0}));
  EXPECT_EQ(wires.beads().size(), 4U);
}

}  // namespace
}  // namespace lahar::coupling
