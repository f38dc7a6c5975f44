// Water, grains and wires whose particles are renumbered between any two steps go on with the same bits: fields, states
// and sums are compared by id.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <random>

#include "core/memory_archive.h"
#include "core/parallel.h"
#include "coupling/coupled_step.h"
#include "dem/spatial_order.h"
#include "tests/coupling/chains.h"

namespace lahar::coupling {
namespace {

constexpr double kSurface = 0.24;  // m
constexpr int kSteps = 500, kEvery = 20, kMiddle = 250;

/// A cable and a ring of some cells, two thin rings that are linked, grains in the water and above it that hardly fit
/// between each other, and a float.
Chains wires_and_grains() {
  Chains c;
  c.add(straight_line(Vec3(0.21, 0.04, 0.2), Vec3(0.2, 0.36, 0.21), 5), 0.08, false, dem::ParticleState::free);
  for (const std::size_t end : {0, 4})
    c.particles.state[end] = dem::ParticleState::fixed, c.particles.inverse_mass[end] = 0;
  c.add(circle(Vec3(0.2, 0.2, 0.32), Vec3(0.1, 0.2, 0.97).normalized(), 0.24, 12), 0.06, true,
        dem::ParticleState::free);
  c.add(circle(Vec3(0.08, 0.3, 0.08), Vec3::UnitZ(), 0.1, 30), 0.01, true, dem::ParticleState::free);
  c.add(circle(Vec3(0.08, 0.25, 0.08), Vec3::UnitX(), 0.1, 30), 0.01, true, dem::ParticleState::free);
  for (int k = 0; k < 40; ++k)
    c.particles.add(
        grain(Vec3(0.3 + 0.058 * (k % 2), 0.05 + 0.06 * (k / 2 % 5), 0.04 + 0.062 * (k / 10)), 0.027, 2500));
  c.particles.add(grain(Vec3(0.08, 0.1, kSurface), 0.04, 400));
  return c;
}

dem::Renumbering any_order(std::size_t particles) {
  static std::mt19937 random(1);
  std::vector<dem::ParticleIndex> order(particles);
  std::iota(order.begin(), order.end(), 0U);
  std::shuffle(order.begin(), order.end(), random);
  return dem::Renumbering(std::move(order));
}

enum class Order { of_ids, any, in_space };

template <class Real>
class Scene {
 public:
  explicit Scene(Order order = Order::of_ids) : order_(order) {
    const lbm::FluidOptions fluid = by_distance(tank(Vec3(0.4, 0.4, 0.48), 0.02, 2e-4));
    Chains c = wires_and_grains();
    dem::SolidsOptions options;
    options.gravity = fluid.gravity;
    options.time_step = 1;  // set by the coupled step
    options.long_step = 5;
    options.watchdog.overlap_limit = 1;
    Walls walls;
    walls.add({"floor", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}});
    dem::Solids solids(std::move(c.particles), std::move(c.bonds), rock(), std::move(walls), options);
    if (order == Order::any) solids.renumber(any_order(solids.particles().size()));
    step_ = std::make_unique<CoupledStep<Real>>(fluid, std::move(solids),
                                                CouplingOptions{.films = GrainFilms::lubrication,
                                                                .thin_wires = ThinWires::drag_law,
                                                                .mapped_wires = MappedWires{2.5},
                                                                .substeps = 20});
  }

  CoupledStep<Real>& step() { return *step_; }
  void fill() { step_->fill({{Vec3::Zero(), Vec3(0.4, 0.4, kSurface)}}); }
  void renumber(Order order) {
    const dem::Particles& p = step_->solids()->particles();
    if (order == Order::any) step_->renumber(any_order(p.size()));
    if (order == Order::in_space) step_->renumber(dem::spatial_order(p));
  }
  /// Pieces of wire break, and a grain under water is taken out.
  void advance_to(int end) {
    dem::Solids& solids = *step_->solids();
    while (step_->steps() < end) {
      if (step_->steps() % kEvery == 0) renumber(order_);
      if (step_->steps() == 120) solids.bonds().intact[1] = solids.bonds().intact[8] = 0;
      if (step_->steps() == 170) solids.remove(solids.particles().index(82));
      step_->advance();
    }
  }

