#pragma once
// Diameters drawn from a grain-size distribution: log-normal between cut-offs, or a sieve curve.
#include <cstdint>
#include <vector>

namespace lahar::dem {

/// What a distribution counts: grains, or their mass (equal densities: their volume).
enum class SizeWeight { number, mass };

/// ln d is normally distributed, cut off at both ends. What is log-normal by number is so by mass, with the same
/// deviation and ln(median by mass) = ln(median by number) + 3 deviation^2 (Hatch & Choate 1929, J. Franklin Inst.
/// 207:369).
struct LogNormalSizes {
  double median = 0;                 ///< m, of the distribution before it is cut off
  double deviation = 0;              ///< standard deviation of ln d
  double smallest = 0, largest = 0;  ///< m, the cut-offs
  SizeWeight weight = SizeWeight::mass;
};

/// A point of a sieve curve: this share of the mass (0 to 1) passes a sieve of this opening (m).
struct SievePoint {
  double opening = 0, passing = 0;
};

/// Rising from 0 to 1. Between two sieves the curve is straight over ln d, as drawn on the usual semi-logarithmic
/// paper.
using SieveCurve = std::vector<SievePoint>;

/// Share of the distribution between the cut-offs, of what `weight` counts.
[[nodiscard]] double kept_share(const LogNormalSizes& sizes);

/// Mean volume of a grain, m^3: of all, and of those between two sieves.
[[nodiscard]] double mean_volume(const LogNormalSizes& sizes);
[[nodiscard]] double mean_volume(double smaller_opening, double larger_opening);

/// Diameters in m, rising, of grains with the given volume (m^3) together, fixed by the seed. The number is rounded, of
/// a sieve curve between each two sieves. They are drawn stratified: one of each of n parts of equal number, so that
/// the number of grains below any diameter is right to within one, and the volume between the cut-offs, or between two
/// sieves, differs from what was asked by no more than one and a half of its largest grains. Throws InputError if a
/// distribution makes no sense.
[[nodiscard]] std::vector<double> draw_diameters(const LogNormalSizes& sizes, double volume, std::uint64_t seed);
[[nodiscard]] std::vector<double> draw_diameters(const SieveCurve& curve, double volume, std::uint64_t seed);

}  // namespace lahar::dem
