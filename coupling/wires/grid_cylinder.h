#pragma once
// A piece of wire between two beads as the grid sees it: a cylinder that is cut by a plane at each bead. Lattice units;
// positions in cells from the corner of cell (0,0,0).
//
// Two pieces that meet at a bead share the plane that halves the angle between them. Each cell belongs to the piece on
// whose side of the plane its centre lies, so that along a chain none is covered twice and none is missed; covered
// share and distance are the same on both sides of the plane, so that they are continuous as the wire moves. The volume
// between two such planes is pi r^2 times the distance of the beads, exactly. A free end is flat.
//
// Covered share of a cell: linear in its distance from the axis as for spheres (sphere_fraction.h), the radius
// r' = sqrt(r^2 - 1/12) gives the exact mean cross-section: that of eps = clamp(1/2 - d, 0, 1), d the distance from r',
// is pi (r'^2 + 1/12) for r' >= 1/2.
//
// Velocity of the solid at x: each bead is a rigid body, in between they are blended by s, 0 to 1 from bead to bead:
//   v(x) = N_i (v_i + w_i x (x - p_i)) + N_j (v_j + w_j x (x - p_j)),   N_i = 1 - s, N_j = s.
// A rigid motion of both beads is a rigid motion of the piece. A force f at x therefore is N_b f on each bead b, with
// the torque N_b (x - p_b) x f: the sums of force, of its moment about any point and of its power are those at x.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/simd_math.h"
#include "coupling/grains/wall_drag.h"
#include "coupling/rows.h"

