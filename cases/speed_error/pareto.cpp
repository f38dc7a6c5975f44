#include "cases/speed_error/pareto.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lahar::validate {

namespace {

bool counts(const Measurement& m) { return std::isfinite(m.error) && std::isfinite(m.seconds); }

/// a / b of numbers that are at least 0.
double ratio(double a, double b) { return b > 0 ? a / b : a > 0 ? std::numeric_limits<double>::infinity() : 1; }

/// Whether one is at least as good in both and better in one.
bool beats(const Measurement& one, const Measurement& other) {
  return one.error <= other.error && one.seconds <= other.seconds &&
         (one.error < other.error || one.seconds < other.seconds);
}

}  // namespace

double beaten_by(const std::vector<Measurement>& trials, std::size_t k) {
  const Measurement& mine = trials.at(k);
  double most = 0;
  for (std::size_t i = 0; i < trials.size(); ++i)
    if (i != k && counts(trials[i]))
      most = std::max(most, std::min(ratio(mine.error, trials[i].error), ratio(mine.seconds, trials[i].seconds)));
  return most;
}

std::vector<std::size_t> pareto_front(const std::vector<Measurement>& trials) {
  std::vector<std::size_t> front;
  for (std::size_t k = 0; k < trials.size(); ++k)
    if (counts(trials[k]) && std::none_of(trials.begin(), trials.end(), [&](const Measurement& other) {
          return counts(other) && beats(other, trials[k]);
        }))
      front.push_back(k);
  std::sort(front.begin(), front.end(),
            [&](std::size_t a, std::size_t b) { return trials[a].seconds < trials[b].seconds; });
  return front;
}

}  // namespace lahar::validate
