#include "lbm/step/rescale.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "lbm/collision/equilibrium.h"
#include "lbm/collision/smagorinsky.h"
#include "lbm/collision/stress_limit.h"
#include "lbm/rheology/herschel_bulkley.h"

namespace lahar::lbm {

namespace {

using Viscosity = std::variant<Newtonian<double>, Smagorinsky<double>, Bingham<double>, HerschelBulkley<double>>;

Viscosity viscosity_of(const SweepParameters& p) {
  if (p.rheology.law == FlowLaw::bingham) return Bingham<double>::of(p);
  if (p.rheology.law == FlowLaw::herschel_bulkley) return HerschelBulkley<double>::of(p);
  if (p.smagorinsky > 0) return Smagorinsky<double>::of(p);
  return Newtonian<double>::of(p);
}

/// Relaxation time of a cell without the bound of exposed cells.
double relaxation_time(const Viscosity& viscosity, bool deviator_alone, const double (&f)[D3Q19::q],
                       const Moments<double>& m) {
  return std::visit(
      [&](const auto& model) {
        using Model = std::decay_t<decltype(model)>;
        if constexpr (Model::constant)
          return 1 / model.rate();
        else
          return 1 / model.rate(deviator_alone || Model::flow_law ? stress(f, m) : second_central_moments(f, m),
                                m.inverse_density);
      },
      viscosity);
}

/// The relaxation time of the odd part that belongs to one of the even part.
double odd_time(const CollisionOperator& collision, double tau) {
  return std::visit(
      [&](const auto& o) {
        if constexpr (requires { o.odd_time(tau); })
          return o.odd_time(tau);
        else
          return tau;
      },
      collision);
}

class CellRescaling {
 public:
  CellRescaling(const SweepParameters& before, double ratio)
      : before_(before),
        viscosity_(viscosity_of(before)),
        ratio_(ratio),
        moments_alone_(bounds_stress(before.collision)) {}

  /// From old to new populations; returns new over old density.
  double apply(double (&f)[D3Q19::q], double largest_rate) const {
    const Moments<double> m = moments(f);
    const double drho = std::expm1(ratio_ * ratio_ * std::log1p(m.drho)),
                 density_ratio = (1 + drho) * m.inverse_density;
    double u[3];
    for (std::size_t a = 0; a < 3; ++a) u[a] = ratio_ * m.u[a] + 0.5 * (ratio_ - ratio_ * ratio_) * before_.gravity[a];
    const double tau = relaxation_time(viscosity_, moments_alone_, f, m), new_tau = 0.5 + ratio_ * (tau - 0.5);
    const double shortest = moments_alone_ ? 1 / largest_rate : 0;
    const double common = ratio_ * density_ratio;
    const double even = common * std::max(new_tau, shortest) / std::max(tau, shortest);
    const CollisionOperator& collision = before_.collision;
    const double odd =
        moments_alone_ ? even : ratio_ * common * odd_time(collision, new_tau) / odd_time(collision, tau);
    const auto excess = [&](int i) { return f[i] - equilibrium(i, m.drho, m.u[0], m.u[1], m.u[2]); };
    const auto rest = [&](int i) { return equilibrium(i, drho, u[0], u[1], u[2]); };
    f[0] = rest(0) + even * excess(0);
    for (int a = 1; a < D3Q19::q; a += 2) {
      const int b = a + 1;
      const double ea = excess(a), eb = excess(b);
      const double sum = 0.5 * even * (ea + eb), difference = 0.5 * odd * (ea - eb);
      f[a] = rest(a) + sum + difference;
      f[b] = rest(b) + sum - difference;
    }
    return density_ratio;
  }

 private:
  const SweepParameters& before_;
  Viscosity viscosity_;
  double ratio_;
  bool
      moments_alone_;  ///< the collision keeps density, velocity and the deviator of the stress, at bodies the odd part
};

/// Returns the mass that came in.
template <class Real>
double rescale_cell(FluidGrid<Real>& grid, CellPlace place, Parity parity, const CellRescaling& rescaling) {
  Block<Real>& block = grid.block(place.block);
  Real* incoming[D3Q19::q];
  incoming[0] = block.f(0) + place.cell;
  for (int a = 1; a < D3Q19::q; a += 2) {
    const auto pair = grid.access(place, a, parity);
    incoming[a] = pair.incoming_a;
    incoming[a + 1] = pair.incoming_b;
  }
  double f[D3Q19::q], before = 0, after = 0;
  for (int i = 0; i < D3Q19::q; ++i) before += f[i] = static_cast<double>(*incoming[i]);
  const double largest_rate =
      block.surface ? static_cast<double>(block.surface->largest_rate[place.cell]) : kLargestRate;
  const double density_ratio = rescaling.apply(f, largest_rate);
  for (int i = 0; i < D3Q19::q; ++i) {
    *incoming[i] = static_cast<Real>(f[i]);
    after += static_cast<double>(*incoming[i]);
  }
  if (block.type[static_cast<std::size_t>(place.cell)] == CellType::liquid) return after - before;
  Real& mass = block.surface->mass[place.cell];
  const Real old_mass = mass;
  mass = static_cast<Real>(density_ratio * static_cast<double>(mass));
  return static_cast<double>(mass) - static_cast<double>(old_mass);
}

/// Velocities of the bodies in the block.
template <class Real>
void rescale_velocities(Block<Real>& block, double ratio) {
  const auto scale = [&](Real* field) {
    for (int n = 0; n < kBlockCells; ++n) field[n] *= static_cast<Real>(ratio);
  };
  if (ImpulseFields<Real>* const impulse = block.impulse)
    for (Real* field : {impulse->x, impulse->y, impulse->z}) scale(field);
  if (!block.body) return;
  BodyFields<Real>& body = *block.body;
  for (Real* field : {body.weighted_velocity_x, body.weighted_velocity_y, body.weighted_velocity_z, body.velocity_x,
                      body.velocity_y, body.velocity_z})
    scale(field);
  if (body.lacks)
    for (Real* field : {body.lacking_x, body.lacking_y, body.lacking_z}) scale(field);
}

}  // namespace

template <class Real>
double rescale_block(FluidGrid<Real>& grid, BlockIndex b, Parity parity, const SweepParameters& before, double ratio) {
  Block<Real>& block = grid.block(b);
  rescale_velocities(block, ratio);
  double mass = 0;
  if (block.wet_cells == 0) return mass;
  const CellRescaling rescaling(before, ratio);
  for (int n = 0; n < kBlockCells; ++n)
    if (is_wet(block.type[static_cast<std::size_t>(n)])) mass += rescale_cell(grid, {b, n}, parity, rescaling);
  return mass;
}

template double rescale_block<float>(FluidGrid<float>&, BlockIndex, Parity, const SweepParameters&, double);
template double rescale_block<double>(FluidGrid<double>&, BlockIndex, Parity, const SweepParameters&, double);

}  // namespace lahar::lbm
