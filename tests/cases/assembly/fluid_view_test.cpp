#include "cases/assembly/fluid_view.h"

#include <gtest/gtest.h>

#include <numeric>

namespace lahar::cases {
namespace {

/// A view says what its fluid says.
template <class Real>
void expect_same() {
  lbm::FluidOptions options;
  options.domain.upper = Vec3(0.32, 0.16, 0.16);
  options.domain.cell_size = 0.02;
  options.time_step = 1e-3;
  options.gravity = Vec3(0, 0, -9.81);
  lbm::Fluid<Real> fluid(options);
  fluid.fill({{Vec3::Zero(), Vec3(0.16, 0.16, 0.1)}});
  const auto view = view_of(fluid);
  view->measure_walls();
  for (int s = 0; s < 20; ++s) fluid.step();
  EXPECT_EQ(view->steps(), 20);
  EXPECT_EQ(view->wet_cells(), fluid.wet_cells());
  EXPECT_EQ(view->liquid_mass(), fluid.liquid_mass());
  EXPECT_EQ(view->mass_drift(fluid.liquid_mass()), fluid.mass_drift());
  EXPECT_EQ(view->max_speed_lu(), fluid.max_speed_lu());
  EXPECT_EQ(view->transfers().left, fluid.outflow_mass());
  EXPECT_EQ(view->wall_loads().size(), fluid.wall_loads().size());
  const Vec3 inside(0.05, 0.05, 0.05);
  ASSERT_TRUE(view->cell_at(inside).has_value());
  EXPECT_EQ(view->cell_at(inside)->pressure, fluid.cell_at(inside)->pressure);
  std::size_t cells = 0;
  view->for_each_wet_cell([&](const lbm::WetCell&) { ++cells; });
  EXPECT_EQ(cells, fluid.wet_cells());
  std::vector<std::size_t> in_block(view->wet_block_count());
  view->for_each_wet_block([&](std::size_t k, std::span<const lbm::WetCell> some) { in_block.at(k) = some.size(); });
  EXPECT_EQ(std::accumulate(in_block.begin(), in_block.end(), std::size_t{0}), fluid.wet_cells());
  EXPECT_EQ(view->snapshot().blocks.size(), fluid.snapshot().blocks.size());
  EXPECT_FALSE(view->leaving_velocity().has_value()) << "all faces are closed";
}

TEST(FluidView, OfSingleAndDoublePrecision) {
  expect_same<float>();
  expect_same<double>();
}

/// A block that flies out of a corner leaves with what it has; one that flies inwards leaves not at all.
TEST(FluidView, VelocityOfWhatLeaves) {
  const auto leaving = [](const Vec3& velocity) {
    lbm::FluidOptions options;
    options.domain.upper = Vec3(0.32, 0.32, 0.32);
    options.domain.cell_size = 0.02;
    options.domain.faces.fill(lbm::FaceKind::open);
    options.time_step = 1e-3;
    lbm::Fluid<double> fluid(options);
    fluid.fill({{.lower = Vec3(0.16, 0.16, 0.16), .upper = Vec3(0.32, 0.32, 0.32), .velocity = velocity}});
    fluid.step();
    return view_of(fluid)->leaving_velocity();
  };
  const Vec3 outwards(1, -0.5, 0.5);
  ASSERT_TRUE(leaving(outwards).has_value());
  EXPECT_LT((*leaving(outwards) - outwards).norm(), 0.05 * outwards.norm());
  EXPECT_FALSE(leaving(Vec3(-1, -1, -1)).has_value());
}

}  // namespace
}  // namespace lahar::cases
