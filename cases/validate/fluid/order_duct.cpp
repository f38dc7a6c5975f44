// Flow in a square duct, driven by a body force from rest (White, Viscous Fluid Flow, eq. 3-48):
//   u = g / (2 nu) [ y (H - y) - 8 H^2 / pi^3 sum_{n odd} sin(n pi y / H) cosh(n pi (z / H - 1/2)) / (n^3 cosh(n pi /
//   2)) ]
#include <fmt/format.h>

#include <numbers>

#include "cases/validate/entry.h"
#include "cases/validate/fluid/flows.h"

namespace lahar::validate {

namespace {

using lbm::CollisionOperator;

constexpr double kViscosity = 0.06;      // lu
constexpr double kDuration = 1;          // t nu / H^2: what is left of the start is exp(-2 pi^2) = 3e-9
constexpr double kPeakSpeed = 0.08;      // lu, on 8 cells; falls with the cell size
constexpr double kPeakFactor = 0.07367;  // u_max nu / (g H^2), from the series
constexpr double kDischarge = 0.035144;  // Q nu / (g H^4)
constexpr double kPeakOverMean = 2.0963;

/// u nu / (g H^2) at y, z in 0..1.
double exact_speed(double y, double z) {
  using std::numbers::pi;
  double sum = 0;
  for (int n = 1; n < 100; n += 2)
    sum += std::sin(n * pi * y) * std::cosh(n * pi * (z - 0.5)) / (n * n * n * std::cosh(n * pi / 2));
  return 0.5 * (y * (1 - y) - 8 / (pi * pi * pi) * sum);
}

struct Duct {
  int cells = 16;
  CollisionOperator collision = lbm::CentralMoments{};
  int along = 0;  ///< axis
};

struct Profile {
  double error;           ///< of the velocity
  double discharge;       ///< Q nu / (g H^4)
  double peak_over_mean;  ///< largest cell over the mean of all
};

Profile profile_of(const Duct& duct) {
  const int y = (duct.along + 1) % 3, z = (duct.along + 2) % 3;
  const double height = duct.cells, g = kPeakSpeed * 8 / height * kViscosity / (kPeakFactor * height * height);
  Vec3i cells = Vec3i::Constant(duct.cells);
  cells[duct.along] = 8;
  lbm::FluidOptions o = lattice_box(cells, kViscosity);
  o.domain.faces.fill(lbm::FaceKind::closed);
  const auto face = static_cast<std::size_t>(2 * duct.along);
  o.domain.faces[face] = o.domain.faces[face + 1] = lbm::FaceKind::periodic;
  o.collision = duct.collision;
  o.gravity = g * Vec3::Unit(duct.along);
  lbm::Fluid<double> fluid(o);
  fluid.fill_everything(at_rest, no_pressure);
  advance(fluid, diffusive_steps(kDuration, duct.cells, kViscosity));
  double sum = 0, peak = 0;
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
    sum += c.velocity[duct.along];
    peak = std::max(peak, c.velocity[duct.along]);
  });
  const double mean = sum / (8 * height * height), unit = g * height * height / kViscosity;
  const auto exact = [&](const Vec3& p) {
    return Vec3(unit * exact_speed(p[y] / height, p[z] / height) * Vec3::Unit(duct.along));
  };
  return {velocity_error(fluid, exact), mean / unit, peak / mean};
}

std::vector<Row> run(const Context& context) {
  const std::vector<int> cells = context.quick ? std::vector{6, 8, 14} : std::vector{8, 16, 32};
  const double tolerance = context.quick ? 0.03 : 0.005;
  std::vector<Row> rows;
  for (const CollisionOperator collision : kOperators) {
    const std::string name(lbm::name(collision));
    std::vector<double> errors;
    Profile finest{};
    for (const int n : cells) {
      finest = profile_of({.cells = n, .collision = collision});
      errors.push_back(finest.error);
    }
    rows.push_back(at_least_row(order_label(name, cells), lowest_order(cells, errors), 1.9));
    rows.push_back(relative_row(fmt::format("{}: viscosity / nu from the discharge, {} cells", name, cells.back()),
                                kDischarge / finest.discharge, 1, tolerance));
    rows.push_back(relative_row(fmt::format("{}: peak / mean, {} cells", name, cells.back()), finest.peak_over_mean,
                                kPeakOverMean, tolerance));
    const double straight = profile_of({.cells = 8, .collision = collision}).discharge;
    for (const int along : {1, 2})
      rows.push_back(relative_row(fmt::format("{}: discharge along {} against along x", name, "xyz"[along]),
                                  profile_of({8, collision, along}).discharge, straight, 1e-9));
  }
  return rows;
}

}  // namespace

Entry order_duct() { return {"fluid.order_duct", {"exact solution of the Navier-Stokes equations (series)"}, run}; }

}  // namespace lahar::validate
