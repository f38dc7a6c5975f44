#pragma once
// The body of the sweep, instantiated per number type and collision operator (sweep_float.cpp, sweep_double.cpp).
#include <limits>

#include "core/check.h"
#include "core/denormals.h"
#include "lbm/collision/bounce_back_operators.h"
#include "lbm/collision/central_moments_at_bodies.h"
#include "lbm/collision/smagorinsky.h"
#include "lbm/collision/stress_limit.h"
#include "lbm/free_surface/lacking_liquid.h"
#include "lbm/rheology/herschel_bulkley.h"
#include "lbm/step/gather.h"
#include "lbm/step/sweep.h"

namespace lahar::lbm {

/// Rows by bit y + 8 z.
inline constexpr std::uint64_t kAllRows = ~std::uint64_t{0};

/// Numbers of a sweep in the kernel's type, spread over a vector.
template <class V, class Viscosity>
struct Uniform {
  Viscosity viscosity;
  V gravity[3], stress_limit;
  CoverageWeights<V> coverage_weight;
  V nonequilibrium_loss;  ///< 1 for SolidOperator::damped_nonequilibrium
  bool bounces_back;      ///< the solid operator bounces populations back,
  bool at_wall_velocity;  ///< by SolidOperator::wall_velocity_bounce_back
  bool keep_velocity;
};

/// Stands for the impulses of blocks that have none.
template <class Real>
inline constexpr std::array<Real, kBlockCells> kNoImpulse alignas(64){};

template <class V, class Viscosity>
Uniform<V, Viscosity> make_uniform(const SweepParameters& p) {
  using Real = typename V::value_type;
  const auto real = [](double x) { return V(static_cast<Real>(x)); };
  double largest_stress;
  if constexpr (Viscosity::flow_law)
    largest_stress = stress_limit(p.rheology);
  else
    largest_stress = stress_limit(p.tau);
  return {Viscosity::of(p),
          {real(p.gravity[0]), real(p.gravity[1]), real(p.gravity[2])},
          real(largest_stress),
          CoverageWeights<V>(p.coverage_weight),
          real(p.solid_operator == SolidOperator::damped_nonequilibrium),
          bounces_back(p.solid_operator),
          p.solid_operator == SolidOperator::wall_velocity_bounce_back,
          p.keep_velocity};
}

template <class Real, bool kMixed, bool kBody>
class BlockKernel {
 public:
  /// A row or two.
  using V = std::conditional_t<kNativeLanes<Real> == 2 * kBlockWidth, Pack<Real, 2 * kBlockWidth>, Row<Real>>;
  static constexpr int width = static_cast<int>(V::size());

  template <class Operator, template <class> class Viscosity>
  static SweepNote run(Block<Real>& block, const std::array<Block<Real>*, 27>& around, const SweepParameters& p) {
    const FlushDenormals flush;
    const std::uint64_t rows = kMixed ? whole_vectors(block.wet_rows) : kAllRows;
    alignas(64) Real nowhere[kBlockCells];
    Real* home[D3Q19::pairs];
    for (int pair = 0; pair < D3Q19::pairs; ++pair) home[pair] = block.f(p.parity.home(D3Q19::forward(pair)));
    const AwayPopulations<Real> away(around, p.parity, nowhere);
    const auto uniform = make_uniform<V, Viscosity<V>>(p);
    CellTypes types;
    if constexpr (kMixed) types.set(block);
    Watch watch;
    for (int n = 0; n < kBlockCells; n += width)
      if (!kMixed || rows >> (n / kBlockWidth) & 1)
        collide_cells<Operator>(block, home, away, types, n, uniform, watch);
    return watch.note(block);
  }

 private:
  /// 1 or 0 for each cell of a block that is not liquid throughout.
  struct CellTypes {
    alignas(64) Real wet[kMixed ? kBlockCells : 1];
    alignas(64) Real liquid[kMixed && kBody ? kBlockCells : 1];

