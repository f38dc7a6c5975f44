// What bodies write into the blocks: volumes, fields, displaced liquid. Compiled without contraction of products and
// sums, so that the same row gives the same numbers wherever it is inlined.
#include "coupling/grains/body_map_parts.h"
#include "coupling/grains/body_rows.h"
#include "lbm/free_surface/covered_cells.h"
#include "lbm/free_surface/touching.h"

namespace lahar::coupling {

using lbm::Block;
using lbm::BlockIndex;
using lbm::CellType;
using lbm::kBlockWidth;

namespace {

/// What an interface cell lacks to be full, lu; not below 0.
template <class Real>
Real room_of(const Block<Real>& block, int cell) {
  return std::max(Real(0), Real(1) + block.surface->density[cell] - block.surface->mass[cell]);
}

/// Calls visit(first cell of the row, eps) for the rows of a block that a body covers.
template <class Body, class Visit>
[[gnu::always_inline]] inline void for_rows(const Body& body, const Vec3i& lowest, const Visit& visit) {
  for_rows_near(
      body, lowest, covered_reach(body), [&](int y, int z) __attribute__((always_inline)) {
        visit(lbm::cell_index(0, y, z), fraction_row(body, lowest.x(), lowest.y() + y, lowest.z() + z));
      });
}

/// Volume of a body in a block, in cells.
template <class Real, class Body>
double volume_in(const Body body, const Vec3i& lowest) {
  lbm::Row<Real> lanes(0);
  for_rows(
      body, lowest, [&](int, const lbm::Row<Real>& eps) __attribute__((always_inline)) { lanes += eps; });
  double sum = 0;
  for (std::size_t c = 0; c < kBlockWidth; ++c) sum += static_cast<double>(static_cast<Real>(lanes[c]));
  return sum;
}

/// field <- change(field) in a row of a block.
template <class Real, class Change>
[[gnu::always_inline]] inline void update_row(Real* field, const Change& change) {
  change(lbm::Row<Real>(field, stdx::vector_aligned)).copy_to(field, stdx::vector_aligned);
}

/// Adds a body to the fields of a block; s is its middle, its velocity and its spin. By copies: what is written could
/// otherwise be part of them. Weighted by eps the coverage and the resistance are the solid fraction itself.
template <bool kByDistance, class Real, class Body>
[[gnu::noinline]] void write_body(const Body body, const GridSphere<Real> s, const Vec3i lowest,
                                  lbm::BodyFields<Real>& f) {
  using Row = lbm::Row<Real>;
  const Row rx = (static_cast<Real>(lowest.x()) + row_places<Real>()) + Real(0.5) - s.centre[0];
  const Row along_y = multiply_add(Row(s.spin[2]), rx, Row(s.velocity[1])), minus_y(-s.spin[1]);
  for_rows_near(
      body, lowest, reach_of(body), [&](int y, int z) __attribute__((always_inline)) {
        const RowCover<Real> cover = cover_row<kByDistance>(body, lowest.x(), lowest.y() + y, lowest.z() + z);
        const Real ry = static_cast<Real>(lowest.y() + y) + Real(0.5) - s.centre[1];
        const Real rz = static_cast<Real>(lowest.z() + z) + Real(0.5) - s.centre[2];
        const Real u = multiply_add(-s.spin[2], ry, multiply_add(s.spin[1], rz, s.velocity[0]));
        const Real w = multiply_add(s.spin[0], ry, s.velocity[2]), turn = s.spin[0] * rz;
        const int row = lbm::cell_index(0, y, z);
        const auto carry = [&](const Row& velocity) __attribute__((always_inline)) {
          return [&cover, velocity ](const Row& momentum) __attribute__((always_inline)) {
            return multiply_add(cover.coverage, velocity, momentum);
          };
        };
        const Row fraction = Row(f.solid_fraction + row, stdx::vector_aligned) + cover.fraction;
        fraction.copy_to(f.solid_fraction + row, stdx::vector_aligned);
        if constexpr (kByDistance) {
          update_row(
              f.coverage + row, [&](const Row& sum) __attribute__((always_inline)) { return sum + cover.coverage; });
          update_row(
              f.resistance + row, [&](const Row& sum) __attribute__((always_inline)) {
                return joined_resistance<Row>(sum, cover.coverage, lbm::number<Row>(kGapResistance));
              });
        } else {
          fraction.copy_to(f.coverage + row, stdx::vector_aligned);
          fraction.copy_to(f.resistance + row, stdx::vector_aligned);
        }
        const Row velocity[3] = {Row(u), along_y - turn, multiply_add(minus_y, rx, Row(w))};
        update_row(f.momentum_x + row, carry(velocity[0]));
        update_row(f.momentum_y + row, carry(velocity[1]));
        update_row(f.momentum_z + row, carry(velocity[2]));
      });
}

template <class Real>
void clear_mapping(lbm::BodyFields<Real>& f) {
  for (Real* field : {f.solid_fraction, f.coverage, f.resistance, f.momentum_x, f.momentum_y, f.momentum_z})
    std::fill(field, field + lbm::kBlockCells, Real(0));
}

template <class Real>
bool is_mixed(const Block<Real>& block) {
  return block.wet_cells < lbm::kBlockCells || block.surface;
}

}  // namespace

/// The wet volume of the former mapping under the cell types of now: conversions have booked their part already.
template <class Real>
void BodyMap<Real>::measure_old(lbm::Fluid<Real>& fluid) {
  parallel_for(0, bodies_.size(), 64, [&](std::size_t k) {
    double sum = 0;
    for (std::size_t p = bodies_[k].first_pair; p < bodies_[k].first_pair + bodies_[k].pairs; ++p) {
      Pair& pair = pairs_[p];
      if (!is_alive(fluid, pair)) {
        pair.wet_volume = 0;
        continue;
      }
      const Block<Real>& block = fluid.grid().block(pair.block);
      pair.wet_volume = pair.volume;
      if (block.wet_cells < lbm::kBlockCells) measure_wet(block, pair);
      sum += pair.wet_volume;
    }
    old_wet_[bodies_[k].particle] = sum;
  });
}

/// Scales each sphere to its exact volume, where all blocks that it reaches exist.
template <class Real>
void BodyMap<Real>::normalize() {
  parallel_for(0, bodies_.size(), 64, [&](std::size_t k) {
    const Body& b = bodies_[k];
    if (b.change != Change::place) return;
    double sum = 0;
    for (std::size_t p = b.first_pair; p < b.first_pair + b.pairs; ++p) {
      pairs_[p].volume = volume_in<Real>(spheres_[k], pairs_[p].lowest);
      sum += pairs_[p].volume;
    }
    const double factor = b.all_blocks && sum > 0 ? b.volume / sum : 1.0;
    spheres_[k].factor = static_cast<Real>(factor);
    for (std::size_t p = b.first_pair; p < b.first_pair + b.pairs; ++p) pairs_[p].volume *= factor;
  });
}

template <class Real>
void BodyMap<Real>::write_fields(lbm::Fluid<Real>& fluid) {
  auto& grid = fluid.grid();
  written_.assign(block_start_.size(), 0);
  for (const BlockIndex b : grid.owned()) {
    const auto at = static_cast<std::size_t>(b);
    if (block_start_[at] < block_start_[at + 1]) {
      lbm::BodyFields<Real>& fields = grid.require_body(b);
      fields.used = true;
      written_[at] = !is_same(fields, at);
    } else if (lbm::BodyFields<Real>* fields = grid.block(b).body; fields && fields->mapped) {
      clear_mapping(*fields);
      fields->mapped = false;
    }
  }
  for_each_block([&](std::size_t b) { write_block(fluid, static_cast<BlockIndex>(b)); });
  wet_volume_ = 0;
  for (const Pair& p : pairs_) wet_volume_ += p.wet_volume;
}

/// Whether the block holds what its bodies would write again.
template <class Real>
bool BodyMap<Real>::is_same(const lbm::BodyFields<Real>& fields, std::size_t block) const {
  if (!fields.mapped || former_start_.size() < block + 2) return false;
  const auto pairs = pairs_of(block_start_, block);
  if (former_start_[block + 1] - former_start_[block] != pairs.size()) return false;
  return std::all_of(pairs.begin(), pairs.end(),
                     [&](std::uint32_t p) { return bodies_[pairs_[p].body].change == Change::none; });
}

template <class Real>
void BodyMap<Real>::write_block(lbm::Fluid<Real>& fluid, BlockIndex index) {
  const Block<Real>& block = fluid.grid().block(index);
  lbm::BodyFields<Real>& f = *block.body;
  const auto at = static_cast<std::size_t>(index);
  const bool by_distance = fluid.options().weighting == lbm::BodyWeighting::wall_distance, mixed = is_mixed(block);
  const auto add = by_distance ? &write_body<true, Real, GridSphere<Real>> : &write_body<false, Real, GridSphere<Real>>;
  const auto pairs = pairs_of(block_start_, at);
  prefetch(pairs);
  if (written_[at]) clear_mapping(f), f.mapped = true;
  for (const std::uint32_t k : pairs) {
    Pair& pair = pairs_[k];
    if (written_[at]) add(spheres_[pair.body], spheres_[pair.body], pair.lowest, f);
    pair.wet_volume = pair.volume;
    pair.surface_weight = pair.room = pair.liquid = pair.drift = 0;
  }
  if (!mixed) return;
  for (const std::uint32_t k : pairs) {
    measure_wet(block, pairs_[k]);
    if (block.surface) settle_covered(block, pairs_[k]);
  }
}

template <class Real>
void BodyMap<Real>::measure_wet(const Block<Real>& block, Pair& pair) const {
  pair.wet_volume = pair.surface_weight = pair.room = pair.liquid = 0;
  for_rows(spheres_[pair.body], pair.lowest, [&](int row, const lbm::Row<Real>& cover) {
    alignas(64) Real eps[kBlockWidth];
    cover.copy_to(eps, stdx::vector_aligned);
    for (int c = 0; c < kBlockWidth; ++c) {
      const CellType t = block.type[static_cast<std::size_t>(row + c)];
      if (lbm::is_wet(t)) pair.wet_volume += static_cast<double>(eps[c]);
      if (t != CellType::interface || eps[c] <= 0 || lbm::is_covered(block, row + c)) continue;
      const auto share = static_cast<double>(eps[c]);
      pair.surface_weight += share;
      pair.room += share * static_cast<double>(room_of(block, row + c));
      pair.liquid += share * static_cast<double>(lbm::liquid_of(block, row + c));
    }
  });
}

/// Interface cells full of bodies are filled to the top. Of several bodies the first one books it.
template <class Real>
void BodyMap<Real>::settle_covered(const Block<Real>& block, Pair& pair) const {
  for_rows(spheres_[pair.body], pair.lowest, [&](int row, const lbm::Row<Real>& cover) {
    for (int c = 0; c < kBlockWidth; ++c) {
      const int cell = row + c;
      if (block.type[static_cast<std::size_t>(cell)] != CellType::interface ||
          cover[static_cast<std::size_t>(c)] <= 0 || !lbm::is_covered(block, cell))
        continue;
      Real& mass = block.surface->mass[cell];
      const Real whole = Real(1) + block.surface->density[cell];
      pair.drift += static_cast<double>(mass) - static_cast<double>(whole);
      mass = whole;
    }
  });
}

/// Adds each body's change of wet volume, and what its full interface cells gained, to the other interface cells that
/// it covers: in proportion to the room that they have, or to their liquid where it is taken, lest a cell that stands
/// full above the surface be filled again and again (docs/decisions/0045). Where that is not enough all of them get
/// alike; the pool takes it where there are none.
template <class Real>
void BodyMap<Real>::book_displacement(lbm::Fluid<Real>& fluid) {
  displaced_.assign(bodies_.size(), 0.0), change_.assign(bodies_.size(), 0.0);
  alike_.assign(bodies_.size(), 0);
  parallel_for(0, bodies_.size(), 256, [&](std::size_t k) {
    const Body& b = bodies_[k];
    double change = -b.old_wet_volume, weight = 0, room = 0, liquid = 0;
    for (std::size_t p = b.first_pair; p < b.first_pair + b.pairs; ++p) {
      change += pairs_[p].wet_volume + pairs_[p].drift;
      weight += pairs_[p].surface_weight, room += pairs_[p].room, liquid += pairs_[p].liquid;
    }
    if (change == 0) return;
    const double able = change > 0 ? room : liquid;
    alike_[k] = able > std::abs(change) ? 0 : 1;
    if (!alike_[k])
      displaced_[k] = change / able;
    else if (weight > std::abs(change))
      displaced_[k] = change / weight;
    else
      change_[k] = change;
  });
  for (const double change : change_)
    if (change != 0) fluid.account().pool += change;
  for_each_block([&](std::size_t index) {
    Block<Real>& block = fluid.grid().block(static_cast<BlockIndex>(index));
    if (!block.surface) return;
    alignas(64) std::array<Real, lbm::kBlockCells> gain{};  // of all bodies: each looks at what the cells had before
    bool any = false;
    for (const std::uint32_t k : pairs_of(block_start_, index)) {
      const Pair& pair = pairs_[k];
      if (displaced_[pair.body] == 0) continue;
      any = true;
      const auto displaced = static_cast<Real>(displaced_[pair.body]);
      const bool alike = alike_[pair.body];
      for_rows(spheres_[pair.body], pair.lowest, [&](int row, const lbm::Row<Real>& cover) {
        alignas(64) Real eps[kBlockWidth];
        cover.copy_to(eps, stdx::vector_aligned);
        for (int c = 0; c < kBlockWidth; ++c) {
          const int cell = row + c;
          if (block.type[static_cast<std::size_t>(cell)] != CellType::interface || eps[c] <= 0 ||
              lbm::is_covered(block, cell))
            continue;
          const Real able = alike ? Real(1) : displaced > 0 ? room_of(block, cell) : lbm::liquid_of(block, cell);
          Real& sum = gain[static_cast<std::size_t>(cell)];
          sum = multiply_add(displaced, eps[c] * able, sum);
        }
      });
    }
    if (!any) return;
    for (std::size_t cell = 0; cell < gain.size(); ++cell)
      if (gain[cell] != 0) block.surface->mass[cell] += gain[cell];
  });
}

template <class Real>
std::size_t BodyMap<Real>::written_blocks() const {
  return static_cast<std::size_t>(std::count(written_.begin(), written_.end(), std::uint8_t{1}));
}

template void BodyMap<float>::measure_old(lbm::Fluid<float>&);
template void BodyMap<double>::measure_old(lbm::Fluid<double>&);
template void BodyMap<float>::normalize();
template void BodyMap<double>::normalize();
template void BodyMap<float>::write_fields(lbm::Fluid<float>&);
template void BodyMap<double>::write_fields(lbm::Fluid<double>&);
template bool BodyMap<float>::is_same(const lbm::BodyFields<float>&, std::size_t) const;
template bool BodyMap<double>::is_same(const lbm::BodyFields<double>&, std::size_t) const;
template void BodyMap<float>::write_block(lbm::Fluid<float>&, lbm::BlockIndex);
template void BodyMap<double>::write_block(lbm::Fluid<double>&, lbm::BlockIndex);
template void BodyMap<float>::measure_wet(const lbm::Block<float>&, Pair&) const;
template void BodyMap<double>::measure_wet(const lbm::Block<double>&, Pair&) const;
template void BodyMap<float>::settle_covered(const lbm::Block<float>&, Pair&) const;
template void BodyMap<double>::settle_covered(const lbm::Block<double>&, Pair&) const;
template void BodyMap<float>::book_displacement(lbm::Fluid<float>&);
template void BodyMap<double>::book_displacement(lbm::Fluid<double>&);
template std::size_t BodyMap<float>::written_blocks() const;
template std::size_t BodyMap<double>::written_blocks() const;

}  // namespace lahar::coupling
