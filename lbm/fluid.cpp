#include "lbm/fluid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

#include "core/capillary.h"
#include "core/check.h"
#include "core/parallel.h"
#include "lbm/boundary/slip_wall.h"
#include "lbm/boundary/wall_balance.h"
#include "lbm/boundary/wall_reflection.h"
#include "lbm/collision/cell_state.h"
#include "lbm/equilibrium.h"
#include "lbm/free_surface/surface_exchange.h"
#include "lbm/rescale.h"
#include "lbm/row_types.h"

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
  p.coverage = coverage_law(o.weighting, p.tau, o.seepage_constant);
  p.places_walls = o.weighting == BodyWeighting::wall_distance;
  p.solid_operator = o.solid_operator;
  p.smagorinsky = o.smagorinsky;
  // The Smagorinsky constant is that of a Newtonian inertial range; in a plug its eddy viscosity would hide the yield
  // stress.
  require(o.time_step <= capillary_time_step(o.density, o.domain.cell_size, o.surface_tension) * (1 + 1e-9),
          "Fluid: the time step is longer than ripples of two cells allow (core/capillary.h)");
  require(o.rheology.law == FlowLaw::newtonian || o.smagorinsky == 0,
          "Fluid: Smagorinsky is for Newtonian fluids alone");
  require(!turns_populations(o.solid_operator) || (o.rheology.law == FlowLaw::newtonian && o.smagorinsky == 0),
          "Fluid: solid operators that turn populations are for a constant viscosity alone");
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

namespace {

/// The part of population i that carries a stress (second moments less their equilibrium): w_i 9/2 (c c - 1/3) : S.
double stress_part(int i, const Mat3& stress) {
  const Vec3 c(D3Q19::c[i][0], D3Q19::c[i][1], D3Q19::c[i][2]);
  return 4.5 * D3Q19::w(i) * (c.dot(stress * c) - stress.trace() / 3);
}

}  // namespace

template <class Real>
void Fluid<Real>::initialize(CellPlace place, double drho, const Vec3& u, const Mat3& stress) {
  grid_.require_neighbours(place);
  const auto r = static_cast<Real>(drho), x = static_cast<Real>(u.x()), y = static_cast<Real>(u.y()),
             z = static_cast<Real>(u.z());
  const auto population = [&](int i) { return equilibrium(i, r, x, y, z) + static_cast<Real>(stress_part(i, stress)); };
  grid_.block(place.block).f(0)[place.cell] = population(0);
  for (int a = 1; a < D3Q19::q; a += 2) {
    const auto pair = grid_.access(place, a, parameters_.parity);
    const Real fa = population(a), fb = population(a + 1);
    // What the cell sends out is what its neighbours receive; from neighbours that send nothing it receives its own.
    *pair.outgoing_a = fa;
    *pair.outgoing_b = fb;
    if (!is_wet(grid_.type(grid_.neighbour(place, a)))) *pair.incoming_b = fb;
    if (!is_wet(grid_.type(grid_.neighbour(place, a + 1)))) *pair.incoming_a = fa;
  }
}

namespace {

/// rho - 1 of liquid at rest under the top of its region (z is the direction of depth): p = rho g h = cs^2 (rho - 1).
double resting_density(double z, const LiquidRegion& region, double gravity_z, const LatticeUnits& units) {
  const double depth_lu = std::max(0.0, region.upper.z() - z) / units.cell_size;
  return std::max(0.0, -3 * units.acceleration_to_lu(gravity_z) * depth_lu);
}

/// Volume of the part of a cell that lies in a box, as a fraction of the cell.
double overlap_fraction(const Vec3& centre, double dx, const LiquidRegion& r) {
  double fraction = 1;
  for (int a = 0; a < 3; ++a) {
    const double low = std::max(centre[a] - dx / 2, r.lower[a]), high = std::min(centre[a] + dx / 2, r.upper[a]);
    fraction *= std::clamp((high - low) / dx, 0.0, 1.0);
  }
  return fraction;
}

/// The same of a body, from its signed distance in eight parts of the cell: exact where the surface is flat and lies
/// along the lattice.
double body_fraction(const Vec3& centre, double dx, const Shape& body) {
  double fraction = 0;
  for (int k = 0; k < 8; ++k) {
    const Vec3 part = centre + dx / 4 * Vec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
    const double d = std::visit([&](const auto& s) { return s.distance(part); }, body);
    fraction += std::clamp(0.5 - d / (dx / 2), 0.0, 1.0) / 8;
  }
  return fraction;
}

}  // namespace

template <class Real>
void Fluid<Real>::fill(const std::vector<LiquidRegion>& regions) {
  const double dx = units_.cell_size;
  std::vector<BlockIndex> touched;
  std::vector<std::pair<CellPlace, const LiquidRegion*>> wet;
  for (const auto& region : regions) {
    std::set<BlockIndex> filled;  // along a periodic axis the block beyond the end is the first one again
    const Vec3i low = block_of(grid_.domain().cell_at(region.lower)),
                high = block_of(grid_.domain().cell_at(region.upper));
    for (int x = low.x(); x <= high.x(); ++x)
      for (int y = low.y(); y <= high.y(); ++y)
        for (int z = low.z(); z <= high.z(); ++z) {
          const BlockIndex b = grid_.require_block({x, y, z});
          if (!filled.insert(b).second) continue;
          touched.push_back(b);
          for (int n = 0; n < kBlockCells; ++n) {
            Block<Real>& block = grid_.block(b);
            CellType& type = block.type[static_cast<std::size_t>(n)];
            const double fraction = region.body ? body_fraction(grid_.centre(b, n), dx, *region.body)
                                                : overlap_fraction(grid_.centre(b, n), dx, region);
            if (type == CellType::wall || type == CellType::sink || fraction < 1e-6) continue;
            SurfaceFields<Real>& surface = grid_.require_surface(b);
            if (type == CellType::gas) wet.push_back({{b, n}, &region});
            type = CellType::interface;
            surface.fill_level[n] = std::min(Real(1), surface.fill_level[n] + static_cast<Real>(fraction));
            surface.mass[n] =
                surface.fill_level[n] *
                static_cast<Real>(1 + resting_density(grid_.centre(b, n).z(), region, options_.gravity.z(), units_));
          }
        }
  }
  for (const auto& [place, region] : wet)
    initialize(place, resting_density(grid_.centre(place.block, place.cell).z(), *region, options_.gravity.z(), units_),
               units_.velocity_to_lu(1.0) * region->velocity);
  classify_filled(touched);
  reflect();  // what is on its way into a wall at the start comes back: without it the mass would change
  open_ledger();
}

