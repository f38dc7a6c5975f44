// Speed of the grains, rings, cables and brakes.
#include "tests/performance/benchmark.h"

namespace lahar::performance {

std::vector<Benchmark> solids_benchmarks() { return {}; }

}  // namespace lahar::performance
