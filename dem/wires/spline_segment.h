#pragma once
// The centre-line of a wire as a smooth curve: the quadratic B-spline of its beads, in segments of one bead each.
//
// The segment of bead k runs from the middle of the bond before it to the middle of the bond behind it and touches both
// bonds there, so that the curve has no corners: C(t) = sum of w_b(t) x_b over beads k-1, k, k+1, t from 0 to 1, with
// w = ((1-t)^2, 1 + 2t - 2t^2, t^2) / 2 (Piegl & Tiller 1997, The NURBS Book, ch. 2). At the end of an open wire it is
// the straight half bond up to the bead. Its weights add up to one and are never negative.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/triple.h"
#include "core/vector.h"
#include "dem/wires/wire_chains.h"

namespace lahar::dem {

struct SplineSegment {
  std::array<ParticleIndex, 3> beads{};  ///< before, own, behind; at an open end its own once more (weight 0)
  bool first = false, last = false;      ///< the curve begins or ends here
  Triple start{}, slope{}, bend{};       ///< C(t) = start + t slope + t^2 bend, m

  [[nodiscard]] Triple at(double t) const { return start + t * (slope + t * bend); }
  [[nodiscard]] Triple along(double t) const { return slope + (2 * t) * bend; }  ///< dC/dt, m
  [[nodiscard]] std::array<double, 3> weights(double t) const {
    if (first) return {0, 1 - 0.5 * t, 0.5 * t};
    if (last) return {0.5 * (1 - t), 0.5 * (1 + t), 0};
    return {0.5 * (1 - t) * (1 - t), 0.5 + t * (1 - t), 0.5 * t * t};
  }
  [[nodiscard]] std::array<double, 3> weight_slopes(double t) const {  ///< dw/dt
    if (first) return {0, -0.5, 0.5};
    if (last) return {-0.5, 0.5, 0};
    return {t - 1, 1 - 2 * t, t};
  }
  /// No point of the segment is farther from its own bead, m; and its square.
  [[nodiscard]] static double extent(const WireChains& chains, const Vec3Field& x, std::size_t k) {
    return std::sqrt(extent2(chains, x, k));
  }
  [[nodiscard]] static double extent2(const WireChains& chains, const Vec3Field& x, std::size_t k) {
    double longest = 0;
    for (const ParticleIndex j : {chains.before(k), chains.behind(k)})
      if (j != WireChains::none) longest = std::max(longest, (x[j] - x[k]).squaredNorm());
    return 0.25 * longest;
  }
};

inline Triple triple_at(const Vec3Field& f, std::size_t i) { return {f.x[i], f.y[i], f.z[i]}; }

/// The segment of a bead that belongs to a wire.
inline SplineSegment spline_segment(const WireChains& chains, const Vec3Field& position, ParticleIndex k) {
  SplineSegment p;
  p.first = chains.before(k) == WireChains::none;
  p.last = chains.behind(k) == WireChains::none;
  p.beads = {p.first ? k : chains.before(k), k, p.last ? k : chains.behind(k)};
  const Triple own = triple_at(position, k);
  const Triple in = p.first ? Triple{} : own - triple_at(position, p.beads[0]);
  const Triple out = p.last ? Triple{} : triple_at(position, p.beads[2]) - own;
  p.start = own - 0.5 * in;
  if (p.first)
    p.slope = 0.5 * out;
  else if (p.last)
    p.slope = 0.5 * in;
  else
    p.slope = in, p.bend = 0.5 * (out - in);
  return p;
}

}  // namespace lahar::dem
