#include "cases/validate/fluid/periodic_flows.h"

#include <limits>
#include <numbers>

#include "core/check.h"

namespace lahar::validate {

namespace {

constexpr int kSamples = 40;

VelocityField start_of(const StabilityCase& c, double speed) {
  const double n = c.cells, k = 2 * std::numbers::pi / n;
  if (c.flow == PeriodicFlow::vortex)
    return [=](const Vec3& p) {
      return Vec3(speed * std::sin(k * p.x()) * std::cos(k * p.y()) * std::cos(k * p.z()),
                  -speed * std::cos(k * p.x()) * std::sin(k * p.y()) * std::cos(k * p.z()), 0);
    };
  return [=](const Vec3& p) {
    const double y = p.y() / n, layer = y <= 0.5 ? y - 0.25 : 0.75 - y;
    return Vec3(speed * std::tanh(80 * layer), 0.05 * speed * std::sin(k * p.x() + std::numbers::pi / 2), 0);
  };
}

template <class Real>
Stability run(const StabilityCase& c) {
  const double speed = c.mach / std::sqrt(3.0);
  const bool vortex = c.flow == PeriodicFlow::vortex;
  lbm::FluidOptions o = lattice_box({c.cells, c.cells, vortex ? c.cells : 8}, c.viscosity);
  o.collision = c.collision;
  o.smagorinsky = c.smagorinsky;
  lbm::Fluid<Real> fluid(o);
  fluid.fill_everything(start_of(c, speed), no_pressure);
  const double duration = vortex ? 10 * c.cells / (2 * std::numbers::pi) / speed : 2 * c.cells / speed;
  const double start = flow_energy(fluid), kinetic = kinetic_energy(fluid);
  EnergyRise energy;
  energy.note(start);
  Stability result;
  try {
    for (int sample = 1; sample <= kSamples; ++sample) {
      advance(fluid, static_cast<int>(duration / kSamples));
      fluid.watch();
      result.largest = std::max(result.largest, kinetic_energy(fluid) / kinetic);
      energy.note(flow_energy(fluid));
      result.rise = energy.largest() / start;
      result.finished = static_cast<double>(sample) / kSamples;
    }
  } catch (const NumericalFailure&) {
    result.largest = result.rise = std::numeric_limits<double>::infinity();
  }
  return result;
}

}  // namespace

Stability run_periodic(const StabilityCase& c, Precision precision) {
  return precision == Precision::float32 ? run<float>(c) : run<double>(c);
}

}  // namespace lahar::validate
