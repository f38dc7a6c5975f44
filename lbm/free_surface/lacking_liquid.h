#pragma once
// What interface cells lack of being full does not act on bodies.
//
// The populations of an interface cell are those of a full one; its liquid is F of that, F the fill level. So is the
// momentum that its liquid loses, when a body takes J from the populations; the rest, (1 - F) J, is of liquid that is
// not there (docs/decisions/0073). J is
//   in a cell that bodies reach but do not cover, the exchange of its collision (step/sweep_kernel.h);
//   over a link to a covered cell (covered_cells.h), what crosses it: in the body's frame, u its velocity,
//     (c - u) f_i - (-c - u) f_opposite,   i from the cell to the body (Wen, Zhang, Tu, Wang & Fang 2014),
//   less the same of the equilibrium at u and at the pressure that the surface sets at the link's middle
//   (surface_exchange.h): that pressure acts on the body wherever the surface lies in the cell, as the water beneath it
//   bears on the bed of a film. It is what keeps the populations that are not liquid in balance: the gas, at the same
//   pressure, holds against it.
// BodyFields::lacking_x to _z hold the sum; whoever gathers forces takes it off. What a covered cell holds is all
// displaced liquid, and counts in full.
#include <algorithm>

#include "lbm/collision/equilibrium.h"
#include "lbm/grid/row_types.h"

namespace lahar::lbm {

/// Before the exchange of a block: whether its surface cells are such, and then nothing noted yet.
template <class Real>
void begin_lacking(Block<Real>& block) {
  BodyFields<Real>& body = *block.body;
  body.lacks = false;
  if (!block.surface) return;
  for (int k = 0; k < block.surface->count && !body.lacks; ++k)
    body.lacks = body.exchange_weight[block.surface->cells[static_cast<std::size_t>(k)]] > 0;
  if (!body.lacks) return;
  for (Real* field : {body.lacking_x, body.lacking_y, body.lacking_z}) std::fill_n(field, kBlockCells, Real(0));
}

/// Momentum that crosses links to covered cells, in the frame of a body, past that of its equilibrium.
template <class V>
class BodyLinks {
 public:
  /// `u`: of the body, lu; `order`: of the equilibrium of the collision operator.
  BodyLinks(EquilibriumOrder order, const V (&u)[3]) : u_{u[0], u[1], u[2]}, higher_(order, u[0], u[1], u[2]) {}

  /// A link along velocity i, of the cells `linked`: what they send, what comes back, and rho - 1 at its middle.
  template <class Mask>
  [[gnu::always_inline]] void add(int i, const Mask& linked, const V& sent, const V& back, const V& drho) {
    const int opposite = i % 2 == 1 ? i + 1 : i - 1;
    const V rho = V(1) + drho, along = V(number<V>(6 * D3Q19::w(i))) * dot(i);
    const V even = equilibrium_pair_sum(i, drho, u_[0], u_[1], u_[2]) + rho * higher_.pair_sum(i);
    const V odd = rho * (along + higher_.of(i) - higher_.of(opposite));
    const V sum = select(linked, sent + back - even, V(0)), difference = select(linked, sent - back - odd, V(0));
    for (int a = 0; a < 3; ++a) momentum_[a] += number<V>(D3Q19::c[i][a]) * sum - u_[a] * difference;
  }
  [[nodiscard]] const V& momentum(int axis) const { return momentum_[axis]; }

 private:
  [[gnu::always_inline]] V dot(int i) const {
    return number<V>(D3Q19::c[i][0]) * u_[0] + number<V>(D3Q19::c[i][1]) * u_[1] + number<V>(D3Q19::c[i][2]) * u_[2];
  }

  const V u_[3];
  const HigherMoments<V> higher_;
  V momentum_[3]{V(0), V(0), V(0)};
};

/// Bits of the interface cells of a row that no body covers.
template <class Real>
unsigned open_interface_cells(const Block<Real>& block, int row) {
  return interface_cells(block, row) & ~unsigned{block.body->covered[static_cast<std::size_t>(row)]};
}

}  // namespace lahar::lbm