namespace lahar::coupling {

/// Radius of the mapping, cells: at least 1/2; thinner pieces cover too much and are left to the wires' drag law.
inline double cylinder_mapping_radius(double r) { return std::max(0.5, std::sqrt(std::max(0.0, r * r - 1.0 / 12))); }

/// A bead, or how its motion changes.
template <class Real>
struct GridMotion {
  Real velocity[3];  ///< lu; or lu per step
  Real spin[3];      ///< rad per step; or per step^2
};

/// The plane at an end of a piece.
template <class Real>
struct WireCut {
  Real place[3];
  Real normal[3];  ///< at a joint that of both pieces; at a free end out of the piece
  /// The piece lies where normal (x - place) >= 0 (1) or < 0 (-1); 0: a free end.
  int side;
};

template <class Real>
struct GridCylinder {
  Real start[3];  ///< the first bead
  Real end[3];    ///< the second
  Real along[3];  ///< unit
  Real length;
  Real radius;   ///< mapping radius
  Real surface;  ///< radius at which the fluid comes to rest; below 0: weighting by eps
  WireCut<Real> cuts[2];
  GridMotion<Real> motion[2];  ///< of the two beads
};

/// How far from the axis, and beyond a free end, eps is not 0.
template <class Real>
Real covered_reach(const GridCylinder<Real>& p) {
  return p.radius + Real(0.5);
}

/// How far from the axis eps or the exchange weight is not 0.
template <class Real>
Real reach_of(const GridCylinder<Real>& p) {
  return std::max(covered_reach(p), p.surface + Real(kWallDragReach));
}

/// What a piece covers of a row of 8 cells.
template <class Real>
struct CylinderRow {
  Row<Real> fraction;  ///< eps
  Row<Real> weight;    ///< in their exchange: eps too, or its drag
  Row<Real> share;     ///< s
};

/// The row (x0..x0+7, y, z). `kByDistance`: surface is given. Products and sums are spelled out, so that a cell at a
/// plane belongs to the same piece wherever this is inlined.
template <bool kByDistance, class Real>
[[gnu::always_inline]] inline CylinderRow<Real> cylinder_row(const GridCylinder<Real>& p, int x0, int y, int z) {
  const Real cy = static_cast<Real>(y) + Real(0.5), cz = static_cast<Real>(z) + Real(0.5);
  const Row<Real> cx = (static_cast<Real>(x0) + Real(0.5)) + lane_index<Row<Real>>();
  const auto over = [&](const Real(&n)[3], const Real(&place)[3]) __attribute__((always_inline)) {
    const Real rest = multiply_add(n[1], Real(cy - place[1]), Real(n[2] * (cz - place[2])));
    return multiply_add(Row<Real>(n[0]), Row<Real>(cx - place[0]), Row<Real>(rest));
  };
  const Row<Real> t = over(p.along, p.start);
  const Row<Real> qx = multiply_add(Row<Real>(-p.along[0]), t, Row<Real>(cx - p.start[0]));
  const Row<Real> qy = multiply_add(Row<Real>(-p.along[1]), t, Row<Real>(cy - p.start[1]));
  const Row<Real> qz = multiply_add(Row<Real>(-p.along[2]), t, Row<Real>(cz - p.start[2]));
  const Row<Real> distance = sqrt(multiply_add(qx, qx, multiply_add(qy, qy, Row<Real>(qz * qz))));
  const Row<Real> none(Real(0)), one(Real(1));
  Row<Real> fraction = min(one, max(none, Row<Real>((Real(0.5) + p.radius) - distance)));
  Row<Real> depth = distance - (kByDistance ? p.surface : Real(0)), owned = one;
  for (const WireCut<Real>& cut : p.cuts) {
    const Row<Real> f = over(cut.normal, cut.place);
    if (cut.side > 0) {
      owned = select(f < none, none, owned);
    } else if (cut.side < 0) {
      owned = select(f >= none, none, owned);
    } else {
      fraction *= min(one, max(none, Row<Real>(Real(0.5) - f)));
      depth = max(depth, f);
    }
  }
  fraction *= owned;
  const Row<Real> share = min(one, max(none, Row<Real>(t / p.length)));
  if constexpr (kByDistance)
    return {fraction, wall_drag<Row<Real>>(depth) * owned, share};
  else
    return {fraction, fraction, share};
}

/// Velocities in a row of 8 cells; ry, rz and rx are arms from the bead.
template <class Real>
struct MotionRow {
  Row<Real> x, y, z;
};

template <class Real>
[[gnu::always_inline]] inline MotionRow<Real> motion_row(const GridMotion<Real>& m, const Row<Real>& rx, Real ry,
                                                         Real rz) {
  const Real u = multiply_add(Real(-m.spin[2]), ry, multiply_add(m.spin[1], rz, m.velocity[0]));
  const Real v = multiply_add(Real(-m.spin[0]), rz, m.velocity[1]);
  const Real w = multiply_add(m.spin[0], ry, m.velocity[2]);
  return {Row<Real>(u), multiply_add(Row<Real>(m.spin[2]), rx, Row<Real>(v)),
          multiply_add(Row<Real>(-m.spin[1]), rx, Row<Real>(w))};
}

/// N_i a + N_j b.
template <class Real>
[[gnu::always_inline]] inline MotionRow<Real> blend(const MotionRow<Real>& a, const MotionRow<Real>& b,
                                                    const Row<Real>& share) {
  const auto mix = [&](const Row<Real>& first, const Row<Real>& second) __attribute__((always_inline)) {
    return multiply_add(share, Row<Real>(second - first), first);
  };
  return {mix(a.x, b.x), mix(a.y, b.y), mix(a.z, b.z)};
}

/// The box that a piece reaches: the cylinder of radius `reach`, drawn out beyond its ends as far as the planes there
/// cut it, or by `reach` less the radius at a free end.
template <class Real>
struct CylinderBox {
  Real low[3], high[3];
};

template <class Real>
CylinderBox<Real> box_of(const GridCylinder<Real>& p, Real reach) {
  Real beyond[2];
  for (int e = 0; e < 2; ++e) {
    const auto& n = p.cuts[e].normal;
    const Real cosine = std::abs(n[0] * p.along[0] + n[1] * p.along[1] + n[2] * p.along[2]);
    const Real tangent = std::sqrt(std::max(Real(0), 1 - cosine * cosine)) / std::max(cosine, Real(0.1));
    beyond[e] = p.cuts[e].side == 0 ? Real(kWallDragReach) : reach * tangent;
  }
  CylinderBox<Real> box;
  for (int a = 0; a < 3; ++a) {
    const Real across = reach * std::sqrt(std::max(Real(0), 1 - p.along[a] * p.along[a])) + Real(1e-3);
    const Real first = p.start[a] - beyond[0] * p.along[a], second = p.end[a] + beyond[1] * p.along[a];
    box.low[a] = std::min(first, second) - across;
    box.high[a] = std::max(first, second) + across;
  }
  return box;
}

/// Calls visit(y, z), local to the block, for the rows of a block in the box.
template <class Real, class Visit>
[[gnu::always_inline]] inline void for_rows_in(const CylinderBox<Real>& box, const Vec3i& lowest, const Visit& visit) {
  int low[3], high[3];
  for (int a = 0; a < 3; ++a) {
    low[a] = std::max(0, static_cast<int>(std::ceil(box.low[a] - Real(0.5))) - lowest[a]);
    high[a] = std::min(lbm::kBlockWidth, static_cast<int>(std::floor(box.high[a] - Real(0.5))) + 1 - lowest[a]);
  }
  if (low[0] >= high[0]) return;
  for (int k = low[2]; k < high[2]; ++k)
    for (int j = low[1]; j < high[1]; ++j) visit(j, k);
}

}  // namespace lahar::coupling
