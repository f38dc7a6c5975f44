#include "lbm/free_surface/cell_flags.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/simd_math.h"
#include "lbm/free_surface/touching.h"
#include "lbm/grid/row_types.h"
#include "lbm/step/gather.h"

namespace lahar::lbm {

namespace {

constexpr double kThreshold = 0.01;  ///< beyond full or empty before a cell converts: damps flicker
/// More where a body moves: its share of a cell changes by up to its speed in a step, and the mixture follows a step or
/// two later. In lu by its speed; and the most that is added (docs/decisions/0052).
constexpr double kThresholdBySpeed = 2, kLargestAtBodies = 0.1;
/// Liquid that a cell may owe while it waits for a filled neighbour: above the thresholds.
constexpr double kLargestDebt = 0.2;
constexpr double kThinFill = 0.1;  ///< liquid share under which a draining cell with no liquid neighbour is given up

constexpr int kSharpBend = 7;  ///< of 18 neighbours: more gas than liquid around a spike, less in a pit

enum class Verdict { stay, fill, empty };

/// What a body adds to kThreshold in a cell that it has a share of.
template <class Real>
Real threshold_at_body(const BodyFields<Real>& body, int cell) {
  const Real w[3] = {body.weighted_velocity_x[cell], body.weighted_velocity_y[cell], body.weighted_velocity_z[cell]};
  const Real speed =
      std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]) / std::max(body.exchange_weight[cell], Real(1e-6));
  return std::min(static_cast<Real>(kLargestAtBodies), static_cast<Real>(kThresholdBySpeed) * speed);
}

/// A thin cell that gains liquid is the front of a drop or sheet on its way: it is kept. Not so at bodies, whose motion
/// changes the cells' liquid too: films that were kept there held a sinking sphere back at the surface.
template <class Real>
Verdict judge(const FluidGrid<Real>& grid, CellPlace place, Real mass, Real rho, bool at_rim, bool draining) {
  const Real eps = body_share(grid.block(place.block), place.cell), room = std::max(Real(0), Real(1) - eps);
  const Real liquid = mass - eps;
  constexpr auto least = static_cast<Real>(kThreshold);
  if (liquid < -least || (!at_rim && mass > (Real(1) + least) * rho)) {
    const Real threshold = eps > 0 ? least + threshold_at_body(*grid.block(place.block).body, place.cell) : least;
    if (liquid < -threshold) return Verdict::empty;
    if (!at_rim && mass > (Real(1) + threshold) * rho) return Verdict::fill;
  }
  const bool thin = (draining || eps > 0) && liquid<Real(kThinFill) * room, thick = mass> Real(1 - kThinFill) * rho;
  if (!thin && !thick) return Verdict::stay;
  if (thick && !at_rim && !touches_gas(grid, place)) return Verdict::fill;
  if (thin && !touches_liquid(grid, place)) return Verdict::empty;
  return Verdict::stay;
}

/// An interface cell that a body covers has no mass of its own to go by (covered_cells.h). The surface inside a body
/// stays unless it is a spike or a pit, or the water around has come up to it (docs/decisions/0041).
template <class Real>
Verdict judge_covered(const FluidGrid<Real>& grid, CellPlace place, bool at_rim) {
  const auto& around = grid.around(place.block);
  int liquid = 0, gas = 0;
  for (int i = 1; i < D3Q19::q; ++i) {
    const Block<Real>* block = around[kNeighbours.slot(i, place.cell)];
    const CellType t = block ? block->type[static_cast<std::size_t>(kNeighbours.cell(i, place.cell))] : CellType::gas;
    liquid += t == CellType::liquid, gas += t == CellType::gas || t == CellType::sink;
  }
  if (gas > liquid + kSharpBend) return Verdict::empty;
  return (gas == 0 || liquid > gas + kSharpBend) && !at_rim ? Verdict::fill : Verdict::stay;
}

template <class Real>
void flag_drop(FluidGrid<Real>& grid, CellPlace place, Parity parity, std::uint64_t round,
               std::vector<Drop<Real>>& drops) {
  const CellMoments<Real> m = outgoing_moments(grid, place, parity);
  const int i = drop_direction(m.u, round);
  if (i != 0 && is_free_to_move(grid, place, i))
    drops.push_back({static_cast<std::uint16_t>(place.cell), static_cast<std::uint8_t>(i), m});
}

/// The interface cells of one block.
template <class Real>
class BlockJudge {
 public:
  BlockJudge(FluidGrid<Real>& grid, BlockIndex b, Parity parity, std::uint64_t round, bool moving,
             Flagged<Real>& flagged)
      : grid_(grid),
        index_(b),
        block_(grid.block(b)),
        surface_(*block_.surface),
        parity_(parity),
        round_(round),
        moving_(moving),
        flagged_(flagged) {}

