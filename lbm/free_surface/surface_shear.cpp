#include "lbm/free_surface/surface_shear.h"

#include <utility>

#include "lbm/collision/newtonian.h"
#include "lbm/collision/smagorinsky.h"
#include "lbm/collision/stress_limit.h"
#include "lbm/grid/row_types.h"
#include "lbm/rheology/herschel_bulkley.h"
#include "lbm/step/row_moments.h"

namespace lahar::lbm {

namespace {

/// The stress in the liquid of a block and one cell beyond; 0 in other cells.
template <class Real>
struct StressAround {
  static constexpr int pitch_y = 16, pitch_z = 10 * pitch_y, size = 10 * pitch_z;
  alignas(64) Real liquid[size];  ///< 1 in liquid
  alignas(64) Real stress[6][size];
  alignas(64) Real rate[size];  ///< at which it relaxes; 2 in other cells

  static constexpr int at(int x, int y, int z) { return x + 1 + pitch_y * (y + 1) + pitch_z * (z + 1); }
  static constexpr int step(int cx, int cy, int cz) { return cx + cy * pitch_y + cz * pitch_z; }
};

/// Rows y + 1 + 10 (z + 1), y and z from -1 to 8, that are next to the given ones (bit y + 8 z).
std::array<bool, 100> rows_next_to(std::uint64_t rows) {
  std::array<bool, 100> next{};
  for (; rows != 0; rows &= rows - 1) {
    const int row = std::countr_zero(rows), y = row & 7, z = row >> 3;
    for (int k = 0; k < 9; ++k) next[static_cast<std::size_t>(y + k % 3 + 10 * (z + k / 3))] = true;
  }
  return next;
}

template <class Real, template <class> class Viscosity>
class ShearMeasure {
 public:
  using V = Row<Real>;

  ShearMeasure(const FluidGrid<Real>& grid, BlockIndex b, const SweepParameters& p)
      : grid_(grid),
        index_(b),
        parity_(p.parity),
        viscosity_(Viscosity<V>::of(p)),
        limit_(
            static_cast<Real>(p.rheology.law == FlowLaw::newtonian ? stress_limit(p.tau) : stress_limit(p.rheology))) {}

  void run(std::vector<ShearRow<Real>>& out) {
    const SurfaceFields<Real>& surface = *grid_.block(index_).surface;
    const auto needed = rows_next_to(surface.rows);
    unsigned columns = 0;
    for (std::uint64_t rows = surface.rows; rows != 0; rows &= rows - 1)
      columns |= interface_cells(grid_.block(index_), std::countr_zero(rows));
    sides_ = {(columns & 0x01U) != 0, true, (columns & 0x80U) != 0};
    for (int k = 0; k < 100; ++k)
      if (needed[static_cast<std::size_t>(k)]) see_row(k % 10 - 1, k / 10 - 1);
    out.resize(static_cast<std::size_t>(std::popcount(surface.rows)));
    std::size_t n = 0;
    for (std::uint64_t rows = surface.rows; rows != 0; rows &= rows - 1) average(std::countr_zero(rows), out[n++]);
  }

 private:
  /// The row and one cell to either side.
  void see_row(int y, int z) {
    const int place = StressAround<Real>::at(0, y, z);
    for (int bx = -1; bx <= 1; ++bx) {
      const auto slot = static_cast<std::size_t>(neighbour_slot(bx, y >> 3, z >> 3));
      const Block<Real>* block = grid_.around(index_)[slot];
      const int first = cell_index(0, y & 7, z & 7);
      V liquid(0), rate(2), stress[6] = {V(0), V(0), V(0), V(0), V(0), V(0)};
      if (block && sides_[static_cast<std::size_t>(bx + 1)] && sees_liquid(*block, first, bx, liquid))
        stress_of_row(grid_.around(grid_.topology().neighbours(index_)[slot]), first, liquid, stress, rate);
      const auto put = [&](Real * field, const V& values) __attribute__((always_inline)) {
        if (bx == 0)
          store(field + place, values);
        else
          field[place + (bx < 0 ? -1 : 8)] = values[bx < 0 ? 7 : 0];
      };
      put(around_.liquid, liquid), put(around_.rate, rate);
      for (std::size_t k = 0; k < 6; ++k) put(around_.stress[k], stress[k]);
    }
  }

  /// Marks the liquid of a row that no body touches; whether a cell that is asked for holds any.
  static bool sees_liquid(const Block<Real>& block, int first, int bx, V& liquid) {
    const std::uint64_t types = types_of_row(block, first / kBlockWidth);
    unsigned cells = wet_cells(types) & ~interface_cells(types) & (bx < 0 ? 0x80U : bx > 0 ? 0x01U : 0xFFU);
    if (block.body)
      for (int x = 0; x < kBlockWidth; ++x)
        if (block.body->exchange_weight[first + x] > 0) cells &= ~(1U << x);
    liquid = select(V::mask_type::from_bits(cells), V(1), V(0));
    return cells != 0;
  }

