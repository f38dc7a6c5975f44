#include "cases/observers/flow.h"

#include <algorithm>
#include <cmath>

namespace lahar::cases {

namespace {

/// Profiles along x: volume of the mixture, and momentum of the liquid, per column of cells across the flow.
struct Profiles {
  std::vector<double> volume, liquid, momentum;
};

double& at(std::vector<double>& v, std::size_t k) {
  if (k >= v.size()) v.resize(k + 1, 0.0);
  return v[k];
}

void find_deepest(const Profiles& profile, double dx, double width, FlowFigures& f) {
  for (std::size_t x = 0; x < profile.volume.size(); ++x) {
    const double depth = profile.volume[x] / (dx * width);
    if (depth <= f.deepest || profile.liquid[x] <= 0) continue;
    f.deepest = depth;
    f.deepest_speed = profile.momentum[x] / profile.liquid[x];
  }
}

}  // namespace

FlowFigures look_at_flow(const Observed& run) {
  FlowFigures f;
  const scene::Scene& scene = run.scene;
  const double dx = scene.fluid.cell_size, rho = scene.fluid.density, g = scene.gravity.magnitude;
  const Vec3 lower = scene.domain.lower;
  const double outflow_x = run.section.value_or(0.0) + scene.measure.outflow_distance;
  Profiles profile;
  std::vector<double> foremost;
  run.simulation.fluid()->for_each_wet_cell([&](const lbm::WetCell& c) {
    const double mass = rho * c.liquid_volume, energy = 0.5 * c.velocity.squaredNorm() + g * run.height(c.centre);
    f.kinetic += 0.5 * mass * c.velocity.squaredNorm();
    f.potential += mass * g * run.height(c.centre);
    f.momentum += mass * c.velocity;
    const auto x = static_cast<std::size_t>(std::max(0.0, (c.centre.x() - lower.x()) / dx));
    at(profile.volume, x) += c.fill_level * dx * dx * dx;
    at(profile.liquid, x) += c.liquid_volume;
    at(profile.momentum, x) += c.liquid_volume * c.velocity.x();
    if (c.fill_level > 0.5 && c.centre.z() - lower.z() < dx) {
      const auto y = static_cast<std::size_t>(std::max(0.0, (c.centre.y() - lower.y()) / dx));
      at(foremost, y) = std::max(at(foremost, y), c.centre.x() + dx / 2 - lower.x());
    }
    if (run.section && std::abs(c.centre.x() - outflow_x) <= dx / 2) {
      f.outflow_rate += mass * c.velocity.x() / dx;
      f.outflow_power += mass * energy * c.velocity.x() / dx;
    }
  });
  const double width = scene.domain.upper.y() - lower.y();
  for (const double x : foremost) f.front += x * dx / width;
  f.front += lower.x();
  find_deepest(profile, dx, width, f);
  return f;
}

Flow::Flow(const Observed& run) : Observer(run) {
  column("fluid_kinetic_J", "J", "kinetic energy of the liquid", [this] { return now_.kinetic; });
  column("fluid_potential_J", "J",
         "potential energy of the liquid about `measure.energy_datum_z_m` on the measured section",
         [this] { return now_.potential; });
  column("front_x_m", "m", "front of the fluid: mean over the width of the foremost bed cell more than half full",
         [this] { return now_.front; });
  if (run.section)
    event("front_arrival_s", "s", "first row with `front_x_m` at the measured section or beyond",
          [this] { return now_.front >= *run_.section ? run_.simulation.time() : kUnknown; });
}

}  // namespace lahar::cases
