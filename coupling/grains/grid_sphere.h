#pragma once
// A sphere as the grid sees it.

namespace lahar::coupling {

/// A sphere as the grid sees it, lattice units; positions in cells from the corner of cell (0,0,0).
template <class Real>
struct GridSphere {
  Real centre[3];
  Real radius;       ///< mapping radius
  Real surface;      ///< radius at which the fluid comes to rest (wall_drag.h); below 0: none, weighting by eps
  Real reach;        ///< how far from the centre the exchange of momentum looks at cells
  Real factor = 1;   ///< scales eps to the exact volume outside of walls
  Real velocity[3];  ///< lu
  Real spin[3];      ///< rad per step
};

/// How far from the centre eps is not 0.
template <class Real>
Real covered_reach(const GridSphere<Real>& s) {
  return s.radius + Real(0.5);
}

}  // namespace lahar::coupling
