// What resolved wires write into the blocks: fields and displaced liquid. Compiled without contraction of products and
// sums, as grain_volumes.cpp is.
#include "coupling/wires/wire_map_parts.h"
#include "lbm/free_surface/isolated_liquid.h"

namespace lahar::coupling {

using lbm::Block;
using lbm::BlockIndex;
using lbm::CellType;
using lbm::kBlockWidth;

namespace {

/// Adds a piece to the fields of a block; by copy: what is written could otherwise be part of it.
template <bool kByDistance, class Real>
[[gnu::noinline]] void write_piece(const GridCylinder<Real> piece, const Vec3i lowest, lbm::BodyFields<Real>& f) {
  for_cylinder_rows<kByDistance>(
      piece, lowest,
      reach_of(piece), [&](int row, const CylinderRow<Real>& cover, int y, int z) __attribute__((always_inline)) {
        if (all(cover.weight <= Row<Real>(0))) return;
        MotionRow<Real> motion[2];
        for (int e = 0; e < 2; ++e) {
          const auto arm = ArmRow<Real>::from(e == 0 ? piece.start : piece.end, lowest.x(), y, z);
          motion[e] = motion_row(piece.motion[e], arm.x, arm.y, arm.z);
        }
        const MotionRow<Real> v = blend(motion[0], motion[1], cover.share);
        add_to_row(f.solid_fraction + row, cover.fraction);
        add_to_row(f.exchange_weight + row, cover.weight);
        if constexpr (kByDistance) {
          // Held whole, but not covered: only spheres, which write before, keep books of what covered cells hold.
          const Row<Real> sum = load_aligned<Row<Real>>(f.drag + row);
          store_aligned(f.drag + row, joined_drag<Row<Real>>(sum, cover.weight, number<Row<Real>>(kGapDrag)));
        } else {
          add_to_row(f.drag + row, cover.weight);
        }
        add_to_row(f.weighted_velocity_x + row, Row<Real>(cover.weight * v.x));
        add_to_row(f.weighted_velocity_y + row, Row<Real>(cover.weight * v.y));
        add_to_row(f.weighted_velocity_z + row, Row<Real>(cover.weight * v.z));
      });
}

/// Volumes of a piece in the cells of two masks; null for all cells, and for none.
template <class Real, class Share>
void measure(const GridCylinder<Real>& piece, const Vec3i& lowest, const CellMask<Real>* wet,
             const CellMask<Real>* surface, std::array<Share, 2>& shares) {
  BeadSums<Real> in_wet, at_surface;
  for_cylinder_rows<false>(piece, lowest, covered_reach(piece), [&](int row, const CylinderRow<Real>& cover, int, int) {
    in_wet.add(wet ? cover.fraction * wet->row(row) : cover.fraction, cover.share);
    if (surface) at_surface.add(cover.fraction * surface->row(row), cover.share);
  });
  in_wet.reduce(shares[0].wet, shares[1].wet);
  at_surface.reduce(shares[0].surface, shares[1].surface);
}

}  // namespace

template <class Real>
void WireMap<Real>::write_block(lbm::Fluid<Real>& fluid, std::size_t index) {
  const Block<Real>& block = fluid.grid().block(static_cast<BlockIndex>(index));
  lbm::BodyFields<Real>& f = *block.body;
  const bool by_distance = lbm::by_wall_distance(fluid.options().weighting);
  const auto add = by_distance ? &write_piece<true, Real> : &write_piece<false, Real>;
  if (tasks_[index] == Task::write) clear_solids(f);
  std::optional<CellMask<Real>> wet, surface;
  if (block.wet_cells < lbm::kBlockCells) wet.emplace(block, [](CellType t) { return lbm::is_wet(t); });
  if (block.surface) surface.emplace(block, [](CellType t) { return t == CellType::interface; });
  for (const std::uint32_t k : by_block_.in(index)) {
    const GridCylinder<Real>& piece = pieces_[pairs_[k].piece];
    if (tasks_[index] > Task::keep) add(piece, pairs_[k].lowest, f);
    measure(piece, pairs_[k].lowest, wet ? &*wet : nullptr, surface ? &*surface : nullptr, shares_[k]);
  }
}

/// Adds each bead's change of wet volume to the interface cells that it covers, by its share of them; cells near by
/// take it where there are none. By beads, not by pieces: a cell that passes from one piece to the next changes
/// nothing.
template <class Real>
void WireMap<Real>::book_displacement(lbm::Fluid<Real>& fluid) {
  const auto beads = wires_.beads();
  displaced_.assign(beads.size(), 0.0);
  isolated_.assign(by_block_.blocks(), 0.0);
  bool any = false;
  for (std::size_t b = 0; b < beads.size(); ++b) {
    Share now;
    for_pairs_of(b, [&](std::size_t p, std::size_t end) {
      now.wet += shares_[p][end].wet, now.surface += shares_[p][end].surface;
    });
    double& before = states_[beads[b]].wet;
    const double change = now.wet - before;
    if (now.surface > std::abs(change))
      displaced_[b] = change / now.surface, any = true;
    else if (now.wet > 0)
      for_pairs_of(b, [&](std::size_t p, std::size_t end) {
        isolated_[static_cast<std::size_t>(pairs_[p].block)] += change * shares_[p][end].wet / now.wet;
      });
    else
      lbm::send_to_pool(change, fluid.account());
    before = now.wet;
  }
  // A bead whose last piece has broken leaves a void.
  std::size_t next = 0;
  for (dem::ParticleId id = 0; id < states_.size(); ++id) {
    if (next < beads.size() && beads[next] == id) {
      ++next;
    } else if (states_[id].known) {
      lbm::send_to_pool(-states_[id].wet, fluid.account());
      states_[id] = {.lent_impulse = states_[id].lent_impulse, .lent_spin = states_[id].lent_spin};
    }
  }
  if (any) by_block_.for_each_block([&](std::size_t b) { displace(fluid, b); });
  lbm::pay_nearby(fluid.grid(), isolated_, fluid.account());
}

template <class Real>
void WireMap<Real>::displace(lbm::Fluid<Real>& fluid, std::size_t index) const {
  Block<Real>& block = fluid.grid().block(static_cast<BlockIndex>(index));
  if (!block.surface) return;
  const CellMask<Real> surface(block, [](CellType t) { return t == CellType::interface; });
  for (const std::uint32_t k : by_block_.in(index)) {
    const std::size_t piece = pairs_[k].piece;
    const Row<Real> first(static_cast<Real>(displaced_[wires_.bead_of(piece, 0)])),
        second(static_cast<Real>(displaced_[wires_.bead_of(piece, 1)]));
    for_cylinder_rows<false>(pieces_[piece], pairs_[k].lowest, covered_reach(pieces_[piece]),
                             [&](int row, const CylinderRow<Real>& cover, int, int) {
                               const Row<Real> more = multiply_add(cover.share, Row<Real>(second - first), first);
                               add_to_row(block.surface->mass + row,
                                          Row<Real>(more * cover.fraction * surface.row(row)));
                             });
  }
}

template void WireMap<float>::book_displacement(lbm::Fluid<float>&);
template void WireMap<double>::book_displacement(lbm::Fluid<double>&);
template void WireMap<float>::write_block(lbm::Fluid<float>&, std::size_t);
template void WireMap<double>::write_block(lbm::Fluid<double>&, std::size_t);
template void WireMap<float>::displace(lbm::Fluid<float>&, std::size_t) const;
template void WireMap<double>::displace(lbm::Fluid<double>&, std::size_t) const;

}  // namespace lahar::coupling
