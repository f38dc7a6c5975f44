#pragma once
// The fluid and its ordered step.
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/step_clock.h"
#include "core/timers.h"
#include "lbm/free_surface/conversion.h"
#include "lbm/free_surface/inflow.h"
#include "lbm/step/cell_moments.h"
#include "lbm/step/fluid_level.h"
#include "lbm/step/fluid_options.h"
#include "lbm/step/fluid_snapshot.h"
#include "lbm/step/surface_pass.h"
#include "lbm/step/survey.h"
#include "lbm/step/time_step_control.h"
#include "lbm/step/wall_pass.h"

namespace lahar::lbm {

/// One wet cell as observers see it, SI.
struct WetCell {
  Vec3 centre;            ///< m
  Vec3 velocity;          ///< m/s
  double fill_level;      ///< 0..1, bodies in the cell included
  double solid_fraction;  ///< 0..1
  double liquid_volume;   ///< m^3
  double pressure;        ///< Pa above ambient
};

template <class Real>
class Fluid {
 public:
  explicit Fluid(FluidOptions options);

  /// Fills boxes with liquid, under the pressure of its own depth along z where walls bear it (fluid_filling.h); call
  /// before the first step. Boxes that stand on each other or overlap are one body of liquid. Cells in walls stay dry.
  void fill(const std::vector<LiquidRegion>& regions);
  /// Fills every free cell of the domain and initializes it from a function of the cell centre that gives velocity
  /// (lu) and rho - 1: for flows without a surface.
  void fill_everything(const std::function<Vec3(const Vec3&)>& velocity_lu,
                       const std::function<double(const Vec3&)>& drho, Start start = Start::equilibrium);

  /// The liquid of now is the start of the mass ledger. Done by fill; to be called again after bodies were put in.
  void open_ledger() { initial_mass_ = liquid_mass() + outflow_mass() - inflow_mass() - rescaled_mass(); }

  /// Whether the velocity of cells with bodies is kept for wires to sample (it is by default).
  void keep_velocities(bool keep) { level_.parameters.keep_velocity = keep; }

  /// One fluid step: mass over the surface, collide and stream, cell conversion, walls, blocks.
  /// Throws NumericalFailure if a cell is no longer finite or faster than the lattice can carry.
  void step();

  /// Takes away the walls that open by `time` (s), between steps; says whether there were some (open_walls.cpp).
  bool open_walls_by(double time);

  /// Makes the blocks in which inflows bring liquid in the coming step, so that bodies can be mapped into them before
  /// it.
  void make_room();

  /// s, with which the coming step collides and streams; where the step adapts this is when it is chosen. The step in
  /// which a change is made collides what has streamed with the old step: time() goes on by the old one once more.
  /// @param speed_of_bodies  m/s, of the fastest that may meet the liquid
  double plan_time_step(double speed_of_bodies = 0);
  /// From the coming step on `time_step` (s) holds: what is in the cells is brought over (rescale.h).
  void set_time_step(double time_step);
  [[nodiscard]] const TimeStepRecord& time_step_record() const { return time_steps_; }

  [[nodiscard]] const LatticeUnits& units() const { return level_.units; }
  [[nodiscard]] const FluidOptions& options() const { return options_; }
  [[nodiscard]] double tau() const { return level_.parameters.tau; }
  [[nodiscard]] const CoverageWeightLaw& coverage_weight_law() const { return level_.parameters.coverage_weight; }
  [[nodiscard]] std::int64_t steps() const { return clock_.steps(); }
  [[nodiscard]] FluidGrid<Real>& grid() { return level_.grid; }
  [[nodiscard]] const FluidGrid<Real>& grid() const { return level_.grid; }
  [[nodiscard]] Parity parity() const { return level_.parity(); }
  [[nodiscard]] LiquidAccount& account() { return account_; }
  /// s, of the last finished step.
  [[nodiscard]] double time() const { return clock_.time(); }
  [[nodiscard]] Timers& timers() { return timers_; }

