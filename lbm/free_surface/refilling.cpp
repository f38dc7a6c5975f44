#include "lbm/free_surface/refilling.h"

#include <algorithm>
#include <cmath>

#include "lbm/collision/equilibrium.h"
#include "lbm/free_surface/covered_cells.h"
#include "lbm/free_surface/touching.h"

namespace lahar::lbm {

namespace {

/// Means over the neighbours of cells of one block; the moments of a neighbour are computed once.
template <class Real>
class NeighbourMeans {
 public:
  NeighbourMeans(FluidGrid<Real>& grid, const LevelChanges<Real>& changes, BlockIndex b, Parity parity)
      : grid_(grid), changes_(changes), index_(b), parity_(parity) {}

  /// Over the wet neighbours that were wet before.
  CellMoments<Real> around(int cell) {
    const auto p = cell_position(cell);
    Real sum[4] = {0, 0, 0, 0};
    int sources = 0;
    for (int i = 1; i < D3Q19::q; ++i) {
      const CellPlace next = grid_.neighbour({index_, cell}, i);
      if (!is_wet(grid_.type(next)) || changes_.of(next.block).fresh.has(next.cell)) continue;
      const auto* c = D3Q19::c[i];
      const Real* const m = moments(next, 1 + p[0] + c[0] + 10 * (1 + p[1] + c[1]) + 100 * (1 + p[2] + c[2]));
      for (int k = 0; k < 4; ++k) sum[k] += m[k];
      ++sources;
    }
    if (sources == 0) return {};
    const auto n = static_cast<Real>(sources);
    return {sum[0] / n, {sum[1] / n, sum[2] / n, sum[3] / n}};
  }

 private:
  const Real* moments(CellPlace place, int at) {
    Real* const m = moments_[at];
    std::uint64_t& word = known_[static_cast<std::size_t>(at >> 6)];
    if (word >> (at & 63) & 1) return m;
    word |= std::uint64_t{1} << (at & 63);
    const CellMoments<Real> own = outgoing_moments(grid_, place, parity_);
    m[0] = own.drho;
    for (int k = 0; k < 3; ++k) m[k + 1] = own.u[k];
    return m;
  }

