#include "dem/packing/grading.h"

#include <cmath>
#include <numbers>
#include <random>

#include "core/check.h"
#include "core/sphere.h"

namespace lahar::dem {

namespace {

/// [0, 1), the same on every machine: the standard's distributions are not.
double random(std::mt19937_64& generator) { return static_cast<double>(generator() >> 11) * 0x1.0p-53; }

/// Share of a normal distribution below x standard deviations.
double normal_share(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

/// Share between two places; from the side on which the shares are small, so that nothing cancels in a tail.
double normal_share(double a, double b) {
  return a > 0 ? normal_share(-a) - normal_share(-b) : normal_share(b) - normal_share(a);
}

/// Standard deviations from the median to a diameter.
double place_of(const LogNormalSizes& s, double diameter) { return std::log(diameter / s.median) / s.deviation; }

/// The same distribution, counting grains.
LogNormalSizes by_number(LogNormalSizes s) {
  if (s.weight == SizeWeight::mass) s.median *= std::exp(-3 * s.deviation * s.deviation);
  s.weight = SizeWeight::number;
  return s;
}

/// The place below which a share of what lies between a and b lies.
double place_at(double share, double a, double b) {
  const double below = share * normal_share(a, b);
  double low = a, high = b;
  while (true) {  // halving ends when no number is left between: at most 60 times or so
    const double middle = 0.5 * (low + high);
    if (!(middle > low && middle < high)) return middle;
    (normal_share(a, middle) < below ? low : high) = middle;
  }
}

/// One place in each of n equal parts of [0, 1).
template <class Draw>
void draw_stratified(long count, std::mt19937_64& generator, const Draw& draw) {
  for (long k = 0; k < count; ++k) draw((static_cast<double>(k) + random(generator)) / static_cast<double>(count));
}

long rounded_count(double volume, double mean) { return std::max(std::lround(volume / mean), 1L); }

void check(const LogNormalSizes& s) {
  if (!(s.median > 0) || !(s.deviation > 0) || !(s.smallest > 0) || !(s.largest > s.smallest))
    throw InputError("grading: a log-normal distribution needs a median, a deviation and rising cut-offs, all above 0");
  if (!(kept_share(s) > 0)) throw InputError("grading: nothing of the log-normal distribution is between its cut-offs");
}

void check(const SieveCurve& curve) {
  bool sound = curve.size() >= 2;
  for (std::size_t k = 0; k < curve.size() && sound; ++k)
    sound = k == 0 ? curve[0].opening > 0 : curve[k].opening > curve[k - 1].opening;
  for (std::size_t k = 1; k < curve.size() && sound; ++k) sound = curve[k].passing >= curve[k - 1].passing;
  if (!sound || curve.front().passing != 0 || curve.back().passing != 1)
    throw InputError("grading: a sieve curve needs rising openings above 0 that pass shares rising from 0 to 1");
}

}  // namespace

double kept_share(const LogNormalSizes& s) { return normal_share(place_of(s, s.smallest), place_of(s, s.largest)); }

double mean_volume(const LogNormalSizes& sizes) {
  // The integral of d^3 over ln d: a factor exp(3 ln d) moves the normal distribution by 3 deviations squared.
  const LogNormalSizes s = by_number(sizes);
  const double a = place_of(s, s.smallest), b = place_of(s, s.largest), shift = 3 * s.deviation;
  return sphere_volume(0.5 * s.median) * std::exp(0.5 * shift * shift) * normal_share(a - shift, b - shift) /
         normal_share(a, b);
}

double mean_volume(double a, double b) {
  // Mass uniform over ln d: 1 / mean = average of 1 / (pi d^3 / 6) = 6 / pi (a^-3 - b^-3) / (3 ln(b / a)).
  return std::numbers::pi / 6 * 3 * std::log(b / a) / (1 / (a * a * a) - 1 / (b * b * b));
}

std::vector<double> draw_diameters(const LogNormalSizes& sizes, double volume, std::uint64_t seed) {
  check(sizes);
  const LogNormalSizes s = by_number(sizes);
  const double a = place_of(s, s.smallest), b = place_of(s, s.largest);
  std::mt19937_64 generator(seed);
  std::vector<double> diameters;
  draw_stratified(rounded_count(volume, mean_volume(s)), generator,
                  [&](double share) { diameters.push_back(s.median * std::exp(s.deviation * place_at(share, a, b))); });
  return diameters;
}

std::vector<double> draw_diameters(const SieveCurve& curve, double volume, std::uint64_t seed) {
  check(curve);
  std::mt19937_64 generator(seed);
  std::vector<double> diameters;
  for (std::size_t k = 1; k < curve.size(); ++k) {
    const double part = curve[k].passing - curve[k - 1].passing, a = curve[k - 1].opening, b = curve[k].opening;
    if (part == 0) continue;
    // Number per ln d falls as d^-3: the share below d is (a^-3 - d^-3) / (a^-3 - b^-3).
    const double first = 1 / (a * a * a), last = 1 / (b * b * b);
    draw_stratified(rounded_count(part * volume, mean_volume(a, b)), generator,
                    [&](double share) { diameters.push_back(1 / std::cbrt(first + share * (last - first))); });
  }
  return diameters;
}

}  // namespace lahar::dem
