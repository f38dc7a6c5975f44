#pragma once
// What looks at a run and says what it sees as quantities. A kind of observer is one file of this folder, and one line
// in observer_list.cpp.
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cases/assembly/simulation.h"
#include "cases/observers/quantity.h"
#include "cases/observers/result_check.h"
#include "core/archive.h"

namespace lahar::cases {

/// What a quantity reads where there is nothing to say, see Quantity::may_be_unknown.
inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// The run that is looked at.
struct Observed {
  Observed(const scene::Scene& scene_of_run, Simulation& simulation_of_run);
  const scene::Scene& scene;
  Simulation& simulation;
  std::optional<double> section;  ///< m, x of the plane that is measured
  Vec3 up;                        ///< unit vector against gravity
  double datum = 0;               ///< m along `up`, where potential energy is 0
  /// m above the datum.
  [[nodiscard]] double height(const Vec3& p) const { return up.dot(p) - datum; }
};

class Observer {
 public:
  explicit Observer(const Observed& run) : run_(run) {}
  virtual ~Observer() = default;
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;

  /// Of its part of a checkpoint.
  [[nodiscard]] virtual std::string_view name() const = 0;
  /// Called after every step: sums what only lasts for a step.
  virtual void after_step() {}
  /// Looks at the run for a row of the series, `interval` (s) after the last one. Its quantities are read afterwards,
  /// when all observers have looked.
  virtual void sample(double interval) { static_cast<void>(interval); }
  /// State for a checkpoint. Metrics that follow rows are kept for it.
  virtual void transfer(Archive& archive) { static_cast<void>(archive); }
  /// What the end of the run is held against.
  [[nodiscard]] virtual std::vector<ResultCheck> checks(const Metrics& metrics) const {
    static_cast<void>(metrics);
    return {};
  }
  /// What the log must tell at the end; empty if nothing.
  [[nodiscard]] virtual std::string warning() const { return {}; }
  /// Writes files of its own at the end.
  virtual void finish(const std::filesystem::path& folder) const { static_cast<void>(folder); }

  [[nodiscard]] const std::vector<Quantity>& quantities() const { return quantities_; }

 protected:
  using Read = std::function<double()>;
  /// A column of the series. Metrics can be added to what is returned, until the next one is declared.
  Quantity& column(Label label, std::string unit, std::string meaning, Read read) {
    quantities_.push_back({std::move(label), std::move(unit), std::move(meaning), std::move(read), true, {}});
    return quantities_.back();
  }
  /// Neither: metrics must be added to what is returned.
  Quantity& hidden(Read read) {
    quantities_.push_back({"", "", "", std::move(read), false, {}});
    return quantities_.back();
  }
  /// A metric that is read at the end.
  Quantity& result(Label label, std::string unit, std::string meaning, Read read) {
    Quantity& quantity = hidden(std::move(read));
    quantity.metrics.push_back({std::move(label), std::move(unit), std::move(meaning), Follow::last});
    return quantity;
  }
  /// A metric that is the first known value among the rows.
  void event(Label label, std::string unit, std::string meaning, Read read) {
    hidden(std::move(read)).metrics.push_back({std::move(label), std::move(unit), std::move(meaning), Follow::first});
  }

  const Observed& run_;

 private:
  std::vector<Quantity> quantities_;
};

}  // namespace lahar::cases
