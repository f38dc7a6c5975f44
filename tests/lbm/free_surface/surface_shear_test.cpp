#include "lbm/free_surface/surface_shear.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lbm/step/fluid.h"
#include "lbm/step/gather.h"

namespace lahar::lbm {
namespace {

using V = Row<double>;

/// A level surface, x along it and the liquid below: what the links upwards add to the momentum along x is the stress
/// at half a link, from that of the next cell and 0 on the surface.
TEST(SurfaceShear, TractionOfALevelSurface) {
  constexpr double stress = 1e-4;
  for (const double depth : {-0.49, -0.2, 0.0, 0.3, 0.5}) {
    const Symmetric<V> s{V(3e-4), V(-2e-4), V(-1e-4), V(5e-5), V(stress), V(0)};
    const auto t =
        surface_traction<V>(s, {V(0), V(0), V(-1)}, V(1.2), {V(0), V(0), V(-2e-5)}, V(2e-5 * depth), V(2e-5));
    EXPECT_NEAR(t.depth[0], depth, 1e-12);
    const double ahead = t.missing<1, 0, 1>(1.0 / 36, 1)[0];     // comes in along (-1, 0, -1)
    const double behind = t.missing<1, 0, -1>(1.0 / 36, -1)[0];  // comes in along (1, 0, -1)
    EXPECT_NEAR(behind - ahead, stress * (depth - 0.5) / (depth + 1), 1e-15);
    EXPECT_NEAR(behind + ahead, 0, 1e-18);  // no mass, no force across
    EXPECT_NEAR((t.missing<0, 0, 1>(1.0 / 18, 1)[0]), 0, 1e-18);
  }
}

TEST(SurfaceShear, RatioOfDepthsIsBoundedAtLargeTau) {
  const Symmetric<V> s{V(0), V(0), V(0), V(0), V(1), V(0)};
  const auto t = surface_traction<V>(s, {V(0), V(0), V(-1)}, V(1 / 20.0), {V(0), V(0), V(-1)}, V(-0.5), V(1));
  EXPECT_NEAR((t.missing<1, 0, -1>(1.0 / 36, -1)[0] - t.missing<1, 0, 1>(1.0 / 36, 1)[0]), -0.2, 1e-12);
}

TEST(SurfaceShear, FadesWithoutAPressureGradient) {
  const Symmetric<V> s{V(0), V(0), V(0), V(0), V(1), V(0)};
  const auto t = surface_traction<V>(s, {V(0), V(0), V(-1)}, V(1), {V(0), V(0), V(-1e-12)}, V(0), V(1));
  EXPECT_LT(std::abs((t.missing<1, 0, 1>(1.0 / 36, 1)[0])), 1e-10);
}

TEST(SurfaceShear, IsOffWhereViscosityIsTooSmallToCount) {
  SweepParameters p;
  p.tau = 0.5 + 1e-5;
  EXPECT_FALSE(feels_surface_shear(p));
  p.rheology.law = FlowLaw::bingham;
  EXPECT_TRUE(feels_surface_shear(p));
  p = {};
  p.tau = 0.51;
  EXPECT_TRUE(feels_surface_shear(p));
}

/// Discharge of a film of `height` cells over that of the Nusselt film; Newtonian, or Bingham below its yield stress
/// everywhere, which creeps as a Newtonian fluid of the limit viscosity.
template <class Real>
double film(double height, bool mud) {
  constexpr double viscosity = 1.0 / 6;
  FluidOptions o;
  o.domain.upper = Vec3(8, 8, std::ceil(height) + 6);
  o.domain.cell_size = o.time_step = o.density = 1;
  o.domain.faces.fill(FaceKind::periodic);
  o.domain.faces[4] = FaceKind::closed, o.domain.faces[5] = FaceKind::open;
  o.kinematic_viscosity = viscosity;
  o.gravity = Vec3(5e-5, 0, -1e-4);
  if (mud) {
    o.kinematic_viscosity = viscosity / 100;
    o.rheology = {.law = FlowLaw::bingham, .yield_stress = 1, .limit_viscosity = viscosity};
  }
  Fluid<Real> fluid(o);
  fluid.fill({{Vec3::Zero(), Vec3(8 - 1e-6, 8 - 1e-6, height)}});
  while (static_cast<double>(fluid.steps()) < 3 * height * height / viscosity) fluid.step();
  double flux = 0;
  fluid.for_each_wet_cell([&](const WetCell& c) { flux += c.liquid_volume * c.velocity.x() / 64; });
  return flux / (5e-5 * std::pow(height, 3) / (3 * viscosity));
}

/// 9 and 17 % off with a stress that vanishes half a link outside; 0.5 % is what the bottom leaves at 8 cells and tau
/// = 1.
TEST(SurfaceShear, FilmsBetweenWholeCells) {
  EXPECT_NEAR(film<double>(8.5, false), 1, 0.01);
  EXPECT_NEAR(film<double>(8.1, false), 1, 0.01);
  EXPECT_NEAR(film<float>(8.5, false), 1, 0.01);
  EXPECT_NEAR(film<float>(8.3, true), 1, 0.01);
}

}  // namespace
}  // namespace lahar::lbm