  /// Liquid in the domain, kg: full cells, interface cells, pool, less the bodies' share.
  [[nodiscard]] double liquid_mass() const;
  /// Liquid that left through open faces, kg.
  [[nodiscard]] double outflow_mass() const { return account_.outflow * level_.units.mass(); }
  /// Liquid that came in through inflow boxes, kg.
  [[nodiscard]] double inflow_mass() const { return account_.inflow * level_.units.mass(); }
  /// Mass that changes of the time step have added, kg: they keep the volume (rescale.h).
  [[nodiscard]] double rescaled_mass() const { return account_.rescaled * level_.units.mass(); }
  /// (in the domain + left - come in - rescaled - at the start) / (come in + at the start); 0 without liquid.
  [[nodiscard]] double mass_drift() const;
  /// The same from a liquid_mass() that is known.
  [[nodiscard]] double mass_drift(double liquid_mass) const;
  [[nodiscard]] std::size_t wet_cells() const;
  /// Updates of cells so far: sum over the steps of wet cells.
  [[nodiscard]] double cell_updates() const { return cell_updates_; }
  /// What the last step saw.
  [[nodiscard]] const Survey& survey() const { return survey_; }
  /// Largest speed in the last step, lu; kNotFinite if one was not a number.
  [[nodiscard]] double max_speed_lu() const { return survey_.speed; }

  /// Most cells at the largest speed (kLargestSpeed) in any step.
  [[nodiscard]] std::size_t limited_cells() const { return limited_cells_; }

  /// From now on books what the walls get.
  void measure_walls() { walls_.measure(level_.grid.domain()); }
  /// What each wall of the domain got since measure_walls(), N s and N m s about the origin of the coordinates: the
  /// walls of the options in their order, then the closed faces. Empty if nothing is measured.
  [[nodiscard]] const std::vector<WallLoad>& wall_loads() const { return walls_.loads(); }

  /// Calls visit for every wet cell in a fixed order.
  void for_each_wet_cell(const std::function<void(const WetCell&)>& visit) const;
  /// Blocks of 8^3 cells that hold wet cells.
  [[nodiscard]] std::size_t wet_block_count() const;
  /// Calls visit(k, wet cells of the k-th such block) side by side: what it writes must belong to k.
  void for_each_wet_block(const std::function<void(std::size_t k, std::span<const WetCell> cells)>& visit) const;
  /// The wet cell at a point, if any.
  [[nodiscard]] std::optional<WetCell> cell_at(const Vec3& p) const;
  [[nodiscard]] FluidSnapshot snapshot() const;

  /// State of a checkpoint; loading needs a fluid of the same options that was not filled (fluid_transfer.cpp). Throws
  /// NumericalFailure instead of saving what is not finite.
  void transfer(Archive& archive);
  /// Whether the last step went well: all numbers finite, few cells held back.
  [[nodiscard]] bool is_in_order() const;

  /// Looks at what the last sweep saw: throws NumericalFailure with cell, step and cause.
  void watch() const;

 private:
  void check_finite() const;
  void sweep();
  void keep_waiting();
  void feed();
  void exchange();
  void reflect();
  void brake();
  void stretch_impulses(double ratio);
  void rescale(double ratio);
  void take_time_step(double time_step);
  void transfer_time(Archive& archive);
  void look(double speed_of_bodies);
  void classify_filled(std::vector<BlockIndex>& touched);
  void require_box(const Vec3i& low, const Vec3i& high);
  void require_neighbours(const std::vector<CellPlace>& cells);
  void initialize(CellPlace place, double drho, const Vec3& velocity_lu, const Mat3& stress = Mat3::Zero());
  [[nodiscard]] Mat3 flow_stress(const std::function<Vec3(const Vec3&)>& velocity_lu, const Vec3& centre) const;
  [[nodiscard]] std::vector<BlockIndex> wet_blocks() const;
  [[nodiscard]] WetCell describe(CellPlace place, const CellMoments<Real>& m) const;
  template <class Visit>
  void describe_block(BlockIndex b, const Visit& visit) const;

  FluidOptions options_;
  FluidLevel<Real> level_;
  CellConversion<Real> conversion_;
  std::vector<Inflow<Real>> inflows_;
  LiquidAccount account_;
  double initial_mass_ = 0;
  StepClock clock_;
  double coming_time_step_ = 0;
  TimeStepRecord time_steps_;
  std::optional<TimeStepControl> control_;
  Survey survey_;                // of the last sweep
  std::int64_t looked_at_ = -1;  // steps at the last look of the control
  double cell_updates_ = 0;
  std::size_t limited_cells_ = 0;  // most cells whose speed was limited in a step
  SurfacePass<Real> surface_pass_;
  WallPass<Real> walls_;
  std::vector<SweepNote> notes_;  // of the last sweep, by place in the list of owned blocks
  Timers timers_;
};

extern template class Fluid<float>;
extern template class Fluid<double>;

}  // namespace lahar::lbm
