#include "tests/performance/solids_scenes.h"

#include <cmath>
#include <utility>

#include "barrier/net.h"
#include "dem/packing/packing.h"
#include "dem/time_step.h"

namespace lahar::performance {

namespace {

dem::Materials materials_of(const ScenePair& pair) {
  dem::Materials m;
  m.add({"one", pair.youngs_modulus, pair.poisson_ratio});
  m.set_pair(0, 0, pair.friction, pair.restitution);
  return m;
}

Walls open_box(const Vec3& size) {
  Walls w;
  w.add({"floor", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}});
  w.add({"left", HalfSpace{Vec3::Zero(), Vec3::UnitX()}});
  w.add({"right", HalfSpace{size, -Vec3::UnitX()}});
  w.add({"front", HalfSpace{Vec3::Zero(), Vec3::UnitY()}});
  w.add({"back", HalfSpace{size, -Vec3::UnitY()}});
  return w;
}

}  // namespace

dem::Solids settled_grains(int count) {
  constexpr double small = 0.02, large = 0.04, density = 2650;
  const int larger = count / 9;  // a large one weighs as much as eight small ones
  const double volume = 4.0 / 3.0 * 3.14159 * (larger * std::pow(large, 3) + (count - larger) * std::pow(small, 3));
  const double side = std::cbrt(volume / 0.6);
  dem::PackingSpec spec;
  spec.upper = Vec3(side, side, 2 * side);
  spec.classes = {{small, count - larger, density, 0}, {large, larger, density, 0}};
  dem::Particles particles;
  for (const dem::ParticleSpec& s : dem::pack(spec)) particles.add(s);

  dem::SolidsOptions options;
  options.time_step = 0.15 * dem::rayleigh_time_step(particles, materials_of(kRock));
  dem::Solids solids(std::move(particles), {}, materials_of(kRock), open_box(spec.upper), options);
  solids.advance(1000);
  return solids;
}

dem::Solids hanging_rings() {
  barrier::RingNetSpec spec;
  spec.free_net = true;
  spec.ring = barrier::wire_bond(3e10, 0);
  spec.ring.damping_ratio = 0.02;
  dem::Particles particles;
  dem::Bonds bonds;
  const barrier::Net net = barrier::build_net(spec, particles, bonds);
  for (int column = 0; column < net.columns; ++column) {
    const barrier::Wire& ring = net.ring(column, net.rows - 1);
    for (dem::ParticleIndex i = ring.first_bead; i < ring.first_bead + ring.beads; ++i) {
      particles.state[i] = dem::ParticleState::fixed;
      particles.inverse_mass[i] = 0;
    }
  }
  dem::SolidsOptions options;
  options.time_step = 0.4 * dem::bond_time_step(bonds, particles);
  dem::Solids solids(std::move(particles), std::move(bonds), materials_of(kSteel), {}, options);
  while (solids.time() < 0.05) solids.advance(100);
  return solids;
}

}  // namespace lahar::performance
