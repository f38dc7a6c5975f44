#pragma once
// summary.json: what came out of a run.
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cases/observers/result_check.h"

namespace lahar::cases {

struct Performance {
  double mlups = 0;  ///< million lattice cell updates per second
  double dem_particle_steps_per_second = 0;
  std::uint64_t peak_rss_bytes = 0;
  std::uint64_t wet_cells_max = 0, blocks_max = 0;
};

struct Summary {
  std::string case_name, version;
  std::string commit;  ///< of a run that several programs had a part in: of all, "first, second"
  std::string machine;
  int threads = 0;
  std::string precision;
  double wall_seconds = 0, simulated_seconds = 0;
  Metrics metrics;                       ///< lower_snake names with a unit suffix
  std::vector<ResultCheck> checks;       ///< only those that were run
  std::map<std::string, double> timers;  ///< s by section
  Performance performance;
};

/// The JSON text. JSON has no infinity and no not-a-number: metrics and timers that are not finite are left out; a
/// check whose value is not finite has `null` there and does not pass.
std::string to_json(const Summary& summary);

/// Writes summary.json into a folder, whole or not at all.
void write_summary(const std::filesystem::path& folder, const Summary& summary);

/// A short table of metrics and checks for the terminal.
std::string results_table(const Summary& summary);

}  // namespace lahar::cases
