// Grains that are held: before the section, or before the foremost bead of a net that has bulged beyond it.
#include "cases/observers/retention.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "cases/observers/observer_list.h"
#include "tests/cases/observers/two_balls.h"

namespace lahar::cases {
namespace {

TEST(Retention, EqualGrainsAreNotToldApart) {
  const scene::Scene scene = scene::load_text(two_balls, {"grains.sphere[1].diameter_m=0.1"});
  const auto simulation = build_simulation(scene);
  const Metrics metrics = ObserverList(scene, *simulation).metrics();
  EXPECT_EQ(metrics.at("retained_mass_ratio"), 0.5);
  EXPECT_FALSE(metrics.contains("retained_small_grains_ratio"));
}

TEST(Retention, WhatIsGoneOrBeyondIsNotHeld) {
  const scene::Scene scene = scene::load_text(two_balls);
  const auto simulation = build_simulation(scene);
  const ObserverList observers(scene, *simulation);
  dem::Particles& p = simulation->solids()->particles();
  const auto held = [&] { return observers.metrics().at("retained_small_grains_ratio"); };
  EXPECT_EQ(held(), 0);  // at 0.8 m
  p.position.x[1] = 0.6;
  EXPECT_EQ(held(), 1);
  EXPECT_EQ(observers.metrics().at("retained_mass_ratio"), 1);
  simulation->solids()->remove(1);
  EXPECT_EQ(held(), 0);
  EXPECT_EQ(observers.metrics().at("retained_large_grains_ratio"), 1);
}

/// The net of the small debris flow bulges: the foremost bead is the limit, its radius included.
TEST(Retention, ABulgedNetHoldsWhatItCarries) {
  const scene::Scene scene = scene::load(scene::source_folder() / "tests/cases/observers/everything.toml");
  const auto simulation = build_simulation(scene);
  const ObserverList observers(scene, *simulation);
  dem::Particles& p = simulation->solids()->particles();
  std::size_t grain = 0, bead = 0, grains = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    (p.kind[i] == dem::ParticleKind::grain ? grain : bead) = i;
    grains += p.kind[i] == dem::ParticleKind::grain;
  }
  const double share = 1 - p.mass[grain] / [&] {
    double mass = 0;
    for (std::size_t i = 0; i < p.size(); ++i) mass += p.kind[i] == dem::ParticleKind::grain ? p.mass[i] : 0.0;
    return mass;
  }();
  ASSERT_GT(grains, 1u);
  ASSERT_EQ(observers.metrics().at("retained_mass_ratio"), 1);
  const double foremost = scene.domain.upper.x() - 2 * p.radius[bead];
  p.position.x[bead] = foremost;
  p.position.x[grain] = foremost + 0.9 * p.radius[bead];
  EXPECT_EQ(observers.metrics().at("retained_mass_ratio"), 1);
  p.position.x[grain] = foremost + 1.1 * p.radius[bead];
  EXPECT_NEAR(observers.metrics().at("retained_mass_ratio"), share, 1e-12);
  // A wire that is torn, or has left the domain, holds nothing.
  p.position.x[grain] = foremost;
  const barrier::Net& net = *simulation->net();
  const auto holds_it = [&](const barrier::Wire& w) {
    return w.first_bead <= p.id(bead) && p.id(bead) < w.first_bead + w.beads;
  };
  const auto wire = std::find_if(net.rings.begin(), net.rings.end(), holds_it);
  const auto cable = std::find_if(net.cables.begin(), net.cables.end(), holds_it);
  ASSERT_TRUE(wire != net.rings.end() || cable != net.cables.end());
  std::uint8_t& bond = simulation->solids()->bonds().intact[(wire != net.rings.end() ? *wire : *cable).first_bond];
  bond = 0;
  EXPECT_NEAR(observers.metrics().at("retained_mass_ratio"), share, 1e-12);
  bond = 1;
  EXPECT_EQ(observers.metrics().at("retained_mass_ratio"), 1);
  p.position.x[bead] = scene.domain.upper.x() + 1;
  EXPECT_NEAR(observers.metrics().at("retained_mass_ratio"), share, 1e-12);
}

/// All grains of the small debris flow at one place, before or behind a net of 30 degrees from upright.
struct InclinedNet {
  explicit InclinedNet(const std::string& height_direction)
      : scene(
            scene::load(scene::source_folder() / "tests/cases/observers/everything.toml",
                        {"barrier.net.origin_m=[0.6, 0, 0.02]", "barrier.net.height_direction=" + height_direction})) {}
  double ratio_at(const Vec3& place) {
    dem::Particles& p = simulation->solids()->particles();
    for (std::size_t i = 0; i < p.size(); ++i)
      if (p.kind[i] == dem::ParticleKind::grain) p.position.set(i, place);
    return observers.metrics().at("retained_mass_ratio");
  }

