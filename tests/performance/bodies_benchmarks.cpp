// Speed of the bodies in water.
#include "tests/performance/benchmark.h"

namespace lahar::performance {

std::vector<Benchmark> bodies_benchmarks() { return {}; }

}  // namespace lahar::performance
