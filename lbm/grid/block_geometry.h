#pragma once
// The geometry of the domain cut into a block: types of its cells, cells at the rim of open faces, links into walls.
#include "lbm/grid/block.h"
#include "lbm/grid/domain.h"

namespace lahar::lbm {

/// The cell inside the domain that a cell beyond a periodic face stands for.
Vec3i image_of(const Domain& domain, Vec3i cell);

/// `lowest` is the block's lowest cell; `velocity_to_lu` converts the walls' velocities. Writes this block alone.
template <class Real>
void cut_geometry(Block<Real>& block, const Domain& domain, const Vec3i& lowest, double velocity_to_lu);

extern template void cut_geometry<float>(Block<float>&, const Domain&, const Vec3i&, double);
extern template void cut_geometry<double>(Block<double>&, const Domain&, const Vec3i&, double);

}  // namespace lahar::lbm