  /// A row without open faces. Few of its cells can convert: the others only get their fill level.
  template <bool kBody>
  void run_row(int row) {
    using V = Row<Real>;
    const int n = kBlockWidth * row;
    const auto real = [](double x) { return V(static_cast<Real>(x)); };
    const V mass = load<V>(surface_.mass + n), before = load<V>(surface_.fill_level + n);
    const V rho = V(1) + load<V>(surface_.density + n);
    V eps(0), room(1);
    if constexpr (kBody)
      if (!block_.body->fills_with_level) eps = load<V>(block_.body->solid_fraction + n), room = max(V(0), V(1) - eps);
    V fill = mass / rho;
    fill = select(fill < V(0), V(0), fill);
    fill = select(fill > V(1), V(1), fill);
    const V liquid = mass - eps;
    const auto draining = fill <= before;
    const auto empty = liquid<real(-kThreshold), full = mass> real(1 + kThreshold) * rho;
    const auto thin =
        (draining || eps > V(0)) && liquid<real(kThinFill) * room, thick = mass> real(1 - kThinFill) * rho;
    const unsigned interface = interface_cells(block_, row);
    alignas(64) Real levels[kBlockWidth];
    store_aligned(levels, fill);
    const unsigned drains = draining.bits();
    unsigned judged = interface & (empty || full || thin || thick).bits();
    if (kBody) judged |= interface & block_.body->covered[static_cast<std::size_t>(row)];
    if (moving_) judged |= interface & alone(row);
    for (unsigned cells = interface; cells != 0; cells &= cells - 1) {
      const int k = std::countr_zero(cells);
      surface_.fill_level[n + k] = levels[k];
    }
    for (; judged != 0; judged &= judged - 1) {
      const int k = std::countr_zero(judged);
      settle(static_cast<std::uint16_t>(n + k), Real(1) + surface_.density[n + k], (drains >> k & 1U) != 0);
    }
  }

  /// One cell; returns what left through an open face.
  double run_cell(std::uint16_t cell) {
    const Real rho = Real(1) + surface_.density[cell];
    Real& mass = surface_.mass[cell];
    double left = 0;
    if (block_.at_rim[cell] && mass > rho) {
      left = static_cast<double>(mass) - static_cast<double>(rho);
      mass = rho;
    }
    const Real fill = std::clamp(mass / rho, Real(0), Real(1));
    const bool draining = fill <= surface_.fill_level[cell];
    surface_.fill_level[cell] = fill;
    settle(cell, rho, draining);
    return left;
  }

 private:
  void settle(std::uint16_t cell, Real rho, bool draining) {
    const CellPlace place{index_, cell};
    const Verdict v = is_covered(block_, cell)
                          ? judge_covered(grid_, place, block_.at_rim[cell])
                          : judge(grid_, place, surface_.mass[cell], rho, block_.at_rim[cell], draining);
    if (v == Verdict::fill) flagged_.filled.add(cell);
    if (v == Verdict::empty) {
      flagged_.emptied.add(cell);
      const Real liquid = surface_.mass[cell] - body_share(block_, cell);
      if (liquid < static_cast<Real>(-kLargestDebt)) flagged_.owing.add(cell);
    }
    if (moving_ && v == Verdict::stay && surface_.alone[cell]) flag_drop(grid_, place, parity_, round_, flagged_.drops);
  }

  unsigned alone(int row) const {
    std::uint64_t bytes;
    std::memcpy(&bytes, surface_.alone.data() + kBlockWidth * row, sizeof(bytes));
    return gather_bytes(bytes);
  }

  FluidGrid<Real>& grid_;
  const BlockIndex index_;
  const Block<Real>& block_;
  SurfaceFields<Real>& surface_;
  const Parity parity_;
  const std::uint64_t round_;
  const bool moving_;
  Flagged<Real>& flagged_;
};

}  // namespace

template <class Real>
double flag_conversions(FluidGrid<Real>& grid, BlockIndex b, Parity parity, std::uint64_t round, double speed,
                        Flagged<Real>& flagged) {
  const Block<Real>& block = grid.block(b);
  BlockJudge<Real> judge_block(grid, b, parity, round, drops_may_move(speed, round), flagged);
  const auto at_rim = [&](int row) {
    std::uint64_t bytes;
    std::memcpy(&bytes, block.at_rim.data() + kBlockWidth * row, sizeof(bytes));
    return bytes != 0;
  };
  double left = 0;
  for (std::uint64_t rows = block.surface->rows; rows != 0; rows &= rows - 1) {
    const int row = std::countr_zero(rows);
    if (!at_rim(row)) {
      if (block.body)
        judge_block.template run_row<true>(row);
      else
        judge_block.template run_row<false>(row);
      continue;
    }
    for (unsigned cells = interface_cells(block, row); cells != 0; cells &= cells - 1)
      left += judge_block.run_cell(static_cast<std::uint16_t>(kBlockWidth * row + std::countr_zero(cells)));
  }
  return left;
}

template double flag_conversions<float>(FluidGrid<float>&, BlockIndex, Parity, std::uint64_t, double, Flagged<float>&);
template double flag_conversions<double>(FluidGrid<double>&, BlockIndex, Parity, std::uint64_t, double,
                                         Flagged<double>&);

}  // namespace lahar::lbm
