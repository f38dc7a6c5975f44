#include "cases/files/image.h"

#include <gtest/gtest.h>

namespace lahar::cases {
namespace {

TEST(Image, HoldsEveryPixelAtItsPlace) {
  Image image(3, 2, Colour(0.25F, 0.5F, 0.75F));
  EXPECT_EQ(image.width(), 3);
  EXPECT_EQ(image.height(), 2);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) {
      EXPECT_EQ(image.at(x, y), Colour(0.25F, 0.5F, 0.75F));
      image.at(x, y) = Colour(static_cast<float>(x), static_cast<float>(y), 0);
    }
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x) EXPECT_EQ(image.at(x, y), Colour(static_cast<float>(x), static_cast<float>(y), 0));
}

TEST(Image, BlendsByOpacityAndOnlyInside) {
  Image image(2, 2, Colour::Zero());
  image.blend(1, 0, Colour(1, 0.5F, 0), 0.25F);
  EXPECT_EQ(image.at(1, 0), Colour(0.25F, 0.125F, 0));
  image.blend(0, 1, Colour(1, 0.5F, 0.25F), 3);  // no more than opaque
  EXPECT_EQ(image.at(0, 1), Colour(1, 0.5F, 0.25F));
  for (const auto& [x, y] : {std::pair{-1, 0}, {0, -1}, {2, 0}, {0, 2}}) {
    EXPECT_FALSE(image.contains(x, y));
    image.blend(x, y, Colour::Ones(), 1);
  }
  EXPECT_EQ(image.at(0, 0), Colour(0, 0, 0));
  EXPECT_EQ(image.at(1, 1), Colour(0, 0, 0));
}

}  // namespace
}  // namespace lahar::cases
