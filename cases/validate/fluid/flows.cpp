#include "cases/validate/fluid/flows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

namespace lahar::validate {

lbm::FluidOptions lattice_box(const Vec3i& cells, double viscosity) {
  lbm::FluidOptions o;
  o.domain.upper = cells.cast<double>();
  o.domain.cell_size = 1;
  o.domain.faces.fill(lbm::FaceKind::periodic);
  o.time_step = 1;
  o.density = 1;
  o.kinematic_viscosity = viscosity;
  return o;
}

double lowest_order(std::span<const int> cells, std::span<const double> errors) {
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < errors.size(); ++k) {
    const double order = std::log(errors[k - 1] / errors[k]) / std::log(static_cast<double>(cells[k]) / cells[k - 1]);
    if (std::isnan(order)) return order;
    lowest = std::min(lowest, order);
  }
  return lowest;
}

std::string order_label(const std::string& what, std::span<const int> cells) {
  return fmt::format("{}: order, {} cells", what, fmt::join(cells, ", "));
}

int diffusive_steps(double time, int cells, double viscosity) {
  return static_cast<int>(std::lround(time * cells * cells / viscosity));
}

}  // namespace lahar::validate
