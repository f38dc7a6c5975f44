#pragma once
// One block of 8 x 8 x 8 cells: populations for every cell, and optional fields only where the block needs them.
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/geometry.h"
#include "lbm/grid/cells.h"
#include "lbm/grid/pool.h"

namespace lahar::lbm {

/// Fields of blocks that hold interface cells.
template <class Real>
struct SurfaceFields {
  alignas(64) Real mass[kBlockCells];        ///< lu; interface cells only, bodies in the cell included
  alignas(64) Real fill_level[kBlockCells];  ///< 0..1; 1 in liquid, 0 in gas; of the last conversion
  alignas(64) Real density[kBlockCells];     ///< rho - 1, written by the sweep
  /// Bound on the relaxation rate (collision/stress_limit.h), written by exchange_surface before each sweep.
  alignas(64) Real largest_rate[kBlockCells];
  /// What interface cells have sent across their faces, by 2 axis + (1 downwards); of each step (face_sums.h).
  alignas(64) Real sent[6][kBlockCells];
  std::array<std::uint16_t, kBlockCells> cells;  ///< the interface cells, ascending
  /// Interface cells without liquid around at the start of the step, written by exchange_surface.
  std::array<bool, kBlockCells> alone;
  std::uint64_t rows = 0;  ///< rows with interface cells, by bit y + 8 z
  int count = 0;
  int exposed = 0;  ///< interface cells with a bound on their relaxation rate
};

/// Fields of blocks that bodies reach, or whose velocity is sampled. The first six and the bits of covered cells are
/// written before a step by who knows the bodies; the others are what the sweep leaves.
template <class Real>
struct BodyFields {
  alignas(64) Real solid_fraction[kBlockCells];       ///< sum over bodies, may exceed 1 where bodies overlap
  alignas(64) Real exchange_weight[kBlockCells];      ///< sum over bodies of their weights in the cell's exchange
  alignas(64) Real drag[kBlockCells];                 ///< what B follows from (collision/coverage_weight.h)
  alignas(64) Real weighted_velocity_x[kBlockCells];  ///< sum over bodies of exchange weight times velocity, lu
  alignas(64) Real weighted_velocity_y[kBlockCells];
  alignas(64) Real weighted_velocity_z[kBlockCells];
  /// Momentum that the fluid gave to the bodies in the cell in the last step, lu; 0 in dry cells.
  alignas(64) Real momentum_exchange_x[kBlockCells];
  alignas(64) Real momentum_exchange_y[kBlockCells];
  alignas(64) Real momentum_exchange_z[kBlockCells];
  /// What of it is of liquid that interface cells lack: the bodies do not get it (free_surface/lacking_liquid.h).
  alignas(64) Real lacking_x[kBlockCells];
  alignas(64) Real lacking_y[kBlockCells];
  alignas(64) Real lacking_z[kBlockCells];
  alignas(64) Real coverage_weight[kBlockCells];  ///< B of the last step; 0 in dry cells
  /// Velocity after the last collision but for half a step of gravity, lu, in wet cells (keep_velocity of the sweep).
  alignas(64) Real velocity_x[kBlockCells];
  alignas(64) Real velocity_y[kBlockCells];
  alignas(64) Real velocity_z[kBlockCells];
  /// Cells that a body takes over whole (free_surface/covered_cells.h): by rows y + 8 z, bit x.
  std::array<std::uint8_t, kBlockCells / kBlockWidth> covered;
  /// Bodies end where the water ends: their fraction here is in proportion to the fill level, and a cell that empties
  /// gives them up with its water. Else a wet cell holds all of them that is in its place.
  bool fills_with_level;
  bool lacks;  ///< lacking_x to _z are set; else they count as 0
};

/// The sweep leaves out dry rows: to be called before it where there are some.
template <class Real>
void clear_momentum_exchange(BodyFields<Real>& body) {
  for (Real* field :
       {body.momentum_exchange_x, body.momentum_exchange_y, body.momentum_exchange_z, body.coverage_weight})
    std::fill(field, field + kBlockCells, Real(0));
}

/// Momentum that cells get from outside in the coming step, lu: from wires and grains by their drag laws, and from
/// inflows. Only blocks that somebody writes to hold it, and only until the sweep has used it up.
template <class Real>
struct ImpulseFields {
  alignas(64) Real x[kBlockCells];
  alignas(64) Real y[kBlockCells];
  alignas(64) Real z[kBlockCells];
};

/// A cell next to a wall, with its links into the wall.
struct WallCell {
  std::uint16_t cell;
  std::uint16_t first_link;
  std::uint8_t links;
  WallSlip slip;
  std::array<float, 3> normal;            ///< unit, out of the wall
  std::array<float, 3> surface_velocity;  ///< of the wall there, m/s
  std::array<float, 3> wall_velocity;     ///< the same, lu
  float distance;                         ///< of the cell centre from the wall, lu
  float roughness;                        ///< k_s, lu; WallSlip::wall_model
  std::int16_t wall = -1;                 ///< index of the wall in the domain
  /// Whether the links' pushes cancel for any velocity along the wall, as they do on a flat wall along the lattice.
  bool even = true;
};

/// One velocity into walls in a row of cells, where what comes back is a copy of what was sent: off walls at rest and
/// mirrors (boundary/row_reflection.h). Cells of a row are named by bits.
struct RowLink {
  std::uint8_t row;           ///< y + 8 z
  std::uint8_t direction;     ///< velocity into the wall
  std::uint8_t along;         ///< its part along a mirror where that leads to another cell, else 0
  std::uint8_t source;        ///< velocity of what comes back: from that other cell into the wall, else `direction`
  std::uint8_t cells;         ///< that have this link
  std::uint8_t mirrored = 0;  ///< of them, those whose link led to another cell at the last reflection (slip_wall.h)
};

/// Where a link meets its wall; only with WallPlacement::interpolated.
struct WallHit {
  float share;         ///< of the link, from the cell centre
  float surface_push;  ///< c_i . u_wall there, m/s
  float push;          ///< the same, lu
};

struct WallLinks {
  std::vector<WallCell> cells;
  std::vector<std::uint16_t> others;     ///< entries of `cells` whose links are not copies by rows
  std::vector<RowLink> rows;             ///< the links that are
  std::vector<std::uint8_t> directions;  ///< velocity index pointing into the wall
  std::vector<WallHit> hits;             ///< one per direction, or empty
  std::vector<double> gains;  ///< per cell: mass that its links will add in the coming sweep, lu (wall_balance.h)
  double gained = 0;          ///< sum of what liquid cells got in the last sweep, lu
  bool brakes = false;        ///< some mirror has the wall model (boundary/wall_braking.h)
  int takers = 0;  ///< entries of liquid cells whose links may add mass, or of those that got some: whichever are more
  void clear() {
    cells.clear(), others.clear(), rows.clear(), directions.clear(), hits.clear(), gains.clear();
    gained = 0, takers = 0, brakes = false;
  }
  /// Lattice velocities of walls from those in m/s: the same whether set at once or after others.
  void set_velocities(double velocity_to_lu) {
    const auto to_lu = [&](float v) { return static_cast<float>(velocity_to_lu * static_cast<double>(v)); };
    for (WallCell& c : cells)
      for (std::size_t a = 0; a < 3; ++a) c.wall_velocity[a] = to_lu(c.surface_velocity[a]);
    for (WallHit& h : hits) h.push = to_lu(h.surface_push);
  }
};

template <class Real>
struct Block {
  static constexpr std::size_t stride = PopulationPool<Real>::stride;

  std::array<CellType, kBlockCells> type;
  std::array<bool, kBlockCells> at_rim;  ///< a neighbour is a sink: never liquid, what exceeds 1 has left
  Real* populations = nullptr;
  SurfaceFields<Real>* surface = nullptr;
  BodyFields<Real>* body = nullptr;
  ImpulseFields<Real>* impulse = nullptr;  ///< only together with `body`
  WallLinks walls;
  int wet_cells = 0;
  std::uint64_t wet_rows = 0;  ///< rows of 8 cells along x with wet cells, by bit y + 8 z
  std::uint64_t birth = 0;     ///< unique per created block, so that a reused index is not taken for the old block

  [[nodiscard]] Real* f(int i) const { return populations + static_cast<std::size_t>(i) * stride; }
};

}  // namespace lahar::lbm
