#include "barrier/topology.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace lahar::barrier {
namespace {

struct Built {
  dem::Particles particles;
  dem::Bonds bonds;
  Net net;
  Topology topology;
  explicit Built(const RingNetSpec& spec)
      : net(build_net(spec, particles, bonds)), topology(find_topology(net, particles, bonds)) {}
  [[nodiscard]] Topology again() const { return find_topology(net, particles, bonds); }
};

RingNetSpec small_spec() {
  RingNetSpec spec;
  spec.width = 0.24, spec.height = 0.18;
  spec.fit = NetFit::cables_on_frame;
  return spec;
}

/// The wires that a ring of this column and row must hold, ascending.
std::vector<int> expected_partners(const Net& net, int column, int row) {
  std::vector<int> partners;
  const auto ring = [&](int c, int r) {
    if (c >= 0 && c < net.columns && r >= 0 && r < net.rows) partners.push_back(r * net.columns + c);
  };
  ring(column, row - 1), ring(column - 1, row), ring(column + 1, row), ring(column, row + 1);
  const int rings = net.columns * net.rows;
  if (row == 0) partners.push_back(rings);
  if (row + 1 == net.rows) partners.push_back(rings + 1);
  if (column == 0) partners.push_back(rings + 2);
  if (column + 1 == net.columns) partners.push_back(rings + 3);
  return partners;
}

void expect_chain_mail(const Built& built) {
  for (int row = 0; row < built.net.rows; ++row)
    for (int column = 0; column < built.net.columns; ++column) {
      std::vector<int> partners;
      for (const Link& l : built.topology.links[static_cast<std::size_t>(row * built.net.columns + column)]) {
        partners.push_back(l.other);
        EXPECT_EQ(std::abs(l.number), 1);
      }
      EXPECT_EQ(partners, expected_partners(built.net, column, row)) << "column " << column << ", row " << row;
    }
}

TEST(Topology, PaperNetIsFourfoldChainMailOnFourCables) {
  const Built built{RingNetSpec{}};
  expect_chain_mail(built);
  EXPECT_TRUE(same_links(built.topology, built.again()));
}

TEST(Topology, RockfallNetIsFourfoldChainMailOnFourCables) {
  RingNetSpec spec;
  spec.ring_diameter = 0.3, spec.ring_pitch = 0.2766, spec.beads_per_ring = 60, spec.wire_diameter = 0.0157;
  spec.width = spec.height = 13 * spec.ring_pitch;
  spec.fit = NetFit::cables_on_frame;
  expect_chain_mail(Built{spec});
}

TEST(Topology, NoticesARingThatLeftItsNeighbours) {
  Built built(small_spec());
  const Wire& ring = built.net.ring(1, 1);
  for (std::uint32_t k = 0; k < ring.beads; ++k) built.particles.position.x[ring.first_bead + k] += 0.03;
  const Topology now = built.again();
  EXPECT_FALSE(same_links(built.topology, now));
  EXPECT_EQ(first_difference(built.topology, now).rfind("ring 1 was linked with 0 (", 0), 0u);
}

TEST(Topology, NoticesARingThatSlippedOffItsCable) {
  Built built(small_spec());
  const Wire& cable = *built.net.cable(Side::upper);
  for (std::uint32_t k = 0; k < cable.beads; ++k) built.particles.position.x[cable.first_bead + k] += 0.03;
  EXPECT_FALSE(same_links(built.topology, built.again()));
}

TEST(Topology, DoesNotMindMotionThatPassesNothing) {
  Built built(small_spec());
  for (std::size_t i = 0; i < built.particles.size(); ++i) {  // shear and stretch the whole space
    const Vec3 p = built.particles.position[i];
    built.particles.position.set(i, {1.5 * p.x() + 0.4 * p.y() * p.z(), p.y() + 0.3 * p.x(), 1.3 * p.z()});
  }
  EXPECT_EQ(first_difference(built.topology, built.again()), "");
}

TEST(Topology, LeavesBrokenRingsOut) {
  Built built(small_spec());
  const Wire& ring = built.net.ring(1, 1);
  built.bonds.intact[ring.first_bond + 3] = 0;
  for (std::uint32_t k = 0; k < ring.beads; ++k) built.particles.position.x[ring.first_bead + k] += 0.03;
  const Topology now = built.again();
  EXPECT_TRUE(same_links(built.topology, now));
  EXPECT_FALSE(now.whole[static_cast<std::size_t>(built.net.columns) + 1]);
}

}  // namespace
}  // namespace lahar::barrier
