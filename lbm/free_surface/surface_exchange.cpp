#include "lbm/free_surface/surface_exchange.h"

#include <algorithm>
#include <cmath>
#include <experimental/simd>

#include "lbm/collision/stress_limit.h"
#include "lbm/equilibrium.h"
#include "lbm/free_surface/curvature.h"
#include "lbm/free_surface/surface_gradient.h"
#include "lbm/free_surface/surface_plane.h"
#include "lbm/free_surface/surroundings.h"
#include "lbm/gather.h"

namespace lahar::lbm {

namespace {

/// Gas around a cell at which liquid no longer holds its stress: a cell at the edge of a cube has 9 of 18, at a flat
/// surface or in a film on a wall 5.
constexpr int kExposedSides = 9;

/// The interface cells of one row, eight at a time; lanes that hold other cells compute along and write nothing.
template <class Real>
class RowExchange {
 public:
  using V = stdx::simd<Real, stdx::simd_abi::deduce_t<Real, kBlockWidth>>;

  RowExchange(const std::array<Block<Real>*, 27>& around, const Surroundings<Real>& near, Parity parity,
              const SurfacePhysics<Real>& physics, const Real* capillary)
      : around_(around),
        block_(*around[13]),
        near_(near),
        parity_(parity),
        gas_drho_(physics.gas_drho),
        largest_gradient_(physics.largest_gradient),
        capillary_(capillary) {}

  void run(int row) {
    load(row);
    const V fill(block_.surface->fill_level + 8 * row, stdx::element_aligned);
    const int place = Surroundings<Real>::at(0, row & 7, row >> 3);
    const auto interface = V(near_.half + place, stdx::element_aligned) > V(0);
    V gain(0), empty(0), fullest(0);
    for_each_pair([&]<int P, int CX, int CY, int CZ>() __attribute__((always_inline)) {
      constexpr int step = Surroundings<Real>::step(CX, CY, CZ);
      const V full_ahead = see(near_.full, place + step), full_behind = see(near_.full, place - step);
      gain += (full_ahead + see(near_.half, place + step) * fill) * (incoming_b_[P] - outgoing_a_[P]);
      gain += (full_behind + see(near_.half, place - step) * fill) * (incoming_a_[P] - outgoing_b_[P]);
      empty += see(near_.empty, place + step) + see(near_.empty, place - step);
      fullest = stdx::max(fullest, stdx::max(full_ahead, full_behind));
    });
    note(row, interface, gain, empty, fullest);
    const auto open = interface && empty > V(0);
    if (stdx::any_of(open)) rebuild_from_gas(row, place, open);
  }

 private:
  struct Velocity {
    V x, y, z;
  };

  /// Pressure over density at a place x in a cell, from its centre: depth + (x, y, z) . x; 0 on the surface.
  struct SurfacePressure {
    V depth, x, y, z;
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

  /// Populations that would come from the gas, in the cells `open` to it.
  template <class Mask>
  void rebuild_from_gas(int row, int place, const Mask& open) {
    const Velocity u = outgoing_velocity(row);
    const SurfacePressure s = surface_pressure(row, place, open);
    const V gas = capillary_ ? V(gas_drho_ + V(capillary_ + 8 * row, stdx::element_aligned)) : gas_drho_;
    for_each_pair([&]<int P, int CX, int CY, int CZ>() __attribute__((always_inline)) {
      constexpr int step = Surroundings<Real>::step(CX, CY, CZ);
      const auto from_ahead = open && see(near_.empty, place + step) > V(0);
      const auto from_behind = open && see(near_.empty, place - step) > V(0);
      const V half_way = V(Real(0.5)) * (V(Real(CX)) * s.x + V(Real(CY)) * s.y + V(Real(CZ)) * s.z);
      const auto even = [&](const V& height) __attribute__((always_inline)) {
        return equilibrium_pair_sum(D3Q19::forward(P), V(gas + V(3) * height), u.x, u.y, u.z);
      };
      if (stdx::any_of(from_ahead))
        write_shifted<P, CX, CY, CZ>(row, even(s.depth + half_way) - outgoing_a_[P], from_ahead);
      if (stdx::any_of(from_behind))
        stdx::where(from_behind, V(even(s.depth - half_way) - outgoing_b_[P]))
            .copy_to(block_.f(parity_.home(D3Q19::forward(P))) + 8 * row, stdx::element_aligned);
    });
  }

