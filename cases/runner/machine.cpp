#include "cases/runner/machine.h"

#include <sys/resource.h>

#include <fstream>
#include <thread>

namespace lahar::cases {

std::string version() { return LAHAR_VERSION; }

std::string machine_name() {
  std::ifstream info("/proc/cpuinfo");
  std::string processor = "unknown processor";
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with("model name")) continue;
    processor = line.substr(std::min(line.size(), line.find(':') + 2));
    break;
  }
  return processor + ", " + std::to_string(std::thread::hardware_concurrency()) + " threads";
}

std::uint64_t peak_rss_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

}  // namespace lahar::cases
