#include "lbm/boundary/row_reflection.h"

#include <algorithm>
#include <tuple>

#include "lbm/boundary/slip_wall.h"
#include "lbm/collision/equilibrium.h"
#include "lbm/grid/mirror_geometry.h"
#include "lbm/grid/row_types.h"
#include "lbm/step/cell_moments.h"

namespace lahar::lbm {

namespace {

constexpr unsigned kWholeRow = 0xFF;

bool is_forward(int i) { return i % 2 == 1; }

/// Where a link leads: off a mirror to the cell beside, else back (lbm/grid/mirror_geometry.h). `lowest`: the block's
/// first cell.
RowLink row_link(const WallCell& wall, int i, const Domain& domain, const Vec3i& lowest) {
  const auto row = static_cast<std::uint8_t>(wall.cell / kBlockWidth), own = static_cast<std::uint8_t>(i);
  RowLink link{row, own, 0, own, static_cast<std::uint8_t>(1U << (wall.cell % kBlockWidth))};
  if (!is_mirror(wall)) return link;
  const MirrorLink parts = mirror_link(i, normal_axis(wall));
  if (parts.into == 0 || parts.along == 0) return link;
  const auto way = [](int k) { return Vec3i(D3Q19::c[k][0], D3Q19::c[k][1], D3Q19::c[k][2]); };
  const auto p = cell_position(wall.cell);
  if (!is_mirror_between(domain, lowest + Vec3i(p[0], p[1], p[2]), way(parts.along), way(parts.into))) return link;
  link.along = static_cast<std::uint8_t>(parts.along);
  link.source = static_cast<std::uint8_t>(parts.mirrored);
  return link;
}

/// Layer by layer and velocity by velocity, as the numbers lie in memory.
auto place_in_memory(const RowLink& a) { return std::tuple(a.row >> 3, a.direction, a.along, a.source, a.row); }

/// Rows beside every row of a block: the block that holds them (neighbour_slot) and the row there, by offset across x.
struct RowTable {
  std::uint8_t slot[9][64];
  std::uint8_t row[9][64];
};

constexpr int offset_across(int cy, int cz) { return 3 * (cy + 1) + cz + 1; }
constexpr int kHere = offset_across(0, 0);

constexpr RowTable make_row_table() {
  RowTable t{};
  for (int cy = -1; cy <= 1; ++cy)
    for (int cz = -1; cz <= 1; ++cz)
      for (int row = 0; row < 64; ++row) {
        const int y = (row & 7) + cy, z = (row >> 3) + cz, offset = offset_across(cy, cz);
        t.slot[offset][row] = static_cast<std::uint8_t>(neighbour_slot(0, y >> 3, z >> 3));
        t.row[offset][row] = static_cast<std::uint8_t>((y & 7) + 8 * (z & 7));
      }
  return t;
}

constexpr RowTable kRows = make_row_table();

/// Where what comes back over velocity i lies, and what the cell at `along` sent over velocity j.
struct WayTable {
  std::uint8_t beside[D3Q19::q];          ///< offset of the cell there
  std::uint8_t back[D3Q19::q];            ///< offset, by i
  std::uint8_t sent[D3Q19::q][D3Q19::q];  ///< offset, by along and j
  std::uint8_t back_slot[2][D3Q19::q];    ///< by parity and i
  std::uint8_t sent_slot[2][D3Q19::q];    ///< by parity and j
};

constexpr WayTable make_way_table() {
  WayTable t{};
  const auto small = [](int n) { return static_cast<std::uint8_t>(n); };
  for (int i = 1; i < D3Q19::q; ++i) {
    const auto& c = D3Q19::c[i];
    const bool forward = i % 2 == 1;
    const int a = forward ? i : i - 1;
    t.beside[i] = small(offset_across(c[1], c[2]));
    t.back[i] = small(forward ? offset_across(c[1], c[2]) : kHere);
    for (int along = 0; along < D3Q19::q; ++along) {
      const auto& d = D3Q19::c[along];
      const int y = d[1] + (forward ? c[1] : 0), z = d[2] + (forward ? c[2] : 0);
      if (y * y <= 1 && z * z <= 1) t.sent[along][i] = small(offset_across(y, z));
    }
    for (const bool odd : {false, true}) {
      const Parity parity{odd};
      t.back_slot[odd][i] = small(forward ? parity.away(a) : parity.home(a));
      t.sent_slot[odd][i] = small(forward ? parity.home(a) : parity.away(a));
    }
  }
  return t;
}

constexpr WayTable kWays = make_way_table();

/// Wet cells beside those of a row, where they exist.
template <class Real>
unsigned wet_beside(const std::array<Block<Real>*, 27>& around, int row, int along) {
  const std::size_t slot = kRows.slot[kWays.beside[along]][row];
  const int row_there = kRows.row[kWays.beside[along]][row], cx = D3Q19::c[along][0];
  const auto wet = [&](std::size_t k) { return around[k] ? wet_cells(*around[k], row_there) : 0U; };
  const unsigned own = wet(slot);
  if (cx > 0) return own >> 1 | (wet(slot + 9) & 1U) << 7;
  if (cx < 0) return (own << 1 & kWholeRow) | wet(slot - 9) >> 7;
  return own;
}

/// Copies the chosen cells of a row; no others are touched, which may be in use by another thread.
template <class Real>
void copy_cells(Real* to, const Real* from, unsigned cells) {
  if (cells == kWholeRow) {
    std::memcpy(to, from, kBlockWidth * sizeof(Real));
  } else if (cells == (kWholeRow & ~1U)) {
    std::memcpy(to + 1, from + 1, (kBlockWidth - 1) * sizeof(Real));
  } else {
    for (; cells != 0; cells &= cells - 1) {
      const int k = std::countr_zero(cells);
      to[k] = from[k];
    }
  }
}

/// The numbers that a row's link copies, seen from the link's own row; those beyond x = 7 lie in the block beside.
template <class Real>
struct RowWay {
  std::size_t to_block, from_block, to_place, from_place;

