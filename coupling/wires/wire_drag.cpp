#include "coupling/wires/wire_drag.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "core/parallel.h"
#include "coupling/rows.h"
#include "coupling/wires/drag_law.h"
#include "coupling/wires/wire_bonds.h"
#include "coupling/wires/wire_crowding.h"
#include "coupling/wires/wire_kernel.h"
#include "lbm/grid/block_geometry.h"
#include "lbm/grid/row_types.h"
#include "lbm/step/cell_moments.h"

namespace lahar::coupling {

using lbm::Block;
using lbm::BlockIndex;
using lbm::kNoBlock;

namespace {

constexpr std::int64_t kCrowdingEvery = 32;  // fluid steps between looks at the neighbours
constexpr std::size_t kBeadsPerTask = 128;

/// Calls visit(first cell of a row, kernel weights of its eight cells) for the rows of a block within reach. `lowest`:
/// the first cell of the block.
template <class Real, class Visit>
[[gnu::always_inline]] inline void for_rows(const WireKernel& kernel, const Vec3i& lowest, const Visit& visit) {
  const Vec3i from = (kernel.lowest() - lowest).cwiseMax(0);
  const Vec3i to = (kernel.highest() - lowest).cwiseMin(lbm::kBlockWidth - 1), shift = lowest - kernel.lowest();
  Row<Real> along(0);
  for (int x = from.x(); x <= to.x(); ++x)
    along.set(static_cast<std::size_t>(x), static_cast<Real>(kernel.weight(0, x + shift.x())));
  for (int z = from.z(); z <= to.z(); ++z)
    for (int y = from.y(); y <= to.y(); ++y) {
      const double across = kernel.weight(1, y + shift.y()) * kernel.weight(2, z + shift.z());
      visit(lbm::cell_index(0, y, z), Row<Real>(static_cast<Real>(across) * along));
    }
}

/// Share of each cell of a row that is liquid: 0 in dry ones.
template <class Real>
[[gnu::always_inline]] inline Row<Real> liquid_shares(const Block<Real>& block, int row) {
  const Row<Real> none(0), one(1);
  const auto wet = Row<Real>::mask_type::from_bits(lbm::wet_cells(block, row / lbm::kBlockWidth));
  Row<Real> share = block.surface ? load_aligned<Row<Real>>(block.surface->fill_level + row) : one;
  if (block.body) share = max(none, share - min(one, load_aligned<Row<Real>>(block.body->solid_fraction + row)));
  return select(wet, share, none);
}

/// A piece of wire in the liquid around it, SI.
struct WirePiece {
  Vec3 relative;  ///< velocity of the liquid less its own
  Vec3 tangent;
  double length, density;  ///< of the piece; of the liquid
  double share;            ///< of the piece that is wet
  double time_step;
  double inverse_mass;  ///< of the bead
  double mass;          ///< that a change of the relative velocity moves (drag_over_a_step.h)
};

/// Drag on a piece of wire, N: normal and tangential parts by their own laws. What the yield stress adds is friction:
/// it does no more than stop the wire in this step.
Vec3 wire_force(const WirePiece& piece, const WireInCells& wire, DraggedSlip& slip) {
  const Vec3& t = piece.tangent;
  const Vec3 along = piece.relative.dot(t) * t, across = piece.relative - along;
  const double sampled = across.norm(), sampled_along = along.norm();
  const double speed = undisturbed_speed(sampled, wire, sampled_along);
  const Vec3 normal_velocity = sampled > 0 ? Vec3(across * (speed / sampled)) : Vec3(Vec3::Zero());
  const double scale = piece.share * piece.density * piece.length;
  const Vec3 drag = scale * viscous_drag(wire, normal_velocity, along);
  const Vec3 drag_along = drag.dot(t) * t, drag_across = drag - drag_along;
  const auto taken_off = [&](const Vec3& force, double of_slip) {  // x of drag_over_a_step.h
    return of_slip > 0 ? force.norm() / of_slip * piece.time_step / piece.mass : 0.0;
  };
  slip.begin(piece.relative);
  const Vec3 taken = slip.bounded_drag(taken_off(drag_along, sampled_along), along) +
                     slip.bounded_drag(taken_off(drag_across, sampled), across);
  const Vec3 force = piece.mass / piece.time_step * taken;
  if (wire.fluid.yield_stress == 0) return force;
  const Vec3 friction = scale * yield_drag(wire, normal_velocity, along);
  const double stop = piece.inverse_mass > 0
                          ? piece.share * piece.relative.norm() / (piece.inverse_mass * piece.time_step)
                          : std::numeric_limits<double>::infinity();
  return force + std::min(1.0, stop / std::max(friction.norm(), 1e-300)) * friction;
}

}  // namespace

template <class Real>
WireDrag<Real>::WireDrag(const dem::Particles& particles, const dem::Bonds& bonds) {
  place_.assign(particles.size(), -1);
  for (dem::ParticleId id = 0; id < particles.size(); ++id) {
    if (particles.kind[particles.index(id)] != dem::ParticleKind::bead) continue;
    place_[id] = static_cast<std::int32_t>(beads_.size());
    beads_.push_back({.id = id, .before = id, .after = id, .length = 0.0});
  }
  for (std::size_t k = 0; k < bonds.size(); ++k) {
    if (is_wire(particles, bonds, k)) wire_bonds_.push_back(static_cast<std::uint32_t>(k));
  }
  join_neighbours(bonds);
  leave_out(bonds, {});
}

template <class Real>
void WireDrag<Real>::join_neighbours(const dem::Bonds& bonds) {
  for (Bead& bead : beads_) bead.before = bead.after = bead.id;
  whole_ = 0;
  for (const std::uint32_t k : wire_bonds_) {
    if (!bonds.intact[k]) continue;
    beads_[static_cast<std::size_t>(place_[bonds.id_i[k]])].after = bonds.id_j[k];
    beads_[static_cast<std::size_t>(place_[bonds.id_j[k]])].before = bonds.id_i[k];
    ++whole_;
  }
}

template <class Real>
void WireDrag<Real>::follow_breakage(const dem::Bonds& bonds) {
  const auto whole =
      std::count_if(wire_bonds_.begin(), wire_bonds_.end(), [&](std::uint32_t k) { return bonds.intact[k] != 0; });
  if (static_cast<std::size_t>(whole) != whole_) join_neighbours(bonds);
}

template <class Real>
void WireDrag<Real>::leave_out(const dem::Bonds& bonds, const std::vector<std::uint8_t>& is_mapped) {
  for (Bead& bead : beads_) bead.length = 0;
  for (const std::uint32_t k : wire_bonds_) {
    if (!is_mapped.empty() && is_mapped[k]) continue;
    for (const dem::ParticleId id : {bonds.id_i[k], bonds.id_j[k]})
      beads_[static_cast<std::size_t>(place_[id])].length += bonds.rest_length[k] / 2;
  }
  since_look_ = kCrowdingEvery;  // other neighbours
}

template <class Real>
std::size_t WireDrag<Real>::beads() const {
  return static_cast<std::size_t>(
      std::count_if(beads_.begin(), beads_.end(), [](const Bead& bead) { return bead.length > 0; }));
}

template <class Real>
ExchangedMomentum WireDrag<Real>::apply(lbm::Fluid<Real>& fluid, dem::Particles& particles, SolidFields<Real>& fields,
                                        const GrainCoupling<Real>* grains) {
  find_pairs(fluid, particles);
  if (!pairs_.empty() && since_look_ >= kCrowdingEvery) look_at_neighbours(fluid, particles);
  ++since_look_;
  allocate_fields(fluid, fields);
  by_block_.for_each_block([&](std::size_t block) {
    for (const std::uint32_t k : by_block_.in(block)) sample(fluid, pairs_[k]);
  });
  const double stretch = fluid.plan_time_step() / fluid.units().time_step;
  parallel_for(0, beads_.size(), kBeadsPerTask, [&](std::size_t k) {
    choose_force(fluid, particles, grains, beads_[k]);
    beads_[k].slip.stretch(stretch);
  });
  by_block_.for_each_block([&](std::size_t block) {
    for (const std::uint32_t k : by_block_.in(block)) spread(fluid, pairs_[k]);
  });
  ExchangedMomentum total;
  wet_beads_ = 0;
  for (const Bead& bead : beads_) {
    if (bead.weight == 0) continue;
    ++wet_beads_;
    total.to_solids += bead.force;
    particles.external_force.add(particles.index(bead.id), bead.force * fluid.units().force_to_si(1.0));
    for (std::size_t p = bead.first_pair; p < bead.first_pair + bead.pairs; ++p) total.from_fluid -= pairs_[p].given;
  }
  return total;
}

template <class Real>
void WireDrag<Real>::look_at_neighbours(const lbm::Fluid<Real>& fluid, const dem::Particles& particles) {
  std::vector<WireSegment> pieces(beads_.size());
  for (std::size_t k = 0; k < beads_.size(); ++k) {
    const Bead& bead = beads_[k];
    const dem::ParticleIndex i = particles.index(bead.id);
    pieces[k] = {particles.position[i], tangent_of(particles, bead), 2 * particles.radius[i], bead.length};
  }
  const Vec3 period =
      lbm::kBlockWidth * fluid.units().cell_size * fluid.grid().domain().period().template cast<double>();
  const std::vector<Crowding> crowding = wire_crowding(pieces, period);
  for (std::size_t k = 0; k < beads_.size(); ++k) beads_[k].crowding = crowding[k];
  since_look_ = 0;
}

/// Along the wire: from the bead before to the one after.
template <class Real>
Vec3 WireDrag<Real>::tangent_of(const dem::Particles& particles, const Bead& bead) {
  const Vec3 chord = particles.position[particles.index(bead.after)] - particles.position[particles.index(bead.before)];
  return chord.squaredNorm() > 0 ? Vec3(chord.normalized()) : Vec3(Vec3::UnitX());
}

/// Pairs of beads and wet blocks, chunk by chunk, then one after the other.
template <class Real>
void WireDrag<Real>::find_pairs(const lbm::Fluid<Real>& fluid, const dem::Particles& particles) {
  kernels_.resize(beads_.size());
  chunk_pairs_.resize((beads_.size() + kBeadsPerTask - 1) / kBeadsPerTask);
  parallel_for_chunks(beads_.size(), kBeadsPerTask, [&](std::size_t first, std::size_t last) {
    auto& pairs = chunk_pairs_[first / kBeadsPerTask];
    pairs.clear();
    for (std::size_t k = first; k < last; ++k) look_up_blocks(fluid, particles, k, pairs);
  });
  pairs_.clear();
  for (const auto& pairs : chunk_pairs_) pairs_.insert(pairs_.end(), pairs.begin(), pairs.end());
  std::size_t pairs = 0;
  for (Bead& bead : beads_) bead.first_pair = pairs, pairs += bead.pairs;
  by_block_.sort(pairs_, fluid.grid().topology().capacity());
}

template <class Real>
void WireDrag<Real>::look_up_blocks(const lbm::Fluid<Real>& fluid, const dem::Particles& particles, std::size_t k,
                                    std::vector<BeadInBlock>& pairs) {
  const auto& grid = fluid.grid();
  Bead& bead = beads_[k];
  bead.pairs = 0;
  if (bead.length <= 0) return;
  const dem::ParticleIndex i = particles.index(bead.id);
  const double dx = fluid.units().cell_size;
  WireKernel& kernel = kernels_[k];
  kernel.set_reach((particles.position[i] - grid.domain().origin()) / dx, kernel_scale(2 * particles.radius[i] / dx));
  const Vec3i low = lbm::block_of(kernel.lowest()), high = lbm::block_of(kernel.highest());
  // Beads of a wire follow each other: mostly the block is that of the one before.
  const bool known = !pairs.empty() && pairs.back().lowest == low * lbm::kBlockWidth;
  const BlockIndex first = known ? pairs.back().block : grid.topology().find(low);
  const bool by_neighbours = first != kNoBlock && (high - low).maxCoeff() <= 1;
  for (int x = low.x(); x <= high.x(); ++x)
    for (int y = low.y(); y <= high.y(); ++y)
      for (int z = low.z(); z <= high.z(); ++z) {
        const Vec3i place(x, y, z), step = place - low;
        const auto slot = static_cast<std::size_t>(lbm::neighbour_slot(step.x(), step.y(), step.z()));
        const BlockIndex b = by_neighbours ? grid.topology().neighbours(first)[slot] : grid.topology().find(place);
        if (b == kNoBlock || grid.block(b).wet_cells == 0) continue;
        pairs.push_back({b, static_cast<std::uint32_t>(k), place * lbm::kBlockWidth});
        ++bead.pairs;
      }
  if (bead.pairs > 0) kernel.set_weights();
}

namespace {

/// What the sweep would have left in fields that a block has just got.
template <class Real>
void note_velocities(lbm::Fluid<Real>& fluid, BlockIndex b) {
  auto& grid = fluid.grid();
  Block<Real>& block = grid.block(b);
  lbm::BodyFields<Real>& fields = *block.body;
  const Vec3 half = 0.5 * fluid.units().acceleration_to_lu(1.0) * fluid.options().gravity;
  const Real x = static_cast<Real>(half.x()), y = static_cast<Real>(half.y()), z = static_cast<Real>(half.z());
  for (int n = 0; n < lbm::kBlockCells; ++n) {
    if (!lbm::is_wet(block.type[static_cast<std::size_t>(n)])) continue;
    const auto m = lbm::outgoing_moments(grid, {b, n}, fluid.parity());
    fields.velocity_x[n] = m.u[0] - x, fields.velocity_y[n] = m.u[1] - y, fields.velocity_z[n] = m.u[2] - z;
  }
}

}  // namespace

/// Blocks in reach get fields, so that impulses can be written and velocities sampled there.
template <class Real>
void WireDrag<Real>::allocate_fields(lbm::Fluid<Real>& fluid, SolidFields<Real>& fields) {
  auto& grid = fluid.grid();
  for (std::size_t b = 0; b < by_block_.blocks(); ++b) {
    if (!by_block_.any_in(b)) continue;
    const auto block = static_cast<BlockIndex>(b);
    fields.reach(grid, block);
    if (fields.is_fresh(block)) note_velocities(fluid, block);
    grid.require_impulse(block);
  }
}

/// Dry cells hold some finite velocity, which counts for nothing.
template <class Real>
void WireDrag<Real>::sample(const lbm::Fluid<Real>& fluid, BeadInBlock& pair) const {
  const Block<Real>& block = fluid.grid().block(pair.block);
  const lbm::BodyFields<Real>& fields = *block.body;
  Row<Real> weight(0), x(0), y(0), z(0);
  for_rows<Real>(
      kernels_[pair.bead], pair.lowest, [&](int row, const Row<Real>& kernel) __attribute__((always_inline)) {
        const Row<Real> share = kernel * liquid_shares(block, row);
        weight += share;
        x += share * load_aligned<Row<Real>>(fields.velocity_x + row);
        y += share * load_aligned<Row<Real>>(fields.velocity_y + row);
        z += share * load_aligned<Row<Real>>(fields.velocity_z + row);
      });
  pair.weight = sum_in_double(weight);
  pair.velocity = Vec3(sum_in_double(x), sum_in_double(y), sum_in_double(z));
}

/// Sum of the kernel's weights over wall cells.
template <class Real>
double WireDrag<Real>::share_in_walls(const lbm::Fluid<Real>& fluid, const WireKernel& kernel) const {
  const auto& grid = fluid.grid();
  const Vec3i count = kernel.highest() - kernel.lowest();
  double sum = 0;
  for (int x = 0; x <= count.x(); ++x)
    for (int y = 0; y <= count.y(); ++y)
      for (int z = 0; z <= count.z(); ++z) {
        const Vec3i cell = lbm::image_of(grid.domain(), kernel.lowest() + Vec3i(x, y, z));
        const BlockIndex b = grid.topology().find(lbm::block_of(cell));
        const lbm::CellType type =
            b == kNoBlock
                ? grid.domain().classify(cell)
                : grid.block(b)
                      .type[static_cast<std::size_t>(lbm::cell_index(cell.x() & 7, cell.y() & 7, cell.z() & 7))];
        if (type == lbm::CellType::wall) sum += kernel.weight(0, x) * kernel.weight(1, y) * kernel.weight(2, z);
      }
  return sum;
}

/// Share of a bead that is wet: at the surface wires within reach of it count as partly wet; in walls there is nothing
/// that could be wet.
template <class Real>
double WireDrag<Real>::wet_share(const lbm::Fluid<Real>& fluid, const Bead& bead) const {
  constexpr double whole = 1 - 1e-3;
  const WireKernel& kernel = kernels_[static_cast<std::size_t>(place_[bead.id])];
  const double open = bead.weight < whole ? 1 - share_in_walls(fluid, kernel) : 1.0;
  return std::min(1.0, bead.weight / std::max(open, 0.1));
}

/// Drag and buoyancy of what was sampled.
template <class Real>
void WireDrag<Real>::choose_force(const lbm::Fluid<Real>& fluid, const dem::Particles& particles,
                                  const GrainCoupling<Real>* grains, Bead& bead) const {
  const auto& units = fluid.units();
  bead.weight = 0, bead.force = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  for (std::size_t p = bead.first_pair; p < bead.first_pair + bead.pairs; ++p)
    bead.weight += pairs_[p].weight, velocity += pairs_[p].velocity;
  if (bead.weight < 1e-6) bead.weight = 0;
  if (bead.weight == 0) return bead.slip.forget();
  const dem::ParticleIndex i = particles.index(bead.id);
  velocity /= bead.weight;
  if (grains)
    velocity =
        grains->liquid_velocity((particles.position[i] - fluid.grid().domain().origin()) / units.cell_size, velocity);
  const double d = 2 * particles.radius[i], rho = fluid.options().density, cells = d / units.cell_size;
  const WireInCells wire{.diameter = d,
                         .diameter_cells = cells,
                         .fluid = lbm::shear_law(fluid.options().rheology, fluid.options().kinematic_viscosity, rho),
                         .screen = bead.crowding};
  const double share = wet_share(fluid, bead);
  const double wide =
      kernel_scale(cells) * units.cell_size / kRomaSquares;  // the liquid that feels the wire, across it
  const double of_liquid = share * rho * wide * wide * bead.length, inverse_mass = particles.inverse_mass[i];
  const Vec3 drag = wire_force({.relative = units.velocity_to_si(1.0) * velocity - particles.velocity[i],
                                .tangent = tangent_of(particles, bead),
                                .length = bead.length,
                                .density = rho,
                                .share = share,
                                .time_step = units.time_step,
                                .inverse_mass = inverse_mass,
                                .mass = 1 / (inverse_mass + 1 / of_liquid)},
                               wire, bead.slip);
  const Vec3 buoyancy = -share * rho * std::numbers::pi / 4 * d * d * bead.length * fluid.options().gravity;
  bead.force = (drag + buoyancy) * units.force_to_lu(1.0);
}

/// Gives the opposite of the force to the cells, as they were sampled. The impulse of a cell is that of a full one: a
/// cell of level F gets F of it.
template <class Real>
void WireDrag<Real>::spread(lbm::Fluid<Real>& fluid, BeadInBlock& pair) const {
  const Bead& bead = beads_[pair.bead];
  pair.given.setZero();
  if (bead.weight == 0) return;
  Block<Real>& block = fluid.grid().block(pair.block);
  lbm::ImpulseFields<Real>& impulse = *block.impulse;
  const Vec3 unit = -bead.force / bead.weight;
  const Row<Real> ux(static_cast<Real>(unit.x())), uy(static_cast<Real>(unit.y())), uz(static_cast<Real>(unit.z()));
  Row<Real> x(0), y(0), z(0);
  for_rows<Real>(
      kernels_[pair.bead], pair.lowest, [&](int row, const Row<Real>& kernel) __attribute__((always_inline)) {
        const Row<Real> share = kernel * liquid_shares(block, row), level = water_in(block, row / lbm::kBlockWidth);
        const Row<Real> full = select(share > Row<Real>(0), share / level, Row<Real>(0));
        add_to_row(impulse.x + row, full * ux), add_to_row(impulse.y + row, full * uy);
        add_to_row(impulse.z + row, full * uz);
        x += share * ux, y += share * uy, z += share * uz;
      });
  pair.given = Vec3(sum_in_double(x), sum_in_double(y), sum_in_double(z));
}

template <class Real>
void WireDrag<Real>::transfer(Archive& archive) {
  archive.value("wet_beads", wet_beads_);
  archive.value("since_look", since_look_);
  constexpr std::size_t of_slip = DraggedSlip::kNumbers;
  archive.pieces<double>("bead", beads_.size(), 3 + of_slip, [&](std::size_t k, double* stored) {
    Crowding& c = beads_[k].crowding;
    double* const own[] = {&c.area, &c.parallel, &c.solidity};
    for (std::size_t a = 0; a < 3; ++a) {
      if (archive.loading())
        *own[a] = stored[a];
      else
        stored[a] = *own[a];
    }
    if (archive.loading())
      beads_[k].slip.load(stored + 3);
    else
      beads_[k].slip.store(stored + 3);
  });
}

template class WireDrag<float>;
template class WireDrag<double>;

}  // namespace lahar::coupling
