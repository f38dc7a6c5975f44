#include "coupling/grains/resolved_exchange.h"

#include <optional>

#include "coupling/grains/sphere_rows.h"
#include "coupling/transfer_vectors.h"
#include "coupling/under_relaxed_force.h"
#include "lbm/step/cell_moments.h"

namespace lahar::coupling {

using lbm::kBlockWidth;

namespace {

/// Cells of a block that bodies reach and that have turned wet after the sweep: their momentum past the bodies, lu.
template <class Real>
struct NewSlip {
  alignas(64) Real past[3][lbm::kBlockCells];  ///< set where there are any
  bool any = false;

  NewSlip(const lbm::Fluid<Real>& fluid, lbm::BlockIndex b) {
    auto& grid = const_cast<lbm::FluidGrid<Real>&>(fluid.grid());  // which is read alone
    const lbm::Block<Real>& block = grid.block(b);
    const lbm::BodyFields<Real>& f = *block.body;
    if (!block.surface) return;
    for (int k = 0; k < block.surface->count; ++k) {
      const int n = block.surface->cells[static_cast<std::size_t>(k)];
      if (f.coverage_weight[n] != 0 || f.exchange_weight[n] <= 0) continue;
      if (!any)
        for (Real(&along)[lbm::kBlockCells] : past) std::fill_n(along, lbm::kBlockCells, Real(0));
      any = true;
      const auto m = lbm::outgoing_moments(grid, {b, n}, fluid.parity());
      const Real body[3] = {f.weighted_velocity_x[n], f.weighted_velocity_y[n], f.weighted_velocity_z[n]};
      for (int a = 0; a < 3; ++a) past[a][n] = (Real(1) + m.drho) * (m.u[a] - body[a] / f.exchange_weight[n]);
    }
  }
};

/// Sums over the rows of a block, one for each of the 8 places in a row; arms from the body's centre.
template <class Real>
struct RowSums {
  Row<Real> force[3]{Row<Real>(0), Row<Real>(0), Row<Real>(0)};
  Row<Real> y_fx{0}, z_fx{0}, z_fy{0}, y_fz{0};  ///< moments by the arms along y and z
  Row<Real> interior{0}, interior_arm{0};        ///< liquid in the body's place; times the squared arm across x
  Row<Real> entrained{0}, entrained_arm{0};      ///< liquid that a step brings to the body's velocity; the same
  Row<Real> brought{0};                          ///< entrained, of covered cells all: what it brings along in the end
  Row<Real> held{0};                             ///< interior that is brought along, of cells that are its alone
  Row<Real> slip[3]{Row<Real>(0), Row<Real>(0), Row<Real>(0)};  ///< momentum of the interior past the body
  Row<Real> kept[3]{Row<Real>(0), Row<Real>(0), Row<Real>(0)};  ///< the same, of cells that are wet now

  [[gnu::always_inline]] void add(const Row<Real>& share, const lbm::BodyFields<Real>& f, int row, Real ry, Real rz) {
    const Row<Real> fx = share * given_row(f, row, 0), fy = share * given_row(f, row, 1),
                    fz = share * given_row(f, row, 2);
    force[0] += fx, force[1] += fy, force[2] += fz;
    y_fx += ry * fx, z_fx += rz * fx, z_fy += rz * fy, y_fz += ry * fz;
  }
  [[gnu::always_inline]] void add_liquid(const Row<Real>& in_place, const Row<Real>& moved, const Row<Real>& along,
                                         const Row<Real>& share, Real ry, Real rz) {
    constexpr Real all = Real(0.99);
    const Real square = ry * ry + rz * rz;
    interior += in_place, interior_arm += square * in_place;
    entrained += moved, entrained_arm += square * moved;
    brought += along, held += select(share > Row<Real>(all), min(in_place, along), Row<Real>(0));
  }
  /// A cell with the weight B gave B of its momentum past the bodies; 1 - B is left; it gave nothing where it was dry.
  /// `fraction`: what the body fills of the cells; `in_place`: of those that are wet now.
  [[gnu::always_inline]] void add_slip(const Row<Real>& fraction, const Row<Real>& in_place, const Row<Real>& weight,
                                       const lbm::BodyFields<Real>& f, int row) {
    const Row<Real> left = (Row<Real>(1) - weight) / max(weight, Row<Real>(Real(1e-9)));
    const Real* const exchange[3] = {f.momentum_exchange_x, f.momentum_exchange_y, f.momentum_exchange_z};
    for (int a = 0; a < 3; ++a) {
      const Row<Real> past = left * load_aligned<Row<Real>>(exchange[a] + row);
      slip[a] += fraction * past, kept[a] += in_place * past;
    }
  }
  /// Of cells that have turned wet since.
  [[gnu::always_inline]] void add_new_slip(const Row<Real>& in_place, const NewSlip<Real>& opened, int row) {
    for (int a = 0; a < 3; ++a) kept[a] += in_place * load_aligned<Row<Real>>(opened.past[a] + row);
  }

