#include "lbm/free_surface/inflow.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/check.h"
#include "lbm/free_surface/covered_cells.h"
#include "lbm/free_surface/touching.h"
#include "lbm/grid/block_geometry.h"
#include "lbm/step/cell_moments.h"

namespace lahar::lbm {

namespace {

constexpr double kNothingDue = 1e-6;  // cells: more than stored masses are rounded by, even in float
constexpr int kReachOfWalls = 2;      // cells: beside liquid cells there are interface cells, which walls hold
/// Cells: what a column is taken to hold at least. The populations of a cell at the surface are those of a full one: a
/// column that has run dry and takes the stream's velocity in one step throws what stands beside it, the harder the
/// shorter the step.
constexpr double kLeastHeld = 0.25;
/// Mean density of the box over that of the liquid, less one: 33 times the stagnation pressure of a stream of 0.1 lu.
constexpr double kMostCompressed = 0.5;

/// The horizontal axis that liquid comes along, by the larger component of its velocity; -1 if it comes vertically.
int stream_axis(const Vec3& velocity) {
  const int axis = std::abs(velocity.x()) >= std::abs(velocity.y()) ? 0 : 1;
  constexpr double rounding = 1e-6;
  return std::abs(velocity[axis]) > rounding * velocity.norm() ? axis : -1;
}

/// The first and the last cell of a box: of those whose centre lies in [lower, upper).
std::pair<Vec3i, Vec3i> cells_of(const InflowOptions& inflow, const Domain& domain) {
  const auto cell = [&](const Vec3& x) {
    const Vec3 at = (x - domain.origin()) / domain.cell_size() - Vec3::Constant(0.5 + 1e-9);
    return Vec3i(at.array().ceil().cast<int>());
  };
  return {cell(inflow.lower), cell(inflow.upper) - Vec3i::Ones()};
}

}  // namespace

double free_volume(const InflowOptions& inflow, const Domain& domain) {
  const auto [first, last] = cells_of(inflow, domain);
  double cells = 0;
  for (int x = first.x(); x <= last.x(); ++x)
    for (int y = first.y(); y <= last.y(); ++y)
      for (int z = first.z(); z <= last.z(); ++z) cells += domain.classify(Vec3i(x, y, z)) != CellType::wall;
  return std::max(1.0, cells) * std::pow(domain.cell_size(), 3);
}

template <class Real>
Inflow<Real>::Inflow(InflowOptions options, const Domain& domain) : options_(std::move(options)) {
  std::tie(first_, last_) = cells_of(options_, domain);
  require((first_.array() <= last_.array()).all(), "Inflow: the box holds the centre of no cell");
  find_columns(domain);
}

template <class Real>
void Inflow<Real>::find_columns(const Domain& domain) {
  free_.clear(), at_wall_.clear();
  // Row by row along the stream: one that lies wholly at a wall is fed as any other.
  const int along = std::max(0, stream_axis(options_.velocity)), across = 1 - along;
  for (int c = first_[across]; c <= last_[across]; ++c) {
    std::vector<Eigen::Vector2i> free, at_wall;
    for (int a = first_[along]; a <= last_[along]; ++a) {
      Eigen::Vector2i at;
      at[along] = a, at[across] = c;
      (has_wall_behind(domain, at.x(), at.y()) ? at_wall : free).push_back(at);
    }
    if (free.empty()) free.swap(at_wall);
    free_.insert(free_.end(), free.begin(), free.end());
    at_wall_.insert(at_wall_.end(), at_wall.begin(), at_wall.end());
  }
}

/// Whether all cells of a column that can take liquid have a wall close by on the side that the liquid comes from, or
/// an open face beside them, through which it would leave.
template <class Real>
bool Inflow<Real>::has_wall_behind(const Domain& domain, int x, int y) const {
  const int axis = stream_axis(options_.velocity);
  if (axis < 0) return false;
  const Vec3i behind = Vec3i::Unit(axis) * (options_.velocity[axis] > 0 ? -1 : 1);
  const auto type = [&](const Vec3i& cell) { return domain.classify(image_of(domain, cell)); };
  for (int z = first_.z(); z <= last_.z(); ++z) {
    const Vec3i cell(x, y, z);
    if (type(cell) != CellType::gas) continue;
    bool held = type(cell + behind) == CellType::sink;
    for (int n = 1; n <= kReachOfWalls; ++n) held = held || type(cell + n * behind) == CellType::wall;
    if (!held) return false;
  }
  return true;
}

/// Cells, with what is left of the steps before.
template <class Real>
double Inflow<Real>::volume_due(const FluidGrid<Real>& grid, double time, double duration) const {
  const double volume = options_.discharge.volume_until(time + duration) - options_.discharge.volume_until(time);
  return owed_ + volume / std::pow(grid.domain().cell_size(), 3);
}

template <class Real>
void Inflow<Real>::make_room(FluidGrid<Real>& grid, double time, double duration) const {
  if (volume_due(grid, time, duration) < kNothingDue) return;
  const Vec3i first = block_of(first_), last = block_of(last_);
  std::vector<Vec3i> blocks;
  for (int x = first.x(); x <= last.x(); ++x)
    for (int y = first.y(); y <= last.y(); ++y)
      for (int z = first.z(); z <= last.z(); ++z) blocks.emplace_back(x, y, z);
  grid.require_blocks(blocks);
}

template <class Real>
void Inflow<Real>::feed(FluidLevel<Real>& level, CellConversion<Real>& conversion, double time, double duration,
                        std::int64_t step, LiquidAccount& account) {
  owed_ = volume_due(level.grid, time, duration);
  if (owed_ < kNothingDue) return;
  cells_.clear();
  columns_.clear();
  collect(level, conversion, free_);
  const std::size_t free = columns_.size();
  if (owed_ > kLargestDose * static_cast<double>(cells_.size())) collect(level, conversion, at_wall_);
  const double all = (last_ - first_ + Vec3i::Ones()).cast<double>().prod();
  if (owed_ > std::max(all, kLargestDose) || columns_.empty())
    throw NumericalFailure(
        "inflow " + options_.name, step,
        columns_.empty() ? "no free cell in its box" : "its box cannot take the discharge; make it larger");
  const std::span<const Column> columns(columns_);
  double arrived = pour(level, columns.first(free), owed_);
  arrived += pour(level, columns.subspan(free), owed_ - arrived);  // only what the others cannot take
  owed_ -= arrived;
  account.inflow += arrived;
  require_room(step);
}

/// Liquid that can flow off nowhere, as in a tank that is full, is compressed: no liquid is.
template <class Real>
void Inflow<Real>::require_room(std::int64_t step) const {
  double compressed = 0, cells = 0;
  for (const Taker& t : cells_)
    if (t.liquid) compressed += static_cast<double>(t.moments.drho), ++cells;
  if (compressed > kMostCompressed * cells)
    throw NumericalFailure("inflow " + options_.name, step,
                           "what is in its box can flow off nowhere and is compressed to more than 1.5 times its "
                           "density; give it room, or less discharge");
}

/// Into columns, in equal parts as far as they can take them; returns what came in.
template <class Real>
double Inflow<Real>::pour(FluidLevel<Real>& level, std::span<const Column> columns, double due) {
  if (columns.empty() || due < kNothingDue) return 0;
  const double share = share_of_column(columns, due);
  double arrived = 0;
  for (const Column& column : columns) arrived += dose(level, column, std::min(share, largest_dose(column)));
  return arrived;
}

/// What a column gets of what is due; those that cannot take as much get their largest dose.
template <class Real>
double Inflow<Real>::share_of_column(std::span<const Column> columns, double due) {
  std::vector<double> largest;
  for (const Column& column : columns) largest.push_back(largest_dose(column));
  std::sort(largest.begin(), largest.end());
  double rest = due;
  for (std::size_t c = 0; c < largest.size(); ++c) {
    const double even = rest / static_cast<double>(largest.size() - c);
    if (even <= largest[c]) return even;
    rest -= largest[c];
  }
  return largest.back();
}

template <class Real>
double Inflow<Real>::largest_dose(const Column& column) {
  return kLargestDose * static_cast<double>(column.end - column.begin);
}

namespace {

/// What a cell holds that is wetted for the liquid that is to come: where bodies are, what moves as they do until then.
template <class Real>
CellMoments<Real> before_it_comes(const FluidGrid<Real>& grid, CellPlace place, const CellMoments<Real>& entering) {
  const BodyFields<Real>* const body = grid.block(place.block).body;
  if (!body || !(body->exchange_weight[place.cell] > 0)) return entering;
  CellMoments<Real> moments;
  const std::array<Real, 3> u = velocity_of_bodies(*body, place.cell);
  std::copy(u.begin(), u.end(), moments.u);
  return moments;
}

}  // namespace

/// Adds columns with their wet cells, upwards, after wetting the lowest free cell of those that are dry there.
template <class Real>
void Inflow<Real>::collect(FluidLevel<Real>& level, CellConversion<Real>& conversion,
                           const std::vector<Eigen::Vector2i>& places) {
  FluidGrid<Real>& grid = level.grid;
  CellMoments<Real> entering;
  for (int a = 0; a < 3; ++a) entering.u[a] = static_cast<Real>(level.units.velocity_to_lu(options_.velocity[a]));
  for (const Eigen::Vector2i& at : places) {
    const std::size_t begin = cells_.size();
    bool lowest = true;
    for (int z = first_.z(); z <= last_.z(); ++z) {
      const Vec3i cell(at.x(), at.y(), z);
      const CellPlace place{grid.require_block(block_of(cell)), cell_index(at.x() & 7, at.y() & 7, z & 7)};
      const CellType type = grid.type(place);
      if (type == CellType::wall || type == CellType::sink) continue;
      if (type == CellType::gas && lowest) conversion.wet(level, place, before_it_comes(grid, place, entering));
      if (is_wet(grid.type(place))) cells_.push_back({place, {}, 0, 0, false});
      lowest = false;
    }
    if (cells_.size() > begin) columns_.push_back({begin, cells_.size()});
  }
}

/// Mass and momentum into one column; returns the mass as it was stored.
template <class Real>
double Inflow<Real>::dose(FluidLevel<Real>& level, const Column& column, double mass) {
  const std::span<Taker> takers(cells_.data() + column.begin, column.end - column.begin);
  FluidGrid<Real>& grid = level.grid;
  for (Taker& t : takers) {
    const Block<Real>& block = grid.block(t.place.block);
    t.moments = outgoing_moments(grid, t.place, level.parity());
    t.liquid = block.type[static_cast<std::size_t>(t.place.cell)] == CellType::liquid;
    const double mass_of_cell =
        t.liquid ? 1 + static_cast<double>(t.moments.drho) : static_cast<double>(block.surface->mass[t.place.cell]);
    t.held = mass_of_cell - static_cast<double>(body_share(block, t.place.cell));
  }
  share_out(takers, mass);

  // What comes in takes the velocity of the cell that it gets into; what it brings beside that goes to all cells of the
  // column, as one change of velocity.
  Vec3 change = Vec3::Zero();
  double moved = 0;
  for (const Taker& t : takers) {
    const Vec3 own(t.moments.u[0], t.moments.u[1], t.moments.u[2]);
    change += t.dose * (options_.velocity * level.units.velocity_to_lu(1) - own);
    moved += std::max(0.0, t.held) + t.dose;
  }
  change /= std::max(kLeastHeld, moved);
  double arrived = 0;
  for (const Taker& t : takers) arrived += put_in(grid, t, change);
  return arrived;
}

/// Surfaces first: there liquid comes without pressure. Cells that owe some get that before others, those below before
/// those above; what the surfaces cannot take goes to liquid cells in equal parts.
template <class Real>
void Inflow<Real>::share_out(std::span<Taker> takers, double mass) {
  double liquid_cells = 0;
  for (Taker& t : takers) {
    t.dose = 0;
    liquid_cells += t.liquid;
  }
  const auto fill_up_to = [&](Taker& t, double most) {
    if (t.liquid) return;
    const double share = std::clamp(most, 0.0, std::min(mass, kLargestDose - t.dose));
    t.dose += share;
    mass -= share;
  };
  for (Taker& t : takers) fill_up_to(t, -t.held);
  for (Taker& t : takers) fill_up_to(t, mass);
  for (Taker& t : takers)
    if (t.liquid) t.dose = mass / liquid_cells;
}

/// The dose of one cell, and a change of velocity.
template <class Real>
double Inflow<Real>::put_in(FluidGrid<Real>& grid, const Taker& t, const Vec3& change) {
  Block<Real>& block = grid.block(t.place.block);
  Real& store = t.liquid ? block.f(0)[t.place.cell] : block.surface->mass[t.place.cell];
  const Real before = store;
  store += static_cast<Real>(t.dose);
  if (t.liquid && block.surface) block.surface->density[t.place.cell] += static_cast<Real>(t.dose);
  // In a liquid cell the added density is at rest and wants its momentum; in an interface cell the populations stand
  // for the liquid that it holds, whatever its level.
  const double added = t.liquid ? t.dose : 0, density = 1 + static_cast<double>(t.moments.drho) + added;
  ImpulseFields<Real>& impulses = grid.require_impulse(t.place.block);
  Real* const impulse[3] = {impulses.x, impulses.y, impulses.z};
  for (int a = 0; a < 3; ++a)
    impulse[a][t.place.cell] += static_cast<Real>(added * static_cast<double>(t.moments.u[a]) + density * change[a]);
  return static_cast<double>(store) - static_cast<double>(before);
}

template class Inflow<float>;
template class Inflow<double>;

}  // namespace lahar::lbm