/// Full cells without a gas neighbour are liquid; all lists are made.
template <class Real>
void Fluid<Real>::classify_filled(std::vector<BlockIndex>& touched) {
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  std::vector<CellPlace> full;
  for (const BlockIndex b : touched) {
    const Block<Real>& block = grid_.block(b);
    for (int n = 0; n < kBlockCells; ++n) {
      const auto at = static_cast<std::size_t>(n);
      if (block.type[at] != CellType::interface || block.at_rim[at] || block.surface->fill_level[n] < Real(0.999999))
        continue;
      bool closed = true;
      for (int i = 1; i < D3Q19::q; ++i) {
        const CellType t = grid_.type(grid_.neighbour({b, n}, i));
        closed = closed && t != CellType::gas && t != CellType::sink;
      }
      if (closed) full.push_back({b, n});
    }
  }
  for (const CellPlace& p : full) {
    grid_.block(p.block).type[static_cast<std::size_t>(p.cell)] = CellType::liquid;
    grid_.block(p.block).surface->mass[p.cell] = 0;
  }
  for (const BlockIndex b : touched) grid_.relist(b);
}

/// Stress after a collision that a velocity field keeps up: (1 - 1/tau) S with S = -2/3 tau D (Chapman-Enskog) and D
/// the deviator of the strain rate, from differences over one cell.
template <class Real>
Mat3 Fluid<Real>::flow_stress(const std::function<Vec3(const Vec3&)>& velocity_lu, const Vec3& centre) const {
  Mat3 gradient;
  for (int a = 0; a < 3; ++a) {
    const Vec3 half = 0.5 * units_.cell_size * Vec3::Unit(a);
    gradient.col(a) = velocity_lu(centre + half) - velocity_lu(centre - half);
  }
  const Mat3 strain = 0.5 * (gradient + gradient.transpose());
  return -2.0 / 3.0 * (parameters_.tau - 1) * (strain - strain.trace() / 3 * Mat3::Identity());
}

template <class Real>
void Fluid<Real>::fill_everything(const std::function<Vec3(const Vec3&)>& velocity_lu,
                                  const std::function<double(const Vec3&)>& drho, Start start) {
  const Vec3i first = grid_.domain().first(), last = first + grid_.domain().cells() - Vec3i::Ones();
  const Vec3i low = block_of(first), high = block_of(last);
  std::vector<CellPlace> wet;
  std::vector<BlockIndex> touched;
  for (int x = low.x(); x <= high.x(); ++x)
    for (int y = low.y(); y <= high.y(); ++y)
      for (int z = low.z(); z <= high.z(); ++z) {
        const BlockIndex b = grid_.require_block({x, y, z});
        touched.push_back(b);
        for (int n = 0; n < kBlockCells; ++n) {
          CellType& type = grid_.block(b).type[static_cast<std::size_t>(n)];
          if (type != CellType::gas) continue;
          type = CellType::liquid;
          wet.push_back({b, n});
        }
      }
  for (const CellPlace& p : wet) {
    const Vec3 centre = grid_.centre(p.block, p.cell);
    initialize(p, drho(centre), velocity_lu(centre),
               start == Start::with_stress ? flow_stress(velocity_lu, centre) : Mat3(Mat3::Zero()));
  }
  for (const BlockIndex b : touched) grid_.relist(b);
  reflect();
  open_ledger();
}

template <class Real>
void Fluid<Real>::step() {
  const double ratio = plan_time_step() / units_.time_step;
  if (ratio != 1) stretch_kicks(ratio);
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
void Fluid<Real>::stretch_kicks(double ratio) {
  for (const BlockIndex b : grid_.active())
    if (BodyFields<Real>* body = grid_.block(b).body; body && !body->no_kicks)
      for (Real* field : {body->exchange_x, body->exchange_y, body->exchange_z})
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
  const SurfacePhysics<Real> physics{Real(0), static_cast<Real>(kLargestGradient * largest),
                                     static_cast<Real>(tension)};
  const auto& active = grid_.active();
  parallel_for(0, active.size(), kBlocksPerTask, [&](std::size_t k) {
    if (!grid_.has_surface(active[k])) return;
    exchange_over_mirrors(grid_, active[k], parameters_.parity);
    exchange_surface(grid_, active[k], parameters_.parity, physics);
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
    if (block.wet_cells == 0) return;
    const bool mixed = block.wet_cells < kBlockCells || block.surface;
    notes_[k] = kernels[mixed][block.body != nullptr](block, grid_.around(active[k]), parameters_);
    if (block.surface) conversion_.flag(grid_, k, parameters_.parity.next(), notes_[k]);
  });
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
  const WallPhysics physics{(parameters_.tau - 0.5) / 3, parameters_.gravity};
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
