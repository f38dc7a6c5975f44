#include "lbm/free_surface/surface_exchange.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "lbm/boundary/slip_wall.h"
#include "lbm/collision/equilibrium.h"
#include "lbm/collision/stress_limit.h"
#include "lbm/free_surface/curvature.h"
#include "lbm/free_surface/face_sums.h"
#include "lbm/free_surface/lacking_liquid.h"
#include "lbm/free_surface/look_around.h"
#include "lbm/free_surface/surface_gradient.h"
#include "lbm/free_surface/surface_plane.h"
#include "lbm/free_surface/surface_shear.h"
#include "lbm/free_surface/surroundings.h"
#include "lbm/step/gather.h"
#include "lbm/step/row_moments.h"

namespace lahar::lbm {

namespace {

/// Gas around a cell at which liquid no longer holds its stress: a cell at the edge of a cube has 9 of 18, at a flat
/// surface or in a film on a wall 5.
constexpr int kExposedSides = 9;
constexpr int kLinksToALayer = 4;     ///< of a cell, to those of a layer beside it
constexpr int kLinksToLiquid = 3;     ///< the same to cells of liquid, also in a corner of the walls
constexpr double kLeastShare = 0.25;  ///< bound on what the depth of a cell's centre makes of the gradient

/// The interface cells of one row, or of two at y and y + 1, y even; lanes that hold other cells compute along and
/// write nothing. V: a pack of 8 numbers or of 16.
template <class V>
class RowExchange {
 public:
  using Real = typename V::value_type;
  static constexpr int kRows = static_cast<int>(V::size()) / kBlockWidth;

  RowExchange(const std::array<Block<Real>*, 27>& around, const Surroundings<Real>& near, Parity parity,
              const SurfacePhysics<Real>& physics, const Real* capillary)
      : around_(around),
        parity_(parity),
        block_(*around[13]),
        near_(near),
        // What is at home in the coming step is away in the one after it, and the reverse.
        home_ahead_(around, parity.next(), nowhere_),
        away_ahead_(around, parity, nowhere_),
        order_(physics.equilibrium_order),
        largest_gradient_(physics.largest_gradient),
        gravity_{V(physics.gravity[0]), V(physics.gravity[1]), V(physics.gravity[2])},
        weight_(physics.weight),
        capillary_(capillary) {
    for (int pair = 0; pair < D3Q19::pairs; ++pair) {
      home_[pair] = block_.f(parity.home(D3Q19::forward(pair)));
      away_[pair] = block_.f(parity.away(D3Q19::forward(pair)));
    }
  }

  /// `row` (y + 8 z): the first. `shear`, of one row, is null where the viscous stress does not count.
  void run(int row, const ShearRow<Real>* shear) {
    load_pairs(row);
    const V half_fill = V(Real(0.5)) * load<V>(block_.surface->fill_level + 8 * row), one(1);
    const Sight<V> sight(near_, row & 7, row >> 3);
    const auto interface = sight.template interface<0, 0, 0>();
    V gain(0), empty(0), fullest(0), full(0);
    for_each_pair([&]<int P, int CX, int CY, int CZ>() __attribute__((always_inline)) {
      if constexpr (CX * CX + CY * CY + CZ * CZ == 1)
        gain += through_faces<P, CX, CY, CZ>(row, sight, half_fill);
      else
        gain += past_edges<P, CX, CY, CZ>(row, sight, half_fill);
      empty = select(sight.template empty<CX, CY, CZ>(), empty + one, empty);
      empty = select(sight.template empty<-CX, -CY, -CZ>(), empty + one, empty);
      const V full_ahead = sight.template full<CX, CY, CZ>(), full_behind = sight.template full<-CX, -CY, -CZ>();
      fullest = max(fullest, max(full_ahead, full_behind));
      full += full_ahead + full_behind;
    });
    note(row, interface, gain, empty, fullest, full);
    const auto open = interface && empty > V(0);
    const auto held = interface && at_bodies(row, sight);
    if (none(open || held)) return;
    const SurfacePressure pressure = surface_pressure(row, sight, open || held);
    if (any(held)) note_lacking(row, sight, held, open, pressure);
    if (none(open)) return;
    rebuild_from_gas(row, sight, open, pressure);
    if constexpr (kRows == 1)
      if (shear) add_shear(row, sight, open && empty < V(kExposedSides), pressure, *shear);
  }

