#include "lbm/free_surface/surface_exchange.h"

#include <algorithm>
#include <experimental/simd>

#include "lbm/collision/stress_limit.h"
#include "lbm/equilibrium.h"
#include "lbm/free_surface/surroundings.h"
#include "lbm/gather.h"

namespace lahar::lbm {

namespace {

namespace stdx = std::experimental;

/// Gas around a cell at which liquid no longer holds its stress: a cell at the edge of a cube has 9 of 18, at a flat
/// surface or in a film on a wall 5.
constexpr int kExposedSides = 9;

/// The interface cells of one row, eight at a time; lanes that hold other cells compute along and write nothing.
template <class Real>
class RowExchange {
 public:
  using V = stdx::simd<Real, stdx::simd_abi::deduce_t<Real, kBlockWidth>>;

  RowExchange(const std::array<Block<Real>*, 27>& around, const Surroundings<Real>& near, Parity parity, Real gas_drho)
      : around_(around), block_(*around[13]), near_(near), parity_(parity), gas_drho_(gas_drho) {}

  void run(int row) {
    load(row);
    const V fill(block_.surface->fill_level + 8 * row, stdx::element_aligned);
    const int place = Surroundings<Real>::at(0, row & 7, row >> 3);
    const auto interface = V(near_.half + place, stdx::element_aligned) > V(0);
    V gain(0), empty(0), fullest(0);
    const Velocity u = outgoing_velocity(row);
    for_each_pair([&]<int P, int CX, int CY, int CZ>() __attribute__((always_inline)) {
      constexpr int step = CX + CY * Surroundings<Real>::pitch_y + CZ * Surroundings<Real>::pitch_z;
      const V full_ahead = see(near_.full, place + step), full_behind = see(near_.full, place - step);
      const V empty_ahead = see(near_.empty, place + step), empty_behind = see(near_.empty, place - step);
      gain += (full_ahead + see(near_.half, place + step) * fill) * (incoming_b_[P] - outgoing_a_[P]);
      gain += (full_behind + see(near_.half, place - step) * fill) * (incoming_a_[P] - outgoing_b_[P]);
      empty += empty_ahead + empty_behind;
      fullest = stdx::max(fullest, stdx::max(full_ahead, full_behind));
      const V even = equilibrium_pair_sum(D3Q19::forward(P), gas_drho_, u.x, u.y, u.z);
      const auto from_ahead = interface && empty_ahead > V(0), from_behind = interface && empty_behind > V(0);
      if (stdx::any_of(from_ahead)) write_shifted<P, CX, CY, CZ>(row, even - outgoing_a_[P], from_ahead);
      if (stdx::any_of(from_behind))
        stdx::where(from_behind, V(even - outgoing_b_[P]))
            .copy_to(block_.f(parity_.home(D3Q19::forward(P))) + 8 * row, stdx::element_aligned);
    });
    note(row, interface, gain, empty, fullest);
  }

 private:
  struct Velocity {
    V x, y, z;
  };

  [[gnu::always_inline]] static V see(const Real* field, int place) { return V(field + place, stdx::element_aligned); }

  /// The four values of every pair (streaming.h) for the eight cells.
  [[gnu::always_inline]] void load(int row) {
    for_each_pair([&]<int P, int CX, int CY, int CZ>() __attribute__((always_inline)) {
      const int home = parity_.home(D3Q19::forward(P)), away = parity_.away(D3Q19::forward(P));
      incoming_a_[P] = V(block_.f(home) + 8 * row, stdx::element_aligned);
      outgoing_b_[P] = V(block_.f(away) + 8 * row, stdx::element_aligned);
      const ShiftedRow ahead = shifted_row<CY, CZ>(row);
      outgoing_a_[P] = read_shifted<CX>(ahead, home);
      incoming_b_[P] = read_shifted<CX>(ahead, away);
    });
  }

  /// The lane whose cell lies in the next block along x.
  template <int CX>
  [[gnu::always_inline]] static auto beyond() {
    const V lane([](auto k) { return static_cast<Real>(k); });
    return lane == V(CX > 0 ? Real(7) : Real(0));
  }

