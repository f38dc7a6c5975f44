// Force and torque of the fluid on the beads of resolved wires. Compiled without contraction of products and sums, as
// wire_map_fields.cpp is.
#include "coupling/bad_force.h"
#include "coupling/under_relaxed_force.h"
#include "coupling/wires/wire_map_parts.h"

namespace lahar::coupling {

namespace {

/// What drags a bead within the step, in M/dt. Once of it damps less than what is held feeds.
constexpr double kDrag = 2;
/// Share of what was lent to a bead that is taken back in a step. With all of it spins of stiff nets grow.
constexpr double kTakenBack = 0.1;

template <class Real>
double sum_of(const Row<Real>& row) {
  return static_cast<double>(sum_of_lanes(row));
}

/// What the cells do to one bead, one sum for each of the 8 places in a row; arms from the bead.
template <class Real>
struct LoadSums {
  using R = Row<Real>;
  R force[3]{R(0), R(0), R(0)}, torque[3]{R(0), R(0), R(0)};
  R entrained{0}, entrained_inertia{0};

  /// `share`: of the bead in the cells.
  [[gnu::always_inline]] void add(const R& share, const ArmRow<Real>& arm, const MotionRow<Real>& f,
                                  const R& entrained_here) {
    const R fx = share * f.x, fy = share * f.y, fz = share * f.z, e = share * entrained_here;
    force[0] += fx, force[1] += fy, force[2] += fz;
    torque[0] += arm.y * fz - arm.z * fy;
    torque[1] += arm.z * fx - arm.x * fz;
    torque[2] += arm.x * fy - arm.y * fx;
    entrained += e;
    entrained_inertia += e * (arm.x * arm.x + Real(arm.y * arm.y + arm.z * arm.z));
  }
  template <class Load>
  void reduce(Load& load) const {
    load.force = Vec3(sum_of(force[0]), sum_of(force[1]), sum_of(force[2]));
    load.torque = Vec3(sum_of(torque[0]), sum_of(torque[1]), sum_of(torque[2]));
    load.entrained = sum_of(entrained), load.entrained_inertia = 2.0 / 3.0 * sum_of(entrained_inertia);
  }
};

/// What a block knows that its pieces are loaded by.
template <class Real>
struct Surroundings {
  const lbm::BodyFields<Real>& fields;
  const CellMask<Real>* wet;  ///< null: all cells
  Vec3 gravity;               ///< lu
};

/// Loads of a piece on its two beads; `rises`: their accelerations. Returns the piece's part of the exchange. In a cell
/// the load is that part, the inertia of the liquid in the piece's place, which is no load on it (Feng & Michaelides
/// 2009; Uhlmann 2005), and the weight of that liquid: buoyancy.
template <bool kByDistance, class Real, class Load>
[[gnu::noinline]] Vec3 load_piece(const GridCylinder<Real> piece, const Vec3i lowest, const GridMotion<Real> rises[2],
                                  const Surroundings<Real>& around, std::array<Load, 2>& loads) {
  using R = Row<Real>;
  LoadSums<Real> sums[2];
  BeadSums<Real> displaced;  // to the bit as the next step measures it where nothing moves
  R taken[3]{R(0), R(0), R(0)};
  const lbm::BodyFields<Real>& f = around.fields;
  const Real gravity[3] = {static_cast<Real>(around.gravity.x()), static_cast<Real>(around.gravity.y()),
                           static_cast<Real>(around.gravity.z())};
  for_cylinder_rows<kByDistance>(
      piece, lowest, reach_of(piece), [&](int row, const CylinderRow<Real>& cover, int y, int z) {
        if (all(cover.weight <= R(0))) return;
        const R part = cover.weight / max(load_aligned<R>(f.exchange_weight + row), R(Real(1e-30)));
        const MotionRow<Real> exchange{part * given_row(f, row, 0), part * given_row(f, row, 1),
                                       part * given_row(f, row, 2)};
        taken[0] += exchange.x, taken[1] += exchange.y, taken[2] += exchange.z;
        const R liquid = around.wet ? around.wet->row(row) : R(1);
        const R weight = load_aligned<R>(f.coverage_weight + row);
        const R entrained = part * weight * liquid, wet = cover.fraction * liquid;
        const R interior = kByDistance ? min(wet, entrained) : entrained;  // no more than the exchange sets in motion
        const ArmRow<Real> arm[2] = {ArmRow<Real>::from(piece.start, lowest.x(), y, z),
                                     ArmRow<Real>::from(piece.end, lowest.x(), y, z)};
        const MotionRow<Real> rise = blend(motion_row(rises[0], arm[0].x, arm[0].y, arm[0].z),
                                           motion_row(rises[1], arm[1].x, arm[1].y, arm[1].z), cover.share);
        const MotionRow<Real> load{exchange.x + interior * rise.x - wet * gravity[0],
                                   exchange.y + interior * rise.y - wet * gravity[1],
                                   exchange.z + interior * rise.z - wet * gravity[2]};
        sums[0].add(R(1) - cover.share, arm[0], load, entrained);
        sums[1].add(cover.share, arm[1], load, entrained);
        displaced.add(wet, cover.share);
      });
  for (std::size_t e = 0; e < 2; ++e) sums[e].reduce(loads[e]);
  displaced.reduce(loads[0].wet, loads[1].wet);
  return {sum_of(taken[0]), sum_of(taken[1]), sum_of(taken[2])};
}

}  // namespace

template <class Real>
void WireMap<Real>::add_loads(const lbm::Fluid<Real>& fluid, std::size_t index) {
  const auto pairs = by_block_.in(index);
  const auto b = static_cast<lbm::BlockIndex>(index);
  const lbm::FluidGrid<Real>& grid = fluid.grid();
  if (!grid.exists(b) || grid.block(b).birth != pairs_[pairs.front()].birth) return;
  const lbm::Block<Real>& block = grid.block(b);
  std::optional<CellMask<Real>> wet;
  if (block.wet_cells < lbm::kBlockCells) wet.emplace(block, [](lbm::CellType t) { return lbm::is_wet(t); });
  const auto& units = fluid.units();
  const Surroundings<Real> around{*block.body, wet ? &*wet : nullptr,
                                  fluid.options().gravity * units.acceleration_to_lu(1.0)};
  const bool by_distance = lbm::by_wall_distance(fluid.options().weighting);
  // The cells took all of the beads' change in this step, however long the one was that it came in.
  const double as_it_changed = time_step_ / units.time_step;  // 1 while the step stays
  const double change_lu = units.acceleration_to_lu(1.0) * as_it_changed;
  const double spin_lu = units.time_step * units.time_step * as_it_changed;
  for (const std::uint32_t k : pairs) {
    const std::size_t piece = pairs_[k].piece;
    GridMotion<Real> rises[2];
    for (int e = 0; e < 2; ++e) {
      const State& s = states_[wires_.beads()[wires_.bead_of(piece, e)]];
      for (int a = 0; a < 3; ++a) {
        rises[e].velocity[a] = static_cast<Real>(change_lu * s.acceleration[a]);
        rises[e].spin[a] = static_cast<Real>(spin_lu * s.spin_up[a]);
      }
    }
    const auto load = by_distance ? &load_piece<true, Real, Load> : &load_piece<false, Real, Load>;
    taken_[k] = load(pieces_[piece], pairs_[k].lowest, rises, around, loads_[k]);
  }
}

template <class Real>
void WireMap<Real>::hand_over(const lbm::Fluid<Real>& fluid, dem::Particles& particles, std::size_t bead) {
  Load sum;
  for_pairs_of(bead, [&](std::size_t p, std::size_t end) {
    const Load& load = loads_[p][end];
    sum.force += load.force, sum.torque += load.torque;
    sum.entrained += load.entrained, sum.entrained_inertia += load.entrained_inertia;
    sum.wet += load.wet;
  });
  const auto& units = fluid.units();
  const dem::ParticleId id = wires_.beads()[bead];
  const dem::ParticleIndex i = particles.index(id);
  State& s = states_[id];
  s.wet = sum.wet;
  const double to_kg = units.mass(), to_kg_m2 = to_kg * units.cell_size * units.cell_size;
  under_relax(s.felt_force, sum.force * units.force_to_si(1.0),
              relaxation_factor(particles.mass[i], to_kg * sum.entrained), sum.entrained > 0);
  under_relax(s.felt_torque, sum.torque * units.torque_to_si(1.0),
              relaxation_factor(particles.inertia[i], to_kg_m2 * sum.entrained_inertia), sum.entrained > 0);
  particles.external_force.add(i, s.felt_force);
  particles.external_torque.add(i, s.felt_torque);
  s.entrained = to_kg * sum.entrained, s.entrained_inertia = to_kg_m2 * sum.entrained_inertia;
}

/// From beads whose wires have broken since, too.
template <class Real>
void WireMap<Real>::take_back(double time_step, dem::Particles& particles) {
  for (const dem::ParticleId id : ever_mapped_) {
    State& s = states_[id];
    const Vec3 impulse = kTakenBack * s.lent_impulse, spin = kTakenBack * s.lent_spin;
    s.lent_impulse -= impulse, s.lent_spin -= spin;
    particles.external_force.add(particles.index(id), -impulse / time_step);
    particles.external_torque.add(particles.index(id), -spin / time_step);
  }
}

template <class Real>
void WireMap<Real>::add_drags(double time_step, const dem::Particles& particles,
                              const std::function<bool(dem::ParticleId)>& is_dragged,
                              std::vector<dem::LiquidDrag>& drags) {
  dragged_.clear();
  for (const dem::ParticleId id : wires_.beads()) {
    const State& s = states_[id];
    const dem::ParticleIndex i = particles.index(id);
    if (s.entrained <= 0 || particles.inverse_mass[i] == 0 || is_dragged(id)) continue;
    const double coefficient = kDrag * s.entrained / time_step;
    dem::LiquidDrag drag;
    drag.particle = i;
    drag.coefficient = {coefficient, coefficient};
    drag.liquid_mass = dem::kMovesOn;
    drag.liquid = particles.velocity[i];
    drag.spin_coefficient = kDrag * s.entrained_inertia / time_step;
    drag.liquid_spin = particles.angular_velocity[i];
    drags.push_back(drag);
    dragged_.push_back(id);
  }
}

template <class Real>
void WireMap<Real>::collect(std::span<const dem::LiquidDrag> drags) {
  require(drags.size() == dragged_.size(), "WireMap::collect: not the drags of the last step");
  for (std::size_t n = 0; n < dragged_.size(); ++n) {
    State& s = states_[dragged_[n]];
    s.lent_impulse += drags[n].impulse, s.lent_spin += drags[n].angular_impulse;
  }
}

template <class Real>
Vec3 WireMap<Real>::add_forces(const lbm::Fluid<Real>& fluid, dem::Particles& particles) {
  loads_.assign(pairs_.size(), {}), taken_.assign(pairs_.size(), Vec3::Zero());
  by_block_.for_each_block([&](std::size_t b) { add_loads(fluid, b); });
  parallel_for(0, wires_.beads().size(), 256, [&](std::size_t b) { hand_over(fluid, particles, b); });
  take_back(fluid.units().time_step, particles);
  for (const dem::ParticleId id : wires_.beads())
    require_finite_force(particles, particles.index(id), "bead", fluid.steps());
  Vec3 total = Vec3::Zero();
  for (const Vec3& t : taken_) total += t;
  return total;
}

template void WireMap<float>::add_loads(const lbm::Fluid<float>&, std::size_t);
template void WireMap<double>::add_loads(const lbm::Fluid<double>&, std::size_t);
template void WireMap<float>::take_back(double, dem::Particles&);
template void WireMap<double>::take_back(double, dem::Particles&);
template void WireMap<float>::add_drags(double, const dem::Particles&, const std::function<bool(dem::ParticleId)>&,
                                        std::vector<dem::LiquidDrag>&);
template void WireMap<double>::add_drags(double, const dem::Particles&, const std::function<bool(dem::ParticleId)>&,
                                         std::vector<dem::LiquidDrag>&);
template void WireMap<float>::collect(std::span<const dem::LiquidDrag>);
template void WireMap<double>::collect(std::span<const dem::LiquidDrag>);
template void WireMap<float>::hand_over(const lbm::Fluid<float>&, dem::Particles&, std::size_t);
template void WireMap<double>::hand_over(const lbm::Fluid<double>&, dem::Particles&, std::size_t);
template Vec3 WireMap<float>::add_forces(const lbm::Fluid<float>&, dem::Particles&);
template Vec3 WireMap<double>::add_forces(const lbm::Fluid<double>&, dem::Particles&);

}  // namespace lahar::coupling
