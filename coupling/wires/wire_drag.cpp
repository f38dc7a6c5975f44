#include "coupling/wires/wire_drag.h"

#include <algorithm>
#include <limits>

#include "core/parallel.h"
#include "core/sphere.h"
#include "coupling/rows.h"
#include "coupling/transfer_vectors.h"
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
/// What accelerates the liquid is a mean, to which each step adds so much of the newest: with a quarter of it no drag
/// swings up, however stiff, where liquid is up to 1.7 times as easily moved as its mass says.
constexpr double kNewestShare = 0.25;

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

/// Drag on a piece of wire in the liquid around it, SI.
struct WirePiece {
  Vec3 slip;       ///< velocity of the liquid less its own, before what drag adds to it in this step: that of the laws
  Vec3 slip_left;  ///< with it
  Vec3 tangent;    ///< unit
  double length;   ///< of the part that is wet
  double density;  ///< of the liquid
};

/// A direction across the stream, which a piece of wire that nothing holds is taken to have.
Vec3 across(const Vec3& slip) { return slip.squaredNorm() > 0 ? slip.unitOrthogonal() : Vec3(Vec3::UnitX()); }

/// Coefficients, over the slip that is left, of the laws across and along a wire at the slip of now: in a steady stream
/// each step takes the law's force off what is left.
void set_laws(const WirePiece& piece, const WireInCells& wire, dem::LiquidDrag& drag) {
  constexpr double slowest = 1e-9;     // m/s
  constexpr double least_left = 0.05;  // of the slip: stiffer drag takes all in any case
  const auto parts = [&](const Vec3& slip) {
    const double along = slip.dot(piece.tangent);
    return dem::AlongAndAcross{std::abs(along), (slip - along * piece.tangent).norm()};
  };
  const dem::AlongAndAcross of_law = parts(piece.slip), of_left = parts(piece.slip_left);
  const double along = std::max(of_law.along, slowest);
  const double sampled = std::max(of_law.across, slowest);
  // What is left of the slip that the law is asked at: the same share as of the slip of now.
  const auto left = [](double of_law_now, double of_left_now, double asked) {
    const double share = of_law_now > 0 ? asked / of_law_now : 1.0;
    return std::max(of_left_now * share, least_left * asked);
  };
  const double left_along = left(of_law.along, of_left.along, along);
  const double left_across = left(of_law.across, of_left.across, sampled);
  const double across = undisturbed_speed(sampled, wire, along), speed = std::hypot(across, along);
  const double scale = piece.density * piece.length;
  const Vec3 viscous = scale * viscous_drag(wire, across * Vec3::UnitX(), along * Vec3::UnitY());
  drag.axis = piece.tangent;
  drag.coefficient = {.along = viscous.y() / left_along, .across = viscous.x() / left_across};
  if (wire.fluid.yield_stress == 0) return;
  const YieldDrag yield = yield_drag(wire, speed);
  drag.friction = {.along = scale * yield.along, .across = scale * yield.across};
  drag.creep_speed = yield.creep_speed * std::hypot(left_across, left_along) / speed;  // the law is of `speed`
}

}  // namespace

