#include "lbm/step/fluid.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/capillary.h"
#include "core/check.h"
#include "core/parallel.h"
#include "lbm/boundary/slip_wall.h"
#include "lbm/boundary/wall_balance.h"
#include "lbm/boundary/wall_reflection.h"
#include "lbm/collision/cell_state.h"
#include "lbm/free_surface/surface_exchange.h"
#include "lbm/free_surface/surface_shear.h"
#include "lbm/grid/row_types.h"
#include "lbm/step/rescale.h"

namespace lahar::lbm {

namespace {

constexpr std::size_t kBlocksPerTask = 8;        // a group of the population layout
constexpr std::int64_t kWatchEvery = 32;         // steps between looks at what the sweeps saw
constexpr std::int64_t kReleaseEvery = 16;       // steps between rounds of giving blocks back
constexpr double kLargestGradient = 2;           // of pressure at the surface, in rho g
constexpr double kCapillaryGradient = 1.0 / 16;  // the same by surface tension: sigma / R^2 at a radius of 4 cells
// A splash may hold a few cells at kLargestSpeed; more than that, and the limit would hide a time step that is too
// long.
constexpr double kLimitedCells = 100, kLimitedShare = 0.02;  // the latter of all wet cells
constexpr double kShortestStep = 1.0 / 32;                   // of the first: shorter, and something else is wrong

LatticeUnits units_of(const FluidOptions& o) { return {o.domain.cell_size, o.time_step, o.density}; }

SweepParameters parameters_of(const FluidOptions& o, const LatticeUnits& units) {
  SweepParameters p;
  p.collision = o.collision;
  p.tau = 0.5 + 3 * units.viscosity_to_lu(o.kinematic_viscosity);
  p.coverage_weight = coverage_weight_law(o.weighting, p.tau, o.seepage_constant);
  p.third_moments_at_bodies = o.weighting == BodyWeighting::wall_distance;
  p.solid_operator = o.solid_operator;
  p.smagorinsky = o.smagorinsky;
  // The Smagorinsky constant is that of a Newtonian inertial range; in a plug its eddy viscosity would hide the yield
  // stress.
  require(o.time_step <= capillary_time_step(o.density, o.domain.cell_size, o.surface_tension) * (1 + 1e-9),
          "Fluid: the time step is longer than ripples of two cells allow (core/capillary.h)");
  require(o.rheology.law == FlowLaw::newtonian || o.smagorinsky == 0,
          "Fluid: Smagorinsky is for Newtonian fluids alone");
  // Its walls slip where the viscosity is large.
  require(o.rheology.law == FlowLaw::newtonian || o.collision != CollisionOperator::bgk,
          "Fluid: BGK is for Newtonian fluids alone");
  require(!bounces_back(o.solid_operator) || (o.rheology.law == FlowLaw::newtonian && o.smagorinsky == 0),
          "Fluid: solid operators that bounce populations back are for a constant viscosity alone");
  const auto& walls = o.domain.walls.all();
  const bool modelled =
      std::any_of(walls.begin(), walls.end(), [](const Wall& w) { return w.slip == WallSlip::wall_model; });
  require(o.rheology.law == FlowLaw::newtonian || !modelled, "Fluid: the wall model is for Newtonian fluids alone");
  p.rheology = rheology_to_lu(o.rheology, o.kinematic_viscosity, units);
  for (int a = 0; a < 3; ++a) p.gravity[static_cast<std::size_t>(a)] = units.acceleration_to_lu(o.gravity[a]);
  return p;
}

/// The step grows no further than to tau = 1 (walls and stress are accurate around it), or where it started.
TimeStepLimits time_step_limits(const FluidOptions& o) {
  TimeStepLimits limits;
  limits.target = o.lattice_velocity;
  limits.cell_size = o.domain.cell_size;
  limits.shortest = kShortestStep * o.time_step;
  const double viscosity = o.rheology.law == FlowLaw::newtonian ? o.kinematic_viscosity : o.rheology.limit_viscosity;
  limits.longest = std::max(o.time_step, o.domain.cell_size * o.domain.cell_size / (6 * viscosity));
  limits.longest = std::min(limits.longest, capillary_time_step(o.density, o.domain.cell_size, o.surface_tension));
  limits.gravity = o.gravity.norm();
  for (const Wall& w : o.domain.walls.all()) limits.known_speed = std::max(limits.known_speed, w.velocity.norm());
  for (const InflowOptions& in : o.inflows) limits.known_speed = std::max(limits.known_speed, in.velocity.norm());
  return limits;
}

std::string describe_place(const Vec3& p) {
  char text[96];
  std::snprintf(text, sizeof text, "fluid cell at (%.4g, %.4g, %.4g) m", p.x(), p.y(), p.z());
  return text;
}

}  // namespace

template <class Real>
Fluid<Real>::Fluid(FluidOptions options)
    : options_(std::move(options)),
      units_(units_of(options_)),
      parameters_(parameters_of(options_, units_)),
      grid_(options_.domain, units_.velocity_to_lu(1.0)),
      clock_(options_.time_step),
      coming_time_step_(options_.time_step),
      time_steps_(options_.time_step) {
  const auto& walls = options_.domain.walls.all();
  balances_walls_ = options_.domain.placement == WallPlacement::interpolated ||
                    std::any_of(walls.begin(), walls.end(), [](const Wall& w) {
                      return w.slip != WallSlip::no_slip || !w.velocity.isZero() || !w.angular_velocity.isZero();
                    });
  for (const InflowOptions& inflow : options_.inflows) inflows_.emplace_back(inflow, grid_.domain(), units_);
  if (options_.adaptive_time_step) control_.emplace(time_step_limits(options_));
}

template <class Real>
void Fluid<Real>::step() {
  const double ratio = plan_time_step() / units_.time_step;
  if (ratio != 1) stretch_impulses(ratio);
  feed();
  exchange();
  if (ratio != 1) rescale(ratio);
  sweep();
  parameters_.parity = parameters_.parity.next();
  {
    const ScopedTimer timer(timers_.section("fluid.conversion"));
    conversion_.run(grid_, parameters_.parity, account_);
  }
  reflect();  // after the conversion: what a mirror sends to gas is another thing than what it sends to a new cell
  clock_.advance();
  if (ratio != 1) clock_.set_time_step(units_.time_step);
  if (!control_ && steps() % kWatchEvery == 0) watch();
  if (steps() % kReleaseEvery == 0) release_dry_blocks();
}

template <class Real>
double Fluid<Real>::plan_time_step() {
  if (control_ && looked_at_ != steps() && (steps() == 1 || (steps() > 0 && steps() % kLookEvery == 0))) look();
  return coming_time_step_;
}

/// A look for the watchdog and for the choice of the step.
template <class Real>
void Fluid<Real>::look() {
  looked_at_ = steps();
  watch();
  const double chosen = control_->choose(units_.time_step, survey_);
  if (chosen != units_.time_step) set_time_step(chosen);
}

template <class Real>
void Fluid<Real>::set_time_step(double time_step) {
  require(time_step > 0, "Fluid: the time step must be positive");
  coming_time_step_ = time_step;
}

/// Wires have written the momentum of a former step: a force that is held gives it over the coming one. It is brought
/// over as a velocity after that, with what inflows add.
template <class Real>
void Fluid<Real>::stretch_impulses(double ratio) {
  for (const BlockIndex b : grid_.active())
    if (ImpulseFields<Real>* impulse = grid_.block(b).impulse)
      for (Real* field : {impulse->x, impulse->y, impulse->z})
        for (int n = 0; n < kBlockCells; ++n) field[n] *= static_cast<Real>(ratio);
}

/// Lattice units are those of the given step.
template <class Real>
void Fluid<Real>::take_time_step(double time_step) {
  options_.time_step = time_step;
  units_ = units_of(options_);
  const Parity parity = parameters_.parity;
  const bool keep_velocity = parameters_.keep_velocity;
  parameters_ = parameters_of(options_, units_);
  parameters_.parity = parity;
  parameters_.keep_velocity = keep_velocity;
  grid_.set_velocity_to_lu(units_.velocity_to_lu(1.0));
  for (Inflow<Real>& inflow : inflows_) inflow.set_units(units_);
}

/// From here on lattice units are those of the new step.
template <class Real>
void Fluid<Real>::rescale(double ratio) {
  const ScopedTimer timer(timers_.section("fluid.time_step"));
  const auto& active = grid_.active();
  account_.rescaled += ordered_sum<double>(
      active.size(),
      [&](std::size_t k) { return rescale_block(grid_, active[k], parameters_.parity, parameters_, ratio); },
      kBlocksPerTask);
  // The drag of a packed bed per time, B / (1 - B) per step = eps / (1 - eps) c / (1 + c), is kept.
  const double drag = ratio * options_.seepage_constant / (1 + options_.seepage_constant);
  options_.seepage_constant = drag / std::max(1 - drag, 1e-6);
  take_time_step(coming_time_step_);
  survey_.speed *= ratio;
  time_steps_.note(options_.time_step);
}

template <class Real>
void Fluid<Real>::feed() {
  for (Inflow<Real>& inflow : inflows_)
    inflow.feed(grid_, conversion_, parameters_.parity, time(), clock_.time_step(), steps(), account_);
}

template <class Real>
void Fluid<Real>::exchange() {
  const ScopedTimer timer(timers_.section("fluid.surface"));
  const auto& g = parameters_.gravity;
  const double tension = units_.surface_tension_to_lu(options_.surface_tension);
  const double largest = std::sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]) + kCapillaryGradient * tension;
  const SurfacePhysics<Real> physics{Real(0), static_cast<Real>(kLargestGradient * largest), static_cast<Real>(tension),
                                     static_cast<Real>(largest)};
  const auto& active = grid_.active();
  const bool viscous = largest > 0 && feels_surface_shear(parameters_);
  if (viscous) measure_surface_shear();
  parallel_for(0, active.size(), kBlocksPerTask, [&](std::size_t k) {
    if (!grid_.has_surface(active[k])) return;
    exchange_over_mirrors(grid_, active[k], parameters_.parity);
    exchange_surface(grid_, active[k], parameters_.parity, physics, viscous ? shear_[k].data() : nullptr);
  });
}

