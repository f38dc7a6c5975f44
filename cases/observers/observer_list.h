#pragma once
// All observers of a run, in the order of their columns.
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cases/files/series_writer.h"
#include "cases/observers/observer.h"

namespace lahar::cases {

class ObserverList {
 public:
  /// The observers that have something to see in this run.
  ObserverList(const scene::Scene& scene, Simulation& simulation);

  /// Declares the columns of all quantities.
  void declare(SeriesWriter& series) const;
  /// To be called after every step.
  void after_step();
  /// Takes a row at the present time.
  void sample(SeriesWriter& series);
  /// Time of the last row, s.
  [[nodiscard]] double last_time() const { return last_time_; }
  /// Closes the books: everything that the run has found.
  [[nodiscard]] Metrics metrics() const;
  [[nodiscard]] std::vector<ResultCheck> checks() const;
  [[nodiscard]] std::vector<std::string> warnings() const;
  /// Writes the files that are due at the end.
  void finish(const std::filesystem::path& folder) const;
  /// Sums, peaks and crossings so far, for a checkpoint.
  void transfer(Archive& archive);

  /// The observer of a kind, null if there is none.
  template <class T>
  [[nodiscard]] const T* find() const {
    for (const auto& o : observers_)
      if (const auto* found = dynamic_cast<const T*>(o.get())) return found;
    return nullptr;
  }
  [[nodiscard]] std::vector<const Quantity*> quantities() const;

 private:
  Observed run_;
  std::vector<std::unique_ptr<Observer>> observers_;
  Metrics found_;  ///< that follow rows; all others as they were at the checkpoint that the run goes on from
  double last_time_ = 0;
  bool is_current_ = true;  ///< no run goes on that has not taken a row yet
};

}  // namespace lahar::cases
