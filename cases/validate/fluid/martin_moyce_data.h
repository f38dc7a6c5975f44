#pragma once
// Front Z = x/a and height H = h / (n^2 a) of the column at the wall behind it, at T = n t sqrt(g/a), n^2 = 2, a = 2.25
// in (Martin & Moyce 1952). Copied from martin_moyce1952.csv: "Table 2 front and Table 6 height, digits READ
// identically in two unrelated code bases; trust: n2=2 high (table values). Reported slope dZ/dT: 1.319 (n2=2,
// T 1.43-3.33)". The heights stand there over t sqrt(g/a).
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
/// t sqrt(g/a) = T / n and H; the table goes on, the runs end here.
inline constexpr std::array<std::pair<double, double>, 10> kMartinMoyceHeight = {{{0.56, 0.94},
                                                                                  {0.77, 0.89},
                                                                                  {0.93, 0.83},
                                                                                  {1.08, 0.78},
                                                                                  {1.28, 0.72},
                                                                                  {1.46, 0.67},
                                                                                  {1.66, 0.61},
                                                                                  {1.84, 0.56},
                                                                                  {2.0, 0.5},
                                                                                  {2.21, 0.44}}};

}  // namespace lahar::validate