template <class Real>
void Fluid<Real>::measure_surface_shear() {
  const auto& active = grid_.active();
  shear_.resize(std::max(shear_.size(), active.size()));
  parallel_for(0, active.size(), kBlocksPerTask, [&](std::size_t k) {
    if (grid_.has_surface(active[k])) measure_shear(grid_, active[k], parameters_, shear_[k]);
  });
}

template <class Real>
void Fluid<Real>::sweep() {
  const ScopedTimer timer(timers_.section("fluid.sweep"));
  const BlockSweep<Real> kernels[2][2] = {
      {choose_sweep<Real>(parameters_, false, false), choose_sweep<Real>(parameters_, false, true)},
      {choose_sweep<Real>(parameters_, true, false), choose_sweep<Real>(parameters_, true, true)}};
  const auto& active = grid_.active();
  notes_.assign(active.size(), {});
  conversion_.begin(grid_);
  parallel_for(0, active.size(), kBlocksPerTask, [&](std::size_t k) {
    Block<Real>& block = grid_.block(active[k]);
    if (block.body && block.wet_cells < kBlockCells) clear_momentum_exchange(*block.body);
    if (block.wet_cells == 0) return;
    const bool mixed = block.wet_cells < kBlockCells || block.surface;
    notes_[k] = kernels[mixed][block.body != nullptr](block, grid_.around(active[k]), parameters_);
    if (block.surface) conversion_.flag(grid_, k, parameters_.parity.next(), notes_[k]);
  });
  grid_.release_impulses();
  survey_ = survey_of(notes_, active);
  cell_updates_ += static_cast<double>(survey_.wet);
  account_.limited += static_cast<std::int64_t>(survey_.limited);
  account_.exposed += static_cast<std::int64_t>(survey_.exposed);
  limited_cells_ = std::max(limited_cells_, survey_.held_back);
}

