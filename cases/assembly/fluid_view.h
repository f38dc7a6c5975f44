#pragma once
// The fluid as observers and writers see it, whatever its number format. They look and change nothing.
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lbm/step/fluid.h"

namespace lahar::cases {

/// Liquid that left or joined the fluid since the start, kg.
struct LiquidTransfers {
  double left = 0;          ///< through open faces
  double came_in = 0;       ///< through inflow boxes
  double rescaled = 0;      ///< added by changes of the time step (lbm/step/rescale.h)
  double paid_nearby = 0;   ///< displaced by bodies, to and from cells near by (lbm/free_surface/isolated_liquid.h)
  double pooled = 0;        ///< went through the pool of isolated cells, either way
  double wall_balance = 0;  ///< given back to the cells at walls (lbm/boundary/wall_balance.h)
};

class FluidView {
 public:
  FluidView() = default;
  virtual ~FluidView() = default;
  FluidView(const FluidView&) = delete;
  FluidView& operator=(const FluidView&) = delete;

  [[nodiscard]] virtual const lbm::FluidOptions& options() const = 0;
  [[nodiscard]] virtual const LatticeUnits& units() const = 0;
  [[nodiscard]] virtual const lbm::Domain& domain() const = 0;

  [[nodiscard]] virtual std::int64_t steps() const = 0;
  [[nodiscard]] virtual const lbm::TimeStepRecord& time_step_record() const = 0;
  /// Whether the last step went well.
  [[nodiscard]] virtual bool is_in_order() const = 0;
  /// Throws NumericalFailure with cell, step and cause if the last step went wrong for good.
  virtual void watch() const = 0;
  /// Wall time by section, s.
  [[nodiscard]] virtual std::map<std::string, double> seconds() const = 0;

  [[nodiscard]] virtual std::size_t wet_cells() const = 0;
  [[nodiscard]] virtual std::size_t active_blocks() const = 0;
  /// Updates of wet cells since the start.
  [[nodiscard]] virtual double cell_updates() const = 0;
  /// Largest speed in the last step, lu.
  [[nodiscard]] virtual double max_speed_lu() const = 0;
  /// Most cells in a step whose speed was limited.
  [[nodiscard]] virtual std::size_t limited_cells() const = 0;

  /// kg in the domain. A sum over all cells.
  [[nodiscard]] virtual double liquid_mass() const = 0;
  /// (in the domain + left - come in - rescaled - at the start) / (come in + at the start), of that liquid_mass().
  [[nodiscard]] virtual double mass_drift(double liquid_mass) const = 0;
  [[nodiscard]] virtual LiquidTransfers transfers() const = 0;

  /// From now on books what the walls get.
  virtual void measure_walls() = 0;
  /// What each wall of the domain got since then, see lbm::Fluid::wall_loads().
  [[nodiscard]] virtual const std::vector<lbm::WallLoad>& wall_loads() const = 0;

  /// Calls visit for every wet cell in a fixed order.
  virtual void for_each_wet_cell(const std::function<void(const lbm::WetCell&)>& visit) const = 0;
  [[nodiscard]] virtual std::size_t wet_block_count() const = 0;
  /// Calls visit(k, wet cells of the k-th block) side by side: what it writes must belong to k.
  virtual void for_each_wet_block(
      const std::function<void(std::size_t k, std::span<const lbm::WetCell> cells)>& visit) const = 0;
  /// The wet cell at a point, if any.
  [[nodiscard]] virtual std::optional<lbm::WetCell> cell_at(const Vec3& p) const = 0;
  [[nodiscard]] virtual lbm::FluidSnapshot snapshot() const = 0;
  /// m/s, of the liquid that goes through open faces: mean over the cells beside them by what flows out of each; none
  /// where nothing does.
  [[nodiscard]] virtual std::optional<Vec3> leaving_velocity() const = 0;
};

/// The view of a fluid, which must outlive it.
std::unique_ptr<FluidView> view_of(lbm::Fluid<float>& fluid);
std::unique_ptr<FluidView> view_of(lbm::Fluid<double>& fluid);

}  // namespace lahar::cases
