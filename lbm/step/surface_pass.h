#pragma once
// The pass over the surface before a sweep: shear stress, mirrors, mass and populations from the gas.
#include <vector>

#include "lbm/free_surface/shear_row.h"
#include "lbm/step/fluid_level.h"

namespace lahar::lbm {

template <class Real>
class SurfacePass {
 public:
  /// `surface_tension` in N/m.
  void run(FluidLevel<Real>& level, double surface_tension);

 private:
  void measure_shears(FluidLevel<Real>& level);

  std::vector<std::vector<ShearRow<Real>>> shear_;  // by place in the list of owned blocks; surface_shear.h
};

extern template class SurfacePass<float>;
extern template class SurfacePass<double>;

}  // namespace lahar::lbm
