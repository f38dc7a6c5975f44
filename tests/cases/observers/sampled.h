#pragma once
// A scene that a test runs step by step, and the rows that its observers take.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "cases/files/series_reader.h"
#include "cases/observers/observer_list.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {

/// Values of a column by rows. Throws std::logic_error where there is none of the name.
inline const std::vector<double>& column_of(const Series& series, const std::string& name) {
  const Series::Column* found = series.find(name);
  if (found == nullptr) throw std::logic_error("no column " + name);
  return found->values;
}

/// Of a column that holds means since the row before: what they sum up to over time.
inline double sum_over_time(const Series& series, const std::string& name) {
  const std::vector<double>& mean = column_of(series, name);
  double sum = 0;
  for (std::size_t k = 1; k < mean.size(); ++k) sum += mean[k] * (series.time_s[k] - series.time_s[k - 1]);
  return sum;
}

/// Throws what building the scene throws; a row holds what all observers of the run see.
struct Sampled {
  explicit Sampled(scene::Scene of_run) : scene(std::move(of_run)) { observers.declare(series_); }
  Sampled(const Sampled&) = delete;  // observers refer to the scene
  Sampled& operator=(const Sampled&) = delete;

  void step() {
    simulation->advance();
    observers.after_step();
  }
  /// A row after so many steps.
  void take_row(int steps = 0) {
    for (int s = 0; s < steps; ++s) step();
    observers.sample(series_);
  }
  /// A row now, one every `interval` (s) from then on, and one at the end (s).
  void take_rows_until(double end, double interval) {
    take_row();
    double next = simulation->time() + interval;
    while (simulation->time() < end) {
      step();
      if (simulation->time() < std::min(next, end)) continue;
      take_row();
      next += interval;
    }
  }
  /// All rows; none can be taken afterwards.
  [[nodiscard]] const Series& rows() {
    if (!rows_) {
      series_.close();
      rows_ = read_series(folder() / "series.h5");
    }
    return *rows_;
  }
  /// A column of rows().
  [[nodiscard]] const std::vector<double>& column(const std::string& name) { return column_of(rows(), name); }
  [[nodiscard]] Metrics metrics() const { return observers.metrics(); }

  [[nodiscard]] dem::Solids& solids() { return *simulation->solids(); }
  /// For files of the test, gone afterwards.
  [[nodiscard]] const std::filesystem::path& folder() const { return scratch_.path(); }

  const scene::Scene scene;
  const std::unique_ptr<Simulation> simulation = build_simulation(scene);
  ObserverList observers{scene, *simulation};

 private:
  scene::ScratchFolder scratch_;
  SeriesWriter series_{scratch_.path() / "series.h5"};
  std::optional<Series> rows_;
};

}  // namespace lahar::cases
