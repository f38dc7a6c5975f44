#include "dem/contact_detection.h"

#include <gtest/gtest.h>

#include "tests/dem/small_scenes.h"

namespace lahar::dem {
namespace {

ContactHistory mark(double value) { return {{value, 2 * value, 3 * value}, 10 * value}; }

TEST(ContactDetection, histories_survive_a_rebuild_with_other_neighbours) {
  Particles p;
  p.add(testing::sphere({0, 0, 0.02}, 0.02, 1000));
  p.add(testing::sphere({0.04, 0, 0.02}, 0.02, 1000));
  p.add(testing::sphere({0, 0.2, 0.02}, 0.02, 1000));
  ContactDetection contacts;
  const Walls walls = testing::ground();
  contacts.rebuild(p, walls, {});
  ASSERT_EQ(contacts.pairs().size(), 1u);
  ASSERT_EQ(contacts.wall_contacts().size(), 3u);
  contacts.restore({{0, 1, false, mark(1)}, {0, 0, true, mark(2)}});

  p.position.set(2, {0.02, 0.035, 0.02});  // now near both
  contacts.rebuild(p, walls, {});
  EXPECT_EQ(contacts.pairs().size(), 3u);
  const auto stored = contacts.stored_contacts();
  ASSERT_EQ(stored.size(), 2u);
  EXPECT_EQ(stored[0].particle, 0u);
  EXPECT_EQ(stored[0].partner, 1u);
  EXPECT_EQ(stored[0].history.tangential_displacement.y, 2);
  EXPECT_TRUE(stored[1].with_wall);
  EXPECT_EQ(stored[1].history.tangential_stiffness, 20);
}

TEST(ContactDetection, restoring_a_contact_between_strangers_is_refused) {
  Particles p;
  p.add(testing::sphere({0, 0, 0}, 0.02, 1000));
  p.add(testing::sphere({1, 0, 0}, 0.02, 1000));
  ContactDetection contacts;
  contacts.rebuild(p, {}, {});
  EXPECT_THROW(contacts.restore({{0, 1, false, mark(1)}}), std::logic_error);
}

TEST(ContactDetection, partners_list_every_slot_once_in_ascending_order) {
  const Particles p = testing::random_cloud(20, 0.04, 300, 0.004, {0.3, 0.3, 0.3}, 1, 11);
  ContactDetection contacts;
  contacts.rebuild(p, {}, {});
  std::size_t seen = 0;
  for (std::size_t j = 0; j < p.size(); ++j)
    for (auto n = contacts.partner_offset()[j]; n < contacts.partner_offset()[j + 1]; ++n, ++seen) {
      EXPECT_EQ(contacts.pairs().partner[contacts.slot_of_partner()[n]], j);
      if (n > contacts.partner_offset()[j]) {
        EXPECT_LT(contacts.slot_of_partner()[n - 1], contacts.slot_of_partner()[n]);
      }
    }
  EXPECT_EQ(seen, contacts.pairs().size());
  EXPECT_GT(seen, 100u);
}

TEST(ContactDetection, lists_walls_within_reach_only) {
  Particles p;
  p.add(testing::sphere({0.021, 0.5, 0.021}, 0.02, 1000));
  p.add(testing::sphere({0.5, 0.5, 0.5}, 0.02, 1000));
  ContactDetection contacts;
  contacts.rebuild(p, testing::open_box({1, 1, 1}), {});
  EXPECT_EQ(contacts.wall_contacts().partner, (std::vector<std::uint32_t>{0, 1}));  // floor and left
  EXPECT_EQ(contacts.wall_contacts().offset, (std::vector<std::uint32_t>{0, 2, 2}));
}

}  // namespace
}  // namespace lahar::dem
