#include "dem/packing/grading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/check.h"

namespace lahar::dem {
namespace {

double volume_of(double d) { return std::numbers::pi / 6 * d * d * d; }

double volume_below(const std::vector<double>& diameters, double d) {
  double volume = 0;
  for (const double x : diameters) volume += x < d ? volume_of(x) : 0;
  return volume;
}

double count_below(const std::vector<double>& diameters, double d) {
  return static_cast<double>(std::count_if(diameters.begin(), diameters.end(), [&](double x) { return x < d; }));
}

/// Integral over ln d, by Simpson's rule.
double integral(double a, double b, const std::function<double(double)>& per_log) {
  constexpr int n = 2000;
  const double step = std::log(b / a) / n;
  double sum = 0;
  for (int k = 0; k <= n; ++k) sum += (k == 0 || k == n ? 1 : k % 2 ? 4 : 2) * per_log(a * std::exp(k * step));
  return sum * step / 3;
}

LogNormalSizes sizes(SizeWeight weight) { return {0.02, 0.4, 0.008, 0.05, weight}; }

/// What `sizes` says, without the code's formulas: a bell over ln d.
double bell(double d) { return std::exp(-0.5 * std::pow(std::log(d / 0.02) / 0.4, 2)); }

class LogNormal : public testing::TestWithParam<SizeWeight> {};

/// Each of n strata holds one diameter. So the number below any d is right to within 1 (the stratum that d cuts). The
/// volume below is right to within v(d) for the whole strata (each errs by its range at most) and v(d) for the cut one,
/// and the rounding of n adds half a mean grain.
TEST_P(LogNormal, IsHeldByNumberAndByMass) {
  const LogNormalSizes s = sizes(GetParam());
  const bool mass = s.weight == SizeWeight::mass;
  const auto number = [&](double d) { return bell(d) / (mass ? d * d * d : 1); };
  const auto volume = [&](double d) { return number(d) * volume_of(d); };
  const auto drawn = draw_diameters(s, 0.02, 3);
  const auto n = static_cast<double>(drawn.size());
  ASSERT_GT(n, 1000);
  EXPECT_NEAR(n, 0.02 * integral(0.008, 0.05, number) / integral(0.008, 0.05, volume), 0.5 + 1e-6 * n);
  for (const double d : {0.009, 0.012, 0.016, 0.02, 0.028, 0.04, 0.05}) {
    const double part = integral(0.008, d, number) / integral(0.008, 0.05, number);
    EXPECT_NEAR(count_below(drawn, d), part * n, 1 + 1e-6 * n) << d;
    const double below = integral(0.008, d, volume) / integral(0.008, 0.05, volume) * 0.02;
    EXPECT_NEAR(volume_below(drawn, d), below, 2 * volume_of(d) + 0.5 * 0.02 / n) << d;
  }
  EXPECT_TRUE(std::is_sorted(drawn.begin(), drawn.end()));
  EXPECT_GE(drawn.front(), 0.008);
  EXPECT_LE(drawn.back(), 0.05);
}

INSTANTIATE_TEST_SUITE_P(Weights, LogNormal, testing::Values(SizeWeight::number, SizeWeight::mass));

/// With cut-offs that cut nothing, the moments are those of the whole distribution: E d^3 = m^3 exp(9 s^2 / 2).
TEST(Grading, WholeLogNormalHasItsMoments) {
  LogNormalSizes s{0.02, 0.2, 0.02 * std::exp(-3.0), 0.02 * std::exp(3.0), SizeWeight::number};
  EXPECT_NEAR(mean_volume(s) / (volume_of(0.02) * std::exp(4.5 * 0.04)), 1, 1e-12);
  EXPECT_NEAR(kept_share(s), 1, 1e-12);
  s.weight = SizeWeight::mass;  // by mass, 1 / E d^-3
  EXPECT_NEAR(mean_volume(s) / (volume_of(0.02) * std::exp(-4.5 * 0.04)), 1, 1e-12);
  s.smallest = 0.02, s.weight = SizeWeight::number;
  EXPECT_NEAR(kept_share(s), 0.5, 1e-12);
}

TEST(Grading, TailsAreDrawnToo) {  // nine deviations out, where a share is 1 minus nothing
  const LogNormalSizes s{0.02, 0.1, 0.02 * std::exp(0.9), 0.02 * std::exp(1.0), SizeWeight::number};
  const auto drawn = draw_diameters(s, 1000 * mean_volume(s), 1);
  ASSERT_EQ(drawn.size(), 1000u);
  // The tail of a normal distribution from x on falls as exp(-x t - t^2 / 2): the median is ln 2 / x to first order.
  const double median = std::log(drawn[500] / 0.02) / 0.1 - 9;
  EXPECT_NEAR(median, std::log(2.0) / 9, 0.05 * std::log(2.0) / 9);
}

/// The standard grading of a gravel: each fraction holds its share of the mass to within 1.5 of its largest grains,
/// at any seed, and inside a fraction the curve is straight over ln d.
TEST(Grading, SieveCurveIsHeldFractionByFraction) {
  const SieveCurve curve = {{0.004, 0}, {0.008, 0.3}, {0.016, 0.3}, {0.0315, 0.75}, {0.063, 1}};
  constexpr double volume = 0.05;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto drawn = draw_diameters(curve, volume, seed);
    for (std::size_t k = 1; k < curve.size(); ++k) {
      const double a = curve[k - 1].opening, b = curve[k].opening, part = curve[k].passing - curve[k - 1].passing;
      const double between = volume_below(drawn, b) - volume_below(drawn, a);
      EXPECT_NEAR(between, part * volume, part > 0 ? 1.5 * volume_of(b) : 0) << k;
      const double middle = volume_below(drawn, std::sqrt(a * b)) - volume_below(drawn, a);
      EXPECT_NEAR(middle, part / 2 * volume, part > 0 ? 2.5 * volume_of(std::sqrt(a * b)) : 0) << k;
    }
    EXPECT_GE(drawn.front(), 0.004);
    EXPECT_LE(drawn.back(), 0.063);
  }
}

TEST(Grading, MeanVolumeBetweenSieves) {
  const double a = 0.01, b = 0.03;
  const double grains = integral(a, b, [](double d) { return 1 / volume_of(d); });  // of mass 1 per ln d
  EXPECT_NEAR(mean_volume(a, b) * grains / std::log(b / a), 1, 1e-9);
}

TEST(Grading, IsFixedByItsSeed) {
  const auto draw = [](std::uint64_t seed) { return draw_diameters(sizes(SizeWeight::mass), 0.001, seed); };
  EXPECT_EQ(draw(1), draw(1));
  EXPECT_NE(draw(1), draw(2));
}

TEST(Grading, RefusesWhatMakesNoSense) {
  const auto curve = [](const SieveCurve& c) { EXPECT_THROW((void)draw_diameters(c, 1, 1), InputError); };
  curve({});
  curve({{0.01, 0}});
  curve({{0.01, 0}, {0.02, 0.7}, {0.03, 0.6}, {0.04, 1}});
  curve({{0.01, 0}, {0.01, 1}});
  curve({{0, 0}, {0.01, 1}});
  curve({{0.01, 0.1}, {0.02, 1}});
  curve({{0.01, 0}, {0.02, 0.9}});
  const auto spoilt = [](const auto& spoil) {
    LogNormalSizes s = sizes(SizeWeight::mass);
    spoil(s);
    EXPECT_THROW((void)draw_diameters(s, 1, 1), InputError);
  };
  spoilt([](LogNormalSizes& s) { s.median = 0; });
  spoilt([](LogNormalSizes& s) { s.deviation = 0; });
  spoilt([](LogNormalSizes& s) { s.smallest = 0; });
  spoilt([](LogNormalSizes& s) { s.largest = s.smallest; });
  spoilt([](LogNormalSizes& s) { s.deviation = 0.001, s.smallest = 0.04; });
}

}  // namespace
}  // namespace lahar::dem