template <class Real>
void Fluid<Real>::reflect() {
  const ScopedTimer timer(timers_.section("fluid.walls"));
  const auto& active = grid_.active();
  const WallPhysics physics{(parameters_.tau - 0.5) / 3, parameters_.gravity,
                            parameters_.rheology.law == FlowLaw::newtonian};
  const bool measured = !wall_loads_.empty();
  if (measured) block_loads_.resize(std::max(block_loads_.size(), active.size()));
  parallel_for(0, active.size(), kBlocksPerTask, [&](std::size_t k) {
    if (measured) block_loads_[k].clear();
    if (grid_.has_walls(active[k]))
      reflect_at_walls(grid_, active[k], parameters_.parity, physics, measured ? &block_loads_[k] : nullptr);
  });
  if (balances_walls_) balance_walls(grid_, account_.walls);
  if (measured) book_wall_loads();
}

/// Adds the loads of the step in the order of the blocks, so that the sum does not depend on the threads.
template <class Real>
void Fluid<Real>::book_wall_loads() {
  const double impulse = units_.mass() * units_.velocity_to_si(1.0);
  for (std::size_t k = 0; k < grid_.active().size(); ++k)
    for (const auto& [wall, load] : block_loads_[k].entries()) {
      WallLoad& sum = wall_loads_[static_cast<std::size_t>(wall)];
      sum.impulse += impulse * load.impulse;
      sum.angular_impulse +=
          impulse * (units_.cell_size * load.angular_impulse + grid_.domain().origin().cross(load.impulse));
    }
}