  /// The links of a row that lead by way of a mirror to gas (boundary/slip_wall.h), of the cells `ending`: what comes
  /// back from there stands on the side of the cell where the mirror is.
  void end_at_gas(FluidGrid<Real>& grid, BlockIndex b, const RowLink& link, unsigned ending) requires(kRows == 1) {
    load_pairs(link.row);
    const Sight<V> sight(near_, link.row & 7, link.row >> 3);
    const SurfacePressure s = surface_pressure(link.row, sight, sight.template interface<0, 0, 0>());
    const Velocity u = velocity_half_a_step_on(link.row, s);
    const auto* c = D3Q19::c[link.direction];
    const V height = s.depth + V(Real(0.5)) * (V(Real(c[0])) * s.x + V(Real(c[1])) * s.y + V(Real(c[2])) * s.z);
    const V drho = V(3) * height + gas_density(link.row);
    const HigherMoments<V> higher(order_, u.x, u.y, u.z);
    const V even =
        V(equilibrium_pair_sum(link.direction, drho, u.x, u.y, u.z)) + (V(1) + drho) * higher.pair_sum(link.direction);
    for (; ending != 0; ending &= ending - 1) {
      const int x = std::countr_zero(ending);
      const auto populations = link_populations(grid, {b, kBlockWidth * link.row + x}, link.direction, parity_);
      *populations.back = even[static_cast<std::size_t>(x)] - *populations.sent;
    }
  }

 private:
  struct Velocity {
    V x, y, z;
  };

  /// Pressure over density at a place x in a cell, from its centre: depth + (x, y, z) . x; 0 on the surface.
  struct SurfacePressure {
    V depth, x, y, z;
  };

  /// The four values of every pair (streaming.h) for the cells.
  [[gnu::always_inline]] void load_pairs(int row) {
    const Rows rows = Rows::at(kBlockWidth * row, kRows);
    for_each_pair([&]<int P, int CX, int CY, int CZ>() __attribute__((always_inline)) {
      incoming_a_[P] = load<V>(home_[P] + rows.n);
      outgoing_b_[P] = load<V>(away_[P] + rows.n);
      outgoing_a_[P] = home_ahead_.template pair<P>().template load<V>(rows);
      incoming_b_[P] = away_ahead_.template pair<P>().template load<V>(rows);
    });
  }

  /// Mass that comes through the two faces across the axis of pair P: from liquid over the link, from interface cells
  /// by the flux between the cells (face_sums.h) times the part of the face that is wet in the course of the step.
  template <int P, int CX, int CY, int CZ>
  [[gnu::always_inline]] V through_faces(int row, const Sight<V>& sight, const V& half_fill) const {
    constexpr int axis = CX != 0 ? 0 : CY != 0 ? 1 : 2, up = face(axis, 1), down = face(axis, -1);
    const V flux_ahead = load<V>(block_.surface->sent[up] + 8 * row) - sent_beside<CX, CY, CZ>(down, row);
    const V flux_behind = sent_beside<-CX, -CY, -CZ>(up, row) - load<V>(block_.surface->sent[down] + 8 * row);
    const V ahead = sight.template full<CX, CY, CZ>(), behind = sight.template full<-CX, -CY, -CZ>(), none(0);
    const V wet_ahead = ahead + half_fill - flux_ahead * (ahead - half_fill);
    const V wet_behind = behind + half_fill - flux_behind * (half_fill - behind);
    V gain = select(sight.template interface<-CX, -CY, -CZ>(), wet_behind * flux_behind, none);
    gain -= select(sight.template interface<CX, CY, CZ>(), wet_ahead * flux_ahead, none);
    gain += select(sight.template liquid<CX, CY, CZ>(), incoming_b_[P] - outgoing_a_[P], none);
    return gain + select(sight.template liquid<-CX, -CY, -CZ>(), incoming_a_[P] - outgoing_b_[P], none);
  }

