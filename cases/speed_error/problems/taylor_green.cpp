// Two-dimensional Taylor-Green vortex of Reynolds number 100 (speed times box over viscosity), to the time at which its
// amplitude has fallen to 0.45: the exact solution of the Navier-Stokes equations.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "cases/speed_error/problems/problems.h"
#include "cases/validate/fluid/flows.h"

namespace lahar::validate {

namespace {

struct Vortex {
  int cells = 32;
  double speed = 0.1;  ///< lu
  lbm::CollisionOperator collision = lbm::CentralMoments{};
  double smagorinsky = 0;
  bool double_precision = false;
};

constexpr double kReynolds = 100, kDuration = 0.01;  // t nu / box^2

template <class Real>
double error_in(const Vortex& v) {
  const double n = v.cells, nu = v.speed * n / kReynolds, k = 2 * std::numbers::pi / n;
  lbm::FluidOptions o = lattice_box(Vec3i(v.cells, v.cells, 8), nu);
  o.collision = v.collision;
  o.smagorinsky = v.smagorinsky;
  const auto exact = [&](double t) {
    const double amplitude = v.speed * std::exp(-2 * nu * k * k * t);
    return [=](const Vec3& p) {
      return Vec3(amplitude * std::cos(k * p.x()) * std::sin(k * p.y()),
                  -amplitude * std::sin(k * p.x()) * std::cos(k * p.y()), 0);
    };
  };
  const auto pressure = [&](const Vec3& p) {
    return -0.75 * v.speed * v.speed * (std::cos(2 * k * p.x()) + std::cos(2 * k * p.y()));
  };
  lbm::Fluid<Real> fluid(o);
  fluid.fill_everything(exact(0), pressure, lbm::Start::with_stress);
  const int steps = diffusive_steps(kDuration, v.cells, nu);
  advance(fluid, steps);
  return velocity_error(fluid, exact(steps));
}

Trial trial(std::vector<Knob> turned, const Vortex& v) {
  return {std::move(turned),
          [v] { return timed([&] { return v.double_precision ? error_in<double>(v) : error_in<float>(v); }); }};
}

}  // namespace

Problem taylor_green_problem(bool quick) {
  Problem p{"taylor_green",
            "RMS of the velocity's error, of the velocity",
            "exact",
            "32 cells, 0.1 lu, central moments, float",
            {}};
  const Vortex standard;
  p.trials.push_back(trial({}, standard));
  for (const int cells : {16, 64, 128}) {
    if (quick && cells > 64) continue;
    Vortex v = standard;
    v.cells = cells;
    p.trials.push_back(trial({{"cells", fmt::to_string(cells)}}, v));
  }
  for (const double speed : {0.2, 0.05, 0.025}) {
    Vortex v = standard;
    v.speed = speed;
    p.trials.push_back(trial({{"lattice_velocity", fmt::to_string(speed)}}, v));
  }
  for (const int cells : {32, 64})
    for (const double speed : {0.2, 0.05}) {
      if (cells == 32) continue;
      Vortex v = standard;
      v.cells = cells, v.speed = speed;
      p.trials.push_back(trial({{"cells", fmt::to_string(cells)}, {"lattice_velocity", fmt::to_string(speed)}}, v));
    }
  const std::pair<const char*, lbm::CollisionOperator> operators[] = {{"trt", lbm::Trt{}}, {"bgk", lbm::Bgk{}}};
  for (const auto& [name, collision] : operators) {
    Vortex v = standard;
    v.collision = collision;
    p.trials.push_back(trial({{"collision", name}}, v));
  }
  Vortex v = standard;
  v.smagorinsky = 0.16;
  p.trials.push_back(trial({{"smagorinsky", "0.16"}}, v));
  v = standard;
  v.double_precision = true;
  p.trials.push_back(trial({{"precision", "double"}}, v));
  return p;
}

}  // namespace lahar::validate
