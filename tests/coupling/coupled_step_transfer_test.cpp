// A debris flow in small - water, grains, a wire whose bonds break - that was stored and loaded goes on with the same
// bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "core/memory_archive.h"
#include "coupling/coupled_step.h"
#include "tests/coupling/tanks.h"

namespace lahar::coupling {
namespace {

const std::vector<lbm::LiquidRegion> kWater{{Vec3::Zero(), Vec3(0.24, 0.16, 0.2)}};

/// Three strings of beads across the tank at three heights, fixed at both ends.
void add_strings(dem::Particles& p, dem::Bonds& bonds, double diameter) {
  dem::BondSort wire;
  wire.axial.stiffness = {1e9, 1e9, 1e9};
  wire.shear_stiffness = 1e9;
  wire.bond_radius = diameter / 2;
  wire.damping_ratio = 0.05;
  wire.tensile_strength = wire.shear_strength = 3e5;
  bonds.add_sort(wire);
  const int last = static_cast<int>(0.15 / diameter);
  for (int k = 0; k < 3; ++k)
    for (int n = 0; n <= last; ++n) {
      dem::ParticleSpec bead = grain({0.4, 0.005 + diameter * n, 0.02 + 0.04 * k}, diameter / 2, 7850);
      bead.kind = dem::ParticleKind::bead;
      bead.body = k;
      bead.state = n % last == 0 ? dem::ParticleState::fixed : dem::ParticleState::free;
      const dem::ParticleIndex i = p.add(bead);
      if (n > 0) bonds.add({i - 1, i, 0}, p);
    }
}

/// Mapped wires are as thick as a cell. With one more grain `beside` the strings, or none.
template <class Real>
std::unique_ptr<CoupledStep<Real>> scene(CouplingOptions options_of_step, lbm::BodyWeighting weighting,
                                         const std::optional<Vec3>& beside = std::nullopt) {
  dem::Particles p;
  if (beside) p.add(grain(*beside, 0.03, 2500));
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 2; ++y)
      for (int z = 0; z < 3; ++z) p.add(grain({0.05 + 0.075 * x, 0.045 + 0.07 * y, 0.04 + 0.075 * z}, 0.03, 2500));
  dem::Bonds bonds;
  add_strings(p, bonds, options_of_step.mapped_wires ? 0.02 : 0.006);
  Walls walls;
  walls.add({"bed", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}});
  walls.add({"right", HalfSpace{Vec3::Zero(), Vec3::UnitY()}});
  walls.add({"left", HalfSpace{Vec3(0, 0.16, 0), -Vec3::UnitY()}});
  dem::SolidsOptions options;
  options.gravity = Vec3(4, 0, -9.0);
  options.time_step = 1;  // set by the coupled step
  options.watchdog.overlap_limit = 1;
  lbm::FluidOptions fluid = tank(Vec3(0.64, 0.16, 0.4), 0.02, 2e-4);
  if (lbm::by_wall_distance(weighting)) fluid = by_distance(fluid, weighting);
  fluid.gravity = options.gravity;
  fluid.domain.faces[1] = lbm::FaceKind::open;
  options_of_step.substeps = 20;
  return std::make_unique<CoupledStep<Real>>(fluid, dem::Solids(p, bonds, rock(), walls, options), options_of_step);
}

template <class Real>
void expect_same_after_restart(const CouplingOptions& options = {},
                               lbm::BodyWeighting weighting = lbm::BodyWeighting::solid_fraction) {
  const auto whole = scene<Real>(options, weighting), resumed = scene<Real>(options, weighting);
  whole->fill(kWater);
  const auto broken = [&] {
    const auto& intact = whole->solids()->bonds().intact;
    return std::count(intact.begin(), intact.end(), 0);
  };
  for (int n = 0; n < 1600 && broken() < 3; ++n) whole->advance();
  ASSERT_GE(broken(), 3);
  EXPECT_GT(whole->wet_beads(), 10U);
  StoredState state = state_of(*whole);
  load_state(state, *resumed);
  EXPECT_TRUE(differing_lists(state, state_of(*resumed)).empty()) << "what was loaded is not what was stored";
  EXPECT_EQ(whole->liquid_momentum(), resumed->liquid_momentum());
  EXPECT_EQ(whole->wet_beads(), resumed->wet_beads());
  for (int n = 0; n < 151; ++n) whole->advance(), resumed->advance();
  const auto differing = differing_lists(state_of(*whole), state_of(*resumed));
  EXPECT_TRUE(differing.empty()) << testing::PrintToString(differing);
  EXPECT_EQ(whole->audit().relative(), resumed->audit().relative());
  EXPECT_EQ(whole->time(), resumed->time());
}

TEST(CoupledStepTransfer, GoesOnInDouble) { expect_same_after_restart<double>(); }

TEST(CoupledStepTransfer, GoesOnInFloat) { expect_same_after_restart<float>(); }

TEST(CoupledStepTransfer, GoesOnWithGrainsByDistance) {
  expect_same_after_restart<double>({}, lbm::BodyWeighting::wall_distance);
  expect_same_after_restart<float>({}, lbm::BodyWeighting::inertial);
}

TEST(CoupledStepTransfer, GoesOnWithAveragedGrains) {
  expect_same_after_restart<double>({.grains = AveragedGrains{.averaging_length = 0.08}});
  expect_same_after_restart<float>({.grains = AveragedGrains{.averaging_length = 0.08, .beads_as_grains = true},
                                    .thin_wires = ThinWires::uncoupled});
}

/// Stored before the first step, as when packing takes long: grains and wires are in the same blocks, and no sweep has
/// left velocities there yet.
TEST(CoupledStepTransfer, GoesOnFromTheStart) {
  const Vec3 beside(0.35, 0.08, 0.15);
  const auto whole = scene<double>({}, lbm::BodyWeighting::inertial, beside),
             resumed = scene<double>({}, lbm::BodyWeighting::inertial, beside);
  lbm::LiquidRegion stream{Vec3::Zero(), Vec3(0.48, 0.16, 0.2)};
  stream.velocity = Vec3(2, 0, 0);
  whole->fill({stream});
  StoredState state = state_of(*whole);
  load_state(state, *resumed);
  for (int n = 0; n < 3; ++n) whole->advance(), resumed->advance();
  const auto differing = differing_lists(state_of(*whole), state_of(*resumed));
  EXPECT_TRUE(differing.empty()) << testing::PrintToString(differing);
}

/// Stored right after a bond broke, which the map of the wires does not know yet.
TEST(CoupledStepTransfer, GoesOnWithMappedWiresAndFilms) {
  const CouplingOptions options{.films = GrainFilms::lubrication, .mapped_wires = MappedWires{.from_diameter = 0.9}};
  expect_same_after_restart<double>(options, lbm::BodyWeighting::wall_distance);
}

}  // namespace
}  // namespace lahar::coupling
