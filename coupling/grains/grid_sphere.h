#pragma once
// A sphere as the grid sees it.
#include <algorithm>

#include "coupling/grains/wall_resistance.h"

namespace lahar::coupling {

/// A sphere as the grid sees it, lattice units; positions in cells from the corner of cell (0,0,0).
template <class Real>
struct GridSphere {
  Real centre[3];
  Real radius;       ///< mapping radius
  Real surface;      ///< radius at which the fluid comes to rest (wall_resistance.h); below 0: weighting by eps
  Real factor = 1;   ///< scales eps to the exact volume
  Real velocity[3];  ///< lu
  Real spin[3];      ///< rad per step
};

/// How far from the centre eps is not 0.
template <class Real>
Real covered_reach(const GridSphere<Real>& s) {
  return s.radius + Real(0.5);
}

/// How far from the centre eps or the coverage is not 0.
template <class Real>
Real reach_of(const GridSphere<Real>& s) {
  return std::max(covered_reach(s), s.surface + Real(kResistanceReach));
}

}  // namespace lahar::coupling
