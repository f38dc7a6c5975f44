#pragma once
// The fluid and its ordered step.
#include <functional>
#include <optional>
#include <vector>

#include "core/step_clock.h"
#include "core/timers.h"
#include "core/units.h"
#include "lbm/boundary/wall_load.h"
#include "lbm/free_surface/conversion.h"
#include "lbm/free_surface/inflow.h"
#include "lbm/free_surface/shear_row.h"
#include "lbm/grid/fluid_grid.h"
#include "lbm/step/cell_moments.h"
#include "lbm/step/fluid_snapshot.h"
#include "lbm/step/sweep.h"
#include "lbm/step/time_step_control.h"

namespace lahar::lbm {

struct FluidOptions {
  DomainSpec domain;
  double time_step = 0;               ///< s; the first, where it adapts
  bool adaptive_time_step = false;    ///< follows the speed of the liquid (time_step_control.h)
  double lattice_velocity = 0.1;      ///< lu, largest speed that an adaptive step aims at
  double density = 1000;              ///< kg/m^3
  double kinematic_viscosity = 1e-6;  ///< m^2/s
  Vec3 gravity = Vec3::Zero();        ///< m/s^2
  double surface_tension = 0;         ///< N/m; 0 is off
  CollisionOperator collision = CollisionOperator::central_moments;
  BodyWeighting weighting = kBodyWeighting;
  SolidOperator solid_operator = kSolidOperator;  ///< those that bounce back: Newtonian without LES only
  double seepage_constant = 0;                    ///< in place of tau - 1/2 for BodyWeighting::seepage
  double smagorinsky = 0;                         ///< Cs; 0 is off; only with a Newtonian fluid
  RheologyOptions rheology;                       ///< flow law of mud and slurry
  std::vector<InflowOptions> inflows;             ///< boxes through which liquid enters
};

/// How the populations of a flow without a surface start.
enum class Start {
  equilibrium,  ///< no stress: it builds up in a few tau; at small viscosity it rings from step to step until it has
  with_stress,  ///< with the viscous stress of the velocity's gradient; for smooth velocities
};

/// Liquid at the start: a box, or a body within it.
struct LiquidRegion {
  Vec3 lower, upper;                         ///< m
  Vec3 velocity = Vec3::Zero();              ///< m/s
  std::optional<Shape> body = std::nullopt;  ///< liquid where its distance is below 0
};

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

  /// Fills boxes with liquid under the pressure of its own depth along z; call before the first step. Cells in walls
  /// stay dry.
  void fill(const std::vector<LiquidRegion>& regions);
  /// Fills every free cell of the domain and initializes it from a function of the cell centre that gives velocity
  /// (lu) and rho - 1: for flows without a surface.
  void fill_everything(const std::function<Vec3(const Vec3&)>& velocity_lu,
                       const std::function<double(const Vec3&)>& drho, Start start = Start::equilibrium);

  /// The liquid of now is the start of the mass ledger. Done by fill; to be called again after bodies were put in.
  void open_ledger() { initial_mass_ = liquid_mass() + outflow_mass() - inflow_mass() - rescaled_mass(); }

  /// Whether the velocity of cells with bodies is kept for wires to sample (it is by default).
  void keep_velocities(bool keep) { parameters_.keep_velocity = keep; }

  /// One fluid step: mass over the surface, collide and stream, walls, cell conversion, blocks.
  /// Throws NumericalFailure if a cell is no longer finite or faster than the lattice can carry.
  void step();

  /// s, with which the coming step collides and streams; where the step adapts this is when it is chosen. The step in
  /// which a change is made collides what has streamed with the old step: time() goes on by the old one once more.
  double plan_time_step();
  /// From the coming step on `time_step` (s) holds: what is in the cells is brought over (rescale.h).
  void set_time_step(double time_step);
  [[nodiscard]] const TimeStepRecord& time_step_record() const { return time_steps_; }

  [[nodiscard]] const LatticeUnits& units() const { return units_; }
  [[nodiscard]] const FluidOptions& options() const { return options_; }
  [[nodiscard]] double tau() const { return parameters_.tau; }
  [[nodiscard]] const CoverageWeightLaw& coverage_weight_law() const { return parameters_.coverage_weight; }
  [[nodiscard]] std::int64_t steps() const { return clock_.steps(); }
  [[nodiscard]] FluidGrid<Real>& grid() { return grid_; }
  [[nodiscard]] const FluidGrid<Real>& grid() const { return grid_; }
  [[nodiscard]] Parity parity() const { return parameters_.parity; }
  [[nodiscard]] LiquidAccount& account() { return account_; }
  /// s, of the last finished step.
  [[nodiscard]] double time() const { return clock_.time(); }
  [[nodiscard]] Timers& timers() { return timers_; }