  template <class Mask>
  SurfacePressure surface_pressure(int row, int place, const Mask& open) const {
    if (largest_gradient_ <= 0) return {V(0), V(0), V(0), V(0)};
    V a[3];
    pressure_gradient(near_, place, see, a);
    const V size = stdx::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]), largest(largest_gradient_);
    const V share = largest / stdx::max(size, largest);
    for (V& component : a) component *= share;
    alignas(64) Real depth[kBlockWidth] = {};
    const SurfaceFields<Real>& surface = *block_.surface;
    for (int k = 0; k < kBlockWidth; ++k) {
      const auto lane = static_cast<std::size_t>(k);
      if (!open[lane]) continue;
      // The level of now: that of the last conversion is a step old, and a pressure that lags feeds waves.
      const int cell = 8 * row + k;
      const Real fill = std::clamp(surface.mass[cell] / (Real(1) + surface.density[cell]), Real(0), Real(1));
      const Real gradient[3] = {a[0][lane], a[1][lane], a[2][lane]};
      depth[k] = depth_of_centre(gradient, fill);
    }
    return {V(depth, stdx::vector_aligned), a[0], a[1], a[2]};
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
    for (int k = 0; k < kBlockWidth; ++k)
      s.alone[static_cast<std::size_t>(8 * row + k)] = alone[static_cast<std::size_t>(k)];
  }

  const std::array<Block<Real>*, 27>& around_;
  Block<Real>& block_;
  const Surroundings<Real>& near_;
  const Parity parity_;
  const V gas_drho_;
  const Real largest_gradient_;
  const Real* const capillary_;  ///< rho - 1 by surface tension, per cell; null without
  V incoming_a_[D3Q19::pairs], outgoing_b_[D3Q19::pairs], outgoing_a_[D3Q19::pairs], incoming_b_[D3Q19::pairs];
};

/// rho - 1 of the pressure sigma x curvature, p = rho c_s^2, in the interface cells of a block.
template <class Real>
void capillary_densities(const FluidGrid<Real>& grid, BlockIndex b, Real surface_tension, Real (&drho)[kBlockCells]) {
  const SurfaceFields<Real>& surface = *grid.block(b).surface;
  const FillAround<Real> around(grid, b);
  std::fill(drho, drho + kBlockCells, Real(0));
  for (int k = 0; k < surface.count; ++k) {
    const int cell = surface.cells[static_cast<std::size_t>(k)];
    const auto p = cell_position(cell);
    drho[cell] = Real(3) * surface_tension * curvature(around, p[0], p[1], p[2]);
  }
}

}  // namespace

template <class Real>
void exchange_surface(FluidGrid<Real>& grid, BlockIndex b, Parity parity, const SurfacePhysics<Real>& physics) {
  Block<Real>& block = grid.block(b);
  if (!block.surface) return;
  SurfaceFields<Real>& surface = *block.surface;
  surface.exposed = 0;
  Surroundings<Real> near;
  LookAround<Real>(grid, b, parity).run(surface.rows, near);
  Real capillary[kBlockCells];
  const bool tense = physics.surface_tension > 0;
  if (tense) capillary_densities(grid, b, physics.surface_tension, capillary);
  RowExchange<Real> exchange(grid.around(b), near, parity, physics, tense ? capillary : nullptr);
  for (int row = 0; row < 64; ++row)
    if (surface.rows >> row & 1) exchange.run(row);
}

template void exchange_surface<float>(FluidGrid<float>&, BlockIndex, Parity, const SurfacePhysics<float>&);
template void exchange_surface<double>(FluidGrid<double>&, BlockIndex, Parity, const SurfacePhysics<double>&);

}  // namespace lahar::lbm
