#include "lbm/free_surface/inflow.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/check.h"
#include "lbm/free_surface/covered_cells.h"
#include "lbm/step/cell_moments.h"

namespace lahar::lbm {

namespace {

constexpr double kNothingDue = 1e-12;  // cells

}  // namespace

template <class Real>
Inflow<Real>::Inflow(InflowOptions options, const Domain& domain) : options_(std::move(options)) {
  // Cells whose centre lies in [lower, upper).
  for (int a = 0; a < 3; ++a) {
    const auto cell = [&](double x) {
      return static_cast<int>(std::ceil((x - domain.origin()[a]) / domain.cell_size() - 0.5 - 1e-9));
    };
    first_[a] = cell(options_.lower[a]);
    last_[a] = cell(options_.upper[a]) - 1;
    require(first_[a] <= last_[a], "Inflow: the box holds the centre of no cell");
  }
}

/// Cells, with what is left of the steps before.
template <class Real>
double Inflow<Real>::volume_due(const FluidGrid<Real>& grid, double time, double duration) const {
  const double volume = options_.discharge.volume_until(time + duration) - options_.discharge.volume_until(time);
  return owed_ + volume / std::pow(grid.domain().cell_size(), 3);
}

template <class Real>
void Inflow<Real>::make_room(FluidGrid<Real>& grid, double time, double duration) const {
  if (std::abs(volume_due(grid, time, duration)) < kNothingDue) return;
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
  if (std::abs(owed_) < kNothingDue) return;
  collect(level, conversion);
  const double cells = (last_ - first_ + Vec3i::Ones()).cast<double>().prod();
  if (owed_ > std::max(cells, kLargestDose) || wet_.empty())
    throw NumericalFailure(
        "inflow " + options_.name, step,
        wet_.empty() ? "no free cell in its box" : "its box cannot take the discharge; make it larger");
  const double mass = std::min(kLargestDose, owed_ / static_cast<double>(wet_.size()));
  double arrived = 0;
  for (const CellPlace& place : wet_) arrived += dose(level, place, mass);
  owed_ -= arrived;
  account.inflow += arrived;
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

/// Lists the wet cells of the box after wetting the lowest free cell of each column that is dry there.
template <class Real>
void Inflow<Real>::collect(FluidLevel<Real>& level, CellConversion<Real>& conversion) {
  FluidGrid<Real>& grid = level.grid;
  wet_.clear();
  CellMoments<Real> entering;
  for (int a = 0; a < 3; ++a) entering.u[a] = static_cast<Real>(level.units.velocity_to_lu(options_.velocity[a]));
  for (int x = first_.x(); x <= last_.x(); ++x)
    for (int y = first_.y(); y <= last_.y(); ++y) {
      bool lowest = true;
      for (int z = first_.z(); z <= last_.z(); ++z) {
        const Vec3i cell(x, y, z);
        const CellPlace place{grid.require_block(block_of(cell)), cell_index(x & 7, y & 7, z & 7)};
        const CellType type = grid.type(place);
        if (type == CellType::wall || type == CellType::sink) continue;
        if (type == CellType::gas && lowest) conversion.wet(level, place, before_it_comes(grid, place, entering));
        if (is_wet(grid.type(place))) wet_.push_back(place);
        lowest = false;
      }
    }
}

/// Mass and momentum into one cell; returns the mass as it was stored.
template <class Real>
double Inflow<Real>::dose(FluidLevel<Real>& level, CellPlace place, double mass) const {
  FluidGrid<Real>& grid = level.grid;
  Block<Real>& block = grid.block(place.block);
  const bool liquid = block.type[static_cast<std::size_t>(place.cell)] == CellType::liquid;
  const auto m = outgoing_moments(grid, place, level.parity());
  Real& store = liquid ? block.f(0)[place.cell] : block.surface->mass[place.cell];
  const Real before = store;
  store += static_cast<Real>(mass);
  if (liquid && block.surface) block.surface->density[place.cell] += static_cast<Real>(mass);
  // In a liquid cell the added density is at rest and wants its own momentum; in an interface cell the populations
  // stand for the mass there was, and take the velocity of the mixture.
  const double density = 1 + static_cast<double>(m.drho), held = std::max(1e-3, static_cast<double>(before));
  const double weight = liquid ? mass : density * mass / (held + mass);
  ImpulseFields<Real>& impulses = grid.require_impulse(place.block);
  Real* const impulse[3] = {impulses.x, impulses.y, impulses.z};
  for (int a = 0; a < 3; ++a) {
    const double entering = level.units.velocity_to_lu(options_.velocity[a]);
    const double change = liquid ? entering : entering - static_cast<double>(m.u[a]);
    impulse[a][place.cell] += static_cast<Real>(weight * change);
  }
  return static_cast<double>(store) - static_cast<double>(before);
}

template class Inflow<float>;
template class Inflow<double>;

}  // namespace lahar::lbm