    void set(const Block<Real>& block) {
      for (std::size_t n = 0; n < kBlockCells; ++n) {
        wet[n] = is_wet(block.type[n]) ? Real(1) : Real(0);
        if constexpr (kBody) liquid[n] = block.type[n] == CellType::liquid ? Real(1) : Real(0);
      }
    }
  };

  /// What the collisions of a block see.
  struct Watch {
    V fastest{0};
    int limited = 0, held_back = 0;
    bool broken = false;

    [[gnu::always_inline]] void see(const Departure<V>& d) {
      fastest = max(fastest, d.square);
      const auto over = too_fast(d);
      if (none(over)) [[likely]]
        return;
      held_back += count(over);
      broken = broken || any(!is_finite(d.square));
    }

    [[nodiscard]] SweepNote note(const Block<Real>& block) const {
      const double square =
          broken ? std::numeric_limits<double>::infinity() : static_cast<double>(greatest_lane(fastest));
      return {block.wet_cells, limited, block.surface ? block.surface->exposed : 0, held_back, square};
    }
  };

  /// The rows that vectors with a wet cell span: a vector of 16 takes two rows.
  static std::uint64_t whole_vectors(std::uint64_t rows) {
    if constexpr (width <= kBlockWidth) return rows;
    static_assert(width <= 2 * kBlockWidth);
    constexpr std::uint64_t even = 0x5555555555555555U;
    const std::uint64_t first = (rows | rows >> 1) & even;
    return first | first << 1;
  }

  template <class Operator, class Uniforms>
  [[gnu::always_inline]] static void collide_cells(Block<Real>& block, Real* const (&home)[D3Q19::pairs],
                                                   const AwayPopulations<Real>& away, const CellTypes& types, int n,
                                                   const Uniforms& uniform, Watch& watch) {
    V f[D3Q19::q];
    f[0] = load_aligned<V>(block.f(0) + n);
    for (int pair = 0; pair < D3Q19::pairs; ++pair) f[2 * pair + 1] = load_aligned<V>(home[pair] + n);
    const Rows rows = Rows::at(n, width / kBlockWidth);
    for_each_pair([&]<int P, int CX, int CY, int CZ>() __attribute__((always_inline)) {
      f[2 * P + 2] = away.template pair<P>().template load<V>(rows);
    });
    const auto dry = [&] {
      if constexpr (kMixed)
        return load_aligned<V>(types.wet + n) == V(0);
      else
        return V::mask_type::all(false);
    }();
    if constexpr (kMixed)
      for (V& population : f) population = select(dry, V(0), population);
    const Moments<V> m = moments(f);
    CellForcing<V> force;
    if constexpr (kMixed)
      if (block.surface) {
        store_aligned(block.surface->density + n, m.drho);
        if constexpr (Operator::bounds_stress) force.largest_rate = load_aligned<V>(block.surface->largest_rate + n);
      }
    if constexpr (Operator::bounds_stress) limit_stress(watch, f, uniform.stress_limit, m, force);
    add_forcing(block, types, n, uniform, m, force);
    if constexpr (kBody && kMixed) {
      force.coverage_weight = select(dry, V(0), force.coverage_weight);
      for (V& change : force.impulse) change = select(dry, V(0), change);
    }
    Departure<V> after;
    bool bounces_back = false;
    if constexpr (kBody && std::is_same_v<std::remove_cvref_t<decltype(uniform.viscosity)>, Newtonian<V>>)
      bounces_back = uniform.bounces_back;
    if (bounces_back) [[unlikely]] {
      if constexpr (kBody) {
        after = velocity_after(m, force);
        collide_bouncing_back<Operator>(f, m, force, uniform.viscosity, uniform.at_wall_velocity);
      }
    } else {
      after = Operator::collide(f, m, force, uniform.viscosity);
    }
    watch.see(after);
    if constexpr (kBody) record_exchange(block, n, m, force, uniform, after);
    // Dry cells store what came of rest: it goes to places that walls or the surface set before a wet cell reads them.
    store_aligned(block.f(0) + n, f[0]);
    for (int pair = 0; pair < D3Q19::pairs; ++pair) store_aligned(home[pair] + n, f[2 * pair + 2]);
    for_each_pair([&]<int P, int CX, int CY, int CZ>()
                      __attribute__((always_inline)) { away.template pair<P>().store(rows, f[2 * P + 1]); });
  }

