#include "dem/numbering.h"

#include <gtest/gtest.h>

#include "dem/particles.h"

namespace lahar::dem {
namespace {

TEST(Renumbering, MovesNumbersAndUndoesItself) {
  const Renumbering change({2, 0, 3, 1});
  std::vector<int> values{10, 11, 12, 13};
  change.move(values);
  EXPECT_EQ(values, (std::vector<int>{12, 10, 13, 11}));
  for (ParticleIndex i = 0; i < 4; ++i) EXPECT_EQ(change.to(change.from(i)), i);
  change.inverse().move(values);
  EXPECT_EQ(values, (std::vector<int>{10, 11, 12, 13}));
}

TEST(Renumbering, LeavesOutWhatIsNotListedYet) {
  std::vector<int> none, short_list{10, 11};
  const Renumbering change({2, 1, 0});
  change.move(none);
  change.move(short_list, -1);
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(short_list, (std::vector<int>{-1, 11, 10}));
}

TEST(Renumbering, MovesRows) {
  std::vector<std::uint32_t> offset{0, 2, 2, 5}, partner{10, 11, 12, 13, 14};
  reorder(partner, Renumbering({2, 0, 1}).move_rows(offset));
  EXPECT_EQ(offset, (std::vector<std::uint32_t>{0, 3, 5, 5}));
  EXPECT_EQ(partner, (std::vector<std::uint32_t>{12, 13, 14, 10, 11}));
  std::vector<std::uint32_t> two_rows{0, 1, 3};
  EXPECT_EQ(Renumbering({2, 1, 0}).move_rows(two_rows), (std::vector<std::uint32_t>{1, 2, 0}));
  EXPECT_EQ(two_rows, (std::vector<std::uint32_t>{0, 0, 2, 3}));
}

TEST(Renumbering, RefusesWhatIsNoOrder) {
  EXPECT_THROW(Renumbering({0, 0, 1}), std::logic_error);
  EXPECT_THROW(Renumbering({0, 3, 1}), std::logic_error);
}

TEST(Numbering, KeepsIdsThroughChangesAndNewParticles) {
  Particles p;
  for (int n = 0; n < 4; ++n) EXPECT_EQ(p.add({.radius = 1.0 + n, .density = 1}), static_cast<ParticleId>(n));
  EXPECT_TRUE(p.numbering.by_id());
  p.renumber(Renumbering({3, 1, 0, 2}));
  EXPECT_EQ(p.add({.radius = 5, .density = 1}), 4U);
  p.renumber(Renumbering({4, 2, 0, 1, 3}));
  EXPECT_FALSE(p.numbering.by_id());
  for (ParticleId id = 0; id < p.size(); ++id) {
    EXPECT_EQ(p.id(p.index(id)), id);
    EXPECT_EQ(p.radius[p.index(id)], 1.0 + id);
  }
  EXPECT_TRUE(p.numbering.precedes(p.index(1), p.index(3)));
  EXPECT_FALSE(p.numbering.precedes(p.index(3), p.index(1)));
  p.renumber(p.numbering.to_ids(p.size()));
  EXPECT_TRUE(p.numbering.by_id());
  EXPECT_EQ(p.radius, (std::vector<double>{1, 2, 3, 4, 5}));
}

}  // namespace
}  // namespace lahar::dem
