// Rings that have gone through each other.
#include "cases/observers/ring_links.h"

#include "tests/cases/observers/small_net.h"

namespace lahar::cases {
namespace {

using RingLinksOfNet = SmallNet;

TEST_F(RingLinksOfNet, ALostLinkIsToldOf) {
  EXPECT_TRUE(observers_.warnings().empty());
  ASSERT_EQ(observers_.checks().size(), 1u);
  EXPECT_TRUE(observers_.checks()[0].pass);
  dem::Particles& p = simulation_->solids()->particles();
  const auto ring = p.body[p.size() / 2];
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.body[i] == ring) p.position.x[i] += 10;
  ASSERT_EQ(observers_.warnings().size(), 1u);
  EXPECT_FALSE(observers_.checks()[0].pass);
}

}  // namespace
}  // namespace lahar::cases