  /// Mass over the diagonal links of pair P, half by way of each of the two cells between its ends: what comes in from
  /// the ends through faces to liquid, and what crosses the cell itself on its way from liquid to an interface cell.
  template <int P, int CX, int CY, int CZ>
  [[gnu::always_inline]] V past_edges(int row, const Sight<V>& sight, const V& half_fill) const {
    constexpr int X = CX, Y = CX != 0 ? 0 : CY;  // one step of the two
    constexpr int OY = CY - Y, OZ = CZ;          // the other
    const V in_ahead =
        half_of_link<CX, CY, CZ, X, Y, 0>(sight, half_fill) + half_of_link<CX, CY, CZ, 0, OY, OZ>(sight, half_fill);
    const V in_behind = half_of_link<-CX, -CY, -CZ, -X, -Y, 0>(sight, half_fill) +
                        half_of_link<-CX, -CY, -CZ, 0, -OY, -OZ>(sight, half_fill);
    return in_ahead * (incoming_b_[P] - outgoing_a_[P]) + in_behind * (incoming_a_[P] - outgoing_b_[P]) +
           crossing<P, -X, -Y, 0, 0, OY, OZ>(row, sight) + crossing<P, 0, -OY, -OZ, X, Y, 0>(row, sight);
  }

  /// Share of the link to c that comes in by way of the cell at m: half where that is liquid; by a wall or gas half of
  /// what a link straight across would have; by an interface cell nothing, that is in the flux between the cells.
  template <int CX, int CY, int CZ, int MX, int MY, int MZ>
  [[gnu::always_inline]] static V half_of_link(const Sight<V>& sight, const V& half_fill) {
    const V half(Real(0.5)), full = sight.template full<CX, CY, CZ>();
    const V straight = half * select(sight.template interface<CX, CY, CZ>(), full + half_fill, full);
    const auto wet = sight.template wet<CX, CY, CZ>();
    const V by_dry = select(sight.template wet<MX, MY, MZ>(), V(0), straight);
    return select(wet && sight.template liquid<MX, MY, MZ>(), half, by_dry);
  }

  /// Half of what the link of pair P from the cell at a to that at b carries, where one of the two is liquid.
  template <int P, int AX, int AY, int AZ, int BX, int BY, int BZ>
  [[gnu::always_inline]] V crossing(int row, const Sight<V>& sight) const {
    const auto in = sight.template liquid<AX, AY, AZ>() && sight.template interface<BX, BY, BZ>();
    const auto out = sight.template interface<AX, AY, AZ>() && sight.template liquid<BX, BY, BZ>();
    const auto either = in || out;
    if (none(either)) return V(0);
    const V half(Real(0.5)), share = select(in, half, -half);
    const auto at_b = [&](int slot) __attribute__((always_inline)) {
      return beside<BX, BY, BZ>(
          row, [slot](const Block<Real>* block)
                   __attribute__((always_inline)) { return block ? block->f(slot) : kRest<Real>; });
    };
    const V flux = at_b(parity_.home(D3Q19::forward(P))) - at_b(parity_.away(D3Q19::forward(P)));
    return select(either, share * flux, V(0));
  }

  /// Of liquid that the pressure holds: what cells send out has half of the force of a step, but not half of the
  /// pressure's part (as at walls: docs/decisions/0076). With it left out, liquid that slides along a bed would be sped
  /// up by (normal part of the force) x dt / (2 depth) of its speed a step.
  Velocity velocity_half_a_step_on(int row, const SurfacePressure& s) const {
    const Velocity u = outgoing_velocity(row);
    const V half(Real(0.5));
    return {u.x - half * s.x, u.y - half * s.y, u.z - half * s.z};
  }

