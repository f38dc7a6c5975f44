#include "lbm/free_surface/lacking_liquid.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "core/simd.h"

namespace lahar::lbm {
namespace {

using V = Row<double>;

/// Momentum of the link along i between cells with the given densities and velocities; the body's velocity is u.
std::array<double, 3> over_link(EquilibriumOrder order, int i, const Vec3& u, double drho_here, const Vec3& here,
                                double drho_there, const Vec3& there, double drho_at_link) {
  const int opposite = i % 2 == 1 ? i + 1 : i - 1;
  BodyLinks<V> links(order, {V(u.x()), V(u.y()), V(u.z())});
  links.add(i, V::mask_type::from_bits(1), V(equilibrium(order, i, drho_here, here.x(), here.y(), here.z())),
            V(equilibrium(order, opposite, drho_there, there.x(), there.y(), there.z())), V(drho_at_link));
  for (int a = 0; a < 3; ++a) EXPECT_EQ(links.momentum(a)[1], 0);  // not linked
  return {links.momentum(0)[0], links.momentum(1)[0], links.momentum(2)[0]};
}

/// Liquid that goes along with the body, at the pressure that the surface sets, gives it nothing but that pressure.
TEST(BodyLinks, NothingPastLiquidThatGoesAlong) {
  const Vec3 u(0.1, -0.07, 0.04);
  for (const auto order : {EquilibriumOrder::second, EquilibriumOrder::fourth})
    for (int i = 1; i < D3Q19::q; ++i)
      for (const double m : over_link(order, i, u, 0.01, u, 0.01, u, 0.01)) EXPECT_NEAR(m, 0, 1e-16);
}

/// The cell is faster than the body by w: 3 w_i c_i (c_i . w), as from a wall (Ladd 1994).
TEST(BodyLinks, MomentumOfLiquidPastTheBody) {
  const Vec3 past(1e-4, 2e-4, -3e-4);
  for (int i = 1; i < D3Q19::q; ++i) {
    const auto m = over_link(EquilibriumOrder::fourth, i, Vec3::Zero(), 0, past, 0, Vec3::Zero(), 0);
    const Vec3 c(D3Q19::c[i][0], D3Q19::c[i][1], D3Q19::c[i][2]);
    const Vec3 expected = 3 * D3Q19::w(i) * c.dot(past) * c;
    for (int a = 0; a < 3; ++a) EXPECT_NEAR(m[static_cast<std::size_t>(a)], expected[a], 1e-7);
  }
}

/// Only cells that bodies exchange with need the fields; what stood there is gone.
TEST(LackingLiquid, BeginsWhereBodiesAreAtTheSurface) {
  auto surface = std::make_unique<SurfaceFields<double>>();
  auto body = std::make_unique<BodyFields<double>>();
  Block<double> block;
  block.body = body.get();
  body->exchange_weight[77] = 0.5, body->lacking_y[9] = 3, body->lacks = true;
  begin_lacking(block);
  EXPECT_FALSE(body->lacks);  // no surface
  block.surface = surface.get();
  surface->count = 1, surface->cells[0] = 9;
  begin_lacking(block);
  EXPECT_FALSE(body->lacks);  // not where the body is
  surface->count = 2, surface->cells[1] = 77;
  begin_lacking(block);
  EXPECT_TRUE(body->lacks);
  EXPECT_EQ(body->lacking_y[9], 0);
}

}  // namespace
}  // namespace lahar::lbm
