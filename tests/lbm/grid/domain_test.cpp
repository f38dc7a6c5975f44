#include "lbm/grid/domain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

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

/// Boxes that begin at a face of the domain, or are flush with a wall that comes after them, are the walls that the
/// liquid meets, whatever their thickness: the distances are equal but for roundings.
TEST(Domain, WallsInOnePlaceAreTheFirstOfThem) {
  int roundings = 0;
  for (const double thick : {0.02, 0.03, 0.05, 0.07, 0.1, 0.2, 0.3, 0.7}) {
    DomainSpec s;
    s.upper = Vec3(0.4, 0.16, 0.3);
    s.cell_size = 0.01;
    s.walls.add({"end", SolidBox{Vec3(0.4, -0.1, -0.1), Vec3(0.4 + thick, 0.3, 0.4)}});
    s.walls.add({"tile", SolidBox{Vec3(0.1, 0.04, 0.05 - thick), Vec3(0.2, 0.12, 0.05)}});
    s.walls.add({"bed", HalfSpace{Vec3(0, 0, 0.05), Vec3::UnitZ()}});
    const Domain d(s);
    for (double z = 0.055; z < 0.3; z += 0.01) {
      const Vec3 beyond(0.405, 0.055, z);
      EXPECT_EQ(d.wall_of(beyond), 0) << thick;
      roundings += d.walls().nearest(beyond).wall != 0;
    }
    for (double x = 0.105; x < 0.2; x += 0.01) {
      const Vec3 below(x, 0.055, 0.045);
      EXPECT_EQ(d.wall_of(below), 1) << thick;
      roundings += d.walls().nearest(below).wall != 1;
    }
    EXPECT_EQ(d.wall_of(Vec3(0.255, 0.055, 0.045)), 2);
  }
  EXPECT_GT(roundings, 0) << "else this test says nothing";
}

/// Distances from boxes are rounded to either side of 0 there.
TEST(Domain, ACellWhoseCentreLiesOnAWallIsFree) {
  for (const auto& [from, to] : {std::pair(0.015, 0.055), std::pair(0.025, 0.065), std::pair(0.175, 0.215),
                                 std::pair(0.205, 0.305), std::pair(0.215, 0.315)}) {
    DomainSpec s;
    s.upper = Vec3(0.4, 0.16, 0.3);
    s.cell_size = 0.01;
    s.walls.add({"box", SolidBox{Vec3(from, 0.04, 0), Vec3(to, 0.12, 0.1)}});
    const Domain d(s);
    const auto on_wall = [&](double x) { return d.classify(d.cell_at(Vec3(x, 0.085, 0.055))); };
    EXPECT_EQ(on_wall(from), CellType::gas) << from;
    EXPECT_EQ(on_wall(to), CellType::gas) << to;
    EXPECT_LT(std::min(d.walls().distance(0, d.centre(d.cell_at(Vec3(from, 0.085, 0.055)))),
                       d.walls().distance(0, d.centre(d.cell_at(Vec3(to, 0.085, 0.055))))),
              0)
        << "else this test says nothing";
    for (double x = from + s.cell_size; x < to - 0.5 * s.cell_size; x += s.cell_size)
      EXPECT_EQ(on_wall(x), CellType::wall) << x;
  }
}

/// Boxes end to end, a box on a bed and one that ends at the domain's face let nothing through where their seam lies on
/// centres of cells, also an oblique one; each of them alone leaves such a centre free.
TEST(Domain, WallsThatTouchLeaveNoSlit) {
  DomainSpec s;
  s.lower = Vec3(0, 0, -0.015);  // centres of cells lie on z = 0
  s.upper = Vec3(0.4, 0.16, 0.3);
  s.cell_size = 0.01;
  const SolidBox left{Vec3(0.1, -0.1, 0), Vec3(0.2, 0.085, 0.1)}, right{Vec3(0.1, 0.085, 0), Vec3(0.2, 0.3, 0.1)};
  const HalfSpace bed{Vec3::Zero(), Vec3::UnitZ()};
  const auto at = [&](const std::vector<Shape>& shapes, const Vec3& p) {
    DomainSpec with = s;
    for (const Shape& shape : shapes) with.walls.add({"wall", shape});
    const Domain d(with);
    return d.classify(d.cell_at(p));
  };
  const Vec3 seam(0.155, 0.085, 0.05), foot(0.155, 0.055, 0), end(0.195, 0.085, 0.09);
  EXPECT_EQ(at({left, right}, seam), CellType::wall);
  EXPECT_EQ(at({left, bed}, foot), CellType::wall);
  EXPECT_EQ(at({left, right}, end), CellType::wall);
  for (const SolidBox& one : {left, right}) EXPECT_EQ(at({one}, seam), CellType::gas);
  EXPECT_EQ(at({bed}, foot), CellType::gas);
  EXPECT_EQ(at({left, right}, Vec3(0.155, 0.085, 0.11)), CellType::gas);
  const Vec3 normal = Vec3(1, 0.37, 0.21).normalized();
  const HalfSpace below{seam, normal}, above{seam, -normal};
  EXPECT_EQ(at({below, above}, seam), CellType::wall);
  EXPECT_EQ(at({below}, seam), CellType::gas);
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
