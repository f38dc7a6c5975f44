#include "dem/contact/active_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "tests/dem/small_scenes.h"

namespace lahar::dem {
namespace {

std::size_t chunks_of(const Particles& p) { return (p.size() + kContactChunk - 1) / kContactChunk; }

ActiveContacts found(const Particles& p, const ContactDetection& contacts) {
  ActiveContacts active;
  active.note_slots(contacts);
  for (std::size_t c = 0; c < chunks_of(p); ++c) active.find_slots(p, contacts, c);
  for (std::size_t c = 0; c < chunks_of(p); ++c) active.find_places(contacts, c);
  return active;
}

TEST(ActiveContacts, AreThoseThatTouchOrDidInTheStepBefore) {
  Particles p;
  p.add(testing::sphere({0, 0, 0}, 0.02, 1000));
  p.add(testing::sphere({0.0401, 0, 0}, 0.02, 1000));
  ContactDetection contacts;
  contacts.rebuild(p, {}, {});
  ASSERT_EQ(contacts.pairs().size(), 1U);
  EXPECT_TRUE(found(p, contacts).slots(0).empty());
  EXPECT_TRUE(found(p, contacts).places(0).empty());

  p.position.set(1, {0.0399, 0, 0});
  EXPECT_EQ(found(p, contacts).slots(0).size(), 1U);
  EXPECT_EQ(found(p, contacts).places(0).size(), 2U);

  p.position.set(1, {0.0401, 0, 0});
  contacts.pairs().touching[0] = 1;
  EXPECT_EQ(found(p, contacts).slots(0).size(), 1U);
}

/// Against all slots one by one, over several chunks, with some that touched before.
TEST(ActiveContacts, AreFoundAmongManySlots) {
  Particles p = testing::random_cloud(40, 0.04, 1200, 0.004, {0.3, 0.3, 0.3}, 1, 11);
  ContactDetection contacts(NeighbourOptions{2, 0});
  contacts.rebuild(p, {}, {});
  for (double& r : p.radius) r *= 0.7;  // most of what is listed is then apart
  ContactSlots& slots = contacts.pairs();
  const ContactParties& t = contacts.parties();
  for (std::size_t k = 0; k < slots.size(); k += 7) slots.touching[k] = 1;
  std::set<std::uint32_t> expected;
  for (std::uint32_t k = 0; k < slots.size(); ++k) {
    const std::uint32_t i = slots.owner[k], j = slots.partner[k];
    const bool touch = (p.position[i] - p.position[j]).norm() < p.radius[i] + p.radius[j];
    if (touch || slots.touching[k] != 0) expected.insert(k);
  }
  ASSERT_GT(expected.size(), slots.size() / 7 + 20);
  ASSERT_LT(expected.size(), slots.size() * 3 / 4);

  const ActiveContacts active = found(p, contacts);
  std::vector<std::uint32_t> of_owners, of_partners;
  for (std::size_t c = 0; c < chunks_of(p); ++c) {
    std::set<std::uint32_t> places;
    for (const std::uint32_t k : active.slots(c)) {
      EXPECT_EQ(slots.owner[k] / kContactChunk, c);
      of_owners.push_back(k), places.insert(t.owner[k]);
    }
    for (const ActiveContacts::Partner& n : active.as_partner(c)) {
      const std::uint32_t k = active.slot(n.number);
      EXPECT_EQ(slots.partner[k] / kContactChunk, c);
      of_partners.push_back(k), places.insert(n.place);
    }
    EXPECT_TRUE(std::ranges::equal(active.places(c), places));
  }
  EXPECT_TRUE(std::ranges::equal(of_owners, expected));  // in the order of slots
  std::sort(of_partners.begin(), of_partners.end());
  EXPECT_TRUE(std::ranges::equal(of_partners, expected));
}

/// A wider list has more slots, but none more that is active.
TEST(ActiveContacts, ForcesDoNotDependOnWhatElseIsListed) {
  const Materials stone = testing::one_material(1e7, 0.25, 0.5, 0.5);
  const Particles p = testing::loose_grains(4, 4, 4, 0.02, 0.04, 2);
  const auto after = [&](double skin) {
    SolidsOptions o = testing::options(2e-5, {0, 0, -9.81});
    o.neighbours.relative_skin = skin;
    Solids solids(p, {}, stone, testing::open_box({0.33, 0.33, 1}), o);
    for (int n = 0; n < 8000; ++n) solids.step();
    return solids.particles();
  };
  const Particles few = after(0.01), many = after(0.8);
  EXPECT_EQ(few.position.x, many.position.x);
  EXPECT_EQ(few.position.z, many.position.z);
  EXPECT_EQ(few.torque.y, many.torque.y);
}

}  // namespace
}  // namespace lahar::dem
