#pragma once
// What a run will take, from rates of runs that were timed on processors without AVX-512.
#include "cases/runner/check.h"

namespace lahar::cases {

/// CPU seconds of one thread; `report` has the scene's figures. A rough estimate: processors differ by a factor of two,
/// and so do flows.
double run_time(const scene::Scene& scene, const CheckReport& report);

}  // namespace lahar::cases
