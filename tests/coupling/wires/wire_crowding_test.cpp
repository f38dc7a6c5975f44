#include "coupling/wires/wire_crowding.h"

#include <gtest/gtest.h>

namespace lahar::coupling {
namespace {

/// Pieces of parallel wires along z, a pitch apart along y, half a diameter long; with `mesh` the same along y.
std::vector<WireSegment> screen(double diameter, double pitch, int wires, bool mesh) {
  std::vector<WireSegment> pieces;
  const double length = diameter / 2, width = pitch * wires;
  for (int k = 0; k < wires; ++k)
    for (int j = 0; j < static_cast<int>(width / length); ++j) {
      pieces.push_back({Vec3(0, (k + 0.5) * pitch, j * length), Vec3::UnitZ(), diameter, length});
      if (mesh) pieces.push_back({Vec3(0, j * length, (k + 0.5) * pitch), Vec3::UnitY(), diameter, length});
    }
  return pieces;
}

TEST(WireCrowding, PlaneScreensHaveTheirSolidity) {
  for (const double s : {0.1, 0.25, 0.4}) {
    const double pitch = 1 / s;
    const Vec3 period(0, 20 * pitch, 20 * pitch);
    const auto parallel = wire_crowding(screen(1, pitch, 20, false), period);
    EXPECT_NEAR(parallel[7].solidity / s, 1, 0.1) << s;
    EXPECT_NEAR(parallel[7].parallel, parallel[7].area, 1e-12);
    const auto mesh = wire_crowding(screen(1, pitch, 20, true), period);
    EXPECT_NEAR(mesh[7].solidity / (1 - (1 - s) * (1 - s)), 1, 0.1) << s;
    EXPECT_NEAR(mesh[7].parallel / s, 1, 0.1) << s;
    EXPECT_NEAR(mesh[7].area / (2 * s), 1, 0.1) << s;
  }
}

TEST(WireCrowding, LoneWireHasNone) {
  std::vector<WireSegment> wire;
  for (int k = 0; k < 200; ++k) wire.push_back({Vec3(0, 0, 0.5 * k), Vec3::UnitZ(), 1, 0.5});
  for (const Crowding& c : wire_crowding(wire, Vec3::Zero())) EXPECT_LT(c.solidity, 0.004);
  EXPECT_TRUE(wire_crowding({}, Vec3::Zero()).empty());
}

/// Across a periodic face the neighbours are the same as inside.
TEST(WireCrowding, SeesThroughPeriodicFaces) {
  const auto pieces = screen(1, 5, 4, false);
  const auto crowding = wire_crowding(pieces, Vec3(0, 20, 20));
  for (const Crowding& c : crowding) EXPECT_NEAR(c.solidity, crowding[0].solidity, 1e-9);
}

}  // namespace
}  // namespace lahar::coupling
