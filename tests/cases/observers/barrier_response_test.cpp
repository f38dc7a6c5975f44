// What is seen of a net.
#include "cases/observers/barrier_response.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cases/files/series_reader.h"
#include "tests/cases/observers/small_net.h"

namespace lahar::cases {
namespace {

TEST_F(SmallNet, LoadsOfItsParts) {
  SeriesWriter series(scratch_.path() / "series.h5");
  observers_.declare(series);
  for (int s = 0; s < 20; ++s) simulation_->advance();
  observers_.sample(series);
  const dem::Solids& solids = *simulation_->solids();
  const auto r = barrier::response(*simulation_->net(), solids.particles(), solids.bonds(), scene_.gravity.vector());
  ASSERT_GT(r[barrier::Component::rings].force_sum, 0);
  const Metrics metrics = observers_.metrics();
  EXPECT_EQ(metrics.at("peak_rings_sum_kN"), r[barrier::Component::rings].force_sum / 1000);
  EXPECT_EQ(metrics.at("peak_barrier_tension_kN"), r[barrier::Component::barrier].max_tension / 1000);
  EXPECT_EQ(metrics.at("max_elongation_m"), std::max(0.0, r.elongation));
  EXPECT_FALSE(metrics.contains("peak_mesh_sum_kN"));
  observers_.finish(scratch_.path());
  EXPECT_TRUE(std::filesystem::exists(scratch_.path() / "cable_forces.png"));
}

/// A cable tears with half the strength that its tension needs. Where it bends, by its own weight and at its ends, it
/// needs more than ten times that, as a solid wire does; with a thousand times it holds.
TEST(BarrierResponse, WiresTearAboveTheirStrength) {
  const auto broken = [](double strength) {
    const scene::Scene scene = scene::load(scene::case_file("hanging_net/scene.toml"),
                                           {"barrier.net.width_m=0.38", "barrier.net.height_m=0.26",
                                            fmt::format("barrier.bonds.cable_tensile_strength_Pa={}", strength)});
    const auto simulation = build_simulation(scene);
    double largest = 0;  // N
    for (int s = 0; s < 400; ++s) {
      simulation->advance();
      const dem::Solids& solids = *simulation->solids();
      const auto r = barrier::response(*simulation->net(), solids.particles(), solids.bonds(), scene.gravity.vector());
      largest = std::max(largest, r[barrier::Component::upper_cable].max_tension);
      if (r[barrier::Component::barrier].broken_bonds > 0) return std::pair{true, largest};
    }
    return std::pair{false, largest};
  };
  const double section =
      M_PI / 4 * std::pow(scene::load(scene::case_file("hanging_net/scene.toml")).barrier.net.wire_diameter, 2);
  const auto [never, tension] = broken(0);
  EXPECT_FALSE(never);
  EXPECT_FALSE(broken(1000 * tension / section).first);
  EXPECT_TRUE(broken(10 * tension / section).first);
  EXPECT_TRUE(broken(0.5 * tension / section).first);
}

/// Rings that were moved along the upper cable have slid by as much.
TEST_F(SmallNet, RingsSlideAlongTheirCables) {
  SeriesWriter series(scratch_.path() / "series.h5");
  observers_.declare(series);
  observers_.sample(series);
  EXPECT_EQ(observers_.metrics().at("max_ring_travel_m"), 0);
  dem::Particles& p = simulation_->solids()->particles();
  const barrier::Net& net = *simulation_->net();
  for (int column = 1; column + 1 < net.columns; ++column) {
    const barrier::Wire& ring = net.ring(column, net.rows - 1);
    for (dem::ParticleId id = ring.first_bead; id < ring.first_bead + ring.beads; ++id)
      p.position.add(p.index(id), 0.01 * net.across);
  }
  observers_.sample(series);
  EXPECT_NEAR(observers_.metrics().at("max_ring_travel_m"), 0.01, 0.001);
  EXPECT_LT(observers_.metrics().at("max_mean_ring_travel_m"), 0.005);
}

/// A boulder on a mesh whose width runs to the left or to the right: it bulges and is pushed down the flow.
TEST(BarrierLoads, DoNotDependOnTheWayTheWidthRuns) {
  const auto metrics = [](const std::vector<std::string>& set) {
    const scene::Scene scene = scene::load(scene::case_file("hexagonal_net/scene.toml"), set);
    const auto simulation = build_simulation(scene);
    ObserverList observers(scene, *simulation);
    const scene::ScratchFolder scratch;
    SeriesWriter series(scratch.path() / "series.h5");
    observers.declare(series);
    observers.sample(series);
    while (simulation->time() < 0.006) {
      simulation->advance();
      observers.after_step();
    }
    observers.sample(series);
    return observers.metrics();
  };
  const Metrics left = metrics({}),
                right = metrics({"barrier.net.width_direction=[0, -1, 0]", "barrier.net.origin_m=[0, 1, 0]"});
  EXPECT_GT(left.at("max_elongation_m"), 0.01);
  EXPECT_GT(left.at("barrier_contact_impulse_Ns"), 0.1);
  constexpr double other_meshes = 0.05;  // the boulder does not hit the middle
  for (const char* name : {"max_elongation_m", "barrier_contact_impulse_Ns"})
    EXPECT_NEAR(right.at(name), left.at(name), other_meshes * left.at(name)) << name;
}

/// Before anything arrives only its own bonds pull at a net, and the side walls a little: the bonds cancel. Then grains
/// and water push it along the flow.
TEST(BarrierLoads, AreThoseFromOutside) {
  const scene::Scene scene =
      scene::load(scene::source_folder() / "tests/integration/small_debris_flow.toml", {"run.duration_s=0.6"});
  const auto simulation = build_simulation(scene);
  ObserverList observers(scene, *simulation);
  const scene::ScratchFolder scratch;
  {
    SeriesWriter series(scratch.path() / "series.h5");
    observers.declare(series);
    observers.sample(series);
    double next = 0.01;
    while (simulation->time() < 0.6) {
      simulation->advance();
      observers.after_step();
      if (simulation->time() < next) continue;
      observers.sample(series), next += 0.01;
    }
  }
  const Series rows = read_series(scratch.path() / "series.h5");
  const auto column = [&](const char* name) -> const std::vector<double>& { return rows.find(name)->values; };
  double bonds = 0, early = 0;
  for (std::size_t k = 1; k < 10; ++k) {
    bonds = std::max(bonds, column("barrier_force_sum_N")[k]);
    early = std::max(
        {early, std::abs(column("barrier_contact_force_x_N")[k]), std::abs(column("barrier_fluid_force_x_N")[k])});
  }
  EXPECT_GT(bonds, 0);
  EXPECT_LT(early, 1e-3 * bonds);
  const Metrics metrics = observers.metrics();
  EXPECT_GT(metrics.at("barrier_fluid_impulse_Ns"), 0);
  EXPECT_GT(metrics.at("barrier_contact_impulse_Ns"), 0);
}

}  // namespace
}  // namespace lahar::cases
