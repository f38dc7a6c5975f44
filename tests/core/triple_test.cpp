#include "core/triple.h"

#include <gtest/gtest.h>

#include "core/simd.h"
#include "core/vector.h"

namespace lahar {
namespace {

Vec3 vec(const Triple& t) { return {t.x, t.y, t.z}; }

TEST(Triple, agrees_with_Vec3) {
  const Triple a{1.5, -2, 0.25}, b{-3, 0.5, 4}, n{0.6, 0, 0.8};
  EXPECT_EQ(vec(a + b), vec(a) + vec(b));
  EXPECT_EQ(vec(a - b), vec(a) - vec(b));
  EXPECT_EQ(vec(2.0 * a), 2 * vec(a));
  EXPECT_EQ(dot(a, b), vec(a).dot(vec(b)));
  EXPECT_EQ(vec(cross(a, b)), vec(a).cross(vec(b)));
  EXPECT_DOUBLE_EQ(length(a), vec(a).norm());
  EXPECT_NEAR(dot(normal_part(a, n), n), 0, 1e-15);
}

/// Bit by bit, with numbers that round: contracted alike.
TEST(Triple, of_packs_agrees_with_that_of_numbers) {
  const Triple a{1.1, -2.3, 0.7}, b{-3.3, 0.13, 4.7};
  using P = Row<double>;
  const TripleOf<P> p{P(a.x), P(a.y), P(a.z)}, q{P(b.x), P(b.y), P(b.z)};
  EXPECT_EQ(dot(p, q)[5], dot(a, b));
  EXPECT_EQ(cross(p, q).x[5], cross(a, b).x);
  EXPECT_EQ(cross(p, q).y[5], cross(a, b).y);
  EXPECT_EQ(cross(p, q).z[5], cross(a, b).z);
  EXPECT_EQ((0.5 * p).z[0], 0.35);
}

}  // namespace
}  // namespace lahar
