#include "cases/assembly/geometry.h"

#include <gtest/gtest.h>

#include "tests/cases/scene/scene_files.h"

namespace lahar::scene {
namespace {

TEST(SceneGeometry, GravityPointsDownTheSlope) {
  const Gravity gravity{.magnitude = 10, .slope_deg = 30};
  EXPECT_NEAR(gravity.vector().x(), 5, 1e-14);
  EXPECT_EQ(gravity.vector().y(), 0);
  EXPECT_NEAR(gravity.vector().z(), -10 * std::sqrt(3.0) / 2, 1e-14);
}

TEST(SceneGeometry, NothingPressesOnAnUprightBed) {
  EXPECT_EQ((Gravity{.magnitude = 10, .slope_deg = 90}.vector()), Vec3(10, 0, 0));
}

TEST(SceneGeometry, WallsOfTheChannel) {
  Scene scene = debris_flow();
  scene.walls[0].normal = {0, 0, 5};
  const Walls walls = make_walls(scene);
  ASSERT_EQ(walls.all().size(), 4u);
  EXPECT_NEAR(walls.nearest({2, 0.9, 0.3}).distance, 0.3, 1e-14);  // the normal is made a unit vector
  EXPECT_NEAR(walls.nearest({2, 1.7, 0.3}).distance, 0.1, 1e-14);
  EXPECT_NEAR(walls.nearest({-0.2, 0.9, 0.3}).distance, -0.2, 1e-14);
  EXPECT_EQ(walls.all()[0].material, material_index(scene, "wall"));
}

TEST(SceneGeometry, OpenDepthEndsAtTheGround) {
  Walls walls;
  EXPECT_NEAR(*open_depth(walls, {0, 0, 1}, {1, 1, 1.9}), 0.9, 1e-14);
  walls.add({"ground", HalfSpace{{0, 0, 1.3}, {0, 0, 1}}, {}, -1, {}, 0});
  EXPECT_NEAR(*open_depth(walls, {0, 0, 1}, {1, 1, 1.9}), 0.6, 1e-14);
  EXPECT_FALSE(filled_by_walls(walls, {0, 0, 1}, {1, 1, 1.9}));
  EXPECT_FALSE(open_depth(walls, {0, 0, 1}, {1, 1, 1.2}).has_value());
  EXPECT_TRUE(filled_by_walls(walls, {0, 0, 1}, {1, 1, 1.2}));
}

TEST(SceneGeometry, EveryShapeBecomesItsSolid) {
  WallSettings w;
  const auto distance = [&](const Vec3& p) {
    return std::visit([&](const auto& solid) { return solid.distance(p); }, make_wall(w, 0).shape);
  };
  w.shape = WallShape::sphere, w.centre = {1, 0, 0}, w.radius = 0.5;
  EXPECT_TRUE(std::holds_alternative<SolidSphere>(make_wall(w, 0).shape));
  EXPECT_NEAR(distance({1, 0, 2}), 1.5, 1e-12);
  w.shape = WallShape::box, w.lower = {0, 0, 0}, w.upper = {1, 2, 3};
  EXPECT_TRUE(std::holds_alternative<SolidBox>(make_wall(w, 0).shape));
  EXPECT_NEAR(distance({0.5, 1, 3.25}), 0.25, 1e-12);
  EXPECT_NEAR(distance({0.5, 2.5, 1}), 0.5, 1e-12);
  w.shape = WallShape::cylinder, w.start = {0, 0, 0}, w.end = {0, 0, 2}, w.radius = 0.5;
  EXPECT_TRUE(std::holds_alternative<SolidCylinder>(make_wall(w, 0).shape));
  EXPECT_NEAR(distance({2, 0, 1}), 1.5, 1e-12);
  EXPECT_NEAR(distance({0, 0, 3}), 1, 1e-12);
  w.shape = WallShape::plane, w.point = {0, 0, 0.3}, w.normal = {0, 0, 2};
  EXPECT_TRUE(std::holds_alternative<HalfSpace>(make_wall(w, 0).shape));
  EXPECT_NEAR(distance({5, 5, 1}), 0.7, 1e-12);
}

TEST(SceneGeometry, MaterialsCarryScaleAndPairs) {
  Scene scene = debris_flow();
  scene.solids.contact_modulus_scale = 0.1;
  const dem::Materials materials = make_materials(scene);
  const int rock = material_index(scene, "rock"), steel = material_index(scene, "steel");
  ASSERT_EQ(materials.size(), 3u);
  EXPECT_DOUBLE_EQ(materials[rock].youngs_modulus, 7e9);
  EXPECT_EQ(materials.pair(rock, steel).friction, 0.1);
  EXPECT_EQ(materials.pair(steel, rock).restitution, 0.1);
  EXPECT_EQ(materials.pair(rock, rock).friction, 0.7);
  EXPECT_EQ(material_index(scene, "gold"), -1);
}

}  // namespace
}  // namespace lahar::scene
