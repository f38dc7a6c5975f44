// Speed of the bodies in water.
#include <algorithm>
#include <cmath>

#include "coupling/grains/grain_coupling.h"
#include "tests/performance/benchmark.h"

namespace lahar::performance {

namespace {

constexpr int kCells = 128;        // along each axis
constexpr double kDiameter = 4.0;  // cells

/// Touching grains in staggered layers (body-centred cubic, 0.68 solid) that creep along by `pace` cells a step, each
/// its own way.
dem::Particles packed_bed(double pace) {
  dem::Particles particles;
  const double pitch = kDiameter * 2 / std::sqrt(3.0);
  const int n = static_cast<int>(kCells / pitch);
  for (int k = 0; k < 2 * n * n * n; ++k) {
    const int c = k / 2, centred = k % 2;
    dem::ParticleSpec grain;
    grain.position = pitch * (Vec3(c % n, c / n % n, c / n / n) + Vec3::Constant(0.5 * centred + 0.3));
    grain.velocity = pace * Vec3(std::sin(k), std::cos(k), std::sin(2.0 * k));
    grain.radius = kDiameter / 2;
    grain.density = 2.65;
    particles.add(grain);
  }
  return particles;
}

/// Where every grain moves in every step all of the mapping is done again; at rest none of it. Bodies by the cheapest
/// weighting and operator, or with those of the debris flow and its eddies. Counted: mapping, collision, forces; the
/// particles' own step is not counted.
Figure packed_bed_rate(const std::string& name, double pace, bool as_in_debris_flow, const Session& session) {
  lbm::FluidOptions o;
  o.domain.cell_size = 1;
  o.domain.upper = Vec3::Constant(kCells);
  o.domain.faces.fill(lbm::FaceKind::periodic);
  o.time_step = 1;
  o.density = 1;
  o.kinematic_viscosity = 1e-5;
  o.gravity = Vec3(0, 0, -1e-5);
  o.weighting = as_in_debris_flow ? lbm::BodyWeighting::inertial : lbm::BodyWeighting::solid_fraction;
  o.solid_operator =
      as_in_debris_flow ? lbm::SolidOperator::equilibrium_difference : lbm::SolidOperator::damped_nonequilibrium;
  if (as_in_debris_flow) o.smagorinsky = 0.16;
  lbm::Fluid<float> fluid(o);
  fluid.keep_velocities(false);  // no wires: as in CoupledStep
  fluid.fill_everything([](const Vec3&) { return Vec3(0.01, 0, 0); }, [](const Vec3&) { return 0.0; });
  dem::Particles particles = packed_bed(pace);
  coupling::SolidFields<float> fields;
  coupling::GrainCoupling<float> grains(as_in_debris_flow
                                            ? coupling::ResolvedGrains{.radius_shift = coupling::kRadiusShiftFast}
                                            : coupling::ResolvedGrains{},
                                        o);
  const auto step = [&] {
    for (std::size_t i = 0; i < particles.size(); ++i) particles.position.add(i, particles.velocity[i]);
    fields.open(fluid.grid());
    grains.update(fluid, particles, fields);
    fields.close(fluid.grid());
    fluid.step();
    particles.external_force.fill(Vec3::Zero());
    particles.external_torque.fill(Vec3::Zero());
    grains.add_forces(fluid, particles);
  };
  step();
  double best = 0;
  for (int r = 0; r < session.repeats; ++r) {
    const double updates = fluid.cell_updates();
    const double seconds = best_seconds(1, [&] {
      for (int s = 0; s < 10; ++s) step();
    });
    best = std::max(best, (fluid.cell_updates() - updates) / seconds / 1e6);
  }
  return {name, best, "MLUPS", best / session.value_of("fluid.plain"), "fluid.plain", pace > 0 ? 0.40 : 0.50};
}

}  // namespace

std::vector<Benchmark> bodies_benchmarks() {
  const auto entry = [](const std::string& name, double pace, bool as_in_debris_flow) {
    return Benchmark{
        name, {"fluid.plain"}, [=](Session& s) { return packed_bed_rate(name, pace, as_in_debris_flow, s); }};
  };
  return {entry("bodies.wet_packed_bed", 1e-3, false), entry("bodies.wet_packed_bed_at_rest", 0, false),
          entry("bodies.debris_flow_bed", 1e-3, true), entry("bodies.debris_flow_bed_at_rest", 0, true)};
}

}  // namespace lahar::performance