  /// SurfaceFields::sent of the cells at an offset; to be used where these are interface cells.
  template <int X, int Y, int Z>
  [[gnu::always_inline]] V sent_beside(int face, int row) const {
    return beside<X, Y, Z>(
        row, [face](const Block<Real>* block) __attribute__((always_inline)) {
          return block && block->surface ? block->surface->sent[face] : kRest<Real>;
        });
  }

  template <int X, int Y, int Z, class Field>
  [[gnu::always_inline]] V beside(int row, const Field& field) const {
    const Row<Real> first = row_at<X, Y, Z>(around_, kBlockWidth * row, field);
    if constexpr (kRows == 1)
      return first;
    else
      return join(first, row_at<X, Y, Z>(around_, kBlockWidth * (row + 1), field));
  }

  /// Populations that would come from the gas, in the cells `open` to it.
  template <class Mask>
  void rebuild_from_gas(int row, const Sight<V>& sight, const Mask& open, const SurfacePressure& s) {
    const Velocity u = velocity_half_a_step_on(row, s);
    const Rows rows = Rows::at(kBlockWidth * row, kRows);
    const HigherMoments<V> higher(order_, u.x, u.y, u.z);
    const V gas = gas_density(row);
    for_each_pair([&]<int P, int CX, int CY, int CZ>() __attribute__((always_inline)) {
      const auto from_ahead = open && sight.template empty<CX, CY, CZ>();
      const auto from_behind = open && sight.template empty<-CX, -CY, -CZ>();
      const V half_way = V(Real(0.5)) * (V(Real(CX)) * s.x + V(Real(CY)) * s.y + V(Real(CZ)) * s.z);
      const auto even = [&](const V& height) __attribute__((always_inline)) {
        const V drho = gas + V(3) * height;
        return V(equilibrium_pair_sum(D3Q19::forward(P), drho, u.x, u.y, u.z) +
                 (V(1) + drho) * higher.pair_sum(D3Q19::forward(P)));
      };
      if (any(from_ahead))
        away_ahead_.template pair<P>().store_chosen(rows, even(s.depth + half_way) - outgoing_a_[P], from_ahead);
      if (any(from_behind)) store_if(from_behind, home_[P] + rows.n, V(even(s.depth - half_way) - outgoing_b_[P]));
    });
  }

  /// What the shear stress adds to these populations in the cells `chosen`, so that it vanishes on the surface.
  template <class Mask>
  void add_shear(int row, const Sight<V>& sight, const Mask& chosen, const SurfacePressure& s,
                 const ShearRow<Real>& shear) {
    const auto from = [](const Real* p) __attribute__((always_inline)) { return load<V>(p); };
    const Symmetric<V> stress{from(shear.stress[0]), from(shear.stress[1]), from(shear.stress[2]),
                              from(shear.stress[3]), from(shear.stress[4]), from(shear.stress[5])};
    const SurfaceTraction<V> t =
        surface_traction<V>(stress, {from(shear.way[0]), from(shear.way[1]), from(shear.way[2])}, from(shear.rate),
                            {s.x, s.y, s.z}, s.depth, weight_);
    const Rows rows = Rows::at(kBlockWidth * row, 1);
    for_each_pair([&]<int P, int CX, int CY, int CZ>() __attribute__((always_inline)) {
      constexpr double w = D3Q19::w(D3Q19::forward(P));
      const auto from_ahead = chosen && sight.template empty<CX, CY, CZ>();
      const auto from_behind = chosen && sight.template empty<-CX, -CY, -CZ>();
      const auto& ahead = away_ahead_.template pair<P>();
      if (any(from_ahead))
        ahead.store_chosen(rows, V(ahead.template load<V>(rows) + t.template missing<CX, CY, CZ>(w, 1)), from_ahead);
      if (any(from_behind))
        store_if(from_behind, home_[P] + rows.n, V(from(home_[P] + rows.n) + t.template missing<CX, CY, CZ>(w, -1)));
    });
  }

