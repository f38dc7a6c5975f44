#include "cases/pictures/colour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace lahar::cases {

namespace {

constexpr std::array<std::uint32_t, 5> kStone{0x4d4a4a, 0x6f645c, 0x94806b, 0xb99f7e, 0xd9c8a9};
constexpr std::array<std::uint32_t, 6> kSpeed{0x2b2f6b, 0x2a5f9e, 0x219a9c, 0x5cc27a, 0xc9da4f, 0xfcef6b};
constexpr std::array<std::uint32_t, 5> kTension{0x8d959e, 0xd9b44a, 0xee8a2a, 0xdc4a25, 0xa5121f};

std::span<const std::uint32_t> anchors(ColourRamp ramp) {
  if (ramp == ColourRamp::stone) return kStone;
  if (ramp == ColourRamp::speed) return kSpeed;
  return kTension;
}

}  // namespace

Colour from_hex(std::uint32_t rgb) {
  return Colour(static_cast<float>(rgb >> 16 & 255U), static_cast<float>(rgb >> 8 & 255U),
                static_cast<float>(rgb & 255U)) /
         255.0F;
}

Colour to_display(const Colour& linear) {
  return linear.unaryExpr([](float v) {
    const float c = std::clamp(v, 0.0F, 1.0F);
    return c <= 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1.0F / 2.4F) - 0.055F;
  });
}

Colour to_linear(const Colour& display) {
  return display.unaryExpr([](float v) {
    const float c = std::clamp(v, 0.0F, 1.0F);
    return c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F);
  });
}

std::vector<Colour> ramp_anchors(ColourRamp ramp) {
  std::vector<Colour> colours;
  for (const std::uint32_t rgb : anchors(ramp)) colours.push_back(from_hex(rgb));
  return colours;
}

Colour ramp_colour(ColourRamp ramp, float t) {
  const auto colours = anchors(ramp);
  const float x = (std::isfinite(t) ? std::clamp(t, 0.0F, 1.0F) : 0.0F) * static_cast<float>(colours.size() - 1);
  const std::size_t lower = std::min(static_cast<std::size_t>(x), colours.size() - 2);
  const float weight = x - static_cast<float>(lower);
  return (1 - weight) * from_hex(colours[lower]) + weight * from_hex(colours[lower + 1]);
}

}  // namespace lahar::cases
