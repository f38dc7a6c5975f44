#pragma once
// Energy, front and profile of the liquid: one look at all wet cells, which other observers share.
#include <cstddef>
#include <vector>

#include "cases/observers/observer.h"

namespace lahar::cases {

/// The lowest free cell of each column of cells: on the bed, on terrain, on the top of what stands there.
class Bed {
 public:
  explicit Bed(const lbm::Domain& domain);
  [[nodiscard]] bool holds(const Vec3i& cell) const {
    return lowest_[static_cast<std::size_t>(cell.y() - first_.y()) * row_ +
                   static_cast<std::size_t>(cell.x() - first_.x())] == cell.z();
  }

 private:
  Vec3i first_;
  std::size_t row_;
  std::vector<int> lowest_;  ///< z, by y and x
};

/// Sums over the wet cells at one moment. What is a mean over the width is one over the wet width: the rows of cells
/// along x that have a bed cell more than half full anywhere. So it is that of a channel of one width.
struct FlowFigures {
  double kinetic = 0, potential = 0;      ///< J, about the datum
  Vec3 momentum = Vec3::Zero();           ///< kg m/s
  double front = 0;                       ///< m: mean over the wet width of the foremost bed cell more than half full
  double outflow_power = 0;               ///< W, energy flux through the outflow section
  double outflow_kinetic_power = 0;       ///< W, the kinetic part of it
  double outflow_rate = 0;                ///< kg/s through that section
  double beyond_outflow = 0;              ///< kg beyond it
  double deepest = 0, deepest_speed = 0;  ///< m, m/s at the section with the largest depth
};

/// Looks at the fluid, which the run must have, on the bed of its domain.
FlowFigures look_at_flow(const Observed& run, const Bed& bed);

class Flow final : public Observer {
 public:
  explicit Flow(const Observed& run);
  static bool applies(const Observed& run) { return run.simulation.fluid() != nullptr; }
  [[nodiscard]] std::string_view name() const override { return "flow"; }
  void sample(double) override;
  [[nodiscard]] const FlowFigures& now() const { return now_; }

 private:
  Bed bed_;
  std::ptrdiff_t open_walls_ = 0;  ///< when the bed was found
  FlowFigures now_;
};

}  // namespace lahar::cases