  /// Bounds the stress of cells that strain too fast, and counts them: rare, hence the test of the squares first.
  [[gnu::always_inline]] static void limit_stress(Watch& watch, const V (&f)[D3Q19::q], const V& largest,
                                                  const Moments<V>& m, CellForcing<V>& force) {
    const Symmetric<V> s = stress(f, m);
    const V limit = largest * (V(1) + m.drho);
    const auto over = square(s) > limit * limit;
    if (none(over)) [[likely]]
      return;
    force.stress_share = limited_stress_share(s, m.inverse_density, largest);
    watch.limited += count(over);
  }

  /// Gravity acts on all that the populations stand for, liquid and displaced liquid; the bodies' buoyancy is the
  /// weight of the latter (coupling/grains/resolved_exchange.h). Liquid leaves a collision by half a step of gravity
  /// faster than it is (0110); bounce-back at the wall's velocity knows that by itself.
  template <class Uniforms>
  [[gnu::always_inline]] static void add_forcing(const Block<Real>& block, const CellTypes& types, int n,
                                                 const Uniforms& uniform, const Moments<V>& m, CellForcing<V>& force) {
    if constexpr (kBody) {
      V ahead(uniform.at_wall_velocity ? Real(0) : Real(0.5));  // of a step
      if constexpr (kMixed) ahead *= load_aligned<V>(types.liquid + n);
      const BodyFields<Real>& body = *block.body;
      const V tiny(Real(1e-12));
      const V sum = load_aligned<V>(body.exchange_weight + n);
      const V inverse = V(1) / max(sum, tiny);
      force.near_body = select(sum > V(0), V(1), force.near_body);
      force.solid_velocity[0] = load_aligned<V>(body.weighted_velocity_x + n) * inverse + ahead * uniform.gravity[0];
      force.solid_velocity[1] = load_aligned<V>(body.weighted_velocity_y + n) * inverse + ahead * uniform.gravity[1];
      force.solid_velocity[2] = load_aligned<V>(body.weighted_velocity_z + n) * inverse + ahead * uniform.gravity[2];
      V square(0);
      for (int a = 0; a < 3; ++a) {
        const V slip = m.u[a] + uniform.gravity[a] - force.solid_velocity[a];
        square += slip * slip;
      }
      // Bodies that exchange nothing here, such as averaged grains, resist in no way.
      const V exchanging = select(sum > V(0), load_aligned<V>(body.solid_fraction + n), V(0));
      force.coverage_weight = uniform.coverage_weight.of(load_aligned<V>(body.drag + n), exchanging, V(sqrt(square)));
      force.nonequilibrium_loss = uniform.nonequilibrium_loss * force.coverage_weight;
      const Real* const none = kNoImpulse<Real>.data();
      const ImpulseFields<Real>* const given = block.impulse;
      const Real* const impulse[3] = {given ? given->x : none, given ? given->y : none, given ? given->z : none};
      for (int a = 0; a < 3; ++a) force.impulse[a] = load_aligned<V>(impulse[a] + n) * m.inverse_density;
    } else {
      force.coverage_weight = V(0);
      for (int a = 0; a < 3; ++a) force.solid_velocity[a] = force.impulse[a] = V(0);
    }
    for (int a = 0; a < 3; ++a) force.acceleration[a] = uniform.gravity[a];
  }