  /// Liquid in the domain, kg: full cells, interface cells, pool, less the bodies' share.
  [[nodiscard]] double liquid_mass() const;
  /// Liquid that left through open faces, kg.
  [[nodiscard]] double outflow_mass() const { return account_.outflow * units_.mass(); }
  /// Liquid that came in through inflow boxes, kg.
  [[nodiscard]] double inflow_mass() const { return account_.inflow * units_.mass(); }
  /// Mass that changes of the time step have added, kg: they keep the volume (rescale.h).
  [[nodiscard]] double rescaled_mass() const { return account_.rescaled * units_.mass(); }
  /// (in the domain + left - come in - rescaled - at the start) / (come in + at the start); 0 without liquid.
  [[nodiscard]] double mass_drift() const;
  [[nodiscard]] std::size_t wet_cells() const;
  /// Cells with at least one update so far (sum over steps of wet cells).
  [[nodiscard]] double cell_updates() const { return cell_updates_; }
  /// What the last step saw.
  [[nodiscard]] const Survey& survey() const { return survey_; }
  /// Largest speed in the last step, lu; kNotFinite if one was not a number.
  [[nodiscard]] double max_speed_lu() const { return survey_.speed; }

  /// Most cells at the largest speed (kLargestSpeed) in any step.
  [[nodiscard]] std::size_t limited_cells() const { return limited_cells_; }

  /// From now on books what the walls get.
  void measure_walls() { wall_loads_.assign(grid_.domain().walls().all().size(), {}); }
  /// What each wall of the domain got since measure_walls(), N s and N m s about the origin of the coordinates: the
  /// walls of the options in their order, then the closed faces. Empty if nothing is measured.
  [[nodiscard]] const std::vector<WallLoad>& wall_loads() const { return wall_loads_; }

  /// Calls visit for every wet cell in a fixed order.
  void for_each_wet_cell(const std::function<void(const WetCell&)>& visit) const;
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
  /// Gives back blocks that no wet cell needs.
  void release_dry_blocks();

 private:
  void check_finite() const;
  void sweep();
  void feed();
  void exchange();
  void measure_surface_shear();
  void reflect();
  void book_wall_loads();
  void stretch_impulses(double ratio);
  void rescale(double ratio);
  void take_time_step(double time_step);
  void transfer_time(Archive& archive);
  void look();
  void classify_filled(std::vector<BlockIndex>& touched);
  void initialize(CellPlace place, double drho, const Vec3& velocity_lu, const Mat3& stress = Mat3::Zero());
  [[nodiscard]] Mat3 flow_stress(const std::function<Vec3(const Vec3&)>& velocity_lu, const Vec3& centre) const;
  [[nodiscard]] WetCell describe(CellPlace place) const;

  FluidOptions options_;
  LatticeUnits units_;
  SweepParameters parameters_;
  FluidGrid<Real> grid_;
  CellConversion<Real> conversion_;
  std::vector<Inflow<Real>> inflows_;
  LiquidAccount account_;
  bool balances_walls_ = false;  ///< whether some wall may change the mass of cells (boundary/wall_balance.h)
  double initial_mass_ = 0;
  StepClock clock_;
  double coming_time_step_ = 0;
  TimeStepRecord time_steps_;
  std::optional<TimeStepControl> control_;
  Survey survey_;                // of the last sweep
  std::int64_t looked_at_ = -1;  // steps at the last look of the control
  double cell_updates_ = 0;
  std::size_t limited_cells_ = 0;                   // most cells whose speed was limited in a step
  std::vector<std::vector<ShearRow<Real>>> shear_;  // by place in active(); surface_shear.h
  std::vector<SweepNote> notes_;                    // of the last sweep, by place in the list of active blocks
  Timers timers_;
  std::vector<std::uint8_t> needed_;
  std::vector<WallLoad> wall_loads_;
  std::vector<BlockWallLoads> block_loads_;  // of the last step, by place in the list of active blocks
};

extern template class Fluid<float>;
extern template class Fluid<double>;

}  // namespace lahar::lbm
