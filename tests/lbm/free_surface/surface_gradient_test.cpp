#include "lbm/free_surface/surface_gradient.h"

#include <gtest/gtest.h>

#include "lbm/free_surface/look_around.h"
#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

/// A box of 16 cells with liquid under a surface at z = 10.
struct Filled {
  Fluid<double> fluid;
  Filled() : fluid(options()) {
    fluid.fill({{Vec3::Zero(), Vec3(16, 16, 10)}});
    for (const BlockIndex b : std::vector<BlockIndex>(fluid.grid().owned())) fluid.grid().require_surface(b);
  }
  static FluidOptions options() {
    FluidOptions o = tank_options(Vec3(16, 16, 16), 1, 1, 1);
    o.gravity = Vec3::Zero();
    return o;
  }
};

/// All of it at rest: what comes in is what goes out.
template <class Field>
void set_density(Fluid<double>& fluid, const Field& drho) {
  auto& grid = fluid.grid();
  for (const BlockIndex b : grid.owned())
    for (int n = 0; n < kBlockCells; ++n)
      if (grid.block(b).surface) grid.block(b).surface->density[n] = grid.block(b).f(0)[n] = drho(grid.centre(b, n));
}

/// As a cell by itself, or as one on a layer whose depth below a surface at rho - 1 = 0 is known.
void gradient_at(Fluid<double>& fluid, CellPlace place, bool on_layer, double (&a)[3]) {
  using V = Row<double>;
  Surroundings<double> near;
  LookAround<double> look(fluid.grid(), place.block, fluid.parity());
  look.run(~std::uint64_t{0}, near);
  look.see_half_a_step_on(~std::uint64_t{0}, near);
  const auto p = cell_position(place.cell);
  const KnownPressure<V> known{V::mask_type::all(on_layer), V(0), {}};
  const Sight<V> sight(near, p[1], p[2]);
  const PressureFit<V> fit = on_layer ? pressure_gradient<true>(sight, known) : pressure_gradient<false>(sight, known);
  const double depth = fluid.grid().block(place.block).surface->density[place.cell] / 3;
  const auto x = static_cast<std::size_t>(p[0]);
  for (int k = 0; k < 3; ++k) a[k] = fit.at_surface[k][x] - depth * fit.per_depth[k][x];
}

/// Exact for a linear pressure in every interface cell, at walls and in corners too.
TEST(SurfaceGradient, IsExactForLinearPressure) {
  Filled filled;
  Fluid<double>& fluid = filled.fluid;
  auto& grid = fluid.grid();
  set_density(fluid, [](const Vec3& p) { return 3 * Vec3(1e-3, 2e-3, -5e-3).dot(p); });
  int cells = 0;
  for (const BlockIndex b : grid.owned())
    for (int n = 0; n < kBlockCells; ++n) {
      if (grid.block(b).type[static_cast<std::size_t>(n)] != CellType::interface) continue;
      for (const bool on_layer : {false, true}) {
        double a[3];
        gradient_at(fluid, {b, n}, on_layer, a);
        EXPECT_NEAR(a[0], 1e-3, 1e-6);
        EXPECT_NEAR(a[1], 2e-3, 1e-6);
        EXPECT_NEAR(a[2], -5e-3, 1e-6);
      }
      ++cells;
    }
  EXPECT_EQ(cells, 256);
}

/// A sound wave of two cells along z is not seen.
TEST(SurfaceGradient, IsBlindForTheShortestWave) {
  Filled filled;
  Fluid<double>& fluid = filled.fluid;
  auto& grid = fluid.grid();
  set_density(fluid, [](const Vec3& p) { return 0.01 * (static_cast<int>(p.z()) % 2); });
  const Vec3i cell = grid.domain().cell_at(Vec3(8.5, 8.5, 9.5));
  const CellPlace place{grid.topology().find(block_of(cell)), cell_index(cell.x() & 7, cell.y() & 7, cell.z() & 7)};
  ASSERT_EQ(grid.type(place), CellType::interface);
  double a[3];
  gradient_at(fluid, place, false, a);
  EXPECT_NEAR(a[2], 0, 1e-12);
}

}  // namespace
}  // namespace lahar::lbm