  const scene::Scene scene;
  const std::unique_ptr<Simulation> simulation = build_simulation(scene);
  const ObserverList observers{scene, *simulation};
};

/// Its crest is farther down than its foot; a grain just beyond the foot has got through.
TEST(Retention, ANetThatLeansDownstreamHoldsNothingBeyondItsPlane) {
  InclinedNet inclined("[0.5, 0, 0.8660254037844386]");
  const Vec3 behind_foot(0.66, 0.13, 0.06), normal(0.8660254037844386, 0, -0.5);
  const barrier::Net& net = *inclined.simulation->net();
  ASSERT_LT((net.normal - normal).norm(), 1e-12);
  EXPECT_EQ(inclined.ratio_at(behind_foot - 0.08 * normal), 1);
  EXPECT_EQ(inclined.ratio_at(behind_foot), 0);
  dem::Particles& p = inclined.simulation->solids()->particles();
  p.position.set(p.index(net.rings.front().first_bead), behind_foot + 0.001 * normal);
  EXPECT_EQ(inclined.ratio_at(behind_foot), 1);
}

/// A grain behind its crest has got over it, although its foot is farther down.
TEST(Retention, ANetThatLeansUpstreamHoldsNothingBeyondItsPlane) {
  InclinedNet inclined("[-0.5, 0, 0.8660254037844386]");
  EXPECT_EQ(inclined.ratio_at({0.58, 0.13, 0.15}), 0);
  EXPECT_EQ(inclined.ratio_at({0.48, 0.13, 0.15}), 1);
}

/// A mesh bulges like a net of rings; a node at a torn wire may fly off and holds nothing.
TEST(Retention, ATornMeshHoldsNothingWhereItIsTorn) {
  const scene::Scene scene = scene::load(scene::case_file("hexagonal_net/scene.toml"),
                                         {"measure.section_x_m=0", "measure.outflow_distance_m=0.2"});
  const auto simulation = build_simulation(scene);
  const ObserverList observers(scene, *simulation);
  dem::Particles& p = simulation->solids()->particles();
  const barrier::MeshPart& mesh = simulation->net()->meshes.front();
  const dem::ParticleId node = mesh.first_node + mesh.nodes / 2;
  const auto ratio = [&] { return observers.metrics().at("retained_mass_ratio"); };
  const auto grain = std::find(p.kind.begin(), p.kind.end(), dem::ParticleKind::grain) - p.kind.begin();
  p.position.x[static_cast<std::size_t>(grain)] = 0.3;
  EXPECT_EQ(ratio(), 0);
  p.position.x[p.index(node)] = 0.4;
  EXPECT_EQ(ratio(), 1);
  dem::Bonds& bonds = simulation->solids()->bonds();
  for (std::size_t b = 0; b < bonds.size(); ++b)
    if (p.id(bonds.i[b]) == node) {
      bonds.intact[b] = 0;
      break;
    }
  EXPECT_EQ(ratio(), 0);
}

/// Posts, and retaining cables that lead downstream from them, hold no grain.
TEST(Retention, PostsAndWhatHangsOnThemDoNotCount) {
  const scene::Scene scene =
      scene::load(scene::case_file("two_spans/scene.toml"),
                  {"barrier.posts.retaining=[{anchor_offset_m = [0.25, 0, -0.005]}]", "measure.section_x_m=0",
                   "measure.outflow_distance_m=0.2",
                   "grains.sphere=[{position_m = [0.1, 0.2, 0.1], diameter_m = 0.04, density_kg_m3 = 2500, material = "
                   "\"steel\"}]"});
  const auto simulation = build_simulation(scene);
  const ObserverList observers(scene, *simulation);
  const barrier::Net& net = *simulation->net();
  dem::Particles& p = simulation->solids()->particles();
  const auto shift_to = [&](dem::ParticleId bead, double x) { p.position.x[p.index(bead)] = x; };
  const auto ratio = [&] { return observers.metrics().at("retained_mass_ratio"); };
  EXPECT_EQ(ratio(), 0);  // the anchors are 0.25 m on
  shift_to(net.posts.front().head(), 0.2);
  EXPECT_EQ(ratio(), 0);
  shift_to(net.rings.front().first_bead, 0.2);
  EXPECT_EQ(ratio(), 1);
}

}  // namespace
}  // namespace lahar::cases
