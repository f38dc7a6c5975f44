#include "cases/observers/quantity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cases/observers/result_check.h"

namespace lahar::cases {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// What the metrics of a quantity are after rows at 0, 1, 2, ... s.
Metrics after(const Quantity& quantity, const std::vector<double>& rows) {
  Metrics found;
  for (std::size_t k = 0; k < rows.size(); ++k) follow_row(quantity, rows[k], static_cast<double>(k), found);
  return found;
}

TEST(Quantity, PeakInAnotherUnitAndItsTime) {
  Quantity q{"force_N", "N", "", {}, true, {}};
  q.peak("peak_kN", "kN", "", 1000).peak_time("when_s");
  EXPECT_EQ(after(q, {1000, 4000, 4000, 2000}), (Metrics{{"peak_kN", 4}, {"when_s", 1}}));
  EXPECT_EQ(after(q, {-3000, -1000, -2000}), (Metrics{{"peak_kN", -1}, {"when_s", 1}}));
  EXPECT_EQ(after(q, {}), Metrics{});
  EXPECT_TRUE(after(q, {}).empty());
}

TEST(Quantity, PeakOfTheMagnitude) {
  Quantity q{"drift", "1", "", {}, true, {}};
  q.peak_magnitude("drift", "");
  EXPECT_EQ(after(q, {0.1, -0.3, 0.2}).at("drift"), 0.3);
}

/// One row that is not a number, and the largest of all rows is not known.
TEST(Quantity, APeakDoesNotHideWhatWentWrong) {
  Quantity q{"drift", "1", "", {}, true, {}};
  q.peak_magnitude("drift", "").peak_time("when_s");
  const Metrics found = after(q, {0.1, kNone, 0.2});
  EXPECT_TRUE(std::isnan(found.at("drift")));
  EXPECT_TRUE(std::isnan(found.at("when_s")));
  EXPECT_FALSE(vanishes(found, "drift", "ledger", 1, "").at(0).pass);
}

TEST(Quantity, APeakLeavesOutWhatIsUnknown) {
  Quantity q{"speed", "m/s", "", {}, true, {}};
  q.unknown_at_times().peak("peak", "m/s", "").peak_time("when_s");
  EXPECT_EQ(after(q, {kNone, 2, kNone, 1}), (Metrics{{"peak", 2}, {"when_s", 1}}));
}

TEST(Quantity, TheFirstKnownValueStays) {
  Quantity q{"arrival", "s", "", {}, false, {}};
  q.metrics.push_back({"arrival", "s", "", Follow::first});
  EXPECT_TRUE(q.is_followed());
  EXPECT_TRUE(after(q, {kNone, kNone}).empty());
  EXPECT_EQ(after(q, {kNone, 3, 5}).at("arrival"), 3);
}

TEST(Quantity, WhatIsOnlyKnownAtTheEnd) {
  double value = kNone;
  Quantity q{"mass", "kg", "", [&] { return value; }, false, {}};
  q.metrics.push_back({"mass", "kg", "", Follow::last});
  EXPECT_FALSE(q.is_followed());
  Metrics found = after(q, {7});
  close_books(q, found);
  EXPECT_TRUE(std::isnan(found.at("mass")));
  found.clear();
  q.unknown_at_times();
  close_books(q, found);
  EXPECT_TRUE(found.empty());
  value = 2;
  close_books(q, found);
  EXPECT_EQ(found, (Metrics{{"mass", 2}}));
}

}  // namespace
}  // namespace lahar::cases
