#pragma once
// Equilibrium, shifted by the weights: f_i^eq - w_i. Of second order in the velocity (Qian, d'Humieres & Lallemand
// 1992), and what the third and fourth moments of the Maxwell distribution add to it. Density, momentum and second
// moments are the same; population by population the two differ by the square of the velocity, so that whoever sets
// some of a cell's populations has to take that of the cell's collision operator (docs/decisions/0065).
#include "core/simd_math.h"
#include "lbm/grid/velocity_set.h"

namespace lahar::lbm {

/// Equilibrium of velocity i at density 1 + drho and velocity u.
template <class V>
[[gnu::always_inline]] inline V equilibrium(int i, const V& drho, const V& ux, const V& uy, const V& uz) {
  const V w = number<V>(D3Q19::w(i)), rho = V(1) + drho;
  const V cu = number<V>(D3Q19::c[i][0]) * ux + number<V>(D3Q19::c[i][1]) * uy + number<V>(D3Q19::c[i][2]) * uz;
  const V uu = ux * ux + uy * uy + uz * uz;
  return w * (drho + rho * (V(3) * cu + number<V>(4.5) * cu * cu - number<V>(1.5) * uu));
}

/// f_i^eq + f_opposite^eq, the part even in c: what anti-bounce-back needs.
template <class V>
[[gnu::always_inline]] inline V equilibrium_pair_sum(int i, const V& drho, const V& ux, const V& uy, const V& uz) {
  const V w = number<V>(D3Q19::w(i)), rho = V(1) + drho;
  const V cu = number<V>(D3Q19::c[i][0]) * ux + number<V>(D3Q19::c[i][1]) * uy + number<V>(D3Q19::c[i][2]) * uz;
  const V uu = ux * ux + uy * uy + uz * uz;
  return V(2) * w * (drho + rho * (number<V>(4.5) * cu * cu - number<V>(1.5) * uu));
}

/// Powers of the velocity that the equilibrium of a collision operator holds.
enum class EquilibriumOrder { second, fourth };

/// What an equilibrium of the given order has more than one of second order, over the density. On D3Q19 that of second
/// order has the moments
///   m_abb = v_a/3,  m_aabb = 1/9 + (v_a^2 + v_b^2)/3 - v_c^2/6,
/// Maxwell's has
///   m_abb = v_a/3 + v_a v_b^2,  m_aabb = 1/9 + (v_a^2 + v_b^2)/3 + v_a^2 v_b^2.
template <class V>
class HigherMoments {
 public:
  [[gnu::always_inline]] HigherMoments(EquilibriumOrder order, const V& ux, const V& uy, const V& uz)
      : u_{ux, uy, uz}, fourth_{V(0), V(0), V(0)}, none_(order == EquilibriumOrder::second) {
    if (none_) return;
    const V x = ux * ux, y = uy * uy, z = uz * uz, sixth = number<V>(1.0 / 6.0);
    fourth_[0] = y * z + sixth * x, fourth_[1] = x * z + sixth * y, fourth_[2] = x * y + sixth * z;
  }

  /// Of f_i + f_opposite.
  [[gnu::always_inline]] V pair_sum(int i) const {
    const auto& c = D3Q19::c[i];
    const auto zero = [&](int a) { return c[a] == 0; };
    V sum(0);
    if (i == 0) return V(2) * (fourth_[0] + fourth_[1] + fourth_[2]);
    if (i < kFirstDiagonal) {  // of the three m_aabb two hold the axis: those not named by it
      for (int a = 0; a < 3; ++a)
        if (zero(a)) sum -= fourth_[a];
      return sum;
    }
    for (int a = 0; a < 3; ++a)
      if (zero(a)) sum = number<V>(0.5) * fourth_[a];
    return sum;
  }

  /// Of f_i.
  [[gnu::always_inline]] V of(int i) const {
    const V even = number<V>(0.5) * pair_sum(i);
    if (i == 0 || none_) return even;
    const auto& c = D3Q19::c[i];
    V odd(0);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        if (a == b || c[a] == 0 || (i < kFirstDiagonal) != (c[b] == 0)) continue;
        odd += number<V>(i < kFirstDiagonal ? -0.5 * c[a] : 0.25 * c[a]) * u_[a] * u_[b] * u_[b];
      }
    return even + odd;
  }

 private:
  static constexpr int kFirstDiagonal = 7;  // 1 to 6 lie along the axes
  const V u_[3];
  V fourth_[3];  // by the axis that m_aabb does not hold
  const bool none_;
};

/// Equilibrium of velocity i and the given order at density 1 + drho and velocity u.
template <class V>
[[gnu::always_inline]] inline V equilibrium(EquilibriumOrder order, int i, const V& drho, const V& ux, const V& uy,
                                            const V& uz) {
  return equilibrium(i, drho, ux, uy, uz) + (V(1) + drho) * HigherMoments<V>(order, ux, uy, uz).of(i);
}

}  // namespace lahar::lbm
