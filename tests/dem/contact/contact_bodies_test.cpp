#include "dem/contact/contact_bodies.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "tests/dem/small_scenes.h"

namespace lahar::dem {
namespace {

/// Three places whose particles lie seven apart are no eight side by side.
TEST(ContactBodies, SomePlacesArePackedAsAllAre) {
  const Particles p = testing::random_cloud(9, 0.04, 0, 0.01, {0.3, 0.3, 0.3}, 1, 5);
  const std::vector<double> damping{1, 2, 3, 4, 5, 6, 7, 8, 9};
  ContactParties parties;
  parties.particle.resize(9);
  std::iota(parties.particle.begin(), parties.particle.end(), 0U);
  std::vector<std::uint32_t> every(9);
  std::iota(every.begin(), every.end(), 0U);
  const std::vector<std::uint32_t> some{0, 3, 7};

  ContactBodies all, few;
  all.make_room(p, parties);
  all.pack(p, parties, every, damping, 1e-4);
  few.make_room(p, parties);
  few.pack(p, parties, some, damping, 1e-4);
  for (const std::uint32_t place : some)
    for (std::size_t n = 0; n < 3 * kRow; ++n)
      EXPECT_EQ(few.data()[ContactBodies::kStride * place + n], all.data()[ContactBodies::kStride * place + n]);
}

}  // namespace
}  // namespace lahar::dem
