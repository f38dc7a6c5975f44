// Case H5 of reference/hard_cases.csv: a sphere of 8 cm slams on water at 5 m/s.
//
// Impulse by the time its lowest point is half a radius R under the level of rest: v m m_a / (m + m_a), what it gives
// the water that has to follow it at once (von Karman 1929), m_a the added mass of the wetted cap under a plane of
// constant pressure, 0.655 rho R^3 (slam_reference.py), and 1.7 % more in a tank 6 R wide: the images of the dipole of
// cap and water, 2.62 rho R^3 v, in a square lattice (sum of r^-3 9.03 for a pitch of 1) make 0.9 % of v. Water that
// rises beside the sphere is left out: by a fit that has it (Miloh 1991, Appl. Ocean Res. 13:34, from memory) the
// impulse is 0.74 rho R^3 v where the sphere keeps its velocity, 13 % more. Weight is 0.3 % of it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/validate/entry.h"
#include "cases/validate/grains_in_fluid/sphere_tanks.h"

namespace lahar::validate {
namespace {

struct Slam {
  double peak = 0;                 ///< largest force, over rho v^2 pi R^2/2, mean of a twentieth of D/v
  double impulse = 0;              ///< until half a radius under the level, over rho R^3 v
  double lowest = 1, highest = 1;  ///< density
};

constexpr double kAddedMass = 0.655 * 1.017;  // over rho R^3

/// Of a sphere of this density ratio, over rho R^3 v.
double impulse_of_slam(double density) {
  const double mass = 4 * std::numbers::pi / 3 * density;
  return mass * kAddedMass / (mass + kAddedMass);
}

/// 5 m/s are 0.1 lu.
SphereTank slam_tank(double density, double diameter) {
  const int w = static_cast<int>(3 * diameter);
  SphereTank t;
  t.cells = Vec3i(w, w, static_cast<int>(4.5 * diameter));
  t.depth = 2.5 * diameter + 0.4;
  t.diameter = diameter;
  t.density = density;
  t.velocity = Vec3(0, 0, -0.1);
  t.gravity = 9.81 * 0.08 / 25 * 0.01 / diameter;
  t.viscosity = 1e-6 / (5 * 0.08) * 0.1 * diameter;
  t.place = Vec3(w / 2 + 0.2, w / 2 - 0.1, t.depth + diameter / 2 + 0.5);
  return t;
}

template <class Real>
void look(const lbm::Fluid<Real>& fluid, Slam& slam) {
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
    slam.lowest = std::min(slam.lowest, 1 + 3 * c.pressure);
    slam.highest = std::max(slam.highest, 1 + 3 * c.pressure);
  });
}

template <class Real>
Slam slam_once(const SphereTank& t, std::vector<Row>& rows, const std::string& what) {
  const auto tank = make_tank<Real>(t);
  auto& step = *tank;
  Slam slam;
  const int steps = static_cast<int>(1.5 * t.diameter / 0.1),
            window = std::max(1, static_cast<int>(0.05 * t.diameter / 0.1));
  std::vector<double> force;
  for (int s = 0; s < steps; ++s) {
    step.advance();
    const dem::Particles& sphere = step.solids()->particles();
    force.push_back(sphere.external_force.z[0]);
    const double radius = t.diameter / 2, under = t.depth - (sphere.position.z[0] - radius);
    if (under < radius / 2) slam.impulse += force.back() / (radius * radius * radius * 0.1);
    if (s % 2 == 0) look(*step.fluid(), slam);
    double mean = 0;
    for (std::size_t k = force.size() - std::min<std::size_t>(force.size(), window); k < force.size(); ++k)
      mean += force[k] / window;
    slam.peak = std::max(slam.peak, mean / (0.5 * 0.01 * std::numbers::pi * t.diameter * t.diameter / 4));
  }
  add_ledgers(rows, what, step);
  return slam;
}

template <class Real>
void float_up(std::vector<Row>& rows) {
  SphereTank t = slam_tank(0.5, 8);
  const auto tank = make_tank<Real>(t);
  auto& step = *tank;
  const int steps = 9000;
  double late = 0;
  int samples = 0;
  for (int s = 0; s < steps; ++s) {
    step.advance();
    if (s >= steps - 2000) late += step.solids()->particles().position.z[0], ++samples;
  }
  const double surface = filled_volume(*step.fluid()) / (static_cast<double>(t.cells.x()) * t.cells.y());
  rows.push_back(absolute_row("density 500 afterwards: immersion depth, diameters",
                              (surface - late / samples) / t.diameter + 0.5, 0.5, 0.05));
}

std::vector<Row> run(const Context& context) {
  return in_precision(context, [&]<class Real>() {
    std::vector<Row> rows;
    for (const double density : {2.5, 0.5}) {
      std::vector<double> peaks, impulses;
      for (const double d : context.quick ? std::vector<double>{4, 8} : std::vector<double>{4, 8, 16}) {
        const std::string what = fmt::format("density {:g}, D {:g} cells", 1000 * density, d);
        const Slam slam = slam_once<Real>(slam_tank(density, d), rows, what);
        rows.push_back(at_least_row(what + ": lowest density", slam.lowest, 0.8));
        rows.push_back(at_most_row(what + ": highest density", slam.highest, 1.2));
        peaks.push_back(slam.peak), impulses.push_back(slam.impulse);
        if (!context.quick && d > 4)
          rows.push_back(relative_row(what + ": impulse until R/2 under the level, over rho R^3 v", slam.impulse,
                                      impulse_of_slam(density), 0.05));
      }
      if (context.quick) continue;
      const std::string what = fmt::format("density {:g}: ", 1000 * density);
      rows.push_back(relative_row(what + "peak force, the last two sizes", peaks[1], peaks[2], 0.2));
      rows.push_back(relative_row(what + "impulse, the last two sizes", impulses[1], impulses[2], 0.05));
    }
    if (!context.quick) float_up<Real>(rows);
    return rows;
  });
}

}  // namespace

Entry slamming_sphere() {
  return {"grains_in_fluid.slamming_sphere",
          {"case H5 of the hard cases; momentum theory of impact, von Karman 1929", {"hard_cases.csv"}},
          run};
}

}  // namespace lahar::validate
