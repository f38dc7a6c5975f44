// A ring that hangs on a taut cable is pulled along it by the load that hangs in it: is the mean pull Coulomb's, and
// how much does it pulsate? With beads the wires are rows of bumps that catch each other; as smooth wires (capsules)
// they slide. The cable moves, the ring is held back by a soft spring at its lowest bead, where the load acts too.
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>

#include "barrier/cable.h"
#include "barrier/ring.h"
#include "cases/validate/dem/solid_scenes.h"
#include "cases/validate/entry.h"
#include "dem/bonds/axial_law.h"
#include "dem/time_step.h"

namespace lahar::validate {

namespace {

// The paper's ring wire (Li, Zhao & Kwan 2020, Table 4), friction and load of one ring of a loaded net.
constexpr double kWire = 0.0061, kRing = 0.07, kDensity = 7850, kModulus = 10e9;  // m, m, kg/m^3, Pa
constexpr double kStiffness = 1.3e12, kShearStiffness = 8e8;                      // N/m^3, of bonds
constexpr double kFriction = 0.1, kLoad = 100, kSpeed = 0.1;                      // -, N, m/s
constexpr double kSpring = 2e4, kDashpot = 20;                                    // N/m, N s/m, at the load

struct Sliding {
  dem::Solids solids;
  dem::ParticleIndex loaded;       // bead of the ring
  dem::ParticleIndex first, last;  // beads of the cable
  double place;                    // m, where the spring is slack
};

Sliding sliding(dem::WireContacts wires) {
  dem::Particles particles;
  dem::Bonds bonds;
  dem::BondSort sort;
  sort.axial.stiffness.fill(kStiffness);
  sort.shear_stiffness = kShearStiffness;
  sort.bond_radius = 0.5 * kWire;
  sort.damping_ratio = 0.1;
  const int wire = bonds.add_sort(sort);
  const barrier::WireProperties properties{kWire, kDensity, 0};
  constexpr double half = 0.15;
  barrier::CableSupport support;
  support.fixed_all = true;
  support.dissipators_at.clear();
  const barrier::Polyline line = barrier::cable_line({.start = Vec3(-half, 0, 0), .end = Vec3(half, 0, 0)}, kWire);
  const barrier::Wire cable = add_cable(line, support, properties, {wire, wire}, 0, particles, bonds);
  const barrier::RingShape shape{kRing, 36, 0, 0.25};
  const Vec3 centre(0.0013, 0, -0.5 * kRing + 1.02 * kWire);  // its inside just above the cable
  const barrier::RingPose pose{centre, Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()};
  const barrier::Wire ring = add_ring(shape, pose, properties, wire, 1, particles, bonds);
  for (dem::ParticleIndex i = cable.first_bead; i < cable.first_bead + cable.beads; ++i)
    particles.velocity.set(i, Vec3(kSpeed, 0, 0));
  dem::ParticleIndex loaded = ring.first_bead;
  for (dem::ParticleIndex i = ring.first_bead; i < ring.first_bead + ring.beads; ++i)
    if (particles.position.z[i] < particles.position.z[loaded]) loaded = i;
  const double place = particles.position.x[loaded];
  dem::SolidsOptions options =
      solids_options(std::min(0.7 * dem::bond_time_step(bonds, particles),
                              0.2 * dem::rayleigh_time_step(particles, one_material(kModulus, 0.3, 0, 1))),
                     Vec3::Zero());
  options.wire_contacts = wires;
  return {dem::Solids(std::move(particles), std::move(bonds), one_material(kModulus, 0.3, kFriction, 0.5), Walls{},
                      options),
          loaded, cable.first_bead, cable.first_bead + cable.beads, place};
}

struct Pull {
  double mean = 0, ripple = 0, load = 0;  // N: mean and root mean square deviation of the pull, mean load on the cable
  double cost = 0;                        // s of processor time a step
};

/// Mean and scatter of what pulls the ring, over whole numbers of beads passed.
Pull measure(Sliding& s, int beads_passed) {
  const double dt = s.solids.options().time_step;
  const auto hold = [&] {
    dem::Particles& p = s.solids.particles();
    const double pull = -kSpring * (p.position.x[s.loaded] - s.place) - kDashpot * p.velocity.x[s.loaded];
    p.external_force.set(s.loaded,
                         Vec3(pull, -kDashpot * p.velocity.y[s.loaded], -kLoad - kDashpot * p.velocity.z[s.loaded]));
  };
  const auto run = [&](double way, const auto& sample) {
    const int steps = static_cast<int>(way / (kSpeed * dt));
    for (int n = 0; n < steps; n += 10) {
      hold();
      s.solids.advance(10);
      sample();
    }
    return steps;
  };
  run(4 * kWire, [] {});  // the ring leans over, the spring is stretched, and what that sets swinging is damped
  double count = 0, sum = 0, square = 0, load = 0;
  const std::clock_t start = std::clock();
  const int steps = run(beads_passed * kWire, [&] {
    const dem::Particles& p = s.solids.particles();
    const double pull = -kSpring * (p.position.x[s.loaded] - s.place);
    for (dem::ParticleIndex i = s.first; i < s.last; ++i) load -= p.force.z[i];
    count += 1, sum += pull, square += pull * pull;
  });
  Pull result;
  result.cost = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / steps;
  result.mean = -sum / count;
  result.ripple = std::sqrt(std::max(0.0, square / count - result.mean * result.mean));
  result.load = load / count;
  return result;
}

std::vector<Row> run(const Context& context) {
  const int beads = context.quick ? 1 : 8;
  const auto pull = [&](dem::WireContacts wires) {
    Sliding s = sliding(wires);
    return measure(s, beads);
  };
  const Pull rough = pull(dem::WireContacts::beads), smooth = pull(dem::WireContacts::capsules);
  const double coulomb = kFriction * kLoad;
  return {relative_row("capsules: mean pull, N, against friction x load", smooth.mean, coulomb, 0.01),
          relative_row("capsules: mean load on the cable, N", smooth.load, kLoad, 0.01),
          at_most_row("capsules: ripple of the pull, rms over mean", smooth.ripple / smooth.mean, 0.02),
          note_row("beads: mean pull, N, against friction x load", rough.mean, coulomb),
          note_row("beads: ripple of the pull, rms over mean", rough.ripple / rough.mean, smooth.ripple / smooth.mean),
          note_row("cost of a step, capsules over beads", smooth.cost / rough.cost, 1)};
}

}  // namespace

Entry wire_sliding() { return {"barrier.wire_sliding", {"Coulomb's law"}, run}; }

}  // namespace lahar::validate
