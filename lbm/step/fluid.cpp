#include "lbm/step/fluid.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include "core/check.h"
#include "core/parallel.h"
#include "lbm/grid/block_sum.h"
#include "lbm/step/dry_blocks.h"
#include "lbm/step/rescale.h"
#include "lbm/step/speed_census.h"

namespace lahar::lbm {

namespace {

constexpr std::size_t kBlocksPerTask = 8;   // a group of the population layout
constexpr std::int64_t kWatchEvery = 32;    // steps between looks at what the sweeps saw
constexpr std::int64_t kReleaseEvery = 16;  // steps between rounds of giving blocks back
// A splash may hold a few cells at kLargestSpeed; more than that, and the limit would hide a time step that is too
// long.
constexpr double kLimitedCells = 100, kLimitedShare = 0.02;  // the latter of all wet cells

std::string describe_place(const Vec3& p) {
  char text[96];
  std::snprintf(text, sizeof text, "fluid cell at (%.4g, %.4g, %.4g) m", p.x(), p.y(), p.z());
  return text;
}

}  // namespace

template <class Real>
Fluid<Real>::Fluid(FluidOptions options)
    : options_(std::move(options)),
      level_{{options_.domain, units_of(options_).velocity_to_lu(1.0)},
             units_of(options_),
             parameters_of(options_, units_of(options_))},
      clock_(options_.time_step),
      coming_time_step_(options_.time_step),
      time_steps_(options_.time_step) {
  for (const InflowOptions& inflow : options_.inflows) inflows_.emplace_back(inflow, level_.grid.domain());
  if (options_.adaptive_time_step) control_.emplace(time_step_limits(options_, level_.grid.domain()));
}

template <class Real>
void Fluid<Real>::step() {
  const double ratio = plan_time_step() / level_.units.time_step;
  if (ratio != 1) stretch_impulses(ratio);
  ratio == 1 ? feed() : keep_waiting();  // what has just come in would be taken for pressure, and rescaled
  exchange();
  if (ratio != 1) rescale(ratio);
  brake();  // when what gas sends is known: what comes out of walls is no flow of mass over links
  sweep();
  level_.parameters.parity = level_.parity().next();
  {
    const ScopedTimer timer(timers_.section("fluid.conversion"));
    conversion_.run(level_, account_);
  }
  reflect();  // after the conversion: what a mirror sends to gas is another thing than what it sends to a new cell
  clock_.advance();
  if (ratio != 1) clock_.set_time_step(level_.units.time_step);
  if (!control_ && steps() % kWatchEvery == 0) watch();
  if (steps() % kReleaseEvery == 0) {
    const ScopedTimer timer(timers_.section("fluid.blocks"));
    release_dry_blocks(level_.grid);
  }
}

template <class Real>
double Fluid<Real>::plan_time_step(double speed_of_bodies) {
  if (control_ && looked_at_ != steps() && (steps() == 1 || (steps() > 0 && steps() % kLookEvery == 0)))
    look(speed_of_bodies);
  return coming_time_step_;
}

/// A look for the watchdog and for the choice of the step.
template <class Real>
void Fluid<Real>::look(double speed_of_bodies) {
  looked_at_ = steps();
  watch();
  const SpeedCensus census = take_speed_census(level_.grid, level_.parity());
  const double uncounted = control_->limits().uncounted;
  const double chosen = control_->choose(
      level_.units.time_step, {census.speed.cells() > 0, census.speed.exceeded_by(uncounted),
                               census.reach.exceeded_by(uncounted), level_.units.velocity_to_lu(speed_of_bodies)});
  if (chosen != level_.units.time_step) set_time_step(chosen);
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
  for (const BlockIndex b : level_.grid.owned())
    if (ImpulseFields<Real>* impulse = level_.grid.block(b).impulse)
      for (Real* field : {impulse->x, impulse->y, impulse->z})
        for (int n = 0; n < kBlockCells; ++n) field[n] *= static_cast<Real>(ratio);
}

/// Lattice units are those of the given step.
template <class Real>
void Fluid<Real>::take_time_step(double time_step) {
  options_.time_step = time_step;
  level_.units = units_of(options_);
  const Parity parity = level_.parameters.parity;
  const bool keep_velocity = level_.parameters.keep_velocity;
  level_.parameters = parameters_of(options_, level_.units);
  level_.parameters.parity = parity;
  level_.parameters.keep_velocity = keep_velocity;
  level_.grid.set_velocity_to_lu(level_.units.velocity_to_lu(1.0));
}

/// From here on lattice units are those of the new step.
template <class Real>
void Fluid<Real>::rescale(double ratio) {
  const ScopedTimer timer(timers_.section("fluid.time_step"));
  account_.rescaled += sum_over_blocks<double>(level_.grid, [&](BlockIndex b) {
    return rescale_block(level_.grid, b, level_.parity(), level_.parameters, ratio);
  });
  take_time_step(coming_time_step_);
  time_steps_.note(options_.time_step);
}

template <class Real>
void Fluid<Real>::make_room() {
  for (const Inflow<Real>& inflow : inflows_) inflow.make_room(level_.grid, time(), clock_.time_step());
}

template <class Real>
void Fluid<Real>::keep_waiting() {
  for (Inflow<Real>& inflow : inflows_) inflow.wait(level_.grid, time(), clock_.time_step());
}

template <class Real>
void Fluid<Real>::feed() {
  for (Inflow<Real>& inflow : inflows_) inflow.feed(level_, conversion_, time(), clock_.time_step(), steps(), account_);
}

template <class Real>
void Fluid<Real>::exchange() {
  const ScopedTimer timer(timers_.section("fluid.surface"));
  exchange_through_steps(level_.grid, level_.parity(), account_.walls);
  surface_pass_.run(level_, options_.surface_tension);
}

template <class Real>
void Fluid<Real>::reflect() {
  const ScopedTimer timer(timers_.section("fluid.walls"));
  walls_.reflect(level_, account_.walls);
}

template <class Real>
void Fluid<Real>::brake() {
  const ScopedTimer timer(timers_.section("fluid.walls"));
  walls_.brake(level_);
}

template <class Real>
void Fluid<Real>::sweep() {
  const ScopedTimer timer(timers_.section("fluid.sweep"));
  const BlockSweep<Real> kernels[2][2] = {
      {choose_sweep<Real>(level_.parameters, false, false), choose_sweep<Real>(level_.parameters, false, true)},
      {choose_sweep<Real>(level_.parameters, true, false), choose_sweep<Real>(level_.parameters, true, true)}};
  const auto& owned = level_.grid.owned();
  notes_.assign(owned.size(), {});
  conversion_.begin(level_.grid);
  parallel_for(0, owned.size(), kBlocksPerTask, [&](std::size_t k) {
    Block<Real>& block = level_.grid.block(owned[k]);
    if (block.body && block.wet_cells < kBlockCells) clear_momentum_exchange(*block.body);
    if (block.wet_cells == 0) return;
    const bool mixed = block.wet_cells < kBlockCells || block.surface;
    notes_[k] = kernels[mixed][block.body != nullptr](block, level_.grid.around(owned[k]), level_.parameters);
    if (block.surface) conversion_.flag(level_.grid, owned[k], level_.parity().next(), notes_[k]);
  });
  level_.grid.release_impulses();
  survey_ = survey_of(notes_, owned);
  cell_updates_ += static_cast<double>(survey_.wet);
  account_.limited += static_cast<std::int64_t>(survey_.limited);
  account_.exposed += static_cast<std::int64_t>(survey_.exposed);
  limited_cells_ = std::max(limited_cells_, survey_.held_back);
}

template <class Real>
bool Fluid<Real>::is_in_order() const {
  const double bearable = std::max(kLimitedCells, kLimitedShare * static_cast<double>(survey_.wet));
  return survey_.speed < kNotFinite && static_cast<double>(survey_.held_back) <= bearable;
}

template <class Real>
void Fluid<Real>::watch() const {
  const bool curable = control_ && control_->can_shorten(level_.units.time_step);
  const bool broken = survey_.speed >= kNotFinite;
  if (is_in_order() || (!broken && curable)) return;
  const std::string too_fast =
      "one of many cells at the largest speed of the lattice; the time step is too long: raise max_speed or lower "
      "lattice_velocity";
  if (!level_.grid.exists(survey_.fastest) || level_.grid.block(survey_.fastest).wet_cells == 0)
    throw NumericalFailure("a fluid cell that has gone dry", steps(), broken ? "velocity is not a number" : too_fast);
  auto& grid = const_cast<FluidGrid<Real>&>(level_.grid);
  const CellPlace place = fastest_cell(grid, survey_.fastest, level_.parameters.parity);
  const auto m = outgoing_moments(grid, place, level_.parameters.parity);
  char cause[240];
  std::snprintf(cause, sizeof cause, "velocity (%.4g, %.4g, %.4g) and density %.4g in lattice units: %s",
                static_cast<double>(m.u[0]), static_cast<double>(m.u[1]), static_cast<double>(m.u[2]),
                1.0 + static_cast<double>(m.drho), broken ? "not a number" : too_fast.c_str());
  throw NumericalFailure(describe_place(level_.grid.centre(place.block, place.cell)), steps(), cause);
}

template class Fluid<float>;
template class Fluid<double>;

}  // namespace lahar::lbm
