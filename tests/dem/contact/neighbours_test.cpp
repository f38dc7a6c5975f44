#include "dem/contact/neighbours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/parallel.h"
#include "tests/dem/small_scenes.h"

namespace lahar::dem {
namespace {

using Pair = std::pair<ParticleIndex, ParticleIndex>;

std::vector<Pair> listed_pairs(const NeighbourList& list) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i + 1 < list.offset().size(); ++i)
    for (auto k = list.offset()[i]; k < list.offset()[i + 1]; ++k)
      pairs.emplace_back(static_cast<ParticleIndex>(i), list.neighbour()[k]);
  return pairs;
}

/// Unordered pairs that are nearer than the mean of their skins.
std::set<Pair> brute_force(const Particles& p, const NeighbourList& list) {
  std::set<Pair> pairs;
  for (ParticleIndex i = 0; i < p.size(); ++i)
    for (ParticleIndex j = i + 1; j < p.size(); ++j) {
      const double reach = p.radius[i] + p.radius[j] + 0.5 * (list.skin(p, i) + list.skin(p, j));
      const bool gone = p.state[i] == ParticleState::removed || p.state[j] == ParticleState::removed;
      if (!gone && (p.position[i] - p.position[j]).norm() < reach) pairs.insert({i, j});
    }
  return pairs;
}

std::set<Pair> unordered(const std::vector<Pair>& pairs) {
  std::set<Pair> set;
  for (const auto& [i, j] : pairs) set.insert(std::minmax(i, j));
  return set;
}

/// Boulders and ring beads together: size ratio 13.
Particles bidisperse() { return testing::random_cloud(40, 0.04, 2500, 0.00305, {0.5, 0.4, 0.3}, 1, 3); }

TEST(NeighbourList, equals_brute_force_at_size_ratio_13) {
  Particles p = bidisperse();
  p.remove(17);
  p.remove(200);
  NeighbourList list;
  list.build(p, {});
  const auto pairs = listed_pairs(list);
  const auto expected = brute_force(p, list);
  EXPECT_GT(expected.size(), 500u);
  EXPECT_EQ(pairs.size(), expected.size());  // each pair once
  EXPECT_EQ(unordered(pairs), expected);
}

TEST(NeighbourList, equals_brute_force_across_zero_and_for_a_wide_range_of_sizes) {
  Particles p;
  std::mt19937 random(5);
  const auto u = [&] { return static_cast<double>(random()) / 4294967296.0; };
  for (int n = 0; n < 600; ++n)
    p.add(testing::sphere({2 * u() - 1, 2 * u() - 1, 2 * u() - 1}, 0.002 * std::pow(50, u()), 1000));
  NeighbourList list({0.1, 0.01});
  list.build(p, {});
  EXPECT_EQ(unordered(listed_pairs(list)), brute_force(p, list));
}

TEST(NeighbourList, rows_ascend_and_do_not_depend_on_threads) {
  const Particles p = bidisperse();
  NeighbourList one, two;
  {
    const ThreadLimit limit(1);
    one.build(p, {});
  }
  {
    const ThreadLimit limit(2);
    two.build(p, {});
  }
  EXPECT_EQ(one.neighbour(), two.neighbour());
  EXPECT_EQ(one.offset(), two.offset());
  const auto pairs = listed_pairs(one);
  EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
}

TEST(NeighbourList, leaves_out_bonded_and_fixed_pairs) {
  Particles p;
  for (int n = 0; n < 4; ++n) {
    auto s = testing::sphere({0.01 * n, 0, 0}, 0.02, 1000);
    if (n >= 2) s.state = ParticleState::fixed;
    p.add(s);
  }
  PairSet bonded;
  bonded.assign(4, {0, 0}, {1, 2}, {1, 0});  // the bond 0-2 is broken
  NeighbourList list;
  list.build(p, bonded);
  EXPECT_EQ(unordered(listed_pairs(list)), (std::set<Pair>{{0, 2}, {0, 3}, {1, 2}, {1, 3}}));
}

TEST(NeighbourList, is_outdated_once_a_particle_has_moved_half_its_skin) {
  Particles p = bidisperse();
  NeighbourList list({0.2, 0});
  EXPECT_TRUE(list.outdated(p));
  list.build(p, {});
  EXPECT_FALSE(list.outdated(p));
  const double half_skin = 0.1 * p.radius[1000];
  p.position.y[1000] += 0.99 * half_skin;
  EXPECT_FALSE(list.outdated(p));
  p.position.y[1000] += 0.02 * half_skin;
  EXPECT_TRUE(list.outdated(p));
  list.build(p, {});
  p.position.x[0] = std::nan("");
  EXPECT_TRUE(list.outdated(p));
}

TEST(NeighbourList, skin_is_at_least_the_minimum) {
  Particles p;
  p.add(testing::sphere(Vec3::Zero(), 0.04, 1000));
  p.add(testing::sphere(Vec3::Zero(), 0.003, 1000));
  const NeighbourList list({0.25, 0.002});
  EXPECT_DOUBLE_EQ(list.skin(p, 0), 0.01);
  EXPECT_DOUBLE_EQ(list.skin(p, 1), 0.002);
}

TEST(PairSet, knows_pairs_both_ways) {
  PairSet set;
  set.assign(5, {0, 3, 3}, {1, 4, 0}, {1, 1, 1});
  EXPECT_TRUE(set.contains(0, 1) && set.contains(1, 0) && set.contains(4, 3) && set.contains(0, 3));
  EXPECT_FALSE(set.contains(1, 3) || set.contains(2, 0) || set.contains(9, 0));
}

}  // namespace
}  // namespace lahar::dem
