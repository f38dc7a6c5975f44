#include "lbm/free_surface/excess_mass.h"

#include <algorithm>
#include <cmath>

#include "lbm/free_surface/liquid_transfer.h"
#include "lbm/free_surface/touching.h"

namespace lahar::lbm {

namespace {

/// The interface neighbours of a cell.
template <class Real>
struct Takers {
  int open = 0, covered = 0;                 ///< number, of those that no body covers and of the others
  Real open_liquid = 0, covered_liquid = 0;  ///< lu
};

template <class Real>
Takers<Real> takers_around(const FluidGrid<Real>& grid, CellPlace place, bool with_liquid) {
  Takers<Real> t;
  for (int i = 1; i < D3Q19::q; ++i) {
    const CellPlace next = grid.neighbour(place, i);
    if (grid.type(next) != CellType::interface) continue;
    const Block<Real>& block = grid.block(next.block);
    const bool covered = is_covered(block, next.cell);
    ++(covered ? t.covered : t.open);
    if (with_liquid) (covered ? t.covered_liquid : t.open_liquid) += liquid_of(block, next.cell);
  }
  return t;
}

}  // namespace

template <class Real>
void ExcessMass<Real>::offer(BlockIndex b) {
  BlockChanges<Real>& own = changes_.of(b);
  for (const Excess<Real>& e : own.excess) offer_excess(b, e);
  changes_.note(b);
}

template <class Real>
void ExcessMass<Real>::offer_excess(BlockIndex b, const Excess<Real>& e) {
  BlockChanges<Real>& own = changes_.of(b);
  const CellPlace place{b, e.cell};
  const Takers<Real> t = takers_around(grid_, place, e.mass < 0);
  const bool covered = t.open == 0;
  const int takers = covered ? t.covered : t.open;
  const Real liquid = covered ? t.covered_liquid : t.open_liquid;
  if (e.mass >= 0 && takers > 0)
    own.gifts.add(e.cell, {e.mass / static_cast<Real>(takers), covered});
  else if (e.mass < 0 && liquid > 0)
    own.claims.add(e.cell, {std::min(Real(1), -e.mass / liquid), -e.mass, covered});
  else
    leave(place, e.mass);
}

/// What a debt leaves, or an excess without takers: to liquid neighbours as density, else to the pool.
template <class Real>
void ExcessMass<Real>::leave(CellPlace place, Real rest) {
  BlockChanges<Real>& own = changes_.of(place.block);
  int liquids = 0;
  for (int i = 1; i < D3Q19::q; ++i) liquids += grid_.type(grid_.neighbour(place, i)) == CellType::liquid;
  if (liquids > 0) return own.spills.add(place.cell, rest / static_cast<Real>(liquids));
  own.pooled += static_cast<double>(rest);
  own.pooled_total += std::abs(static_cast<double>(rest));
}

template <class Real>
void ExcessMass<Real>::pay(BlockIndex b) {
  const Block<Real>& block = grid_.block(b);
  if (!block.surface) return;
  Real shares[kBlockCells];
  CellSet asked;
  const auto claims = [](const BlockChanges<Real>& c) -> const auto& { return c.claims; };
  changes_.for_each_noted(grid_, b, kClaims, claims, [&](int cell, const Claim<Real>& claim) {
    if (block.type[static_cast<std::size_t>(cell)] != CellType::interface) return;
    if (claim.from_covered != is_covered(block, cell)) return;
    shares[cell] = (asked.has(cell) ? shares[cell] : Real(0)) + claim.share;
    asked.add(cell);
  });
  CellMap<Payer<Real>>& payers = changes_.of(b).payers;
  asked.for_each([&](int cell) {
    const Real liquid = liquid_of(block, cell), per_share = shares[cell] > 1 ? liquid / shares[cell] : liquid;
    payers.append(cell, {per_share, per_share * shares[cell], shares[cell] > 1});
  });
}

template <class Real>
void ExcessMass<Real>::collect(BlockIndex b) {
  BlockChanges<Real>& own = changes_.of(b);
  own.claims.for_each([&](int cell, const Claim<Real>& claim) {
    if (const Real rest = unpaid({b, cell}, claim); rest != 0) leave({b, cell}, -rest);
  });
  changes_.note(b);
}

/// Returns what the neighbours could not pay. Where all paid what they were asked the rest is rounding, and none.
template <class Real>
Real ExcessMass<Real>::unpaid(CellPlace place, const Claim<Real>& claim) const {
  bool whole = claim.share < 1;
  Real got = 0;
  for (int i = 1; i < D3Q19::q; ++i) {
    const CellPlace next = grid_.neighbour(place, i);
    const Payer<Real>* payer = changes_.of(next.block).payers.find(next.cell);
    if (!payer || is_covered(grid_.block(next.block), next.cell) != claim.from_covered) continue;
    got += claim.share * payer->per_share;
    whole = whole && !payer->scaled;
  }
  return whole ? Real(0) : claim.owed - got;
}

template <class Real>
void ExcessMass<Real>::take(BlockIndex b) {
  const BlockChanges<Real>& own = changes_.of(b);
  Block<Real>& block = grid_.block(b);
  const auto type = [&](int cell) { return block.type[static_cast<std::size_t>(cell)]; };
  const auto gifts = [](const BlockChanges<Real>& c) -> const auto& { return c.gifts; };
  changes_.for_each_noted(grid_, b, kGifts, gifts, [&](int cell, const Gift<Real>& gift) {
    if (type(cell) == CellType::interface && gift.to_covered == is_covered(block, cell))
      block.surface->mass[cell] += gift.part;
  });
  own.payers.for_each([&](int cell, const Payer<Real>& payer) { block.surface->mass[cell] -= payer.paid; });
  const auto spills = [](const BlockChanges<Real>& c) -> const auto& { return c.spills; };
  changes_.for_each_noted(grid_, b, kSpills, spills, [&](int cell, Real part) {
    if (type(cell) == CellType::liquid) add_to_liquid(grid_, {b, cell}, part, parity_, order_);
  });
}

template class ExcessMass<float>;
template class ExcessMass<double>;

}  // namespace lahar::lbm
