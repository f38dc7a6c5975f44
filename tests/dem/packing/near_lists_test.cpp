#include "dem/packing/near_lists.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/parallel.h"

namespace lahar::dem {
namespace {

struct Cloud {
  std::vector<double> radius;
  Vec3Field position;
};

/// 400 spheres in a box of 0.4 x 0.3 m, radii from 0.01 m up by `ratio`.
Cloud cloud(double ratio) {
  std::mt19937_64 generator(5);
  const auto random = [&] { return static_cast<double>(generator() >> 11) * 0x1.0p-53; };
  Cloud c;
  for (int k = 0; k < 400; ++k) {
    const double x = 0.4 * random(), y = 0.3 * random(), z = 0.2 * random() - 0.1;
    c.position.push_back({x, y, z});
    c.radius.push_back(k % 7 ? 0.01 : 0.01 * ratio);
  }
  return c;
}

bool lists_all(const NearLists& lists, const Cloud& c, double skin) {
  for (std::uint32_t i = 0; i < c.radius.size(); ++i) {
    std::vector<std::uint32_t> found(lists.of(i).begin(), lists.of(i).end()), near;
    std::sort(found.begin(), found.end());
    for (std::uint32_t j = 0; j < c.radius.size(); ++j)
      if (j != i && (c.position[i] - c.position[j]).norm() < c.radius[i] + c.radius[j] + skin) near.push_back(j);
    if (found != near) return false;
  }
  return true;
}

class NearListsOfSizes : public testing::TestWithParam<double> {};

TEST_P(NearListsOfSizes, HoldWhatComparingAllPairsFinds) {
  const Cloud c = cloud(GetParam());
  NearLists lists(0.4, 0.3, c.radius, 0.004);
  lists.list(c.position);
  EXPECT_TRUE(lists_all(lists, c, 0.004));
  std::size_t entries = 0;
  for (std::size_t i = 0; i < 400; ++i) entries += lists.of(i).size();
  EXPECT_GT(entries, 100u);
}

TEST_P(NearListsOfSizes, AreMadeAgainWhenASphereHasMoved) {
  Cloud c = cloud(GetParam());
  NearLists lists(0.4, 0.3, c.radius, 0.004);
  lists.list(c.position);
  c.position.set(0, c.position[350] + Vec3(0.015, 0, 0));
  lists.update(c.position);
  EXPECT_TRUE(lists_all(lists, c, 0.004));
  EXPECT_FALSE(lists.of(0).empty());
}

TEST_P(NearListsOfSizes, DoNotDependOnTheThreads) {
  const Cloud c = cloud(GetParam());
  const auto entries = [&](int threads) {
    const ThreadLimit limit(threads);
    NearLists lists(0.4, 0.3, c.radius, 0.004);
    lists.list(c.position);
    std::vector<std::uint32_t> all;
    for (std::size_t i = 0; i < 400; ++i) all.insert(all.end(), lists.of(i).begin(), lists.of(i).end());
    return all;
  };
  EXPECT_EQ(entries(1), entries(2));
}

INSTANTIATE_TEST_SUITE_P(Ratios, NearListsOfSizes, testing::Values(1.0, 2.5, 8.0));

}  // namespace
}  // namespace lahar::dem
