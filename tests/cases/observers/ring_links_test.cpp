// Rings that have gone through each other.
#include "cases/observers/ring_links.h"

#include "tests/cases/observers/small_net.h"

namespace lahar::cases {
namespace {

using RingLinksOfNet = SmallNet;

TEST_F(RingLinksOfNet, ALostLinkIsToldOf) {
  EXPECT_TRUE(run_.observers.warnings().empty());
  ASSERT_EQ(run_.observers.checks().size(), 1u);
  EXPECT_TRUE(run_.observers.checks()[0].pass);
  dem::Particles& p = run_.solids().particles();
  const auto ring = p.body[p.size() / 2];
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.body[i] == ring) p.position.x[i] += 10;
  ASSERT_EQ(run_.observers.warnings().size(), 1u);
  EXPECT_FALSE(run_.observers.checks()[0].pass);
}

}  // namespace
}  // namespace lahar::cases
