#pragma once
// An entry of the speed ladder: a figure of ours against a limit of the machine or another figure of the same run.
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace lahar::performance {

/// Memory rates of this run, GB/s, update in place. Measured before and after every entry; the best so far counts.
struct MachineLimits {
  double stream_one = 0, stream_all = 0;
};

struct Figure {
  std::string name;  ///< group.entry, for example fluid.plain
  double value = 0;
  std::string unit;
  double ratio = 0;     ///< what the bar is set on
  std::string against;  ///< what the ratio is taken to
  double bar = 0;
  bool at_least = true;         ///< the ratio must reach the bar; otherwise stay below it
  bool of_memory_rate = false;  ///< the ratio is one of the memory rate, which is measured again after the entry
  std::map<std::string, double> shares{};  ///< of the time, by section; empty where it is not divided
  std::string missing{};                   ///< why there is no ratio, if there is none; the bar is then not reached
  [[nodiscard]] bool measured() const { return missing.empty(); }
  [[nodiscard]] bool pass() const { return measured() && (at_least ? ratio >= bar : ratio <= bar); }
};

/// Shared by the entries of a run: what was measured before, by name.
struct Session {
  MachineLimits limits;
  int repeats = 3;
  std::filesystem::path folder;  ///< where entries keep what takes long to make
  std::vector<Figure> figures;
  /// value of a figure that was measured before, 0 if there is none.
  [[nodiscard]] double value_of(const std::string& name) const;
};

struct Benchmark {
  std::string name;                ///< group.entry
  std::vector<std::string> needs;  ///< entries that must have run before
  std::function<Figure(Session&)> run;
  bool by_name_only = false;  ///< takes long: left out unless it or its group is named
};

std::vector<Benchmark> fluid_benchmarks();
std::vector<Benchmark> bodies_benchmarks();
std::vector<Benchmark> solids_benchmarks();
std::vector<Benchmark> debris_flow_benchmarks();
/// All of them, group by group.
std::vector<Benchmark> all_benchmarks();

/// Best time of `repeats` calls, s.
double best_seconds(int repeats, const std::function<void()>& body);

}  // namespace lahar::performance
