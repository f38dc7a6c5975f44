#include "cases/assembly/fluid_view.h"

#include <algorithm>

namespace lahar::cases {

namespace {

/// How fast liquid of this velocity runs out of a cell through open faces of the domain, m/s summed over them.
template <class Real>
double outward_speed(const lbm::FluidGrid<Real>& grid, lbm::CellPlace place, const Vec3& velocity) {
  double sum = 0;
  for (int i = 1; i <= 6; ++i) {  // along the axes
    if (grid.type(grid.neighbour(place, i)) != lbm::CellType::sink) continue;
    const auto& c = lbm::D3Q19::c[i];
    sum += std::max(0.0, velocity.dot(Vec3(c[0], c[1], c[2])));
  }
  return sum;
}

template <class Real>
class ViewOf final : public FluidView {
 public:
  explicit ViewOf(lbm::Fluid<Real>& fluid) : fluid_(fluid) {}

  [[nodiscard]] const lbm::FluidOptions& options() const override { return fluid_.options(); }
  [[nodiscard]] const LatticeUnits& units() const override { return fluid_.units(); }
  [[nodiscard]] const lbm::Domain& domain() const override { return fluid_.grid().domain(); }
  [[nodiscard]] std::int64_t steps() const override { return fluid_.steps(); }
  [[nodiscard]] const lbm::TimeStepRecord& time_step_record() const override { return fluid_.time_step_record(); }
  [[nodiscard]] bool is_in_order() const override { return fluid_.is_in_order(); }
  void watch() const override { fluid_.watch(); }
  [[nodiscard]] std::map<std::string, double> seconds() const override { return fluid_.timers().seconds(); }
  [[nodiscard]] std::size_t wet_cells() const override { return fluid_.wet_cells(); }
  [[nodiscard]] std::size_t active_blocks() const override { return fluid_.grid().owned().size(); }
  [[nodiscard]] double cell_updates() const override { return fluid_.cell_updates(); }
  [[nodiscard]] double max_speed_lu() const override { return fluid_.max_speed_lu(); }
  [[nodiscard]] std::size_t limited_cells() const override { return fluid_.limited_cells(); }
  [[nodiscard]] double liquid_mass() const override { return fluid_.liquid_mass(); }
  [[nodiscard]] double mass_drift(double liquid_mass) const override { return fluid_.mass_drift(liquid_mass); }
  [[nodiscard]] LiquidTransfers transfers() const override {
    const double mass = units().mass();
    const lbm::LiquidAccount& account = fluid_.account();
    return {fluid_.outflow_mass(),      fluid_.inflow_mass(),        fluid_.rescaled_mass(),
            account.paid_nearby * mass, account.pooled_total * mass, account.walls.returned * mass};
  }
  void measure_walls() override { fluid_.measure_walls(); }
  [[nodiscard]] const std::vector<lbm::WallLoad>& wall_loads() const override { return fluid_.wall_loads(); }
  void for_each_wet_cell(const std::function<void(const lbm::WetCell&)>& visit) const override {
    fluid_.for_each_wet_cell(visit);
  }
  [[nodiscard]] std::size_t wet_block_count() const override { return fluid_.wet_block_count(); }
  void for_each_wet_block(const std::function<void(std::size_t, std::span<const lbm::WetCell>)>& visit) const override {
    fluid_.for_each_wet_block(visit);
  }
  [[nodiscard]] std::optional<lbm::WetCell> cell_at(const Vec3& p) const override { return fluid_.cell_at(p); }
  [[nodiscard]] lbm::FluidSnapshot snapshot() const override { return fluid_.snapshot(); }
  [[nodiscard]] std::optional<Vec3> leaving_velocity() const override {
    const lbm::FluidGrid<Real>& grid = fluid_.grid();
    Vec3 sum = Vec3::Zero();
    double outflow = 0;
    for (const lbm::BlockIndex b : grid.owned()) {
      if (!grid.has_surface(b)) continue;  // cells at open faces never become full ones
      const lbm::Block<Real>& block = grid.block(b);
      for (int n = 0; n < lbm::kBlockCells; ++n) {
        if (!block.at_rim[static_cast<std::size_t>(n)]) continue;
        const auto cell = fluid_.cell_at(grid.centre(b, n));
        if (!cell) continue;
        const double flow = cell->liquid_volume * outward_speed(grid, {b, n}, cell->velocity);
        outflow += flow, sum += flow * cell->velocity;
      }
    }
    return outflow > 0 ? std::optional<Vec3>(sum / outflow) : std::nullopt;
  }

 private:
  lbm::Fluid<Real>& fluid_;
};

}  // namespace

std::unique_ptr<FluidView> view_of(lbm::Fluid<float>& fluid) { return std::make_unique<ViewOf<float>>(fluid); }
std::unique_ptr<FluidView> view_of(lbm::Fluid<double>& fluid) { return std::make_unique<ViewOf<double>>(fluid); }

}  // namespace lahar::cases
