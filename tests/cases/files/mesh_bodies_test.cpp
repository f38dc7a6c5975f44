#include "cases/files/mesh_bodies.h"

#include <gtest/gtest.h>

#include "tests/core/shapes.h"

namespace lahar::cases {
namespace {

TriangleMesh joined(const std::vector<TriangleMesh>& parts) {
  TriangleMesh mesh;
  for (const TriangleMesh& part : parts) {
    const auto start = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), part.points.begin(), part.points.end());
    for (const auto& t : part.triangles) mesh.triangles.push_back({t[0] + start, t[1] + start, t[2] + start});
  }
  return mesh;
}

TriangleMesh turned(TriangleMesh mesh) {
  flip(mesh);
  return mesh;
}

const TriangleMesh block = box_mesh(Vec3::Zero(), Vec3::Ones());
const TriangleMesh room = box_mesh(Vec3::Constant(0.2), Vec3::Constant(0.8));  // inside the block
const TriangleMesh core = box_mesh(Vec3::Constant(0.4), Vec3::Constant(0.6));  // inside the room
const TriangleMesh above = box_mesh(Vec3(0.2, 0.2, 1), Vec3(0.6, 0.6, 1.5));   // stands on the block

TEST(MeshBodies, ArePartsWithoutASharedCorner) {
  const std::vector<TriangleMesh> bodies = bodies_of(joined({block, turned(room), above}));
  ASSERT_EQ(bodies.size(), 3U);
  EXPECT_NEAR(signed_volume(bodies[0]), 1, 1e-12);
  EXPECT_NEAR(signed_volume(bodies[1]), -0.216, 1e-12);
  EXPECT_EQ(bounds_of(bodies[2]).lower, Vec3(0.2, 0.2, 1));
  EXPECT_EQ(bodies[2].points.size(), 8U);
  EXPECT_EQ(bodies_of(block).size(), 1U);
}

TEST(MeshBodies, BodiesAndCavitiesInOrder) {
  EXPECT_FALSE(body_inside_out(block));
  EXPECT_FALSE(body_inside_out(joined({block, above})));
  EXPECT_FALSE(body_inside_out(joined({turned(room), block})));
  EXPECT_FALSE(body_inside_out(joined({block, turned(room), core, above})));
}

TEST(MeshBodies, TheOneInsideOutIsFound) {
  const auto lower_of = [](const TriangleMesh& mesh) {
    const auto found = body_inside_out(mesh);
    return found ? found->lower : Vec3(Vec3::Constant(-1));
  };
  EXPECT_EQ(lower_of(turned(block)), Vec3::Zero());
  EXPECT_EQ(lower_of(joined({block, turned(above)})), Vec3(0.2, 0.2, 1)) << "though it touches the other";
  EXPECT_EQ(lower_of(joined({turned(block), room})), Vec3::Zero());
  EXPECT_EQ(lower_of(joined({block, turned(room), turned(core)})), Vec3::Constant(0.4)) << "a cavity in a cavity";
}

/// Two faces back to back enclose nothing, whatever the rounding.
TEST(MeshBodies, AFlatOneIsInOrder) {
  TriangleMesh flat;
  flat.points = {{0.1, 0.2, 0.3}, {1.3, 0.7, 0.4}, {0.2, 1.1, 0.9}};
  flat.triangles = {{0, 2, 1}, {0, 1, 2}};
  EXPECT_FALSE(body_inside_out(flat));
}

}  // namespace
}  // namespace lahar::cases
