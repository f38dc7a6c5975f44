#pragma once
// A stirred periodic box in lattice units, and the momentum of what its cells hold: seen from outside of the code's own
// books.
#include <cmath>
#include <numbers>

#include "cases/validate/fluid/flows.h"
#include "coupling/coupled_step.h"

namespace lahar::validate {

/// Fills a cube of `width` cells with a stream along x that varies along all axes.
template <class Real>
void stir(coupling::CoupledStep<Real>& step, int width) {
  step.fluid()->fill_everything(
      [width](const Vec3& x) {
        const double k = 2 * std::numbers::pi / width;
        return Vec3(0.05 + 0.02 * std::sin(k * x.y()), 0.02 * std::sin(k * x.z()), 0.02 * std::sin(k * x.x()));
      },
      no_pressure);
}

/// Of all cells, less what they have still to give to wires.
template <class Real>
Vec3 momentum_of_cells(coupling::CoupledStep<Real>& step) {
  Vec3 sum = Vec3::Zero();
  step.fluid()->for_each_wet_cell([&](const lbm::WetCell& c) { sum += (1 + 3 * c.pressure) * c.velocity; });
  return sum - step.owed_to_wires();
}

}  // namespace lahar::validate
