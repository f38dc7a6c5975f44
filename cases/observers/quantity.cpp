#include "cases/observers/quantity.h"

#include <algorithm>
#include <cmath>

namespace lahar::cases {

bool Quantity::is_followed() const {
  return is_column ||
         std::any_of(metrics.begin(), metrics.end(), [](const Metric& m) { return m.follow != Follow::last; });
}

void follow_row(const Quantity& quantity, double value, double time, Metrics& found) {
  if (std::isnan(value) && quantity.may_be_unknown) return;
  const bool wrong = std::isnan(value);
  bool rose = false;
  for (const Metric& m : quantity.metrics) {
    const std::string& name = m.label.name;
    if (m.follow == Follow::peak || m.follow == Follow::peak_magnitude) {
      const double now = (m.follow == Follow::peak ? value : std::abs(value)) / m.divisor;
      const auto [peak, is_first] = found.try_emplace(name, now);
      rose = is_first || wrong || now > peak->second;  // what went wrong stays so
      if (rose) peak->second = now;
    } else if (m.follow == Follow::peak_time) {
      double& when = found[name];
      if (rose) when = wrong ? value : time;
    } else if (m.follow == Follow::first && !wrong) {
      found.try_emplace(name, value / m.divisor);
    }
  }
}

void close_books(const Quantity& quantity, Metrics& found) {
  for (const Metric& m : quantity.metrics) {
    if (m.follow != Follow::last) continue;
    const double value = quantity.read();
    if (!std::isnan(value) || !quantity.may_be_unknown)
      found[m.label.name] = value / m.divisor;
    else
      found.erase(m.label.name);
  }
}

}  // namespace lahar::cases
