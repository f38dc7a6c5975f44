// A small net with soft bonds hangs and swings in the particle step.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "barrier/clearance.h"
#include "barrier/guide.h"
#include "barrier/net.h"
#include "barrier/response.h"
#include "barrier/topology.h"
#include "core/memory_archive.h"
#include "dem/solids.h"
#include "dem/time_step.h"

namespace lahar::barrier {
namespace {

RingNetSpec soft_spec() {
  RingNetSpec spec;
  spec.width = 0.24, spec.height = 0.18;
  spec.fit = NetFit::cables_on_frame;
  spec.ring = wire_bond(3e9, 0);
  spec.cable = wire_bond(8e9, 0);
  spec.dissipator = dissipator_bond(8e9, 8e8, 2000, 0);
  spec.ring.damping_ratio = spec.cable.damping_ratio = spec.dissipator.damping_ratio = 0.02;
  return spec;
}

dem::Solids solids(dem::Particles particles, dem::Bonds bonds, const Vec3& gravity) {
  dem::Materials materials;
  materials.add({"steel", 2e8, 0.3});
  materials.set_pair(0, 0, 0.1, 0.1);
  dem::SolidsOptions options;
  options.gravity = gravity;
  options.time_step = 0.2 * dem::bond_time_step(bonds, particles);
  return {std::move(particles), std::move(bonds), std::move(materials), {}, options};
}

TEST(HangingNet, KeepsItsLinksAndDoesNotInterpenetrate) {
  dem::Particles particles;
  dem::Bonds bonds;
  const Net net = build_net(soft_spec(), particles, bonds);
  const Topology before = find_topology(net, particles, bonds);
  const Vec3 gravity(9.81, 0, -9.81);  // swings out along the flow as well
  dem::Solids run = solids(std::move(particles), std::move(bonds), gravity);
  double deepest = 0;
  while (run.time() < 0.08) {
    run.advance(100);
    deepest = std::max(deepest, run.worst_overlap().ratio);
  }
  EXPECT_LT(deepest, 0.1);  // of a bead's radius
  EXPECT_EQ(first_difference(before, find_topology(net, run.particles(), run.bonds())), "");
  const BarrierResponse r = response(net, run.particles(), run.bonds(), gravity);
  EXPECT_GT(r.elongation, 1e-4);
  EXPECT_LT(r.elongation, 0.1);
  EXPECT_LT(r.potential_energy, 0);
  EXPECT_GT(r[Component::upper_cable].max_tension, 0);
  // The same energies as the particle step's own ledger has in total.
  EXPECT_NEAR(r[Component::barrier].energy.axial, run.bond_energy().axial, 1e-9 * run.bond_energy().elastic());
  EXPECT_NEAR(r[Component::barrier].energy.elastic(), run.bond_energy().elastic(), 1e-9 * run.bond_energy().elastic());
}

/// A net in guides that swings for a while, and what is measured of it.
struct Swing {
  StoredState state;
  std::vector<double> measured;

  explicit Swing(bool renumber) {
    RingNetSpec spec = soft_spec();
    spec.cable_extension = 0.06;
    dem::Particles particles;
    dem::Bonds bonds;
    const Net net = build_net(spec, particles, bonds);
    const Topology before = find_topology(net, particles, bonds);
    Guides guides({.stiffness = 1e3, .damping_ratio = 0.1});
    for (std::size_t c = 0; c < net.cables.size(); ++c)
      for (const Vec3& corner : {net.corners[c].start, net.corners[c].end}) guides.add(net.cables[c], corner);
    const Vec3 gravity(9.81, 0, -9.81);
    dem::Solids run = solids(std::move(particles), std::move(bonds), gravity);
    std::mt19937 random(2);
    for (int n = 0; n < 100; ++n) {
      std::vector<dem::ParticleIndex> order(run.particles().size());
      std::iota(order.begin(), order.end(), 0U);
      std::shuffle(order.begin(), order.end(), random);
      if (renumber) run.renumber(dem::Renumbering(std::move(order)));
      guides.apply(run.particles());
      run.advance(10);
    }
    EXPECT_EQ(first_difference(before, find_topology(net, run.particles(), run.bonds())), "");
    state = state_of(run);
    const BarrierResponse r = response(net, run.particles(), run.bonds(), gravity);
    const ComponentResponse &whole = r[Component::barrier], &left = r[Component::left_cable];
    measured = {r.elongation,    r.kinetic_energy,       r.potential_energy,    guides.energy(),
                whole.force_sum, whole.energy.elastic(), whole.reaction.norm(), left.start_reaction.norm(),
                left.max_tension};
  }
};

TEST(HangingNet, KeepsItsBitsWhenParticlesAreRenumbered) {
  const Swing plain(false), renumbered(true);
  for (const double x : plain.measured) EXPECT_NE(x, 0);
  EXPECT_EQ(plain.measured, renumbered.measured);
  const auto differing = differing_lists(plain.state, renumbered.state);
  EXPECT_TRUE(differing.empty()) << ::testing::PrintToString(differing);
}

TEST(HangingNet, NetIsFreeOfStressAndContactWhenBuilt) {
  dem::Particles particles;
  dem::Bonds bonds;
  const Net net = build_net(soft_spec(), particles, bonds);
  dem::Solids run = solids(std::move(particles), std::move(bonds), Vec3::Zero());
  run.advance(100);
  const BarrierResponse r = response(net, run.particles(), run.bonds(), Vec3::Zero());
  EXPECT_LT(r.kinetic_energy, 1e-20);  // rounding
  EXPECT_NEAR(r[Component::barrier].force_sum, 0, 1e-9);
}

TEST(HangingNet, FreeNetFallsWithoutDeforming) {
  RingNetSpec spec = soft_spec();
  spec.free_net = true;
  dem::Particles particles;
  dem::Bonds bonds;
  const Net net = build_net(spec, particles, bonds);
  dem::Solids run = solids(std::move(particles), std::move(bonds), {0, 0, -9.81});
  run.advance(1000);
  const double fallen = 0.5 * 9.81 * run.time() * run.time();
  for (std::size_t i = 0; i < net.beads; ++i)
    EXPECT_LT((run.particles().position[i] - net.start[i] + fallen * Vec3::UnitZ()).norm(), 1e-9);
  EXPECT_GT(fallen, 1e-4);
}

}  // namespace
}  // namespace lahar::barrier
