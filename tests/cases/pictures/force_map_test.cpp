#include "cases/pictures/force_map.h"

#include <gtest/gtest.h>

#include <vector>

#include "cases/pictures/colour.h"
#include "core/check.h"

namespace lahar::cases {
namespace {

/// Two level wires of ten bonds, 0.2 m and 0.6 m above the frame's lower edge.
struct TwoWires {
  dem::Particles particles;
  dem::Bonds bonds;
  ForceMap map;

  TwoWires() {
    const int sort = bonds.add_sort({});
    for (const double z : {0.2, 0.6})
      for (int k = 0; k <= 10; ++k) {
        particles.add({.position = Vec3(0.5, 0.1 * k, z), .radius = 0.01, .density = 7800});
        const auto id = static_cast<dem::ParticleId>(particles.size() - 1);
        if (k > 0) bonds.add({id - 1, id, sort}, particles);
      }
    map.particles = &particles, map.bonds = &bonds;
    map.bond_count = bonds.size();
    map.width = 1, map.height = 0.8;
  }
  void pull(std::size_t wire, double force) {
    for (std::size_t k = 0; k < 10; ++k) bonds.axial_force[10 * wire + k] = force;
  }
};

/// Pixels close to a colour in the rows of the frame alone, without head and legend.
int pixels_of(const Image& image, const Colour& colour, int from_row, int to_row) {
  int count = 0;
  for (int y = from_row; y < to_row; ++y)
    for (int x = 0; x < image.width(); ++x) count += (image.at(x, y) - colour).norm() < 0.1F;
  return count;
}

TEST(ForceMap, StrongWiresAreRedAndWide) {
  TwoWires wires;
  wires.pull(0, 9.9), wires.pull(1, 9900);
  const Image image = force_map(wires.map);
  const int top = 60, foot = image.height() - 100;
  const Colour taut = ramp_colour(ColourRamp::tension, 1), white = Colour::Ones();
  const int middle = (top + foot) / 2;
  EXPECT_GT(pixels_of(image, taut, top, middle), 2000);  // the upper wire: about 1000 x 6 pixels
  EXPECT_EQ(pixels_of(image, taut, middle, foot), 0);
  EXPECT_LT(pixels_of(image, white, top, middle), image.width() * (middle - top) - 3000);
  EXPECT_LT(pixels_of(image, white, middle, foot), image.width() * (foot - middle) - 900);  // 1000 x 1 pixels
  EXPECT_GT(pixels_of(image, white, middle, foot), image.width() * (foot - middle) - 2200);
}

TEST(ForceMap, ShearCountsAndBrokenBondsAreLeftOut) {
  TwoWires wires;
  const Image slack = force_map(wires.map);
  for (std::size_t b = 10; b < 20; ++b) wires.bonds.shear_force.set(b, Vec3(0, 0, 1000));
  const Image sheared = force_map(wires.map);
  const Colour taut = ramp_colour(ColourRamp::tension, 1);
  EXPECT_EQ(pixels_of(slack, taut, 60, slack.height() - 100), 0);
  EXPECT_GT(pixels_of(sheared, taut, 60, slack.height() - 100), 2000);
  for (std::size_t b = 0; b < 20; ++b) wires.bonds.intact[b] = 0;
  const Image broken = force_map(wires.map);
  EXPECT_EQ(pixels_of(broken, Colour::Ones(), 60, broken.height() - 100), broken.width() * (broken.height() - 160));
}

/// Where the wires hung before, 0.2 m lower, in grey under what is there.
TEST(ForceMap, EarlierPlacesAreGrey) {
  TwoWires wires;
  wires.pull(0, 9900), wires.pull(1, 9900);
  std::vector<Vec3> before;
  for (dem::ParticleId id = 0; id < wires.particles.size(); ++id)
    before.push_back(wires.particles.position[wires.particles.index(id)] - Vec3(0, 0, id < 11 ? 0 : 0.2));
  const Image alone = force_map(wires.map);
  wires.map.before = &before;
  const Image image = force_map(wires.map);
  const Colour taut = ramp_colour(ColourRamp::tension, 1), grey = from_hex(0xcccccc);
  const int top = 60, foot = image.height() - 100;
  EXPECT_EQ(pixels_of(alone, grey, top, foot), 0);
  const int drawn = pixels_of(image, grey, top, foot);
  EXPECT_GT(drawn, 900);  // the upper wire: about 1000 x 1 pixels; the lower one is covered
  EXPECT_LT(drawn, 1500);
  EXPECT_EQ(pixels_of(image, taut, top, foot), pixels_of(alone, taut, top, foot));
}

/// A net fifty times as tall as wide fits, too.
TEST(ForceMap, TallNetsAreDrawnSmaller) {
  TwoWires wires;
  wires.map.width = 0.3, wires.map.height = 15;
  const Image image = force_map(wires.map);
  EXPECT_GT(image.height(), 6 * image.width());
  EXPECT_LT(image.height(), 10000);
}

TEST(ForceMap, NeedsBondsAndAFrame) {
  TwoWires wires;
  wires.map.width = 0;
  EXPECT_THROW((void)force_map(wires.map), std::logic_error);
  EXPECT_THROW((void)force_map(ForceMap{}), std::logic_error);
}

}  // namespace
}  // namespace lahar::cases
