// A viscous film of 8 cells flows down a plane under its weight (Nusselt 1916): u(z) = g sin / nu (h z - z^2/2).
#include <cmath>

#include "cases/validate/fluid/surface_entries.h"
#include "cases/validate/fluid/surface_flows.h"

namespace lahar::validate {
namespace {

struct Film {
  double height = 8;  ///< cells
  double viscosity = 0.05, gravity = 5e-5, angle = 35 * 3.14159265358979 / 180;
  [[nodiscard]] double along() const { return gravity * std::sin(angle); }
  [[nodiscard]] double surface_velocity() const { return along() * height * height / (2 * viscosity); }
  [[nodiscard]] double velocity(double z) const { return along() / viscosity * (height * z - 0.5 * z * z); }
};

template <class Real>
std::vector<Row> ask(const Film& film, const std::string& label, double bar) {
  lbm::FluidOptions o = open_tank(Vec3i(8, 8, static_cast<int>(film.height) + 6), film.viscosity,
                                  film.gravity * Vec3(std::sin(film.angle), 0, -std::cos(film.angle)));
  o.domain.faces.fill(lbm::FaceKind::periodic);
  o.domain.faces[4] = lbm::FaceKind::closed, o.domain.faces[5] = lbm::FaceKind::open;
  lbm::Fluid<Real> fluid(o);
  fluid.fill({{Vec3::Zero(), Vec3(8 - 1e-9, 8 - 1e-9, film.height)}});
  // The slowest mode decays as exp(-nu (pi/2h)^2 t): to 1e-4.
  const double rate = film.viscosity * std::pow(3.14159265358979 / (2 * film.height), 2);
  while (static_cast<double>(fluid.steps()) < 9.2 / rate) fluid.step();
  double flux = 0, squares = 0, volume = 0;
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
    flux += c.liquid_volume * c.velocity.x();
    volume += c.liquid_volume;
    squares += c.liquid_volume * std::pow(c.velocity.x() - film.velocity(c.centre.z()), 2);
  });
  const double exact = 2.0 / 3.0 * film.surface_velocity() * film.height * 64;
  return {relative_row(label + "discharge", flux, exact, bar),
          at_most_row(label + "RMS of the profile, of the surface velocity",
                      std::sqrt(squares / volume) / film.surface_velocity(), bar)};
}

}  // namespace

std::vector<Row> nusselt_film(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    std::vector<Row> rows = ask<Real>({}, "8 cells: ", 0.02);
    // Beyond the ladder's table: the stress vanishes half a link from the last cells' centres wherever the surface
    // lies, so that a film between whole cells runs as one of the next whole cell.
    for (const Row& r : ask<Real>({.height = 8.5}, "8.5 cells, first order: ", 0.12)) rows.push_back(r);
    return rows;
  });
}

}  // namespace lahar::validate
