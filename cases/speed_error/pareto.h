#pragma once
// Which trials are worth their time.
#include <cstddef>
#include <vector>

#include "cases/speed_error/problem.h"

namespace lahar::validate {

/// By how much the trial that beats the k-th most does so: the largest factor f for which another takes at most 1/f of
/// its time and has at most 1/f of its error; at most 1 for a trial on the Pareto front. Trials whose error or time is
/// not finite beat none. Throws std::out_of_range for a k that is none.
double beaten_by(const std::vector<Measurement>& trials, std::size_t k);

/// Indices of the trials on the front, by rising time.
std::vector<std::size_t> pareto_front(const std::vector<Measurement>& trials);

}  // namespace lahar::validate