template <class Real>
WireDrag<Real>::WireDrag(const dem::Particles& particles, const dem::Bonds& bonds) {
  place_.assign(particles.size(), -1);
  for (dem::ParticleId id = 0; id < particles.size(); ++id) {
    if (particles.kind[particles.index(id)] != dem::ParticleKind::bead) continue;
    place_[id] = static_cast<std::int32_t>(beads_.size());
    const double diameter = 2 * particles.radius[particles.index(id)];
    beads_.push_back({.id = id, .before = id, .after = id, .diameter = diameter, .length = 0.0});
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
  std::vector<double> mapped(beads_.size(), 0.0);  // m, of the wire of a bead
  for (const std::uint32_t k : wire_bonds_)
    for (const dem::ParticleId id : {bonds.id_i[k], bonds.id_j[k]}) {
      const auto at = static_cast<std::size_t>(place_[id]);
      (!is_mapped.empty() && is_mapped[k] ? mapped[at] : beads_[at].length) += bonds.rest_length[k] / 2;
    }
  for (std::size_t b = 0; b < beads_.size(); ++b)
    if (Bead& bead = beads_[b]; bead.length > 0) bead.lifted = bead.length / (bead.length + mapped[b]);
  since_look_ = kCrowdingEvery;  // other neighbours
}

template <class Real>
std::size_t WireDrag<Real>::beads() const {
  return static_cast<std::size_t>(
      std::count_if(beads_.begin(), beads_.end(), [](const Bead& bead) { return bead.length > 0; }));
}

template <class Real>
ExchangedMomentum WireDrag<Real>::apply(lbm::Fluid<Real>& fluid, dem::Particles& particles, SolidFields<Real>& fields,
                                        std::vector<dem::LiquidDrag>& drags, const GrainCoupling<Real>* grains) {
  find_pairs(fluid, particles);
  if (!pairs_.empty() && since_look_ >= kCrowdingEvery) look_at_neighbours(fluid, particles);
  ++since_look_;
  allocate_fields(fluid, fields);
  by_block_.for_each_block([&](std::size_t block) {
    for (const std::uint32_t k : by_block_.in(block)) weigh(fluid, pairs_[k]);
  });
  const double time_step = fluid.plan_time_step();
  parallel_for(0, beads_.size(), kBeadsPerTask,
               [&](std::size_t k) { choose_given(fluid, time_step, particles, beads_[k]); });
  by_block_.for_each_block([&](std::size_t block) {
    WiresInBlock& wires = wires_[wires_at_[block]];
    wires = {};
    for (const std::uint32_t k : by_block_.in(block)) spread(fluid, pairs_[k], wires);
    for (const std::uint32_t k : by_block_.in(block)) sample(fluid, pairs_[k], wires);
  });
  ExchangedMomentum total;
  wet_.clear();
  for (std::uint32_t k = 0; k < beads_.size(); ++k) {
    const Bead& bead = beads_[k];
    if (bead.weight == 0) continue;
    wet_.push_back(k);
    particles.external_force.add(particles.index(bead.id), bead.buoyancy);
    total.to_solids += bead.given;
    for (std::size_t p = bead.first_pair; p < bead.first_pair + bead.pairs; ++p) total.from_fluid += pairs_[p].given;
  }
  wet_beads_ = wet_.size();
  const std::size_t first = drags.size();
  drags.resize(first + wet_.size());
  parallel_for(0, wet_.size(), kBeadsPerTask,
               [&](std::size_t n) { drags[first + n] = drag_on(fluid, particles, grains, beads_[wet_[n]]); });
  return total;
}

template <class Real>
void WireDrag<Real>::collect(std::span<const dem::LiquidDrag> drags) {
  require(drags.size() == wet_.size(), "WireDrag::collect: not the drags of the last step");
  for (std::size_t n = 0; n < wet_.size(); ++n) {
    Bead& bead = beads_[wet_[n]];
    bead.impulse = drags[n].impulse, bead.liquid = drags[n].liquid;
  }
}

template <class Real>
Vec3 WireDrag<Real>::owed() const {
  Vec3 sum = Vec3::Zero();
  for (const Bead& bead : beads_) sum += bead.impulse;
  return sum;
}

template <class Real>
void WireDrag<Real>::look_at_neighbours(const lbm::Fluid<Real>& fluid, const dem::Particles& particles) {
  std::vector<WireSegment> pieces(beads_.size());
  for (std::size_t k = 0; k < beads_.size(); ++k) {
    const Bead& bead = beads_[k];
    const dem::ParticleIndex i = particles.index(bead.id);
    pieces[k] = {particles.position[i], tangent_of(particles, bead).value_or(Vec3::UnitX()), 2 * particles.radius[i],
                 bead.length};
  }
  const Vec3 period =
      lbm::kBlockWidth * fluid.units().cell_size * fluid.grid().domain().period().template cast<double>();
  const std::vector<Crowding> crowding = wire_crowding(pieces, period);
  for (std::size_t k = 0; k < beads_.size(); ++k) beads_[k].crowding = crowding[k];
  since_look_ = 0;
}

/// Along the wire: from the bead before to the one after. None of a bead that both its bonds have left.
template <class Real>
std::optional<Vec3> WireDrag<Real>::tangent_of(const dem::Particles& particles, const Bead& bead) {
  const Vec3 chord = particles.position[particles.index(bead.after)] - particles.position[particles.index(bead.before)];
  if (chord.squaredNorm() == 0) return std::nullopt;
  return Vec3(chord.normalized());
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
  wires_at_.resize(by_block_.blocks());
  std::uint32_t in_reach = 0;
  for (std::size_t b = 0; b < by_block_.blocks(); ++b) {
    if (!by_block_.any_in(b)) continue;
    wires_at_[b] = in_reach++;
    const auto block = static_cast<BlockIndex>(b);
    fields.reach(grid, block);
    // Nor before the first sweep: a checkpoint of then does not say which fields are fresh.
    if (fields.is_fresh(block) || fluid.steps() == 0) note_velocities(fluid, block);
    grid.require_impulse(block);
  }
  if (wires_.size() < in_reach) wires_.resize(in_reach);
}

template <class Real>
void WireDrag<Real>::weigh(const lbm::Fluid<Real>& fluid, BeadInBlock& pair) const {
  const Block<Real>& block = fluid.grid().block(pair.block);
  Row<Real> weight(0);
  for_rows<Real>(
      kernels_[pair.bead], pair.lowest, [&](int row, const Row<Real>& kernel) __attribute__((always_inline)) {
        weight += kernel * liquid_shares(block, row);
      });
  pair.weight = sum_in_double(weight);
}

/// Velocities as the last step left them, and what drag adds in this one; what buoyancy adds is balanced by pressure.
/// Dry cells hold some finite velocity, which counts for nothing.
template <class Real>
void WireDrag<Real>::sample(const lbm::Fluid<Real>& fluid, BeadInBlock& pair, const WiresInBlock& wires) const {
  const Block<Real>& block = fluid.grid().block(pair.block);
  const lbm::BodyFields<Real>& fields = *block.body;
  Row<Real> x(0), y(0), z(0), more_x(0), more_y(0), more_z(0), claims(0);
  for_rows<Real>(
      kernels_[pair.bead], pair.lowest, [&](int row, const Row<Real>& kernel) __attribute__((always_inline)) {
        const Row<Real> share = kernel * liquid_shares(block, row);
        const auto of = [&](const Real* field) __attribute__((always_inline)) {
          return share * load_aligned<Row<Real>>(field + row);
        };
        x += of(fields.velocity_x), y += of(fields.velocity_y), z += of(fields.velocity_z);
        more_x += of(wires.x), more_y += of(wires.y), more_z += of(wires.z);
        claims += of(wires.claims);
      });
  pair.velocity = Vec3(sum_in_double(x), sum_in_double(y), sum_in_double(z));
  pair.change = Vec3(sum_in_double(more_x), sum_in_double(more_y), sum_in_double(more_z));
  pair.claims = sum_in_double(claims);
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

/// Of the liquid that feels a bead's piece of wire, were there no other wire, cells.
template <class Real>
double WireDrag<Real>::liquid_volume(const lbm::Fluid<Real>& fluid, const Bead& bead) const {
  const double dx = fluid.units().cell_size, wide = kernel_scale(bead.diameter / dx) / kRomaSquares;
  return bead.share * wide * wide * bead.length / dx;
}

/// What the cells give for the bead: its buoyancy in the coming step, of `time_step` s, and what drag gave it in the
/// last.
template <class Real>
void WireDrag<Real>::choose_given(const lbm::Fluid<Real>& fluid, double time_step, dem::Particles& particles,
                                  Bead& bead) const {
  bead.weight = 0;
  for (std::size_t p = bead.first_pair; p < bead.first_pair + bead.pairs; ++p) bead.weight += pairs_[p].weight;
  if (bead.weight < 1e-6) bead.weight = 0;
  const auto& units = fluid.units();
  const dem::ParticleIndex i = particles.index(bead.id);
  if (bead.weight == 0) {
    if (bead.dragged) particles.external_force.add(i, -bead.impulse / time_step);
    bead.dragged = false, bead.impulse = Vec3::Zero();
    return;
  }
  bead.share = wet_share(fluid, bead);
  bead.buoyancy =
      -bead.share * bead.lifted * fluid.options().density * sphere_volume(bead.diameter / 2) * fluid.options().gravity;
  // Forces act over the coming step, and the fluid stretches what cells get to it; impulses are what they are. The
  // velocities that wires sample are those of the step that has ended.
  bead.change = units.force_to_lu(1.0) / units.time_step * bead.impulse;
  bead.given = units.force_to_lu(1.0) * (bead.impulse / time_step + bead.buoyancy);
}

/// The impulse of a cell is that of a full one: a cell of level F gets F of it.
template <class Real>
void WireDrag<Real>::spread(lbm::Fluid<Real>& fluid, BeadInBlock& pair, WiresInBlock& wires) const {
  const Bead& bead = beads_[pair.bead];
  pair.given.setZero();
  if (bead.weight == 0) return;
  Block<Real>& block = fluid.grid().block(pair.block);
  lbm::ImpulseFields<Real>& impulse = *block.impulse;
  const Vec3 unit = bead.given / bead.weight, of_drag = bead.change / bead.weight;
  const Row<Real> ux(static_cast<Real>(unit.x())), uy(static_cast<Real>(unit.y())), uz(static_cast<Real>(unit.z()));
  const Row<Real> dx(static_cast<Real>(of_drag.x())), dy(static_cast<Real>(of_drag.y())),
      dz(static_cast<Real>(of_drag.z()));
  const Row<Real> claim(static_cast<Real>(liquid_volume(fluid, bead) / bead.weight));
  Row<Real> x(0), y(0), z(0);
  for_rows<Real>(
      kernels_[pair.bead], pair.lowest, [&](int row, const Row<Real>& kernel) __attribute__((always_inline)) {
        const Row<Real> share = kernel * liquid_shares(block, row), level = water_in(block, row / lbm::kBlockWidth);
        const Row<Real> full = select(share > Row<Real>(0), share / level, Row<Real>(0));
        add_to_row(impulse.x + row, -full * ux), add_to_row(impulse.y + row, -full * uy);
        add_to_row(impulse.z + row, -full * uz);
        add_to_row(wires.x + row, -full * dx), add_to_row(wires.y + row, -full * dy);
        add_to_row(wires.z + row, -full * dz), add_to_row(wires.claims + row, full * claim);
        x += share * ux, y += share * uy, z += share * uz;
      });
  pair.given = Vec3(sum_in_double(x), sum_in_double(y), sum_in_double(z));
}

/// Drag on a bead from now on, in liquid that goes on to be accelerated as it was.
template <class Real>
dem::LiquidDrag WireDrag<Real>::drag_on(const lbm::Fluid<Real>& fluid, const dem::Particles& particles,
                                        const GrainCoupling<Real>* grains, Bead& bead) const {
  const auto& units = fluid.units();
  const dem::ParticleIndex i = particles.index(bead.id);
  Vec3 velocity = Vec3::Zero(), change = Vec3::Zero();
  double claims = 0;
  for (std::size_t p = bead.first_pair; p < bead.first_pair + bead.pairs; ++p)
    velocity += pairs_[p].velocity, change += pairs_[p].change, claims += pairs_[p].claims / bead.weight;
  const auto of_liquid = [&](const Vec3& sampled) {  // between averaged grains
    const Vec3 place = (particles.position[i] - fluid.grid().domain().origin()) / units.cell_size;
    return Vec3(units.velocity_to_si(1.0) * (grains ? grains->liquid_velocity(place, sampled) : sampled));
  };
  const Vec3 before = of_liquid(velocity / bead.weight), liquid = of_liquid((velocity + change) / bead.weight);
  if (bead.dragged)
    bead.acceleration += kNewestShare * (liquid - bead.liquid) / units.time_step;
  else
    bead.acceleration = Vec3::Zero();
  bead.dragged = true;
  const double d = bead.diameter, rho = fluid.options().density;
  const WireInCells wire{.diameter = d,
                         .diameter_cells = d / units.cell_size,
                         .fluid = lbm::shear_law(fluid.options().rheology, fluid.options().kinematic_viscosity, rho),
                         .screen = bead.crowding};
  dem::LiquidDrag drag;
  drag.particle = i;
  drag.liquid = liquid, drag.acceleration = bead.acceleration;
  drag.liquid_mass = units.mass() * liquid_volume(fluid, bead) / std::max(1.0, claims);
  const Vec3 slip = before - particles.velocity[i];
  const std::optional<Vec3> tangent = tangent_of(particles, bead);
  set_laws({.slip = slip,
            .slip_left = liquid - particles.velocity[i],
            .tangent = tangent ? *tangent : across(slip),
            .length = bead.share * bead.length,
            .density = rho},
           wire, drag);
  return drag;
}

template <class Real>
void WireDrag<Real>::transfer(Archive& archive) {
  archive.value("wet_beads", wet_beads_);
  archive.value("since_look", since_look_);
  archive.pieces<double>("bead", beads_.size(), 13, [&](std::size_t k, double* stored) {
    Bead& bead = beads_[k];
    transfer_vectors(archive, {&bead.impulse, &bead.liquid, &bead.acceleration}, stored);
    Crowding& c = bead.crowding;
    double* const own[] = {&c.area, &c.parallel, &c.solidity};
    for (std::size_t a = 0; a < 3; ++a) archive.loading() ? *own[a] = stored[9 + a] : stored[9 + a] = *own[a];
    if (archive.loading())
      bead.dragged = stored[12] != 0;
    else
      stored[12] = bead.dragged ? 1 : 0;
  });
}

template class WireDrag<float>;
template class WireDrag<double>;

}  // namespace lahar::coupling