  FluidGrid<Real>& grid_;
  const LevelChanges<Real>& changes_;
  const BlockIndex index_;
  const Parity parity_;
  std::array<std::uint64_t, 16> known_{};
  Real moments_[1000][4];  ///< rho - 1 and velocity, of the block's cells and one cell around it
};

/// What is of a body in a cell moves as it does: at another velocity it would bring the body momentum from nowhere. A
/// covered cell without liquid has the body's velocity; of others the solid share has it, by the part B of the slip
/// that the body takes over in a step, and by `inertial`, whose bodies take it over step by step, all of it. A drop in
/// a covered cell gets the slip of which the body takes the momentum of the drop's liquid (lu); by `inertial` it takes
/// but what does not stay in its place (docs/decisions/0061, 0087).
template <class Real>
void take_over_velocity(const Block<Real>& block, int cell, Real liquid, const CoverageWeightLaw& law,
                        CellMoments<Real>& m) {
  const BodyFields<Real>& body = *block.body;
  const bool covered = is_covered(block, cell);
  if (liquid > 0 && !covered) return;
  const std::array<Real, 3> of_bodies = velocity_of_bodies(body, cell);
  Real slip[3], square = 0;
  for (std::size_t a = 0; a < 3; ++a) slip[a] = m.u[a] - of_bodies[a], square += slip[a] * slip[a];
  const Real eps = std::clamp(body.solid_fraction[cell], Real(0), Real(1));
  const Real taken = CoverageWeights<Real>(law).of(body.drag[cell], eps, std::sqrt(square));
  const bool inertial = law.inertial > 0;
  Real share = covered ? Real(0) : Real(1) - eps * (inertial ? Real(1) : std::min(Real(1), taken));
  if (liquid > 0) {
    const Real given = inertial ? taken * (Real(1) - eps) : taken;
    share = std::min(Real(1), liquid / std::max(given, Real(1e-6)));
  }
  for (int a = 0; a < 3; ++a) m.u[a] -= (Real(1) - share) * slip[a];
}

}  // namespace

template <class Real>
void refill_cell(FluidGrid<Real>& grid, CellPlace place, Parity parity, CellMoments<Real> mean, Real liquid,
                 const RefillLaw& law) {
  Block<Real>& block = grid.block(place.block);
  if (block.body && !block.body->fills_with_level)
    take_over_velocity(block, place.cell, liquid, law.coverage_weight, mean);
  SurfaceFields<Real>& surface = *block.surface;
  const auto cell = static_cast<std::size_t>(place.cell);
  surface.mass[cell] = body_share(block, place.cell) + liquid;
  surface.density[cell] = mean.drho;
  surface.fill_level[cell] = std::clamp(surface.mass[cell] / (Real(1) + mean.drho), Real(0), Real(1));
  if (block.body) {
    BodyFields<Real>& body = *block.body;
    body.velocity_x[cell] = mean.u[0], body.velocity_y[cell] = mean.u[1], body.velocity_z[cell] = mean.u[2];
  }
  // Outgoing populations of the new cell; what comes in from wet neighbours is there already, what comes from gas is
  // rebuilt before the next step, what comes from walls is set here.
  block.f(0)[cell] = equilibrium(law.order, 0, mean.drho, mean.u[0], mean.u[1], mean.u[2]);
  for (int a = 1; a < D3Q19::q; a += 2) {
    const auto pair = grid.access(place, a, parity);
    const Real fa = equilibrium(law.order, a, mean.drho, mean.u[0], mean.u[1], mean.u[2]);
    const Real fb = equilibrium(law.order, a + 1, mean.drho, mean.u[0], mean.u[1], mean.u[2]);
    *pair.outgoing_a = fa;
    *pair.outgoing_b = fb;
    if (grid.type(grid.neighbour(place, a)) == CellType::wall) *pair.incoming_b = fb;
    if (grid.type(grid.neighbour(place, a + 1)) == CellType::wall) *pair.incoming_a = fa;
  }
}

template <class Real>
void expose_cell(FluidGrid<Real>& grid, CellPlace place, Parity parity) {
  const Real drho = outgoing_moments(grid, place, parity).drho;
  SurfaceFields<Real>& surface = *grid.block(place.block).surface;
  surface.mass[place.cell] = Real(1) + drho;
  surface.density[place.cell] = drho;
  surface.fill_level[place.cell] = Real(1);
}

template <class Real>
void refill(FluidGrid<Real>& grid, const LevelChanges<Real>& changes, BlockIndex b, Parity parity,
            const RefillLaw& law) {
  const BlockChanges<Real>& own = changes.of(b);
  if (own.new_surface) grid.clear_surface(b);
  if (!own.opened.empty()) {
    NeighbourMeans<Real> means(grid, changes, b, parity);
    own.opened.for_each([&](int cell) { refill_cell(grid, {b, cell}, parity, means.around(cell), Real(0), law); });
  }
  own.arrivals.for_each([&](int cell, const Arrival<Real>& a) {
    refill_cell(grid, {b, cell}, parity, a.moments, a.liquid, law);
  });
  own.exposed.for_each([&](int cell) { expose_cell(grid, {b, cell}, parity); });
}

template void refill<float>(FluidGrid<float>&, const LevelChanges<float>&, BlockIndex, Parity, const RefillLaw&);
template void refill<double>(FluidGrid<double>&, const LevelChanges<double>&, BlockIndex, Parity, const RefillLaw&);
template void expose_cell<float>(FluidGrid<float>&, CellPlace, Parity);
template void expose_cell<double>(FluidGrid<double>&, CellPlace, Parity);
template void refill_cell<float>(FluidGrid<float>&, CellPlace, Parity, CellMoments<float>, float, const RefillLaw&);
template void refill_cell<double>(FluidGrid<double>&, CellPlace, Parity, CellMoments<double>, double, const RefillLaw&);

}  // namespace lahar::lbm
