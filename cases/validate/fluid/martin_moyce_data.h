#pragma once
// Front Z = x/a at T = n t sqrt(g/a), n^2 = 2, a = 2.25 in (Martin & Moyce 1952). Copied from martin_moyce1952.csv:
// "Table 2 front, digits READ identically in two unrelated code bases; trust: n2=2 high (table values). Reported slope
// dZ/dT: 1.319 (n2=2, T 1.43-3.33)".
#include <array>
#include <utility>

namespace lahar::validate {

inline constexpr std::array<std::pair<double, double>, 15> kMartinMoyceFront = {{{0.41, 1.11},
                                                                                 {0.84, 1.22},
                                                                                 {1.19, 1.44},
                                                                                 {1.43, 1.67},
                                                                                 {1.63, 1.89},
                                                                                 {1.83, 2.11},
                                                                                 {1.98, 2.33},
                                                                                 {2.2, 2.56},
                                                                                 {2.32, 2.78},
                                                                                 {2.51, 3.0},
                                                                                 {2.65, 3.22},
                                                                                 {2.83, 3.44},
                                                                                 {2.98, 3.67},
                                                                                 {3.11, 3.89},
                                                                                 {3.33, 4.11}}};
inline constexpr double kMartinMoyceSlopeFrom = 1.43;

}  // namespace lahar::validate
