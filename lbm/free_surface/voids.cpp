#include "lbm/free_surface/voids.h"

#include <algorithm>

#include "lbm/free_surface/liquid_transfer.h"
#include "lbm/free_surface/touching.h"

namespace lahar::lbm {

namespace {

constexpr double kLargestShare = 0.5;  ///< of the pressure of a liquid cell, to all voids around it

}  // namespace

template <class Real>
Real Voids<Real>::pressure_of(CellPlace place) const {
  return std::max(Real(0), outgoing_moments(grid_, place, parity_).drho);
}

template <class Real>
void Voids<Real>::find(BlockIndex b) {
  const Block<Real>& block = grid_.block(b);
  for (int c = 0; c < block.surface->count; ++c) {
    const int cell = block.surface->cells[static_cast<std::size_t>(c)];
    if (!block.at_rim[static_cast<std::size_t>(cell)] && !touches_gas(grid_, {b, cell})) ask(b, cell);
  }
  if (!changes_.of(b).claims.empty()) changes_.note(b);
}

template <class Real>
void Voids<Real>::ask(BlockIndex b, int cell) {
  const SurfaceFields<Real>& surface = *grid_.block(b).surface;
  const Real missing = Real(1) + surface.density[cell] - surface.mass[cell];
  if (missing <= 0) return;
  Real sum = 0;
  for (int i = 1; i < D3Q19::q; ++i) {
    const CellPlace next = grid_.neighbour({b, cell}, i);
    if (grid_.type(next) == CellType::liquid) sum += pressure_of(next);
  }
  if (sum > 0)
    changes_.of(b).claims.add(cell, {std::min(static_cast<Real>(kLargestShare), missing / sum), missing, false});
}

template <class Real>
void Voids<Real>::pay(BlockIndex b) {
  const Block<Real>& block = grid_.block(b);
  Real shares[kBlockCells];
  CellSet asked;
  const auto claims = [](const BlockChanges<Real>& c) -> const auto& { return c.claims; };
  changes_.for_each_noted(grid_, b, kClaims, claims, [&](int cell, const Claim<Real>& claim) {
    if (block.type[static_cast<std::size_t>(cell)] != CellType::liquid) return;
    shares[cell] = (asked.has(cell) ? shares[cell] : Real(0)) + claim.share;
    asked.add(cell);
  });
  constexpr auto most = static_cast<Real>(kLargestShare);
  asked.for_each([&](int cell) {
    const Real above = pressure_of({b, cell}), per_share = shares[cell] > most ? above * most / shares[cell] : above;
    if (above > 0) changes_.of(b).payers.append(cell, {per_share, per_share * shares[cell], shares[cell] > most});
  });
}

template <class Real>
void Voids<Real>::close(BlockIndex b) {
  BlockChanges<Real>& own = changes_.of(b);
  Block<Real>& block = grid_.block(b);
  own.payers.for_each([&](int cell, const Payer<Real>& payer) {
    add_to_liquid(grid_, {b, cell}, -payer.paid, parity_, order_);
  });
  own.claims.for_each([&](int cell, const Claim<Real>& claim) {
    for (int i = 1; i < D3Q19::q; ++i) {
      const CellPlace next = grid_.neighbour({b, cell}, i);
      if (const Payer<Real>* payer = changes_.of(next.block).payers.find(next.cell))
        block.surface->mass[cell] += claim.share * payer->per_share;
    }
  });
}

template class Voids<float>;
template class Voids<double>;

}  // namespace lahar::lbm
