#include "cases/validate/free_surface/surface_flows.h"

#include <algorithm>

#include "core/worst.h"

namespace lahar::validate {

lbm::FluidOptions open_tank(const Vec3i& cells, double viscosity, const Vec3& gravity) {
  lbm::FluidOptions o;
  o.domain.upper = cells.cast<double>();
  o.domain.cell_size = 1;
  o.domain.faces[5] = lbm::FaceKind::open;
  o.time_step = 1;
  o.density = 1;
  o.kinematic_viscosity = viscosity;
  o.gravity = gravity;
  return o;
}

std::vector<lbm::LiquidRegion> liquid_under(const Vec3i& cells, const std::function<double(double)>& surface) {
  std::vector<lbm::LiquidRegion> regions;
  for (int x = 0; x < cells.x(); ++x) {
    lbm::LiquidRegion column;
    // A hair inside the column's faces: what reaches the far face of a periodic axis would be filled in twice.
    column.lower = Vec3(x + 1e-9, 0, 0);
    column.upper = Vec3(x + 1 - 1e-9, cells.y() - 1e-9, surface(x + 0.5));
    regions.push_back(column);
  }
  return regions;
}

std::vector<lbm::LiquidRegion> liquid_under_slope(const Vec3i& cells, const std::function<double(double)>& surface) {
  constexpr int kParts = 16;
  std::vector<lbm::LiquidRegion> regions;
  for (int x = 0; x < cells.x(); ++x)
    for (int k = 0; k < kParts; ++k) {
      const int part = (k + kParts / 2) % kParts;  // the first one sets the cells' pressure: from the middle
      const double low = x + static_cast<double>(part) / kParts, high = low + 1.0 / kParts;
      lbm::LiquidRegion slice;
      slice.lower = Vec3(low + 1e-9, 0, 0);
      slice.upper = Vec3(high - 1e-9, cells.y() - 1e-9, surface(0.5 * (low + high)));
      regions.push_back(slice);
    }
  return regions;
}

template <class Real>
double fastest(const lbm::Fluid<Real>& fluid) {
  double speed = 0;
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) { keep_worst(speed, c.velocity.norm()); });
  return speed;
}

template <class Real>
Energies energies(const lbm::Fluid<Real>& fluid) {
  Energies e;
  const Vec3 g = fluid.options().gravity, down = g.normalized();
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
    const double mass = c.liquid_volume * (1 + 3 * c.pressure);
    const Vec3 centre = c.centre + 0.5 * (1 - c.fill_level) * down;  // liquid lies at the bottom of its cell
    e.kinetic += 0.5 * mass * c.velocity.squaredNorm();
    e.potential -= mass * g.dot(centre);
    e.elastic += 1.5 * c.liquid_volume * c.pressure * c.pressure;
  });
  return e;
}

template <class Real>
double front_in_bottom_layer(const lbm::Fluid<Real>& fluid, const Vec3i& cells) {
  std::vector<double> fill(static_cast<std::size_t>(cells.x()) + 1, 0.0);
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
    if (c.centre.z() < 1) fill[static_cast<std::size_t>(c.centre.x())] += c.fill_level / cells.y();
  });
  std::size_t last = fill.size() - 1;
  while (last > 0 && fill[last - 1] < 0.5) --last;
  // The cell before `last` is more than half full: the front lies where what is in both of them would end.
  return static_cast<double>(last) - 1 + std::min(1.0, fill[last - 1]) + fill[last];
}

template <class Real>
double height_at_back(const lbm::Fluid<Real>& fluid, const Vec3i& cells) {
  double height = 0;
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
    if (c.centre.x() < 1) height += c.fill_level / cells.y();
  });
  return height;
}

template double fastest<float>(const lbm::Fluid<float>&);
template double fastest<double>(const lbm::Fluid<double>&);
template double front_in_bottom_layer<float>(const lbm::Fluid<float>&, const Vec3i&);
template double front_in_bottom_layer<double>(const lbm::Fluid<double>&, const Vec3i&);
template double height_at_back<float>(const lbm::Fluid<float>&, const Vec3i&);
template double height_at_back<double>(const lbm::Fluid<double>&, const Vec3i&);
template Energies energies<float>(const lbm::Fluid<float>&);
template Energies energies<double>(const lbm::Fluid<double>&);

}  // namespace lahar::validate
