#include "lbm/boundary/surface_cells_at_walls.h"

#include <gtest/gtest.h>

#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

/// A film thinner than a cell runs down its bed at the mean velocity of Nusselt's film, g h^2 / (3 nu).
TEST(SurfaceCellsAtWalls, AFilmWithinACellRunsAsNusseltSays) {
  const double viscosity = 0.002, gravity = 1e-5;
  for (const double height : {0.5, 0.7, 0.9})
    for (const bool moving : {false, true}) {
      FluidOptions o = lattice_options({8, 8, 8}, viscosity);
      o.domain.faces[4] = FaceKind::closed;
      o.domain.faces[5] = FaceKind::open;
      Wall bed{"bed", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}, WallSlip::no_slip};
      const Vec3 frame = moving ? Vec3(0, 0.02, 0) : Vec3(Vec3::Zero());
      bed.velocity = frame;
      o.domain.walls.add(bed);
      o.gravity = Vec3(gravity, 0, -gravity);
      Fluid<double> fluid(o);
      fluid.fill({{Vec3::Zero(), Vec3(8, 8, height), frame}});
      for (int s = 0; s < 1500; ++s) fluid.step();
      const auto cell = fluid.cell_at(Vec3(4.5, 4.5, 0.5));
      ASSERT_TRUE(cell.has_value());
      EXPECT_NEAR(cell->velocity.x() / (gravity * height * height / (3 * viscosity)), 1, 0.04) << height << moving;
      EXPECT_NEAR(cell->velocity.y(), frame.y(), 1e-4) << height;
    }
}

/// A sheet of one cell that slides over a bed without viscosity keeps its velocity, and a thicker one that of its
/// surface.
TEST(SurfaceCellsAtWalls, WithoutViscosityNothingBrakes) {
  for (const double height : {0.6, 2.6}) {
    FluidOptions o = lattice_options({16, 8, 8}, 1e-8);
    o.domain.faces[4] = FaceKind::closed;
    o.domain.faces[5] = FaceKind::open;
    o.domain.walls.add({"bed", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}, WallSlip::no_slip});
    o.gravity = Vec3(0, 0, -1e-5);
    Fluid<double> fluid(o);
    fluid.fill({{Vec3::Zero(), Vec3(16, 8, height), Vec3(0.05, 0, 0)}});
    for (int s = 0; s < 100; ++s) fluid.step();
    const auto top = fluid.cell_at(Vec3(4.5, 4.5, height - 0.1));
    ASSERT_TRUE(top.has_value());
    EXPECT_NEAR(top->velocity.x(), 0.05, 1e-3) << height;
  }
}

/// However fast a film is, its bed takes what viscosity does, 3 nu u / F. (With the third moments of what the cells
/// send left out 0.9 of it were left at 0.05 lu, a third at 0.15.)
TEST(SurfaceCellsAtWalls, FastFilmsAreNotPushed) {
  const double viscosity = 5e-6, height = 0.6;
  for (const double speed : {0.05, 0.11, 0.15}) {
    FluidOptions o = lattice_options({16, 8, 8}, viscosity);
    o.domain.faces[4] = FaceKind::closed;
    o.domain.faces[5] = FaceKind::open;
    o.domain.walls.add({"bed", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}, WallSlip::no_slip});
    o.gravity = Vec3(0, 0, -1e-4);
    Fluid<double> fluid(o);
    fluid.fill({{Vec3::Zero(), Vec3(16, 8, height), Vec3(speed, 0, 0)}});
    const auto now = [&] { return fluid.cell_at(Vec3(4.5, 4.5, 0.5))->velocity.x(); };
    fluid.measure_walls();
    double taken = 0;
    for (int s = 0; s < 100; ++s) {
      taken += fluid.options().density * 16 * 8 * 3 * viscosity * now() / height;
      fluid.step();
    }
    EXPECT_NEAR(fluid.wall_loads()[0].impulse.x() / taken, 1, 0.1) << speed;
  }
}

}  // namespace
}  // namespace lahar::lbm