  /// sigma and its rate from what comes into the liquid cells of a row; other lanes stay as they are.
  void stress_of_row(const std::array<Block<Real>*, 27>& around, int first, const V& liquid, V (&stress)[6],
                     V& rate) const {
    const Block<Real>& block = *around[13];
    V f[D3Q19::q];
    f[0] = load<V>(block.f(0) + first);
    for_each_pair([&]<int P, int CX, int CY, int CZ>() __attribute__((always_inline)) {
      f[2 * P + 1] = load<V>(block.f(parity_.home(D3Q19::forward(P))) + first);
      f[2 * P + 2] = row_ahead<CX, CY, CZ>(around, parity_.away(D3Q19::forward(P)), first);
    });
    const Moments<V> m = moments(f);
    const Symmetric<V> s = lbm::stress(f, m);
    V omega;
    if constexpr (Viscosity<V>::constant)
      omega = viscosity_.rate();
    else
      omega = viscosity_.rate(s, m.inverse_density);
    rate = select(liquid > V(0), omega, rate);
    const V share = (number<V>(0.5) * omega - V(1)) * limited_stress_share(s, m.inverse_density, limit_);
    const V* const parts[6] = {&s.xx, &s.yy, &s.zz, &s.xy, &s.xz, &s.yz};
    for (int k = 0; k < 6; ++k) stress[k] = select(liquid > V(0), share * *parts[k], stress[k]);
  }

  /// Means over the liquid neighbours of the cells of a row, with the weights of the lattice.
  void average(int row, ShearRow<Real>& out) const {
    const int place = StressAround<Real>::at(0, row & 7, row >> 3);
    V weights(Real(1e-9)), rate(2), way[3] = {V(0), V(0), V(0)}, sum[6] = {V(0), V(0), V(0), V(0), V(0), V(0)};
    const auto add = [&]<int I>() __attribute__((always_inline)) {
      constexpr const int* c = D3Q19::c[I];
      constexpr int step = StressAround<Real>::step(D3Q19::c[I][0], D3Q19::c[I][1], D3Q19::c[I][2]);
      const V w = number<V>(D3Q19::w(I)), there = w * load<V>(around_.liquid + place + step);
      weights += there;
      rate = min(rate, load<V>(around_.rate + place + step));
      for (int k = 0; k < 3; ++k)
        if (c[k] != 0) way[k] += number<V>(c[k]) * there;
      for (int k = 0; k < 6; ++k) sum[k] += w * load<V>(around_.stress[k] + place + step);
    };
    [&]<std::size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
      (add.template operator()<static_cast<int>(I) + 1>(), ...);
    }
    (std::make_index_sequence<D3Q19::q - 1>{});
    store(out.rate, rate);
    const V inverse = V(1) / weights;
    for (int k = 0; k < 3; ++k) store(out.way[k], V(way[k] * inverse));
    for (int k = 0; k < 6; ++k) store(out.stress[k], V(sum[k] * inverse));
  }

  const FluidGrid<Real>& grid_;
  const BlockIndex index_;
  const Parity parity_;
  const Viscosity<V> viscosity_;
  const V limit_;
  std::array<bool, 3> sides_{};  ///< whether an interface cell looks at the blocks at x - 1, 0, 1
  StressAround<Real> around_;
};

}  // namespace

template <class Real>
void measure_shear(const FluidGrid<Real>& grid, BlockIndex b, const SweepParameters& p,
                   std::vector<ShearRow<Real>>& rows) {
  if (!grid.block(b).surface) return rows.clear();
  switch (p.rheology.law) {
    case FlowLaw::bingham:
      return ShearMeasure<Real, Bingham>(grid, b, p).run(rows);
    case FlowLaw::herschel_bulkley:
      return ShearMeasure<Real, HerschelBulkley>(grid, b, p).run(rows);
    case FlowLaw::newtonian:
      break;
  }
  if (p.smagorinsky > 0) return ShearMeasure<Real, Smagorinsky>(grid, b, p).run(rows);
  ShearMeasure<Real, Newtonian>(grid, b, p).run(rows);
}

template void measure_shear<float>(const FluidGrid<float>&, BlockIndex, const SweepParameters&,
                                   std::vector<ShearRow<float>>&);
template void measure_shear<double>(const FluidGrid<double>&, BlockIndex, const SweepParameters&,
                                    std::vector<ShearRow<double>>&);

}  // namespace lahar::lbm
