#pragma once
// What the entries without a surface share: boxes in lattice units (cell size, time step and density 1), errors,
// orders.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "cases/validate/entry.h"
#include "lbm/step/fluid.h"

namespace lahar::validate {

/// A periodic box filled with fluid at rest, in lattice units.
lbm::FluidOptions lattice_box(const Vec3i& cells, double viscosity);

inline constexpr std::array<lbm::CollisionOperator, 3> kOperators = {lbm::CentralMoments{}, lbm::Trt{}, lbm::Bgk{}};

/// Velocity as a function of the place, lu.
using VelocityField = std::function<Vec3(const Vec3&)>;

inline Vec3 at_rest(const Vec3&) { return Vec3::Zero(); }
inline double no_pressure(const Vec3&) { return 0; }

template <class Real>
void advance(lbm::Fluid<Real>& fluid, int steps) {
  for (int s = 0; s < steps; ++s) fluid.step();
}

/// sqrt(sum |u - exact|^2 / sum |exact - frame|^2) over all wet cells.
template <class Real>
double velocity_error(const lbm::Fluid<Real>& fluid, const VelocityField& exact, const Vec3& frame = Vec3::Zero()) {
  double difference = 0, size = 0;
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
    const Vec3 u = exact(c.centre);
    difference += (c.velocity - u).squaredNorm();
    size += (u - frame).squaredNorm();
  });
  return std::sqrt(difference / size);
}

/// Sum of |u - frame|^2 / 2 over all wet cells.
template <class Real>
double kinetic_energy(const lbm::Fluid<Real>& fluid, const Vec3& frame = Vec3::Zero()) {
  double sum = 0;
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) { sum += 0.5 * (c.velocity - frame).squaredNorm(); });
  return sum;
}

/// Kinetic energy and that of compression, c_s^2 (rho - 1)^2 / 2: sound takes the one for the other.
template <class Real>
double flow_energy(const lbm::Fluid<Real>& fluid) {
  double sum = 0;
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) { sum += 1.5 * c.pressure * c.pressure; });
  return kinetic_energy(fluid) + sum;
}

/// How far an energy that nothing feeds has risen above the lowest that it had before.
class EnergyRise {
 public:
  void note(double energy) {
    lowest_ = std::min(lowest_, energy);
    largest_ = std::max(largest_, energy - lowest_);
  }
  [[nodiscard]] double largest() const { return largest_; }

 private:
  double lowest_ = std::numeric_limits<double>::infinity(), largest_ = 0;
};

/// The lowest order of accuracy between neighbours of a series of grids: log(e_k / e_k+1) / log(n_k+1 / n_k).
double lowest_order(std::span<const int> cells, std::span<const double> errors);

/// "bgk: order over 16, 32, 64 cells"
std::string order_label(const std::string& what, std::span<const int> cells);

/// Steps of a grid under diffusive scaling, as many as make t nu / length^2 = time.
int diffusive_steps(double time, int cells, double viscosity);

}  // namespace lahar::validate
