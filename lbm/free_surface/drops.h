#pragma once
// Spray: interface cells whose mass has nowhere to flow. Mass moves between wet cells only, and gas is wetted only when
// a cell fills up. A drop smaller than a cell, or a sheet thinner than one, would hang in the air for ever while
// gravity went on to accelerate it, until it was faster than sound. Such a cell moves on as a whole instead, with its
// mass and velocity, one cell at a time.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "lbm/boundary/slip_wall.h"
#include "lbm/grid/fluid_grid.h"
#include "lbm/step/cell_moments.h"

namespace lahar::lbm {

/// A cell that moves on in this step, with what it carries along.
template <class Real>
struct Drop {
  std::uint16_t cell;
  std::uint8_t direction;  ///< axis velocity, 1..6
  CellMoments<Real> moments;
};

/// The draw of a round, in [0, 1): multiples of the golden ratio fill it evenly (Weyl 1916).
inline double drop_draw(std::uint64_t round) {
  constexpr double kGolden = 0.6180339887498949;
  const double multiple = static_cast<double>(round) * kGolden;
  return multiple - std::floor(multiple);
}

/// Whether a drop no faster than this, lu, may move in a round: |u_x| + |u_y| + |u_z| <= sqrt(3) |u|.
inline bool drops_may_move(double speed, std::uint64_t round) {
  return drop_draw(round) < 1.001 * std::sqrt(3.0) * speed;
}

/// The axis velocity along which a drop moves on in a step, 0 for none: in a share |u_k| of all steps along axis k. All
/// take the same draw, so that the mean speed is right without a stored displacement, and neighbours of like velocity
/// move in the same step.
template <class Real>
int drop_direction(const Real (&u)[3], std::uint64_t round) {
  double draw = drop_draw(round);
  for (int k = 0; k < 3; ++k) {
    draw -= std::abs(static_cast<double>(u[k]));
    if (draw < 0) return 2 * k + (u[k] > 0 ? 1 : 2);
  }
  return 0;
}

/// Whether a cell stands at a wall in steps.
template <class Real>
bool on_steps(const Block<Real>& block, std::uint16_t cell) {
  return std::ranges::any_of(block.walls.cells, [&](const WallCell& w) { return w.cell == cell && is_in_steps(w); });
}

/// Whether mass of an interface cell can only go along axis velocity i by moving the cell: no liquid around it, nothing
/// wet ahead (none of the five cells that mass would flow to), and no flow or wall from behind. A step behind does not
/// hold the cell: down a slope of 45 degrees one is behind it wherever it stands.
template <class Real>
bool is_free_to_move(const FluidGrid<Real>& grid, CellPlace place, int i) {
  const auto is_empty = [](CellType t) { return t == CellType::gas || t == CellType::sink; };
  if (!is_empty(grid.type(grid.neighbour(place, i)))) return false;
  const CellType behind = grid.type(grid.neighbour(place, D3Q19::opposite(i)));
  const bool step = behind == CellType::wall && on_steps(grid.block(place.block), place.cell);
  if (!is_empty(behind) && !step) return false;
  for (int k = 1; k < D3Q19::q; ++k) {
    const CellType type = grid.type(grid.neighbour(place, k));
    const auto *c = D3Q19::c[i], *d = D3Q19::c[k];
    const bool ahead = c[0] * d[0] + c[1] * d[1] + c[2] * d[2] > 0;
    if (type == CellType::liquid || (ahead && type == CellType::interface)) return false;
  }
  return true;
}

}  // namespace lahar::lbm
