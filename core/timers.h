#pragma once
// Wall-clock time per part of a step.
#include <chrono>
#include <deque>
#include <map>
#include <string>

#include "core/archive.h"

namespace lahar {

/// Named accumulators. Look a section up once (`Timers::section`), then time it with ScopedTimer: no allocation in a
/// step.
class Timers {
 public:
  struct Section {
    std::string name;
    double seconds = 0;
  };

  Section& section(const std::string& name) {
    for (auto& s : sections_)
      if (s.name == name) return s;
    sections_.push_back({name, 0.0});
    return sections_.back();
  }

  [[nodiscard]] std::map<std::string, double> seconds() const {
    std::map<std::string, double> all;
    for (const auto& s : sections_) all[s.name] = s.seconds;
    return all;
  }

  /// Goes on with the times of an earlier part of the run.
  void transfer(Archive& archive) {
    auto all = seconds();
    archive.numbers("seconds", all);
    if (archive.loading())
      for (const auto& [name, seconds] : all) section(name).seconds = seconds;
  }

 private:
  std::deque<Section> sections_;  // addresses stay valid
};

/// Adds the time between construction and destruction to a section.
class ScopedTimer {
 public:
  explicit ScopedTimer(Timers::Section& section) : section_(section), start_(Clock::now()) {}
  ~ScopedTimer() { section_.seconds += std::chrono::duration<double>(Clock::now() - start_).count(); }
  ScopedTimer(const ScopedTimer&) = delete;
  ScopedTimer& operator=(const ScopedTimer&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  Timers::Section& section_;
  Clock::time_point start_;
};

}  // namespace lahar
