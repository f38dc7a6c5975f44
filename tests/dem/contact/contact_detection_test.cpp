#include "dem/contact/contact_detection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

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
  contacts.restore(p, {{0, 1, false, mark(1)}, {0, 0, true, mark(2)}});

  p.position.set(2, {0.02, 0.0347, 0.02});  // now near both
  contacts.rebuild(p, walls, {});
  EXPECT_EQ(contacts.pairs().size(), 3u);
  const auto stored = contacts.stored_contacts(p);
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
  EXPECT_THROW(contacts.restore(p, {{0, 1, false, mark(1)}}), std::logic_error);
}

TEST(ContactDetection, every_slot_is_listed_once_with_the_chunk_of_its_partner) {
  const Particles p = testing::random_cloud(20, 0.04, 600, 0.004, {0.3, 0.3, 0.3}, 1, 11);
  ContactDetection contacts(NeighbourOptions{2, 0});
  contacts.rebuild(p, {}, {});
  const ContactParties& t = contacts.parties();
  const ContactSlots& slots = contacts.pairs();
  const std::size_t chunks = (p.size() + kContactChunk - 1) / kContactChunk;
  ASSERT_EQ(t.first_partner.size(), chunks + 1);
  ASSERT_EQ(t.first_place.size(), chunks + 1);
  EXPECT_EQ(t.first_place[chunks], t.particle.size());
  std::vector<int> seen(slots.size(), 0);
  for (std::size_t c = 0; c < chunks; ++c) {
    for (auto place = t.first_place[c]; place < t.first_place[c + 1]; ++place)
      EXPECT_EQ(t.particle[place] / kContactChunk, c);
    for (auto n = t.first_partner[c]; n < t.first_partner[c + 1]; ++n) {
      const auto [slot, place] = t.as_partner[n];
      ++seen[slot];
      EXPECT_EQ(place, t.partner[slot]);
      EXPECT_EQ(slots.partner[slot], t.particle[place]);
      EXPECT_EQ(slots.owner[slot], t.particle[t.owner[slot]]);
      EXPECT_EQ(slots.partner[slot] / kContactChunk, c);
      if (n > t.first_partner[c]) {
        EXPECT_LT(t.as_partner[n - 1].slot, slot);
      }
    }
  }
  EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int times) { return times == 1; }));
  EXPECT_GT(seen.size(), 200u);
}

TEST(ContactDetection, slots_hold_every_pair_within_the_narrow_skin_while_they_last) {
  Particles p = testing::random_cloud(100, 0.03, 300, 0.01, {0.5, 0.5, 0.5}, 1, 12);
  ContactDetection contacts;
  contacts.rebuild(p, {}, {});
  std::size_t touching = 0;
  for (int step = 0; step < 400; ++step) {
    for (std::size_t i = 0; i < p.size(); ++i) p.position.add(i, 2e-5 * p.velocity[i]);
    if (contacts.outdated(p)) contacts.neighbours_hold(p) ? contacts.refresh(p) : contacts.rebuild(p, {}, {});
    if (step % 20 != 0) continue;
    std::set<std::pair<std::uint32_t, std::uint32_t>> listed;
    for (std::size_t k = 0; k < contacts.pairs().size(); ++k)
      listed.insert(std::minmax(contacts.pairs().owner[k], contacts.pairs().partner[k]));
    for (std::uint32_t i = 0; i < p.size(); ++i)
      for (std::uint32_t j = i + 1; j < p.size(); ++j)
        if ((p.position[i] - p.position[j]).norm() < p.radius[i] + p.radius[j]) {
          ++touching;
          EXPECT_TRUE(listed.contains({i, j})) << i << ' ' << j << " in step " << step;
        }
  }
  EXPECT_GT(touching, 1000u);
  EXPECT_GT(contacts.refreshes(), contacts.neighbours().builds() + 5);
}

/// Two spheres alone head on, at many speeds and from many gaps: they may never overlap without being listed.
TEST(ContactDetection, pairs_that_were_far_when_the_neighbour_list_was_built_are_listed_in_time) {
  int touched = 0;
  for (const double speed : {0.5, 1.0, 2.0, 4.0, 8.0})
    for (int n = 0; n < 40; ++n) {
      Particles p;
      p.add(testing::sphere({0, 0, 0}, 0.02, 2650, {speed, 0, 0}));
      p.add(testing::sphere({0.04 + 2e-4 * n, 0, 0}, 0.02, 2650, {-speed, 0, 0}));
      ContactDetection contacts;
      contacts.rebuild(p, {}, {});
      while (p.position.x[1] - p.position.x[0] > 0.038) {
        for (std::size_t i = 0; i < 2; ++i) p.position.add(i, 1.37e-5 * p.velocity[i]);
        if (contacts.outdated(p)) contacts.neighbours_hold(p) ? contacts.refresh(p) : contacts.rebuild(p, {}, {});
        if (p.position.x[1] - p.position.x[0] >= 0.04) continue;
        ++touched;
        ASSERT_EQ(contacts.pairs().size(), 1u) << speed << " m/s from " << 2e-4 * n << " m";
      }
    }
  EXPECT_GT(touched, 1000);
}

TEST(ContactDetection, a_contact_that_parts_at_once_stays_listed_until_its_end_was_seen) {
  Particles p;
  p.add(testing::sphere({0, 0, 0}, 0.02, 1000));
  p.add(testing::sphere({0.0399, 0, 0}, 0.02, 1000));
  ContactDetection contacts;
  contacts.rebuild(p, {}, {});
  contacts.restore(p, {{0, 1, false, mark(1)}});
  p.position.set(1, {0.0415, 0, 0});  // beyond the narrow skin, within the wide one
  contacts.refresh(p);
  ASSERT_EQ(contacts.pairs().size(), 1u);
  EXPECT_EQ(contacts.pairs().touching[0], 1);
  contacts.pairs().touching[0] = 0;
  contacts.refresh(p);
  EXPECT_EQ(contacts.pairs().size(), 0u);
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