  /// `rx`: arms along x. Sets force, torque, interior and entrained, and these times 2/3 of the squared arm.
  template <class Load>
  [[gnu::always_inline]] void reduce(const Row<Real>& rx, Load& load) const {
    const auto sum = [](const Row<Real>& row) { return static_cast<double>(sum_of_lanes(row)); };
    load.force = Vec3(sum(force[0]), sum(force[1]), sum(force[2]));
    load.torque = Vec3(sum(y_fz - z_fy), sum(z_fx - rx * force[2]), sum(rx * force[1] - y_fx));
    load.interior = sum(interior), load.interior_inertia = 2.0 / 3.0 * sum(interior_arm + rx * rx * interior);
    load.entrained = sum(entrained), load.entrained_inertia = 2.0 / 3.0 * sum(entrained_arm + rx * rx * entrained);
    load.brought = sum(brought), load.held = sum(held);
    load.slip = Vec3(sum(slip[0]), sum(slip[1]), sum(slip[2]));
    load.kept = Vec3(sum(kept[0]), sum(kept[1]), sum(kept[2]));
  }
};

/// What all bodies of a block look at.
template <class Real>
struct BlockCover {
  const lbm::BodyFields<Real>& fields;
  const Real* wet;                        ///< 1 or 0 for each cell; null where all of the block is wet
  const NewSlip<Real>* opened = nullptr;  ///< where some have turned wet
};

/// Sums of a sphere over a block. With `kByDistance` eps of the liquid stands in its place, else what a step brings to
/// its velocity. `kMixed`: some cells are dry. `kSlips`: the slip of the liquid in its place is summed too.
template <class Real, bool kByDistance, bool kSlips, bool kMixed, class Load>
[[gnu::noinline]] void sum_rows(const GridSphere<Real> s, const Vec3i lowest, const BlockCover<Real> block,
                                Load& load) {
  RowSums<Real> sums;
  for_rows_near(
      s, lowest, s.reach, [&](int y, int z) __attribute__((always_inline)) {
        const RowCover<Real> cover = cover_row<kByDistance>(s, lowest.x(), lowest.y() + y, lowest.z() + z);
        const int row = lbm::cell_index(0, y, z);
        const Real ry = static_cast<Real>(lowest.y() + y) + Real(0.5) - s.centre[1];
        const Real rz = static_cast<Real>(lowest.z() + z) + Real(0.5) - s.centre[2];
        const Row<Real> all = load_aligned<Row<Real>>(block.fields.exchange_weight + row);
        const Row<Real> share = cover.weight / max(all, Row<Real>(Real(1e-30)));
        sums.add(share, block.fields, row, ry, rz);
        const Row<Real> weight = load_aligned<Row<Real>>(block.fields.coverage_weight + row);
        Row<Real> entrained = share * weight, interior = entrained, brought = entrained;
        if constexpr (kByDistance) {
          interior = cover.fraction;
          brought = select(cover.weight >= Row<Real>(Real(kCoveredDrag)), share, entrained);
        }
        if constexpr (kMixed) {
          const Row<Real> liquid = load_aligned<Row<Real>>(block.wet + row);
          entrained *= liquid, interior *= liquid, brought *= liquid;
        }
        sums.add_liquid(interior, entrained, brought, share, ry, rz);
        if constexpr (kSlips) {
          sums.add_slip(cover.fraction, interior, weight, block.fields, row);
          if (block.opened) sums.add_new_slip(interior, *block.opened, row);
        }
      });
  sums.reduce(static_cast<Real>(lowest.x()) + lane_index<Row<Real>>() + Real(0.5) - s.centre[0], load);
}

template <class Real, bool kByDistance, bool kSlips, class Load>
void sum_over(const GridSphere<Real>& s, const Vec3i& lowest, const BlockCover<Real>& block, Load& load) {
  if (block.wet)
    sum_rows<Real, kByDistance, kSlips, true>(s, lowest, block, load);
  else
    sum_rows<Real, kByDistance, kSlips, false>(s, lowest, block, load);
}

}  // namespace

template <class Real>
auto ResolvedExchange<Real>::Load::operator+=(const Load& o) -> Load& {
  force += o.force, torque += o.torque;
  interior += o.interior, interior_inertia += o.interior_inertia;
  entrained += o.entrained, entrained_inertia += o.entrained_inertia;
  brought += o.brought, held += o.held;
  slip += o.slip, kept += o.kept;
  return *this;
}

template <class Real>
void ResolvedExchange<Real>::shape_sphere(double radius, GridSphere<Real>& sphere) const {
  const bool by_distance = lbm::by_wall_distance(weighting_);
  sphere.surface = by_distance ? static_cast<Real>(std::max(0.0, radius + radius_shift_)) : Real(-2);
  sphere.reach = std::max(covered_reach(sphere), sphere.surface + Real(kWallDragReach));
}

template <class Real>
void ResolvedExchange<Real>::prepare(const lbm::Fluid<Real>& fluid, const dem::Particles& particles,
                                     const GrainMap<Real>& map) {
  time_step_ = fluid.units().time_step;
  states_.resize(particles.size());
  loads_.resize(map.pairs().size());
}

template <class Real>
void ResolvedExchange<Real>::gather_block(const lbm::Fluid<Real>& fluid, const GrainMap<Real>& map, std::size_t index) {
  const auto pairs = map.by_block().in(index);
  if (!map.is_alive(fluid, map.pairs()[pairs.front()])) {
    for (const std::uint32_t k : pairs) loads_[k] = {};
    return;
  }
  const auto b = static_cast<lbm::BlockIndex>(index);
  const lbm::Block<Real>& block = fluid.grid().block(b);
  alignas(64) Real mask[lbm::kBlockCells];
  const Real* const wet = block.wet_cells < lbm::kBlockCells ? mask : nullptr;
  for (std::size_t n = 0; wet && n < lbm::kBlockCells; ++n) mask[n] = lbm::is_wet(block.type[n]) ? Real(1) : Real(0);
  BlockCover<Real> cover{*block.body, wet};
  std::optional<NewSlip<Real>> opened;
  if (weighting_ == lbm::BodyWeighting::inertial && block.surface) opened.emplace(fluid, b);
  if (opened && opened->any) cover.opened = &*opened;
  for (const std::uint32_t k : pairs) {
    const GrainInBlock& pair = map.pairs()[k];
    const GridSphere<Real>& s = map.sphere(pair.grain);
    if (weighting_ == lbm::BodyWeighting::inertial)
      sum_over<Real, true, true>(s, pair.lowest, cover, loads_[k]);
    else if (lbm::by_wall_distance(weighting_))
      sum_over<Real, true, false>(s, pair.lowest, cover, loads_[k]);
    else
      sum_over<Real, false, false>(s, pair.lowest, cover, loads_[k]);
  }
}

namespace {

/// Where no slip is summed: mass of the interior liquid whose inertia is no load on the body, at most what a step
/// brings along. A body of a cell or two covers less than its volume, and what was taken off beyond that would drive
/// it. With other weightings than wall_distance a light body is spared no more than a share of its own, and none has
/// its spin driven by more than its own inertia (docs/decisions/0034).
constexpr double kShareOfOwn = 0.7;

double interior_mass(double interior, double entrained, double own, lbm::BodyWeighting weighting) {
  const double most = lbm::by_wall_distance(weighting) ? entrained : std::min(entrained, kShareOfOwn * own);
  return std::min(interior, most);
}

/// What of it is spared while contacts or the waves between bodies jolt the body: half of what it holds alone, more
/// where it is heavy, all from three times the liquid's mass on. A jolt that came back by more than the exchange takes
/// at once would drive a body on, the easier the lighter it is, the fewer cells it has and the more viscous the liquid
/// between it and others is: of what it holds nothing is spared from `viscosity` (lu) 0.01 on. Where the exchange is
/// soft the slip holds the jolt back, and all is spared.
double interior_mass_in_jolts(double spared, double held, double own, double viscosity) {
  constexpr double thick = 0.01;
  const double share = 0.5 * std::max(0.0, 1 - viscosity / thick);
  return std::min(spared, std::max((own - spared) / 2, share * held));
}

/// Calm goes from 0 to 1 in so many steps after a jolt: a step that changes the acceleration by more than half.
constexpr double kStepsToCalm = 40;

double calm_after(double calm, const Vec3& acceleration, const Vec3& former) {
  const double most = std::max(acceleration.squaredNorm(), former.squaredNorm());
  const bool jolted = (acceleration - former).squaredNorm() > 0.25 * most;
  return jolted ? 0.0 : std::min(1.0, calm + 1 / kStepsToCalm);
}

}  // namespace

template <class Real>
Vec3 ResolvedExchange<Real>::finish(const lbm::Fluid<Real>& fluid, const GrainMap<Real>& map, std::size_t grain,
                                    double wet_volume, dem::Particles& particles) {
  const auto& units = fluid.units();
  const MappedGrain& g = map.grains()[grain];
  const dem::ParticleIndex i = particles.index(g.id);
  State& state = states_[g.id];
  Load sum;
  for (std::size_t p = g.first_pair; p < g.first_pair + g.pairs; ++p) sum += loads_[p];
  // Else the liquid in its place moves as the grain does.
  const bool slips = weighting_ == lbm::BodyWeighting::inertial;
  // Means over the last step of the solids; of the liquid in the grain's place.
  Vec3 acceleration = Vec3::Zero(), spin_up = Vec3::Zero(), slip_change = Vec3::Zero();
  const double to_momentum = units.mass() * units.velocity_to_si(1.0);
  if (state.known) {
    acceleration = (particles.velocity[i] - state.velocity) / time_step_;
    spin_up = (particles.angular_velocity[i] - state.spin) / time_step_;
    if (!state.acceleration.isZero()) state.calm = calm_after(state.calm, acceleration, state.acceleration);
    if (!state.spin_up.isZero()) state.calm_spin = calm_after(state.calm_spin, spin_up, state.spin_up);
    state.acceleration = acceleration, state.spin_up = spin_up;
    // Of the cells that the sweep saw, from what they had before it: what they have won when they turn dry, the liquid
    // around them has lost, and the grain gets it. The slip that a cell turns wet with nobody has lost
    // (docs/decisions/0073).
    if (slips) slip_change = sum.slip - state.slip / to_momentum;
  }
  state.slip = to_momentum * sum.kept;
  state.velocity = particles.velocity[i], state.spin = particles.angular_velocity[i];
  state.known = true;
  const Vec3 gravity = fluid.options().gravity * units.acceleration_to_lu(1.0);
  const double to_kg = units.mass(), to_kg_m2 = to_kg * units.cell_size * units.cell_size;
  const lbm::FluidOptions& o = fluid.options();
  const double viscosity = units.viscosity_to_lu(
      o.rheology.law == lbm::FlowLaw::newtonian ? o.kinematic_viscosity : o.rheology.limit_viscosity);
  // Where the slip is known, all of it: what the grain does not bring along slips back, and drives nothing
  // (docs/decisions/0063).
  const double own = particles.mass[i] / to_kg,
               interior = slips ? sum.interior : interior_mass(sum.interior, sum.entrained, own, weighting_),
               jolted = interior_mass_in_jolts(interior, sum.held, own, viscosity);
  const double soft = slips && sum.brought > 0 ? 1 - std::min(1.0, sum.entrained / sum.brought) : 0;
  const double spared = jolted + (interior - jolted) * std::max(state.calm, soft);
  // The cells took all of the change in this step, however long the one was that it came in; 1 while the step stays.
  const double as_it_changed = time_step_ / units.time_step;
  Vec3 force = sum.force + spared * units.acceleration_to_lu(1.0) * as_it_changed * acceleration - wet_volume * gravity;
  const double share = sum.interior > 0 ? spared / sum.interior : 1;
  force += share * slip_change + (1 - share) * (sum.slip - sum.kept);
  const double spun =
      state.calm_spin * std::min({sum.interior_inertia, sum.entrained_inertia, particles.inertia[i] / to_kg_m2});
  Vec3 torque = sum.torque + spun * units.time_step * units.time_step * as_it_changed * spin_up;
  force *= units.force_to_si(1.0), torque *= units.torque_to_si(1.0);
  under_relax(state.felt_force, force, relaxation_factor(particles.mass[i], to_kg * sum.entrained), sum.entrained > 0);
  // About any axis the entrained liquid has at most 3/2 of the mean over axes.
  under_relax(state.felt_torque, torque,
              relaxation_factor(particles.inertia[i], 1.5 * to_kg_m2 * sum.entrained_inertia), sum.entrained > 0);
  particles.external_force.add(i, state.felt_force);
  particles.external_torque.add(i, state.felt_torque);
  return sum.force;
}

template <class Real>
void ResolvedExchange<Real>::transfer(Archive& archive) {
  std::size_t particles = states_.size();
  archive.value("particles", particles);
  states_.resize(particles);
  archive.pieces<double>("grain", particles, 24, [&](std::size_t k, double* stored) {
    State& s = states_[k];
    transfer_vectors(
        archive, {&s.velocity, &s.spin, &s.felt_force, &s.felt_torque, &s.acceleration, &s.spin_up, &s.slip}, stored);
    if (archive.loading())
      s.known = stored[21] != 0, s.calm = stored[22], s.calm_spin = stored[23];
    else
      stored[21] = s.known ? 1 : 0, stored[22] = s.calm, stored[23] = s.calm_spin;
  });
}

template class ResolvedExchange<float>;
template class ResolvedExchange<double>;

}  // namespace lahar::coupling
