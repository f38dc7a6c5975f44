#pragma once
// Colours: linear light while a picture is computed, display (sRGB) values in an Image.
#include <cstdint>
#include <vector>

#include "cases/files/image.h"

namespace lahar::cases {

/// Display colour from 0xRRGGBB.
[[nodiscard]] Colour from_hex(std::uint32_t rgb);
/// sRGB transfer function (IEC 61966-2-1), per channel.
[[nodiscard]] Colour to_display(const Colour& linear);
[[nodiscard]] Colour to_linear(const Colour& display);

/// Which quantity a ramp of display colours stands for; t in 0..1 is clamped.
enum class ColourRamp {
  stone,    ///< grain size: dark slate (small) to light sandstone (large)
  speed,    ///< slow blue to fast yellow
  tension,  ///< slack steel grey to taut red
};
[[nodiscard]] Colour ramp_colour(ColourRamp ramp, float t);
/// The colours, equally far apart in t, between which a ramp is straight.
[[nodiscard]] std::vector<Colour> ramp_anchors(ColourRamp ramp);

}  // namespace lahar::cases
