// What can be read from the fluid between two steps.
#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "lbm/grid/block_sum.h"
#include "lbm/step/fluid.h"
#include "lbm/step/row_moments.h"

namespace lahar::lbm {

template <class Real>
double Fluid<Real>::liquid_mass() const {
  const double cells = sum_over_blocks<double>(level_.grid, [&](BlockIndex b) {
    const Block<Real>& block = level_.grid.block(b);
    double sum = 0;
    if (block.wet_cells == 0) return sum;
    BlockMoments<Real> moments;
    find_moments(level_.grid, b, level_.parity(), moments);
    for (int n = 0; n < kBlockCells; ++n) {
      const CellType t = block.type[static_cast<std::size_t>(n)];
      if (!is_wet(t)) continue;
      if (t == CellType::liquid)
        sum += 1.0 + static_cast<double>(moments.drho[n]);
      else
        sum += static_cast<double>(block.surface->mass[n]);
      if (block.body) sum -= static_cast<double>(block.body->solid_fraction[n]);
    }
    return sum;
  });
  return (cells + account_.pool - account_.released - account_.walls.owed) * level_.units.mass();
}

template <class Real>
double Fluid<Real>::mass_drift(double liquid_mass) const {
  const double put_in = initial_mass_ + inflow_mass();
  return put_in <= 0 ? 0.0 : (liquid_mass + outflow_mass() - rescaled_mass() - put_in) / put_in;  // NaN stays NaN
}

template <class Real>
double Fluid<Real>::mass_drift() const {
  return mass_drift(liquid_mass());
}

template <class Real>
std::size_t Fluid<Real>::wet_cells() const {
  return sum_over_blocks<std::size_t>(
      level_.grid, [&](BlockIndex b) { return static_cast<std::size_t>(level_.grid.block(b).wet_cells); });
}

template <class Real>
WetCell Fluid<Real>::describe(CellPlace place, const CellMoments<Real>& m) const {
  const Block<Real>& block = level_.grid.block(place.block);
  const bool liquid = block.type[static_cast<std::size_t>(place.cell)] == CellType::liquid;
  WetCell c;
  c.centre = level_.grid.centre(place.block, place.cell);
  for (int a = 0; a < 3; ++a) c.velocity[a] = level_.units.velocity_to_si(static_cast<double>(m.u[a]));
  c.velocity -=
      0.5 * level_.units.time_step * options_.gravity;  // half of the last force: the velocity between two steps
  const double fill = liquid ? 1.0 : static_cast<double>(block.surface->fill_level[place.cell]);
  const double eps = block.body ? static_cast<double>(block.body->solid_fraction[place.cell]) : 0.0;
  const double dx = level_.units.cell_size;
  c.fill_level = fill;
  c.solid_fraction = std::min(1.0, eps);
  c.liquid_volume = std::max(0.0, fill - eps) * (dx * dx * dx);
  c.pressure = level_.units.pressure_to_si(static_cast<double>(m.drho) / 3);
  return c;
}

template <class Real>
template <class Visit>
void Fluid<Real>::describe_block(BlockIndex b, const Visit& visit) const {
  const Block<Real>& block = level_.grid.block(b);
  BlockMoments<Real> m;
  find_moments(level_.grid, b, level_.parity(), m);
  for (int n = 0; n < kBlockCells; ++n)
    if (is_wet(block.type[static_cast<std::size_t>(n)]))
      visit(n, describe({b, n}, {m.drho[n], {m.u[0][n], m.u[1][n], m.u[2][n]}}));
}

template <class Real>
std::vector<BlockIndex> Fluid<Real>::wet_blocks() const {
  std::vector<BlockIndex> wet;
  for (const BlockIndex b : level_.grid.owned())
    if (level_.grid.block(b).wet_cells > 0) wet.push_back(b);
  return wet;
}

template <class Real>
void Fluid<Real>::for_each_wet_cell(const std::function<void(const WetCell&)>& visit) const {
  for (const BlockIndex b : wet_blocks()) describe_block(b, [&](int, const WetCell& cell) { visit(cell); });
}

template <class Real>
std::size_t Fluid<Real>::wet_block_count() const {
  return wet_blocks().size();
}

template <class Real>
void Fluid<Real>::for_each_wet_block(
    const std::function<void(std::size_t k, std::span<const WetCell> cells)>& visit) const {
  const std::vector<BlockIndex> wet = wet_blocks();
  parallel_for(0, wet.size(), 8, [&](std::size_t k) {
    std::array<WetCell, kBlockCells> cells;
    std::size_t count = 0;
    describe_block(wet[k], [&](int, const WetCell& cell) { cells[count++] = cell; });
    visit(k, {cells.data(), count});
  });
}

template <class Real>
std::optional<WetCell> Fluid<Real>::cell_at(const Vec3& p) const {
  const Vec3i cell = level_.grid.domain().cell_at(p);
  const BlockIndex b = level_.grid.topology().find(block_of(cell));
  if (b == kNoBlock) return std::nullopt;
  const CellPlace place{b, cell_index(cell.x() & 7, cell.y() & 7, cell.z() & 7)};
  if (!is_wet(level_.grid.type(place))) return std::nullopt;
  return describe(place, outgoing_moments(const_cast<FluidGrid<Real>&>(level_.grid), place, level_.parity()));
}

template <class Real>
FluidSnapshot Fluid<Real>::snapshot() const {
  FluidSnapshot s;
  s.cell_size = level_.units.cell_size;
  s.origin = level_.grid.domain().origin();
  std::vector<BlockIndex> wet = wet_blocks();
  std::sort(wet.begin(), wet.end(), [&](BlockIndex a, BlockIndex b) {
    const Vec3i p = level_.grid.topology().coordinate(a), q = level_.grid.topology().coordinate(b);
    return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
  });
  s.blocks.resize(wet.size());
  parallel_for(0, wet.size(), 8, [&](std::size_t k) {
    auto& out = s.blocks[k];
    out.origin = level_.grid.lowest_cell(wet[k]);
    out.fill_level.fill(0), out.velocity_x.fill(0), out.velocity_y.fill(0), out.velocity_z.fill(0);
    describe_block(wet[k], [&](int n, const WetCell& c) {
      const auto [x, y, z] = cell_position(n);
      const auto at = static_cast<std::size_t>(64 * x + 8 * y + z);
      out.fill_level[at] = static_cast<float>(c.fill_level);
      out.velocity_x[at] = static_cast<float>(c.velocity.x());
      out.velocity_y[at] = static_cast<float>(c.velocity.y());
      out.velocity_z[at] = static_cast<float>(c.velocity.z());
    });
  });
  return s;
}

// The class is instantiated elsewhere, without what is defined here.
#define LAHAR_INSTANTIATE(Real)                                                                                    \
  template double Fluid<Real>::liquid_mass() const;                                                                \
  template double Fluid<Real>::mass_drift() const;                                                                 \
  template double Fluid<Real>::mass_drift(double) const;                                                           \
  template std::size_t Fluid<Real>::wet_cells() const;                                                             \
  template std::vector<BlockIndex> Fluid<Real>::wet_blocks() const;                                                \
  template WetCell Fluid<Real>::describe(CellPlace, const CellMoments<Real>&) const;                               \
  template void Fluid<Real>::for_each_wet_cell(const std::function<void(const WetCell&)>&) const;                  \
  template std::size_t Fluid<Real>::wet_block_count() const;                                                       \
  template void Fluid<Real>::for_each_wet_block(const std::function<void(std::size_t, std::span<const WetCell>)>&) \
      const;                                                                                                       \
  template std::optional<WetCell> Fluid<Real>::cell_at(const Vec3&) const;                                         \
  template FluidSnapshot Fluid<Real>::snapshot() const;
LAHAR_INSTANTIATE(float)
LAHAR_INSTANTIATE(double)
#undef LAHAR_INSTANTIATE

}  // namespace lahar::lbm