  template <int CX>
  [[gnu::always_inline]] V read_shifted(const ShiftedRow& row, int slot) const {
    const Real* near = row_of(around_, 0, row, slot);
    V values = near ? V(near + CX, stdx::element_aligned) : V(0);
    if constexpr (CX != 0) {  // a blend: a number stored into a row that is loaded next would stall
      const Real* far = row_of(around_, CX, row, slot);
      stdx::where(beyond<CX>(), values) = V(far ? far[CX > 0 ? 0 : 7] : Real(0));
    }
    return values;
  }

  /// Writes incoming_b of the chosen cells, where they lie in the row ahead. Those of an interface cell always exist.
  template <int P, int CX, int CY, int CZ, class Mask>
  [[gnu::always_inline]] void write_shifted(int row, const V& values, const Mask& chosen) {
    const ShiftedRow ahead = shifted_row<CY, CZ>(row);
    const int slot = parity_.away(D3Q19::forward(P));
    Real* const near = row_of(around_, 0, ahead, slot);
    Real* const far = row_of(around_, CX, ahead, slot);
    for (int k = 0; k < kBlockWidth; ++k) {
      if (!chosen[static_cast<std::size_t>(k)]) continue;
      const int to = k + CX;
      (to < 0 || to > 7 ? far : near)[to & 7] = values[static_cast<std::size_t>(k)];
    }
  }

  /// Velocity that the cells had after their last collision.
  [[gnu::always_inline]] Velocity outgoing_velocity(int row) const {
    V rho = V(1) + V(block_.f(0) + 8 * row, stdx::element_aligned), jx(0), jy(0), jz(0);
    for_each_pair([&]<int P, int CX, int CY, int CZ>() __attribute__((always_inline)) {
      rho += outgoing_a_[P] + outgoing_b_[P];
      const V odd = outgoing_a_[P] - outgoing_b_[P];
      if constexpr (CX != 0) jx += CX > 0 ? odd : -odd;
      if constexpr (CY != 0) jy += CY > 0 ? odd : -odd;
      if constexpr (CZ != 0) jz += CZ > 0 ? odd : -odd;
    });
    const V inverse = V(1) / rho;
    return {jx * inverse, jy * inverse, jz * inverse};
  }

  /// Mass, and how the cells stand: exposed with gas on half of their links or more, alone without liquid around.
  template <class Mask>
  [[gnu::always_inline]] void note(int row, const Mask& interface, const V& gain, const V& empty, const V& fullest) {
    SurfaceFields<Real>& s = *block_.surface;
    V mass(s.mass + 8 * row, stdx::element_aligned);
    stdx::where(interface, mass) += gain;
    mass.copy_to(s.mass + 8 * row, stdx::element_aligned);
    const auto exposed = interface && empty >= V(kExposedSides);
    V rate(static_cast<Real>(kLargestRate));
    stdx::where(exposed, rate) = V(static_cast<Real>(kLargestExposedRate));
    rate.copy_to(s.largest_rate + 8 * row, stdx::element_aligned);
    s.exposed += stdx::popcount(exposed);
    const auto alone = fullest < V(1);
    for (int k = 0; k < kBlockWidth; ++k) s.alone[static_cast<std::size_t>(8 * row + k)] = alone[static_cast<std::size_t>(k)];
  }

  const std::array<Block<Real>*, 27>& around_;
  Block<Real>& block_;
  const Surroundings<Real>& near_;
  const Parity parity_;
  const V gas_drho_;
  V incoming_a_[D3Q19::pairs], outgoing_b_[D3Q19::pairs], outgoing_a_[D3Q19::pairs], incoming_b_[D3Q19::pairs];
};

}  // namespace

template <class Real>
void exchange_surface(FluidGrid<Real>& grid, BlockIndex b, Parity parity, Real gas_drho) {
  Block<Real>& block = grid.block(b);
  if (!block.surface) return;
  SurfaceFields<Real>& surface = *block.surface;
  surface.exposed = 0;
  Surroundings<Real> near;
  look_around(grid.around(b), surface.rows, near);
  RowExchange<Real> exchange(grid.around(b), near, parity, gas_drho);
  for (int row = 0; row < 64; ++row)
    if (surface.rows >> row & 1) exchange.run(row);
}

template void exchange_surface<float>(FluidGrid<float>&, BlockIndex, Parity, float);
template void exchange_surface<double>(FluidGrid<double>&, BlockIndex, Parity, double);

}  // namespace lahar::lbm
