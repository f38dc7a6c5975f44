#pragma once
// Curvature of the surface from the fill levels around a cell.
//
// Height functions (Sussman 2003, J. Comput. Phys. 187, 110; Cummins, Francois & Kothe 2005, Comput. Struct. 83, 425):
// along the axis closest to the normal the fill levels of nine columns of nine cells add up to heights h, and
//   curvature = -(h_xx (1 + h_y^2) + h_yy (1 + h_x^2) - 2 h_xy h_x h_y) / (1 + h_x^2 + h_y^2)^(3/2),
// second order in the cell size. A column must begin in liquid and end in gas. Where the columns along no axis do, in
// drops and sheets of a few cells, the divergence of the normals (Brackbill, Kothe & Zemach 1992, J. Comput. Phys. 100,
// 335) has to do, which is coarse.
//
// Walls: contact angle of 90 degrees. A column in a wall is as high as its neighbour in the middle, and one that runs
// into a wall goes on as the last cell before it, below the surface as liquid; a dry one on a wall has no height.
#include "lbm/grid/fluid_grid.h"

namespace lahar::lbm {

/// Fill levels of a block and four cells around it.
template <class Real>
struct FillAround {
  static constexpr int rim = 4, width = 16;
  static constexpr Real wall = Real(-1);
  Real fill[width * width * width];

  FillAround(const FluidGrid<Real>& grid, BlockIndex b);
  FillAround() = default;
  /// Cell (x, y, z), each -4..11.
  static constexpr int at(int x, int y, int z) { return (x + rim) + width * ((y + rim) + width * (z + rim)); }
};

/// Sum of the two principal curvatures in a cell of the block at (x, y, z), 1/cell: positive for a drop. Bounded by 1,
/// that of a drop of 2 cells radius.
template <class Real>
Real curvature(const FillAround<Real>& around, int x, int y, int z);

extern template struct FillAround<float>;
extern template struct FillAround<double>;
extern template float curvature<float>(const FillAround<float>&, int, int, int);
extern template double curvature<double>(const FillAround<double>&, int, int, int);

}  // namespace lahar::lbm