  template <class Mask>
  SurfacePressure surface_pressure(int row, const Sight<V>& sight, const Mask& open) const {
    if (largest_gradient_ <= 0) return {V(0), V(0), V(0), V(0)};
    Mask layer = open && on_a_layer(row, sight);
    const V surface = gas_density(row);
    if (capillary_)  // not on drops: there the fit would follow what is wrong in the curvature from cell to cell
      layer = layer && surface * surface < V(9) * squared(gravity_);  // less than the weight of a cell
    const bool layers = any(layer);
    const KnownPressure<V> known{layer, surface, {gravity_[0], gravity_[1], gravity_[2]}};
    const PressureFit<V> fit = layers ? pressure_gradient<true>(sight, known) : pressure_gradient<false>(sight, known);
    const V fill = fill_of_now(row), largest(largest_gradient_);
    V a[3] = {fit.at_surface[0], fit.at_surface[1], fit.at_surface[2]};
    if (layers) {
      // a = at_surface - depth x per_depth, depth = |a| x the centre's distance from the surface: solved along a.
      const V first = depths_of_centres(a, fill, layer), square = squared(a);
      const V along = a[0] * fit.per_depth[0] + a[1] * fit.per_depth[1] + a[2] * fit.per_depth[2];
      const V share = V(1) + first * along / max(square, V(Real(1e-30)));
      const V depth = first / max(share, V(static_cast<Real>(kLeastShare)));
      for (std::size_t k = 0; k < 3; ++k) a[k] -= depth * fit.per_depth[k];
    }
    const V bounded = largest / max(sqrt(squared(a)), largest);
    for (V& component : a) component *= bounded;
    return {depths_of_centres(a, fill, open), a[0], a[1], a[2]};
  }

  /// rho - 1 on the surface: of the gas, 0, and by surface tension.
  [[gnu::always_inline]] V gas_density(int row) const { return capillary_ ? load<V>(capillary_ + 8 * row) : V(0); }

  [[gnu::always_inline]] static V squared(const V (&a)[3]) { return a[0] * a[0] + a[1] * a[1] + a[2] * a[2]; }

  /// Cells with liquid on one side, as in the surface of a layer, and without bodies.
  [[gnu::always_inline]] typename V::mask_type on_a_layer(int row, const Sight<V>& sight) const {
    using Mask = typename V::mask_type;
    const Mask bare = block_.body ? !(load<V>(block_.body->exchange_weight + 8 * row) > V(0)) : Mask::all(true);
    if (none(bare && sight.template interface<0, 0, 0>())) return Mask::all(false);
    V links(0);
    for_each_pair([&]<int P, int CX, int CY, int CZ>() __attribute__((always_inline)) {
      links = select(sight.template liquid<CX, CY, CZ>(), links + V(1), links);
      links = select(sight.template liquid<-CX, -CY, -CZ>(), links + V(1), links);
    });
    return bare && links >= V(kLinksToLiquid);
  }

  /// The level of now: that of the last conversion is a step old, and a pressure that lags feeds waves.
  [[gnu::always_inline]] V fill_of_now(int row) const {
    const SurfaceFields<Real>& surface = *block_.surface;
    const V mass = load<V>(surface.mass + 8 * row), density = load<V>(surface.density + 8 * row);
    return min(max(V(mass / (V(1) + density)), V(0)), V(1));
  }

  /// The cells that bodies reach and do not cover, where some are (lacking_liquid.h).
  [[gnu::always_inline]] typename V::mask_type at_bodies(int row, const Sight<V>& sight) const {
    if (!block_.body || !block_.body->lacks) return V::mask_type::all(false);
    return load<V>(block_.body->exchange_weight + 8 * row) > V(0) && !sight.template covered<0, 0, 0>();
  }

