#include "lbm/grid/velocity_set.h"

#include <gtest/gtest.h>

namespace lahar::lbm {
namespace {

TEST(VelocitySet, PairsAreOpposite) {
  for (int i = 1; i < D3Q19::q; ++i) {
    const int o = D3Q19::opposite(i);
    EXPECT_NE(o, i);
    EXPECT_EQ(D3Q19::opposite(o), i);
    for (int a = 0; a < 3; ++a) EXPECT_EQ(D3Q19::c[o][a], -D3Q19::c[i][a]);
  }
}

TEST(VelocitySet, AllVelocitiesDiffer) {
  for (int i = 0; i < D3Q19::q; ++i)
    for (int j = 0; j < i; ++j) {
      const bool same =
          D3Q19::c[i][0] == D3Q19::c[j][0] && D3Q19::c[i][1] == D3Q19::c[j][1] && D3Q19::c[i][2] == D3Q19::c[j][2];
      EXPECT_FALSE(same) << i << " " << j;
    }
}

/// Isotropy up to fourth order: what the Navier-Stokes equations need (Qian et al. 1992).
TEST(VelocitySet, MomentsAreIsotropic) {
  const auto delta = [](int a, int b) { return a == b ? 1.0 : 0.0; };
  double zeroth = 0;
  for (int i = 0; i < D3Q19::q; ++i) zeroth += D3Q19::w(i);
  EXPECT_NEAR(zeroth, 1, 1e-15);
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      double second = 0;
      for (int i = 0; i < D3Q19::q; ++i) second += D3Q19::w(i) * D3Q19::c[i][a] * D3Q19::c[i][b];
      EXPECT_NEAR(second, D3Q19::cs2 * delta(a, b), 1e-15);
      for (int c = 0; c < 3; ++c)
        for (int d = 0; d < 3; ++d) {
          double fourth = 0;
          for (int i = 0; i < D3Q19::q; ++i)
            fourth += D3Q19::w(i) * D3Q19::c[i][a] * D3Q19::c[i][b] * D3Q19::c[i][c] * D3Q19::c[i][d];
          const double exact = D3Q19::cs2 * D3Q19::cs2 *
                               (delta(a, b) * delta(c, d) + delta(a, c) * delta(b, d) + delta(a, d) * delta(b, c));
          EXPECT_NEAR(fourth, exact, 1e-15);
        }
    }
}

}  // namespace
}  // namespace lahar::lbm