/// The sides of a block at which it has wet cells.
struct SidesReached {
  bool low[3], high[3];
};

template <class Real>
SidesReached sides_reached(const Block<Real>& block) {
  constexpr std::uint64_t first_y = 0x0101010101010101U, first_z = 0xFFU;
  unsigned wet = block.wet_cells == kBlockCells ? 0xFFU : 0U;
  for (std::uint64_t rows = wet ? 0 : block.wet_rows; rows != 0; rows &= rows - 1)
    wet |= wet_cells(block, std::countr_zero(rows));
  const std::uint64_t rows = block.wet_rows;
  return {{(wet & 1U) != 0, (rows & first_y) != 0, (rows & first_z) != 0},
          {wet >> 7 != 0, (rows & first_y << 7) != 0, (rows & first_z << 56) != 0}};
}

template <class Real>
void Fluid<Real>::release_dry_blocks() {
  const ScopedTimer timer(timers_.section("fluid.blocks"));
  needed_.assign(grid_.topology().capacity(), 0);
  for (const BlockIndex b : grid_.active()) {
    const Block<Real>& block = grid_.block(b);
    if (block.wet_cells == 0) continue;
    const SidesReached sides = sides_reached(block);
    for (int slot = 0; slot < 27; ++slot) {
      const int d[3] = {slot / 9 - 1, slot / 3 % 3 - 1, slot % 3 - 1};
      bool reached = true;
      for (int a = 0; a < 3; ++a) reached = reached && (d[a] == 0 || (d[a] < 0 ? sides.low[a] : sides.high[a]));
      const BlockIndex other = grid_.topology().neighbours(b)[static_cast<std::size_t>(slot)];
      if (reached && other != kNoBlock) needed_[static_cast<std::size_t>(other)] = 1;
    }
  }
  std::vector<BlockIndex> gone;
  for (const BlockIndex b : grid_.active())
    if (!needed_[static_cast<std::size_t>(b)]) gone.push_back(b);
  for (const BlockIndex b : gone) grid_.release(b);
}

template <class Real>
bool Fluid<Real>::is_in_order() const {
  const double bearable = std::max(kLimitedCells, kLimitedShare * static_cast<double>(survey_.wet));
  return survey_.speed < kNotFinite && static_cast<double>(survey_.held_back) <= bearable;
}

template <class Real>
void Fluid<Real>::watch() const {
  const bool curable = control_ && control_->can_shorten(units_.time_step);
  const bool broken = survey_.speed >= kNotFinite;
  if (is_in_order() || (!broken && curable)) return;
  if (!grid_.exists(survey_.fastest)) return;  // it went dry since
  auto& grid = const_cast<FluidGrid<Real>&>(grid_);
  const CellPlace place = fastest_cell(grid, survey_.fastest, parameters_.parity);
  const auto m = outgoing_moments(grid, place, parameters_.parity);
  char cause[240];
  std::snprintf(cause, sizeof cause, "velocity (%.4g, %.4g, %.4g) and density %.4g in lattice units: %s",
                static_cast<double>(m.u[0]), static_cast<double>(m.u[1]), static_cast<double>(m.u[2]),
                1.0 + static_cast<double>(m.drho),
                broken ? "not a number"
                       : "one of many cells at the largest speed of the lattice; the time step is too long: raise "
                         "max_speed or lower lattice_velocity");
  throw NumericalFailure(describe_place(grid_.centre(place.block, place.cell)), steps(), cause);
}

template <class Real>
double Fluid<Real>::liquid_mass() const {
  auto& grid = const_cast<FluidGrid<Real>&>(grid_);
  const auto& active = grid_.active();
  const double cells = ordered_sum<double>(
      active.size(),
      [&](std::size_t k) {
        const Block<Real>& block = grid_.block(active[k]);
        double sum = 0;
        if (block.wet_cells == 0) return sum;
        for (int n = 0; n < kBlockCells; ++n) {
          const CellType t = block.type[static_cast<std::size_t>(n)];
          if (!is_wet(t)) continue;
          if (t == CellType::liquid) {
            const auto m = outgoing_moments(grid, {active[k], n}, parameters_.parity);
            sum += 1.0 + static_cast<double>(m.drho);
          } else {
            sum += static_cast<double>(block.surface->mass[n]);
          }
          if (block.body) sum -= static_cast<double>(block.body->solid_fraction[n]);
        }
        return sum;
      },
      16);
  return (cells + account_.pool) * units_.mass();
}

