#pragma once
// In-place streaming, Esoteric Pull (Lehmann 2022, Computation 10:92). One copy of the populations; each location is
// read and written by exactly one cell per step, so a step has no race and no second lattice.
//
// For the pair (a, b = a + 1) with forward velocity c_a, a cell n uses two locations:
//   home:  slot home(a) of n itself          holds, before a step, the incoming f_a and, after it, the outgoing f_b
//   away:  slot away(a) of cell n + c_a      holds, before a step, the incoming f_b and, after it, the outgoing f_a
// with home(a) = a, away(a) = b in odd steps and the reverse in even steps. Seen from the next step, the outgoing f_b
// of n lies in n's slot away(a), and the outgoing f_a of n in slot home(a) of n + c_a.
#include "lbm/grid/block.h"

namespace lahar::lbm {

/// Which slot of a pair is used in a step.
struct Parity {
  bool odd = false;
  [[nodiscard]] constexpr int home(int a) const { return odd ? a : a + 1; }
  [[nodiscard]] constexpr int away(int a) const { return odd ? a + 1 : a; }
  [[nodiscard]] constexpr Parity next() const { return {!odd}; }
};

/// The four values of a pair at a cell before a step: what comes in, and what the cell itself sent out in the last one.
template <class Real>
struct PairAccess {
  Real* incoming_a;
  Real* outgoing_b;
  Real* outgoing_a;
  Real* incoming_b;
};

/// `ahead` is the block that holds cell + c_a.
template <class Real>
PairAccess<Real> access_pair(const Block<Real>& block, const Block<Real>& ahead, int cell, int a, Parity p) {
  const int cell_ahead = kNeighbours.cell(a, cell);
  return {block.f(p.home(a)) + cell, block.f(p.away(a)) + cell, ahead.f(p.home(a)) + cell_ahead,
          ahead.f(p.away(a)) + cell_ahead};
}

}  // namespace lahar::lbm