  /// Momentum that the fluid gives to the bodies of the cell, B rho (u + a - u_s), in liquid with u_s + a/2, and the
  /// velocity after collision but for half a step of gravity.
  /// Bounce-back at the wall's velocity gives B rho (2 (u - u_s) + a).
  template <class Uniforms>
  [[gnu::always_inline]] static void record_exchange(Block<Real>& block, int n, const Moments<V>& m,
                                                     const CellForcing<V>& force, const Uniforms& uniform,
                                                     const Departure<V>& after) {
    const V weight = force.coverage_weight * (V(1) + m.drho);
    BodyFields<Real>& body = *block.body;
    store_aligned(body.coverage_weight + n, force.coverage_weight);
    Real* const out[3] = {body.momentum_exchange_x, body.momentum_exchange_y, body.momentum_exchange_z};
    Real* const velocity[3] = {body.velocity_x, body.velocity_y, body.velocity_z};
    for (int a = 0; a < 3; ++a) {
      V loss = m.u[a] + force.acceleration[a] - force.solid_velocity[a], velocity_a = after.v[a];
      if (uniform.at_wall_velocity) [[unlikely]] {
        const V slip = m.u[a] - force.solid_velocity[a];
        loss += slip, velocity_a -= force.coverage_weight * slip;
      }
      store_aligned(out[a] + n, weight * loss);
      if (uniform.keep_velocity) store_aligned(velocity[a] + n, velocity_a - V(Real(0.5)) * force.acceleration[a]);
    }
    if constexpr (kMixed)
      if (body.lacks) add_lacking(block, n, m);
  }

  /// Of the exchange within interface cells (free_surface/lacking_liquid.h).
  [[gnu::always_inline]] static void add_lacking(Block<Real>& block, int n, const Moments<V>& m) {
    constexpr int rows = width / kBlockWidth;
    unsigned cells = 0;
    for (int r = 0; r < rows; ++r) cells |= open_interface_cells(block, n / kBlockWidth + r) << (kBlockWidth * r);
    if (cells == 0) return;
    const auto open = V::mask_type::from_bits(cells);
    const V fill = min(max(V(load_aligned<V>(block.surface->mass + n) * m.inverse_density), V(0)), V(1));
    const V share = select(open, V(1) - fill, V(0));
    BodyFields<Real>& body = *block.body;
    const Real* const exchange[3] = {body.momentum_exchange_x, body.momentum_exchange_y, body.momentum_exchange_z};
    Real* const lacking[3] = {body.lacking_x, body.lacking_y, body.lacking_z};
    for (int a = 0; a < 3; ++a)
      store_aligned(lacking[a] + n, load_aligned<V>(lacking[a] + n) + share * load_aligned<V>(exchange[a] + n));
  }
};

template <class Real, bool kMixed, bool kBody, class Operator>
BlockSweep<Real> pick_viscosity(const SweepParameters& p) {
  using Kernel = BlockKernel<Real, kMixed, kBody>;
  if constexpr (Operator::takes_flow_laws) {
    if (p.rheology.law == FlowLaw::bingham) return &Kernel::template run<Operator, Bingham>;
    if (p.rheology.law == FlowLaw::herschel_bulkley) return &Kernel::template run<Operator, HerschelBulkley>;
  } else {
    require(p.rheology.law == FlowLaw::newtonian, "choose_sweep: this operator is for Newtonian fluids alone");
  }
  return p.smagorinsky > 0 ? &Kernel::template run<Operator, Smagorinsky> : &Kernel::template run<Operator, Newtonian>;
}

template <class Real, bool kMixed, bool kBody>
BlockSweep<Real> pick_operator(const SweepParameters& p) {
  return std::visit(
      [&]<class Operator>(Operator) {
        if constexpr (kBody && std::is_same_v<Operator, CentralMoments>)
          if (p.third_moments_at_bodies) return pick_viscosity<Real, kMixed, kBody, CentralMomentsAtBodies>(p);
        return pick_viscosity<Real, kMixed, kBody, Operator>(p);
      },
      p.collision);
}

template <class Real>
BlockSweep<Real> choose_sweep(const SweepParameters& p, bool mixed, bool bodies) {
  if (bodies) return mixed ? pick_operator<Real, true, true>(p) : pick_operator<Real, false, true>(p);
  return mixed ? pick_operator<Real, true, false>(p) : pick_operator<Real, false, false>(p);
}

}  // namespace lahar::lbm
