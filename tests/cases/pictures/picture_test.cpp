#include "cases/pictures/picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cases/pictures/colour.h"
#include "core/parallel.h"
#include "tests/cases/pictures/fluid_shapes.h"

namespace lahar::cases {
namespace {

PictureStyle plain_style() {
  PictureStyle style;
  style.width = 640;
  style.height = 360;
  style.samples = 1;
  style.time_stamp = style.legend = false;
  return style;
}

const Camera kCamera{Vec3(0, -4, 0.5), Vec3(0, 0, 0.5), Vec3::UnitZ(), 30};
const ViewBox kBox{Vec3(-2, -1, 0), Vec3(2, 1, 1)};

int different_pixels(const Image& a, const Image& b) {
  int count = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) count += !(a.at(x, y) - b.at(x, y)).isZero(1e-4F);
  return count;
}

dem::Particles one_grain(const Vec3& position, double radius) {
  dem::Particles particles;
  particles.add({.position = position, .velocity = Vec3(1, 0, 0), .radius = radius, .density = 2600});
  return particles;
}

TEST(Picture, ASphereCoversItsExactSilhouette) {
  const dem::Particles particles = one_grain(Vec3(0, 0, 0.5), 0.8);
  PictureScene scene{.box = kBox};
  const Image empty = render_picture(scene, kCamera, plain_style());
  scene.particles = &particles;
  const Image image = render_picture(scene, kCamera, plain_style());
  // A sphere of radius r at distance d fills a cone of half-angle asin(r/d).
  const double radius = std::tan(std::asin(0.8 / 4)) / (2 * std::tan(std::numbers::pi / 12) / 360);
  EXPECT_NEAR(different_pixels(image, empty), std::numbers::pi * radius * radius,
              0.01 * std::numbers::pi * radius * radius);
}

/// Each grain has a brightness of its own, wherever it stands in the arrays.
TEST(Picture, StaysTheSameWhenParticlesAreRenumbered) {
  dem::Particles particles;
  for (int k = 0; k < 8; ++k)
    particles.add({.position = Vec3(-1.4 + 0.4 * k, 0.1 * k, 0.5), .radius = 0.2 + 0.01 * k, .density = 2600});
  const PictureScene scene{.particles = &particles, .box = kBox};
  const Image before = render_picture(scene, kCamera, plain_style());
  EXPECT_GT(different_pixels(before, render_picture({.box = kBox}, kCamera, plain_style())), 1000);
  particles.renumber(dem::Renumbering({3, 0, 7, 1, 6, 2, 5, 4}));
  EXPECT_EQ(different_pixels(before, render_picture(scene, kCamera, plain_style())), 0);
}

TEST(Picture, AnEmptySceneIsASmoothSky) {
  PictureStyle style = plain_style();
  const Image image = render_picture({.box = kBox}, kCamera, style);
  for (int y = 0; y + 1 < 360; ++y)
    for (int x = 0; x + 1 < 640; ++x) {
      ASSERT_TRUE(image.at(x, y).allFinite());
      ASSERT_LT((image.at(x, y) - image.at(x, y + 1)).norm(), 0.02F);
      ASSERT_GT(image.at(x, y).minCoeff(), 0.5F);
    }
  EXPECT_GT((image.at(320, 0) - image.at(320, 180)).norm(), 0.02F) << "no gradient towards the zenith";
  style.time_stamp = true;
  EXPECT_GT(different_pixels(image, render_picture({.box = kBox}, kCamera, style)), 100) << "no time stamp";
}

TEST(Picture, GravityTurnsTheLightAndSky) {
  const Image level = render_picture({.box = kBox}, kCamera, plain_style());
  const Image tilted = render_picture({.box = kBox, .gravity = Vec3(5, 0, -8)}, kCamera, plain_style());
  EXPECT_LT((level.at(10, 180) - level.at(630, 180)).norm(), 1e-3F);
  EXPECT_GT((tilted.at(10, 180) - tilted.at(630, 180)).norm(), 0.02F) << "the horizon must be oblique";
}

TEST(Picture, WaterAbsorbsMoreWhereItIsDeeper) {
  Walls walls;
  walls.add({"back", HalfSpace{Vec3(0, 1, 0), -Vec3::UnitY()}});
  // A wedge of water: thickness along the view grows from left to right.
  const auto wedge = [](const Vec3& p) {
    return p.z() > 1 ? 0.0 : std::clamp((0.45 * (p.x() + 0.2) - (1 - p.y())) / 0.05 + 0.5, 0.0, 1.0);
  };
  const lbm::FluidSnapshot fluid = fluid_of(0.05, Vec3i(-4, -3, 0), Vec3i(4, 3, 3), wedge);
  PictureStyle style = plain_style();
  style.water_colour = Colour::Zero();
  style.water_clarity = 0.5;
  PictureScene scene{.walls = &walls, .box = kBox};
  const Image dry = render_picture(scene, kCamera, style);
  scene.fluid = &fluid;
  const Image wet = render_picture(scene, kCamera, style);
  const Projection projection(kCamera, 640, 360);
  const auto passed = [&](double x) {
    const Point p = projection.pixel(Vec3(x, 1, 0.5));
    const int px = static_cast<int>(p.x()), py = static_cast<int>(p.y());
    return (to_linear(wet.at(px, py)).array() / to_linear(dry.at(px, py)).array()).eval();
  };
  EXPECT_TRUE((passed(-0.8) > 0.999F).all()) << "no water there";
  EXPECT_GT(passed(0.3).y(), passed(0.9).y());
  EXPECT_GT(passed(0.9).y(), passed(1.3).y());
  EXPECT_GT(passed(0.9).z(), passed(0.9).x()) << "water takes red first";
}

TEST(Picture, WiresShowTheirTensionAndBrokenOnesVanish) {
  dem::Particles particles;
  for (int n = 0; n < 2; ++n)
    particles.add(
        {.position = Vec3(2 * n - 1, 0, 0.5), .radius = 0.05, .density = 7800, .kind = dem::ParticleKind::bead});
  dem::Bonds bonds;
  bonds.add_sort({});
  bonds.add({0, 1, 0}, particles);
  PictureStyle style = plain_style();
  style.full_tension = 100;
  const PictureScene scene{.particles = &particles, .bonds = &bonds, .box = kBox};
  const auto middle = [&](double force) {
    bonds.axial_force[0] = force;
    return render_picture(scene, kCamera, style).at(320, 180);
  };
  const Colour slack = middle(0), taut = middle(100);
  EXPECT_LT(slack.x() - slack.z(), 0.1F);
  EXPECT_GT(taut.x() - taut.z(), 0.3F);
  bonds.intact[0] = 0;
  const Image background = render_picture({.box = kBox}, kCamera, style);
  EXPECT_LT((middle(100) - background.at(320, 180)).norm(), 1e-3F);
}

TEST(Picture, RemovedAndBrokenParticlesAreLeftOut) {
  dem::Particles particles = one_grain(Vec3(0, 0, 0.5), 0.3);
  particles.add({.position = Vec3(std::nan(""), 0, 0), .radius = 0.3, .density = 2600});
  particles.remove(0);
  const Image image = render_picture({.particles = &particles, .box = kBox}, kCamera, plain_style());
  EXPECT_EQ(different_pixels(image, render_picture({.box = kBox}, kCamera, plain_style())), 0);
}

TEST(Picture, AGrainThrowsAShadowOnTheBed) {
  Walls walls;
  walls.add({"bed", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}});
  const Camera above{Vec3(0, -0.01, 4), Vec3::Zero(), Vec3::UnitY(), 30};
  PictureScene scene{.walls = &walls, .box = kBox};
  const Image bare = render_picture(scene, above, plain_style());
  const dem::Particles particles = one_grain(Vec3(0, 0, 0.6), 0.1);
  scene.particles = &particles;
  const Image shaded = render_picture(scene, above, plain_style());
  int darker = 0;
  for (int y = 0; y < 360; ++y)
    for (int x = 0; x < 640; ++x) darker += shaded.at(x, y).sum() < 0.75F * bare.at(x, y).sum();
  EXPECT_GT(darker, 200);
}

TEST(Picture, TheNumberOfThreadsDoesNotMatter) {
  const dem::Particles particles = one_grain(Vec3(0, 0, 0.5), 0.3);
  const lbm::FluidSnapshot fluid = fluid_of(0.1, Vec3i(-2, -1, 0), Vec3i(2, 1, 1), level_water(0.45, 0.1));
  const PictureScene scene{.particles = &particles, .fluid = &fluid, .box = kBox};
  const Image parallel = render_picture(scene, kCamera, plain_style());
  const ThreadLimit one(1);
  EXPECT_EQ(different_pixels(parallel, render_picture(scene, kCamera, plain_style())), 0);
}

}  // namespace
}  // namespace lahar::cases
