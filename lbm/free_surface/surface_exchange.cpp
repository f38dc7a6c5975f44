#include "lbm/free_surface/surface_exchange.h"

#include <algorithm>
#include <cmath>

#include "lbm/collision/stress_limit.h"
#include "lbm/equilibrium.h"
#include "lbm/free_surface/surface_gradient.h"
#include "lbm/free_surface/surface_plane.h"

namespace lahar::lbm {

namespace {

/// Share of a link's population flux that is mass of the interface cell.
template <class Real>
Real exchange_share(const FluidGrid<Real>& grid, CellPlace neighbour, CellType type, Real fill) {
  if (type == CellType::liquid) return Real(1);
  if (type != CellType::interface) return Real(0);
  return Real(0.5) * (fill + grid.block(neighbour.block).surface->fill_level[neighbour.cell]);
}

bool is_empty(CellType t) { return t == CellType::gas || t == CellType::sink; }

/// Gas around a cell at which liquid no longer holds its stress: a cell at the edge of a cube has 9 of 18, at a flat
/// surface or in a film on a wall 5.
constexpr int kExposedSides = 9;

/// The nine pairs of a cell and the cells at their ends.
template <class Real>
struct CellLinks {
  PairAccess<Real> pair[D3Q19::pairs];
  CellPlace ahead[D3Q19::pairs], behind[D3Q19::pairs];
  CellType type_ahead[D3Q19::pairs], type_behind[D3Q19::pairs];
};

template <class Real>
CellLinks<Real> links_of(FluidGrid<Real>& grid, CellPlace place, Parity parity) {
  CellLinks<Real> links;
  for (int p = 0; p < D3Q19::pairs; ++p) {
    const int a = D3Q19::forward(p);
    links.pair[p] = grid.access(place, a, parity);
    links.ahead[p] = grid.neighbour(place, a);
    links.behind[p] = grid.neighbour(place, a + 1);
    links.type_ahead[p] = grid.type(links.ahead[p]);
    links.type_behind[p] = grid.type(links.behind[p]);
  }
  return links;
}

/// Notes whether a cell is exposed, with gas on half of its links or more, and whether it is without liquid around.
template <class Real>
void judge_surroundings(const CellLinks<Real>& links, int cell, SurfaceFields<Real>& surface) {
  int empty = 0;
  bool liquid = false;
  for (int p = 0; p < D3Q19::pairs; ++p) {
    empty += is_empty(links.type_ahead[p]) + is_empty(links.type_behind[p]);
    liquid |= links.type_ahead[p] == CellType::liquid || links.type_behind[p] == CellType::liquid;
  }
  surface.alone[static_cast<std::size_t>(cell)] = !liquid;
  if (empty < kExposedSides) return;
  surface.largest_rate[cell] = Real(kLargestExposedRate);
  ++surface.exposed;
}

/// Velocity that the cell had after its last collision.
template <class Real>
void outgoing_velocity(const CellLinks<Real>& links, Real rest, Real (&u)[3]) {
  Real rho = Real(1) + rest, j[3] = {0, 0, 0};
  for (int p = 0; p < D3Q19::pairs; ++p) {
    const auto* c = D3Q19::c[D3Q19::forward(p)];
    const Real fa = *links.pair[p].outgoing_a, fb = *links.pair[p].outgoing_b;
    rho += fa + fb;
    for (int k = 0; k < 3; ++k) j[k] += static_cast<Real>(c[k]) * (fa - fb);
  }
  for (int k = 0; k < 3; ++k) u[k] = j[k] / rho;
}

/// What a cell gains over its links.
template <class Real>
Real mass_gain(const FluidGrid<Real>& grid, const CellLinks<Real>& links, Real fill) {
  Real gain = 0;
  for (int p = 0; p < D3Q19::pairs; ++p) {
    const auto& l = links.pair[p];
    gain += exchange_share(grid, links.ahead[p], links.type_ahead[p], fill) * (*l.incoming_b - *l.outgoing_a);
    gain += exchange_share(grid, links.behind[p], links.type_behind[p], fill) * (*l.incoming_a - *l.outgoing_b);
  }
  return gain;
}

/// Pressure over density at a place x in the cell, from its centre: depth + gradient . x; 0 on the surface.
template <class Real>
struct SurfacePressure {
  Real gradient[3] = {0, 0, 0}, depth = 0;
};

template <class Real>
SurfacePressure<Real> surface_pressure(FluidGrid<Real>& grid, CellPlace place, Parity parity, Real fill,
                                       Real largest_gradient) {
  SurfacePressure<Real> s;
  if (largest_gradient <= 0) return s;
  auto& a = s.gradient;
  pressure_gradient(grid, place, parity, a);
  const Real size = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
  if (size > largest_gradient)
    for (Real& component : a) component *= largest_gradient / size;
  s.depth = depth_of_centre(a, fill);
  return s;
}

/// Populations that would come from the gas.
template <class Real>
void rebuild_from_gas(const CellLinks<Real>& links, const Real (&u)[3], Real gas_drho, const SurfacePressure<Real>& s) {
  for (int p = 0; p < D3Q19::pairs; ++p) {
    const bool ahead = is_empty(links.type_ahead[p]), behind = is_empty(links.type_behind[p]);
    if (!ahead && !behind) continue;
    const auto& l = links.pair[p];
    const auto* c = D3Q19::c[D3Q19::forward(p)];
    Real half_way = 0;  // gradient . c / 2
    for (int k = 0; k < 3; ++k) half_way += Real(0.5) * s.gradient[k] * static_cast<Real>(c[k]);
    const auto even = [&](Real drho) { return equilibrium_pair_sum(D3Q19::forward(p), drho, u[0], u[1], u[2]); };
    if (ahead) *l.incoming_b = even(gas_drho + Real(3) * (s.depth + half_way)) - *l.outgoing_a;
    if (behind) *l.incoming_a = even(gas_drho + Real(3) * (s.depth - half_way)) - *l.outgoing_b;
  }
}

}  // namespace

template <class Real>
void exchange_surface(FluidGrid<Real>& grid, BlockIndex b, Parity parity, Real gas_drho, Real largest_gradient) {
  Block<Real>& block = grid.block(b);
  if (!block.surface) return;
  SurfaceFields<Real>& surface = *block.surface;
  std::fill_n(surface.largest_rate, kBlockCells, Real(kLargestRate));
  surface.exposed = 0;
  for (int k = 0; k < surface.count; ++k) {
    const int cell = surface.cells[static_cast<std::size_t>(k)];
    const CellLinks<Real> links = links_of(grid, {b, cell}, parity);
    Real u[3];
    outgoing_velocity(links, block.f(0)[cell], u);
    surface.mass[cell] += mass_gain(grid, links, surface.fill_level[cell]);
    // The level of now: that of the last conversion is a step old, and a pressure that lags feeds waves.
    const Real fill = std::clamp(surface.mass[cell] / (Real(1) + surface.density[cell]), Real(0), Real(1));
    rebuild_from_gas(links, u, gas_drho, surface_pressure(grid, {b, cell}, parity, fill, largest_gradient));
    judge_surroundings(links, cell, surface);
  }
}

template void exchange_surface<float>(FluidGrid<float>&, BlockIndex, Parity, float, float);
template void exchange_surface<double>(FluidGrid<double>&, BlockIndex, Parity, double, double);

}  // namespace lahar::lbm