  /// What links to covered cells carry of liquid that the cells `held` lack. The gas sets the pressure in the cells
  /// `open` to it, the liquid around in the others.
  template <class Mask>
  void note_lacking(int row, const Sight<V>& sight, const Mask& held, const Mask& open, const SurfacePressure& s) {
    const V depth = select(open, s.depth, V(Real(1.0 / 3.0)) * sight.template density<0, 0, 0>());
    const V gas = select(open, gas_density(row), V(0));
    BodyFields<Real>& body = *block_.body;
    const V inverse = V(1) / max(load<V>(body.exchange_weight + 8 * row), V(Real(1e-12)));
    BodyLinks<V> links(order_, {V(load<V>(body.weighted_velocity_x + 8 * row) * inverse),
                                V(load<V>(body.weighted_velocity_y + 8 * row) * inverse),
                                V(load<V>(body.weighted_velocity_z + 8 * row) * inverse)});
    for_each_pair([&]<int P, int CX, int CY, int CZ>() __attribute__((always_inline)) {
      const auto ahead = held && sight.template covered<CX, CY, CZ>() && sight.template wet<CX, CY, CZ>();
      const auto behind = held && sight.template covered<-CX, -CY, -CZ>() && sight.template wet<-CX, -CY, -CZ>();
      const V half_way = V(Real(0.5)) * (V(Real(CX)) * s.x + V(Real(CY)) * s.y + V(Real(CZ)) * s.z);
      constexpr int i = D3Q19::forward(P);
      if (any(ahead)) links.add(i, ahead, outgoing_a_[P], incoming_b_[P], V(gas + V(3) * (depth + half_way)));
      if (any(behind)) links.add(i + 1, behind, outgoing_b_[P], incoming_a_[P], V(gas + V(3) * (depth - half_way)));
    });
    const V lacks = V(1) - fill_of_now(row);
    Real* const lacking[3] = {body.lacking_x, body.lacking_y, body.lacking_z};
    for (int a = 0; a < 3; ++a) store(lacking[a] + 8 * row, select(held, lacks * links.momentum(a), V(0)));
  }

