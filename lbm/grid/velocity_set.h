#pragma once
// D3Q19 (Qian, d'Humieres & Lallemand 1992). Velocities come in pairs: odd i and its opposite i + 1, so that in-place
// streaming handles a pair at a time. The odd velocity of a pair is its "forward" one.
#include <array>

namespace lahar::lbm {

struct D3Q19 {
  static constexpr int q = 19;
  static constexpr int pairs = 9;
  static constexpr double cs2 = 1.0 / 3.0;  ///< speed of sound squared, lu

  /// c[i][axis]
  static constexpr int c[q][3] = {{0, 0, 0},  {1, 0, 0},   {-1, 0, 0}, {0, 1, 0},   {0, -1, 0}, {0, 0, 1},   {0, 0, -1},
                                  {1, 1, 0},  {-1, -1, 0}, {1, 0, 1},  {-1, 0, -1}, {0, 1, 1},  {0, -1, -1}, {1, -1, 0},
                                  {-1, 1, 0}, {1, 0, -1},  {-1, 0, 1}, {0, 1, -1},  {0, -1, 1}};

  static constexpr double w(int i) { return i == 0 ? 1.0 / 3.0 : (i < 7 ? 1.0 / 18.0 : 1.0 / 36.0); }
  static constexpr int opposite(int i) { return i == 0 ? 0 : (i % 2 == 1 ? i + 1 : i - 1); }
  /// The forward (odd) velocity of pair p.
  static constexpr int forward(int p) { return 2 * p + 1; }
};

}  // namespace lahar::lbm
