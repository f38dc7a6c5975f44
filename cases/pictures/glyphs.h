#pragma once
// The strokes that letters are made of.
#include <Eigen/Core>
#include <vector>

namespace lahar::cases {

/// One letter in units of a sixth of the capital height: baseline at y = 0, capitals up to 6, small letters up to 4,
/// descenders down to -2; y points up.
struct Glyph {
  std::vector<std::vector<Eigen::Vector2f>> strokes;
  float width = 0;  ///< without the space to the next letter
};

/// The glyph of an ASCII character (an empty box if there is none).
[[nodiscard]] const Glyph& glyph_of(char character);

}  // namespace lahar::cases
