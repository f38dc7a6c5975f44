#include "barrier/threading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "barrier/clearance.h"
#include "barrier/topology.h"

namespace lahar::barrier {
namespace {

/// 4 x 3 rings of the rockfall test with cables that go on beyond the corners.
RingNetSpec extended_spec() {
  RingNetSpec spec;
  spec.ring_diameter = 0.3, spec.ring_pitch = 0.2786, spec.beads_per_ring = 60, spec.wire_diameter = 0.0157;
  spec.width = 4 * spec.ring_pitch, spec.height = 3 * spec.ring_pitch;
  spec.fit = NetFit::cables_on_frame;
  spec.lower = spec.left = spec.right = NetCable{};
  spec.cable_extension = 0.5;
  return spec;
}

struct Built {
  dem::Particles particles;
  dem::Bonds bonds;
  Net net;
  Built() { net = build_net(extended_spec(), particles, bonds); }
};

TEST(ExtendedCables, GoOnBeyondTheCornersAndCrossWithoutTouching) {
  const Built b;
  ASSERT_EQ(b.net.corners.size(), 4u);
  for (std::size_t c = 0; c < 4; ++c) {
    const Polyline cable = centre_line(b.net.cables[c], b.particles);
    const auto& [start, end] = b.net.corners[c];
    EXPECT_NEAR((cable.points.front() - start).norm(), 0.5, 1e-9) << c;
    EXPECT_NEAR((cable.points.back() - end).norm(), 0.5, 1e-9) << c;
  }
  EXPECT_GT(smallest_wire_gap(centre_lines(b.net, b.particles), b.net.wire_diameter), 0);
  EXPECT_EQ(b.net.dissipators.size(), 8u);
}

TEST(ExtendedCables, StillThreadTheEdgeRings) {
  const Built b;
  const Topology topology = find_topology(b.net, b.particles, b.bonds);
  const auto threads = threadings(b.net);
  EXPECT_EQ(threads.size(), 2u * (4 + 3));
  for (const auto& [ring, cable] : threads) {
    const int wanted = static_cast<int>(b.net.rings.size() + cable);
    int number = 0;
    for (const Link& l : topology.links[ring])
      if (l.other == wanted) number = l.number;
    EXPECT_EQ(std::abs(number), 1) << "ring " << ring << " on cable " << cable;
  }
}

TEST(Threading, FindsWhereACablePassesThroughARing) {
  Polyline ring, cable;
  ring.closed = true;
  for (int k = 0; k < 12; ++k) {
    const double phi = 2 * std::numbers::pi * k / 12;
    ring.points.push_back(Vec3(0.325, 0.1 * std::cos(phi) + 0.04, 0.1 * std::sin(phi)));
  }
  for (int k = 0; k <= 10; ++k) cable.points.push_back(Vec3(0.1 * k, 0, 0));
  const auto place = place_on_cable(ring, cable);
  ASSERT_TRUE(place.has_value());
  EXPECT_NEAR(*place, 3.25, 1e-9);
  for (Vec3& p : ring.points) p.y() += 0.2;
  EXPECT_FALSE(place_on_cable(ring, cable).has_value());
}

TEST(Threading, PlacesOfANewNetAreInTheMiddleOfItsRings) {
  const Built b;
  for (const auto& [r, c] : threadings(b.net)) {
    const Polyline ring = centre_line(b.net.rings[r], b.particles), cable = centre_line(b.net.cables[c], b.particles);
    const auto place = place_on_cable(ring, cable);
    ASSERT_TRUE(place.has_value()) << r;
    const Vec3 at = cable.points[static_cast<std::size_t>(std::lround(*place))];
    const Vec3 along = (cable.points.back() - cable.points.front()).normalized();
    EXPECT_LT(std::abs((at - bounding_sphere(ring).centre).dot(along)), 0.03) << r;
  }
}

/// A net that grows by a tenth carries its rings along with their cables.
TEST(Threading, PlacesAreThoseAlongTheCableAsMade) {
  Built b;
  const auto threads = threadings(b.net);
  const std::vector<double> before = places_on_cables(b.net, threads, b.particles, b.bonds);
  ASSERT_EQ(before.size(), threads.size());
  for (std::size_t k = 0; k < threads.size(); ++k) {
    const Polyline ring = centre_line(b.net.rings[threads[k].ring], b.particles),
                   cable = centre_line(b.net.cables[threads[k].cable], b.particles);
    EXPECT_NEAR(before[k], place_on_cable(ring, cable).value() * (cable.end(0) - cable.start(0)).norm(), 1e-6) << k;
  }
  for (std::size_t i = 0; i < b.particles.size(); ++i) b.particles.position.set(i, 1.1 * b.particles.position[i]);
  const Travel travel = travel_between(before, places_on_cables(b.net, threads, b.particles, b.bonds));
  EXPECT_NEAR(travel.furthest, 0, 1e-9);
}

TEST(Threading, TornRingsAndCablesHaveNoPlaces) {
  Built b;
  const auto threads = threadings(b.net);
  b.bonds.intact[b.net.rings[threads.front().ring].first_bond] = 0;
  b.bonds.intact[b.net.cables[1].first_bond + 3] = 0;
  const std::vector<double> places = places_on_cables(b.net, threads, b.particles, b.bonds);
  for (std::size_t k = 0; k < threads.size(); ++k)
    EXPECT_EQ(std::isnan(places[k]), threads[k].ring == threads.front().ring || threads[k].cable == 1) << k;
}

TEST(Threading, TravelLeavesOutWhatHasNoPlace) {
  const double none = std::nan("");
  const Travel travel = travel_between({1, 2, none, 4}, {1.5, none, 3, 3});
  EXPECT_DOUBLE_EQ(travel.mean, 0.75);
  EXPECT_DOUBLE_EQ(travel.furthest, 1);
  EXPECT_EQ(travel_between({none, 1}, {1, none}).mean, 0);
}

TEST(Threading, TiesBondEachThreadedRingOnceToTheNearestBeadOfItsCable) {
  Built b;
  const std::size_t before = b.bonds.size();
  tie_to_cables(b.net, b.particles, b.bonds.add_sort(wire_bond(3e11, 0.00785)), b.bonds);
  ASSERT_EQ(b.bonds.size() - before, threadings(b.net).size());
  for (std::size_t k = before; k < b.bonds.size(); ++k) {
    EXPECT_LT(b.bonds.rest_length[k], 1.6 * b.net.wire_diameter);
    EXPECT_NE(b.particles.body[b.bonds.i[k]], b.particles.body[b.bonds.j[k]]);
  }
}

}  // namespace
}  // namespace lahar::barrier