template <class Real>
double Fluid<Real>::mass_drift() const {
  const double put_in = initial_mass_ + inflow_mass();
  return put_in > 0 ? (liquid_mass() + outflow_mass() - rescaled_mass() - put_in) / put_in : 0.0;
}

template <class Real>
std::size_t Fluid<Real>::wet_cells() const {
  std::size_t sum = 0;
  for (const BlockIndex b : grid_.active()) sum += static_cast<std::size_t>(grid_.block(b).wet_cells);
  return sum;
}

template <class Real>
WetCell Fluid<Real>::describe(CellPlace place) const {
  const Block<Real>& block = grid_.block(place.block);
  const auto m = outgoing_moments(const_cast<FluidGrid<Real>&>(grid_), place, parameters_.parity);
  const bool liquid = block.type[static_cast<std::size_t>(place.cell)] == CellType::liquid;
  WetCell c;
  c.centre = grid_.centre(place.block, place.cell);
  for (int a = 0; a < 3; ++a) c.velocity[a] = units_.velocity_to_si(static_cast<double>(m.u[a]));
  c.velocity -= 0.5 * units_.time_step * options_.gravity;  // half of the last force: the velocity between two steps
  const double fill = liquid ? 1.0 : static_cast<double>(block.surface->fill_level[place.cell]);
  const double eps = block.body ? static_cast<double>(block.body->solid_fraction[place.cell]) : 0.0;
  c.fill_level = fill;
  c.solid_fraction = std::min(1.0, eps);
  c.liquid_volume = std::max(0.0, fill - eps) * std::pow(units_.cell_size, 3);
  c.pressure = units_.pressure_to_si(static_cast<double>(m.drho) / 3);
  return c;
}

template <class Real>
void Fluid<Real>::for_each_wet_cell(const std::function<void(const WetCell&)>& visit) const {
  for (const BlockIndex b : grid_.active()) {
    const Block<Real>& block = grid_.block(b);
    if (block.wet_cells == 0) continue;
    for (int n = 0; n < kBlockCells; ++n)
      if (is_wet(block.type[static_cast<std::size_t>(n)])) visit(describe({b, n}));
  }
}

template <class Real>
std::optional<WetCell> Fluid<Real>::cell_at(const Vec3& p) const {
  const Vec3i cell = grid_.domain().cell_at(p);
  const BlockIndex b = grid_.topology().find(block_of(cell));
  if (b == kNoBlock) return std::nullopt;
  const CellPlace place{b, cell_index(cell.x() & 7, cell.y() & 7, cell.z() & 7)};
  if (!is_wet(grid_.type(place))) return std::nullopt;
  return describe(place);
}

template <class Real>
FluidSnapshot Fluid<Real>::snapshot() const {
  FluidSnapshot s;
  s.cell_size = units_.cell_size;
  s.origin = grid_.domain().origin();
  std::vector<BlockIndex> wet;
  for (const BlockIndex b : grid_.active())
    if (grid_.block(b).wet_cells > 0) wet.push_back(b);
  std::sort(wet.begin(), wet.end(), [&](BlockIndex a, BlockIndex b) {
    const Vec3i p = grid_.topology().coordinate(a), q = grid_.topology().coordinate(b);
    return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
  });
  s.blocks.resize(wet.size());
  parallel_for(0, wet.size(), kBlocksPerTask, [&](std::size_t k) {
    auto& out = s.blocks[k];
    out.origin = grid_.lowest_cell(wet[k]);
    out.fill_level.fill(0), out.velocity_x.fill(0), out.velocity_y.fill(0), out.velocity_z.fill(0);
    for (int n = 0; n < kBlockCells; ++n) {
      if (!is_wet(grid_.block(wet[k]).type[static_cast<std::size_t>(n)])) continue;
      const auto [x, y, z] = cell_position(n);
      const auto at = static_cast<std::size_t>(64 * x + 8 * y + z);
      const WetCell c = describe({wet[k], n});
      out.fill_level[at] = static_cast<float>(c.fill_level);
      out.velocity_x[at] = static_cast<float>(c.velocity.x());
      out.velocity_y[at] = static_cast<float>(c.velocity.y());
      out.velocity_z[at] = static_cast<float>(c.velocity.z());
    }
  });
  return s;
}

template class Fluid<float>;
template class Fluid<double>;

}  // namespace lahar::lbm
