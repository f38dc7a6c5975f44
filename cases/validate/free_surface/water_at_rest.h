#pragma once
// Water at rest in a tank: it must stay at rest, with the pressure of its depth. The surface lies between two cells, or
// the tank stands at 35 degrees to the lattice and its surface cuts the cells in every way.
#include <cmath>
#include <string>
#include <vector>

#include "cases/validate/entry.h"
#include "core/vector.h"

namespace lahar::validate {

struct WaterAtRest {
  Vec3i cells = Vec3i::Zero();
  double angle = 0;  ///< rad, between gravity and -z, in the xz plane
  double level = 0;  ///< of the surface in the middle of the tank, cells
  double viscosity = 0.01;
  double wave_speed = 0.02;  ///< sqrt(g H), lu: the liquid is compressed by 0.1 % at the bottom
  int steps = 100000;

  [[nodiscard]] double gravity() const { return wave_speed * wave_speed / level; }
  [[nodiscard]] Vec3 acceleration() const { return gravity() * Vec3(std::sin(angle), 0, -std::cos(angle)); }
  [[nodiscard]] double surface(double x) const { return level + std::tan(angle) * (x - 0.5 * cells.x()); }
  /// Hydrostatic pressure, lu, where the surface is the plane through the middle of the tank.
  [[nodiscard]] double pressure(const Vec3& p) const { return gravity() * std::cos(angle) * (surface(p.x()) - p.z()); }
};

/// A tank level in the lattice, and one tilted by 35 degrees.
WaterAtRest level_tank(const Context& context);
WaterAtRest tilted_tank(const Context& context);

/// Rows on the speed, the pressure and the mass of the liquid at the end.
std::vector<Row> rows_at_rest(const WaterAtRest& rest, const std::string& label, const Context& context);

}  // namespace lahar::validate