  RowWay(const RowLink& link, Parity parity) {
    const int to = kWays.back[link.direction], from = kWays.sent[link.along][link.source];
    to_block = kRows.slot[to][link.row], from_block = kRows.slot[from][link.row];
    to_place =
        kWays.back_slot[parity.odd][link.direction] * Block<Real>::stride + kBlockWidth * kRows.row[to][link.row];
    from_place =
        kWays.sent_slot[parity.odd][link.source] * Block<Real>::stride + kBlockWidth * kRows.row[from][link.row];
  }
};

template <class Real>
void copy_row(const std::array<Block<Real>*, 27>& around, const RowLink& link, unsigned cells, Parity parity) {
  const RowWay<Real> way(link, parity);
  const auto copy = [&](std::size_t beyond_x, unsigned chosen) {
    copy_cells(around[way.to_block + beyond_x]->populations + way.to_place,
               around[way.from_block + beyond_x]->populations + way.from_place, chosen);
  };
  if (!is_forward(link.direction) || D3Q19::c[link.direction][0] == 0) return copy(0, cells);
  if (const unsigned near = cells << 1 & kWholeRow) copy(0, near);
  if (cells >> 7) copy(9, 1);
}

/// A mirrored link that ends at gas: anti-bounce-back at the gas pressure. Before the coming step the pass over the
/// surface sets it again, with the place of the surface and its tension (free_surface/surface_exchange.h); what stands
/// here is for the loads of walls.
template <class Real>
void end_at_gas(FluidGrid<Real>& grid, CellPlace place, int i, Parity parity, EquilibriumOrder order) {
  const auto m = outgoing_moments(grid, place, parity);
  const auto link = link_populations(grid, place, i, parity);
  const HigherMoments<Real> higher(order, m.u[0], m.u[1], m.u[2]);
  *link.back = equilibrium_pair_sum(i, Real(0), m.u[0], m.u[1], m.u[2]) + higher.pair_sum(i) - *link.sent;
}

}  // namespace

void list_row_links(WallLinks& walls, const Domain& domain, const Vec3i& lowest) {
  walls.rows.clear(), walls.others.clear();
  for (std::size_t entry = 0; entry < walls.cells.size(); ++entry) {
    const WallCell& wall = walls.cells[entry];
    const bool interpolated = wall.slip == WallSlip::no_slip && domain.placement() == WallPlacement::interpolated;
    if (interpolated || !(stands_still(wall) || is_mirror(wall))) {
      walls.others.push_back(static_cast<std::uint16_t>(entry));
      continue;
    }
    const std::uint8_t* const links = walls.directions.data() + wall.first_link;
    walls.brakes = walls.brakes || (is_mirror(wall) && wall.slip == WallSlip::wall_model);
    for (int k = 0; k < wall.links; ++k) walls.rows.push_back(row_link(wall, links[k], domain, lowest));
  }
  std::sort(walls.rows.begin(), walls.rows.end(),
            [](const RowLink& a, const RowLink& b) { return place_in_memory(a) < place_in_memory(b); });
  std::size_t last = 0;
  for (std::size_t k = 1; k < walls.rows.size(); ++k)
    if (place_in_memory(walls.rows[last]) == place_in_memory(walls.rows[k]))
      walls.rows[last].cells |= walls.rows[k].cells;
    else
      walls.rows[++last] = walls.rows[k];
  if (!walls.rows.empty()) walls.rows.resize(last + 1);
}

template <class Real>
void reflect_rows(FluidGrid<Real>& grid, BlockIndex b, Parity parity, EquilibriumOrder order) {
  const auto& around = grid.around(b);
  Block<Real>& block = *around[13];
  for (RowLink& link : block.walls.rows) {
    unsigned cells = link.cells & wet_cells(block, link.row);
    if (link.along != 0) {
      unsigned at_gas = cells == 0 ? 0 : cells & ~wet_beside(around, link.row, link.along);
      cells &= ~at_gas;
      link.mirrored = static_cast<std::uint8_t>(cells);
      for (; at_gas != 0; at_gas &= at_gas - 1)
        end_at_gas(grid, {b, kBlockWidth * link.row + std::countr_zero(at_gas)}, link.direction, parity, order);
    }
    if (cells != 0) copy_row(around, link, cells, parity);
  }
}

MirroredLinks::MirroredLinks(const WallLinks& walls) {
  for (const RowLink& link : walls.rows) cells_[link.row][link.direction] |= link.mirrored;
}

std::uint32_t MirroredLinks::of(const WallCell& wall, const std::uint8_t* directions) const {
  const auto& row = cells_[static_cast<std::size_t>(wall.cell / kBlockWidth)];
  std::uint32_t links = 0;
  for (int k = 0; k < wall.links; ++k)
    links |= static_cast<std::uint32_t>(row[directions[wall.first_link + k]] >> (wall.cell % kBlockWidth) & 1) << k;
  return links;
}

void MirroredLinks::restore(WallLinks& walls, const std::uint32_t* of_cells) {
  std::array<std::array<std::uint8_t, D3Q19::q>, 64> cells{};
  for (const WallCell& wall : walls.cells) {
    const std::uint32_t links = *of_cells++;
    for (int k = 0; k < wall.links; ++k)
      if (links >> k & 1)
        cells[static_cast<std::size_t>(wall.cell / kBlockWidth)]
             [walls.directions[wall.first_link + static_cast<std::size_t>(k)]] |=
            static_cast<std::uint8_t>(1U << (wall.cell % kBlockWidth));
  }
  for (RowLink& link : walls.rows)
    link.mirrored =
        link.along == 0 ? std::uint8_t{0} : static_cast<std::uint8_t>(cells[link.row][link.direction] & link.cells);
}

LinksAlongMirrors::LinksAlongMirrors(const WallLinks& walls) {
  for (const RowLink& link : walls.rows)
    if (link.along != 0) cells_[link.row][link.direction] |= link.cells;
}

template void reflect_rows<float>(FluidGrid<float>&, BlockIndex, Parity, EquilibriumOrder);
template void reflect_rows<double>(FluidGrid<double>&, BlockIndex, Parity, EquilibriumOrder);

}  // namespace lahar::lbm
