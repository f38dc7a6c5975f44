#pragma once
// Sums that vectorize in an order that the source fixes.
#include <array>
#include <cstddef>

namespace lahar::dem {

/// Sum of term(k) over [first, last) in eight partial sums, which are added up at the end.
template <class Term>
double lane_sum(std::size_t first, std::size_t last, const Term& term) {
  std::array<double, 8> lane{};
  std::size_t k = first;
  for (; k + 8 <= last; k += 8)
    for (std::size_t l = 0; l < 8; ++l) lane[l] += term(k + l);
  for (std::size_t l = 0; k < last; ++k, ++l) lane[l] += term(k);
  double sum = 0;
  for (const double v : lane) sum += v;
  return sum;
}

}  // namespace lahar::dem