  /// Velocity that the cells had after their last collision.
  [[gnu::always_inline]] Velocity outgoing_velocity(int row) const {
    V rho = V(1) + load<V>(block_.f(0) + 8 * row), jx(0), jy(0), jz(0);
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
  [[gnu::always_inline]] void note(int row, const Mask& interface, const V& gain, const V& empty, const V& fullest,
                                   const V& full) {
    SurfaceFields<Real>& s = *block_.surface;
    V mass = load<V>(s.mass + 8 * row);
    mass = select(interface, mass + gain, mass);
    store(s.mass + 8 * row, mass);
    const auto exposed = interface && empty >= V(kExposedSides);
    // How far the surface lies below the centre, of cells on a layer of liquid that it hardly moves through.
    V low = select(full >= V(kLinksToALayer), max(V(Real(0.5)) - fill_of_now(row), V(0)), V(0));
    if (block_.body) low = select(load<V>(block_.body->exchange_weight + 8 * row) > V(0), V(0), low);
    const V calm = max(V(1) - V(static_cast<Real>(1 / kCalmGain)) * max(gain, V(-gain)), V(0));
    V rate =
        select(interface, V(static_cast<Real>(kLargestRate)) - V(static_cast<Real>(kRateLostBelow)) * low * low * calm,
               V(static_cast<Real>(kLargestRate)));
    rate = select(exposed, V(static_cast<Real>(kLargestExposedRate)), rate);
    store(s.largest_rate + 8 * row, rate);
    s.exposed += count(exposed);
    store(s.alone.data() + 8 * row, fullest < V(1));
  }

  const std::array<Block<Real>*, 27>& around_;
  const Parity parity_;
  Block<Real>& block_;
  const Surroundings<Real>& near_;
  Real *home_[D3Q19::pairs], *away_[D3Q19::pairs];  ///< the block's own numbers
  alignas(64) Real nowhere_[kBlockCells];
  const AwayPopulations<Real> home_ahead_, away_ahead_;
  const EquilibriumOrder order_;
  const Real largest_gradient_;
  const V gravity_[3];
  const V weight_;
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

/// Links by way of mirrors that end at gas, once `near` has been filled.
template <class Real>
void end_mirrors_at_gas(FluidGrid<Real>& grid, BlockIndex b, Parity parity, const SurfacePhysics<Real>& physics,
                        const Surroundings<Real>& near, const Real* capillary) {
  const Block<Real>& block = grid.block(b);
  std::optional<RowExchange<Row<Real>>> exchange;
  for (const RowLink& link : block.walls.rows) {
    if (link.along == 0 || !(block.surface->rows >> link.row & 1)) continue;
    unsigned ending = 0;
    for (unsigned left = link.cells & ~unsigned{link.mirrored}; left != 0; left &= left - 1) {
      const int x = std::countr_zero(left);
      if (block.type[static_cast<std::size_t>(kBlockWidth * link.row + x)] == CellType::interface) ending |= 1U << x;
    }
    if (ending == 0) continue;
    if (!exchange) exchange.emplace(grid.around(b), near, parity, physics, capillary);
    exchange->end_at_gas(grid, b, link, ending);
  }
}

}  // namespace

template <class Real>
void exchange_surface(FluidGrid<Real>& grid, BlockIndex b, Parity parity, const SurfacePhysics<Real>& physics,
                      const ShearRow<Real>* shear) {
  Block<Real>& block = grid.block(b);
  if (!block.surface) return;
  SurfaceFields<Real>& surface = *block.surface;
  surface.exposed = 0;
  if (block.body) begin_lacking(block);
  Surroundings<Real> near;
  Real capillary[kBlockCells];
  const bool tense = physics.surface_tension > 0;
  if (tense) capillary_densities(grid, b, physics.surface_tension, capillary);
  const Real* const drho = tense ? capillary : nullptr;
  LookAround<Real> look(grid, b, parity);
  const auto look_around = [&](std::uint64_t rows) {
    look.run(rows, near);
    if (physics.largest_gradient > 0) look.see_half_a_step_on(surface.rows, near);
  };
  if constexpr (kNativeLanes<Real> == 2 * kBlockWidth)
    if (!shear) {
      constexpr std::uint64_t even = 0x5555555555555555U;
      const std::uint64_t pairs = (surface.rows | surface.rows >> 1) & even;
      look_around(pairs | pairs << 1);
      RowExchange<Pack<Real, 2 * kBlockWidth>> exchange(grid.around(b), near, parity, physics, drho);
      for (std::uint64_t rows = pairs; rows != 0; rows &= rows - 1) exchange.run(std::countr_zero(rows), nullptr);
      return end_mirrors_at_gas(grid, b, parity, physics, near, drho);
    }
  look_around(surface.rows);
  RowExchange<Row<Real>> exchange(grid.around(b), near, parity, physics, drho);
  for (std::uint64_t rows = surface.rows; rows != 0; rows &= rows - 1)
    exchange.run(std::countr_zero(rows), shear ? shear++ : nullptr);
  end_mirrors_at_gas(grid, b, parity, physics, near, drho);
}

template <class Real>
void note_densities(FluidGrid<Real>& grid, BlockIndex b, Parity parity) {
  Block<Real>& block = grid.block(b);
  for (int row = 0; row < 64; ++row) {
    if (!(block.wet_rows >> row & 1)) continue;
    const Row<Real> drho = outgoing_density(grid.around(b), kBlockWidth * row, parity);
    for (int x = 0; x < kBlockWidth; ++x) {
      const int cell = kBlockWidth * row + x;
      if (block.type[static_cast<std::size_t>(cell)] == CellType::liquid)
        block.surface->density[cell] = drho[static_cast<std::size_t>(x)];
    }
  }
}

template void note_densities<float>(FluidGrid<float>&, BlockIndex, Parity);
template void note_densities<double>(FluidGrid<double>&, BlockIndex, Parity);
template void exchange_surface<float>(FluidGrid<float>&, BlockIndex, Parity, const SurfacePhysics<float>&,
                                      const ShearRow<float>*);
template void exchange_surface<double>(FluidGrid<double>&, BlockIndex, Parity, const SurfacePhysics<double>&,
                                       const ShearRow<double>*);

}  // namespace lahar::lbm