 private:
  Order order_;
  std::unique_ptr<CoupledStep<Real>> step_;
};

/// All that a run shows.
struct Outcome {
  StoredState state;
  std::vector<double> sums;

  template <class Real>
  explicit Outcome(CoupledStep<Real>& step) : state(state_of(step)) {
    const dem::EnergyLedger ledger = step.solids()->ledger();
    for (const auto& [name, joules] : ledger.terms()) sums.push_back(joules);
    const Vec3 force = step.solids()->force_on_wall(0);
    sums.insert(sums.end(),
                {force.x(), force.y(), force.z(), step.audit().relative(), step.fluid()->mass_drift(),
                 step.fluid()->liquid_mass(), step.fluid()->account().pool, static_cast<double>(step.wet_beads())});
  }
};

void expect_same(const Outcome& a, const Outcome& b) {
  EXPECT_EQ(a.sums, b.sums);
  const auto differing = differing_lists(a.state, b.state);
  EXPECT_TRUE(differing.empty()) << testing::PrintToString(differing);
}

template <class Real>
Outcome run(Order order) {
  Scene<Real> scene(order);
  scene.fill();
  scene.advance_to(kSteps);
  return Outcome(scene.step());
}

template <class Real>
void expect_same_in_any_order() {
  Scene<Real> plain;
  plain.fill();
  plain.advance_to(kSteps);
  EXPECT_GT(plain.step().wet_beads(), 60U);
  EXPECT_NE(plain.step().fluid()->account().pool, 0);
  EXPECT_GT(plain.step().fluid()->account().paid_nearby, 0);
  const auto& height = plain.step().solids()->particles().position.z;
  EXPECT_TRUE(std::any_of(height.end() - 41, height.end(), [](double z) { return std::abs(z - kSurface) < 0.02; }));
  const Outcome expected(plain.step());
  expect_same(expected, run<Real>(Order::any));
  expect_same(expected, run<Real>(Order::in_space));
  const ThreadLimit limit(2);
  expect_same(expected, run<Real>(Order::any));
}

TEST(CoupledStepRenumber, KeepsItsBitsInDouble) { expect_same_in_any_order<double>(); }

TEST(CoupledStepRenumber, KeepsItsBitsInFloat) { expect_same_in_any_order<float>(); }

/// One renumbering in the middle, and a checkpoint in that order: as long as it stands, and as it is read again.
TEST(CoupledStepRenumber, GoesOnFromACheckpointInAnotherOrder) {
  Scene<float> plain, renumbered, resumed;
  for (auto* scene : {&plain, &renumbered}) scene->fill(), scene->advance_to(kMiddle);
  renumbered.renumber(Order::any);
  renumbered.advance_to(kMiddle + 30);
  StoredState state = state_of(renumbered.step());
  load_state(state, resumed.step());
  EXPECT_FALSE(renumbered.step().solids()->particles().numbering.by_id());
  EXPECT_TRUE(resumed.step().solids()->particles().numbering.by_id());
  for (auto* scene : {&plain, &renumbered, &resumed}) scene->advance_to(kSteps);
  const Outcome expected(plain.step());
  expect_same(expected, Outcome(renumbered.step()));
  expect_same(expected, Outcome(resumed.step()));
}

TEST(CoupledStepRenumber, NeedsSolids) {
  CoupledStep<float> water(tank(Vec3(0.32, 0.16, 0.32), 0.02, 2e-4), std::nullopt, {});
  EXPECT_THROW(water.renumber(any_order(0)), std::logic_error);
}

}  // namespace
}  // namespace lahar::coupling
