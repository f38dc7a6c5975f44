#pragma once
// A dam break over a film of water at rest, in shallow water without friction (Stoker 1957, Water Waves, section 10.8):
// a bore runs into the film, behind it depth and velocity are uniform, behind that is the rarefaction of the reservoir.
#include <cmath>

namespace lahar::validate {

/// Lengths over the depth h0 of the reservoir, velocities over sqrt(g h0).
struct Bore {
  double speed = 0;     ///< of the bore
  double depth = 0;     ///< behind it
  double velocity = 0;  ///< of the water behind it
  /// Speed of the far end of the rarefaction, from where on depth and velocity are those behind the bore.
  [[nodiscard]] double end_of_rarefaction() const { return velocity - std::sqrt(depth); }
};

/// The bore over a film of depth `film` (over h0, above 0 and below 1). Mass and momentum across the bore,
///   depth = film/2 (sqrt(1 + 8 s^2/film) - 1),   velocity = s (1 - film/depth),
/// and velocity + 2 sqrt(depth) = 2 through the rarefaction; the speed s by bisection, to rounding.
inline Bore stoker(double film) {
  const auto behind = [film](double s) {
    const double depth = film / 2 * (std::sqrt(1 + 8 * s * s / film) - 1);
    return Bore{s, depth, s * (1 - film / depth)};
  };
  double low = std::sqrt(film), high = 2 + low;  // a wave on the film; faster than the front on a dry bed
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (low + high);
    const Bore b = behind(middle);
    (b.velocity + 2 * std::sqrt(b.depth) > 2 ? high : low) = middle;
  }
  return behind(0.5 * (low + high));
}

}  // namespace lahar::validate
