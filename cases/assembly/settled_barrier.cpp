#include "cases/assembly/settled_barrier.h"

#include <string>

#include "barrier/topology.h"
#include "cases/assembly/build.h"
#include "core/check.h"
#include "core/parallel.h"
#include "dem/time_step.h"

namespace lahar::cases {

namespace {

constexpr int kSteps = 25;  // between two looks at the kinetic energy
constexpr double kShareOfLimit = 0.8;

double kinetic_energy(const dem::Particles& p) {
  return ordered_sum<double>(
      p.size(),
      [&](std::size_t i) {
        if (p.state[i] != dem::ParticleState::free) return 0.0;
        return 0.5 * (p.mass[i] * p.velocity[i].squaredNorm() + p.inertia[i] * p.angular_velocity[i].squaredNorm());
      },
      1024, 0.0);
}

void stop(dem::Particles& p) {
  p.velocity.fill(Vec3::Zero());
  p.angular_velocity.fill(Vec3::Zero());
}

}  // namespace

scene::Scene barrier_alone(scene::Scene scene) {
  scene.grains = {};
  scene.fluid.enabled = scene.coupling.enabled = false;
  scene.barrier.settle_time = 0;
  scene.solids.time_step = 0;             // that of the run may be too long without slow beads
  scene.barrier.net.bead_mass_scale = 1;  // of no account for how it hangs; slow beads would take longer
  return scene;
}

void settle_barrier(const scene::Scene& scene, const barrier::Net& net, dem::Particles& particles, dem::Bonds& bonds) {
  BuiltSolids built = build_solids(barrier_alone(scene));
  dem::Solids& alone = built.solids;
  dem::Particles& beads = alone.particles();
  const double limit = dem::bond_time_step(alone.bonds(), beads);  // of bonds between beads that do not touch, too
  if (alone.options().time_step > limit) alone.set_time_step(kShareOfLimit * limit);
  const auto topology = [&] { return barrier::find_topology(*built.net, beads, alone.bonds()); };
  const barrier::Topology as_built = topology();
  double before = 0;
  while (alone.time() < scene.barrier.settle_time) {
    alone.advance(kSteps);
    const double now = kinetic_energy(beads);
    if (now < before) {
      stop(beads);
      before = 0;
    } else {
      before = now;
    }
  }
  require(beads.size() == net.beads && alone.bonds().size() == net.bonds, "settle_barrier: another barrier");
  if (const std::string lost = barrier::first_difference(as_built, topology()); !lost.empty())
    throw NumericalFailure("the net as it comes to rest", alone.step_count(), lost);
  for (dem::ParticleId k = 0; k < net.beads; ++k)
    particles.position.set(particles.index(net.first_bead + k), beads.position[beads.index(k)]);
  bonds.take_load(net.first_bond, alone.bonds());
}

}  // namespace lahar::cases
