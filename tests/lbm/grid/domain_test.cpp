#include "lbm/grid/domain.h"

#include <gtest/gtest.h>

namespace lahar::lbm {
namespace {

DomainSpec tank() {
  DomainSpec s;
  s.lower = Vec3(1, 2, 3);
  s.upper = Vec3(2, 3, 4);
  s.cell_size = 0.1;
  s.faces[5] = FaceKind::open;
  return s;
}

TEST(Domain, CellsLieInsideTheBox) {
  const Domain d(tank());
  EXPECT_EQ(d.cells(), Vec3i(10, 10, 10));
  EXPECT_NEAR((d.centre(d.first()) - Vec3(1.05, 2.05, 3.05)).norm(), 0, 1e-12);
  EXPECT_EQ(d.cell_at(Vec3(1.05, 2.05, 3.05)), d.first());
}

TEST(Domain, TheLastCellsMayLieInTheWall) {
  DomainSpec s = tank();
  s.upper = Vec3(2.03, 3.07, 4);
  const Domain d(s);
  EXPECT_EQ(d.cells(), Vec3i(11, 11, 10));
  EXPECT_EQ(d.last_within(), Vec3i(10, 11, 10));
  EXPECT_EQ(d.classify({10, 11, 1}), CellType::gas);
  EXPECT_EQ(d.classify({11, 11, 1}), CellType::wall);
}

TEST(Domain, FacesAreWallsOrSinks) {
  const Domain d(tank());
  EXPECT_EQ(d.classify({1, 1, 1}), CellType::gas);
  EXPECT_EQ(d.classify({0, 1, 1}), CellType::wall);
  EXPECT_EQ(d.classify({11, 1, 1}), CellType::wall);
  EXPECT_EQ(d.classify({1, 1, 0}), CellType::wall);
  EXPECT_EQ(d.classify({1, 1, 11}), CellType::sink);
}

TEST(Domain, SolidsOfTheSceneAreWalls) {
  DomainSpec s = tank();
  s.walls.add({"block", SolidBox{Vec3(1.4, 2.4, 3), Vec3(1.6, 2.6, 3.5)}});
  const Domain d(s);
  EXPECT_EQ(d.classify(d.cell_at(Vec3(1.5, 2.5, 3.2))), CellType::wall);
  EXPECT_EQ(d.classify(d.cell_at(Vec3(1.5, 2.5, 3.7))), CellType::gas);
}

TEST(Domain, PeriodicAxesAreChecked) {
  DomainSpec s = tank();
  s.faces[0] = FaceKind::periodic;
  EXPECT_THROW(Domain{s}, std::logic_error);
  s.faces[1] = FaceKind::periodic;
  EXPECT_THROW(Domain{s}, std::logic_error);  // 10 cells are no multiple of 8
}

/// A bed that ends at periodic faces is an endless one.
TEST(Domain, WallsGoOnBeyondPeriodicFaces) {
  for (const double height : {0.23, 0.25, 0.3}) {
    DomainSpec s;
    s.lower = Vec3::Zero(), s.upper = Vec3(0.8, 0.8, 0.8), s.cell_size = 0.1;
    s.faces[0] = s.faces[1] = FaceKind::periodic;
    s.walls.add({"bed", SolidBox{Vec3(0, -1, -1), Vec3(0.8, 2, height)}});
    const Domain d(s);
    for (const double x : {0.05, 0.45, 0.75}) {
      const Vec3 from(x, 0.35, height + 0.04);
      for (const double aside : {-0.1, 0.0, 0.1})
        EXPECT_NEAR(d.wall_share(from, from + Vec3(aside, 0, -0.1)), 0.4, 1e-9) << height << " " << x << " " << aside;
    }
  }
}

}  // namespace
}  // namespace lahar::lbm
