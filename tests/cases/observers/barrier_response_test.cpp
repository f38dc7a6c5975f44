// What is seen of a net.
#include "cases/observers/barrier_response.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/cases/observers/small_net.h"

namespace lahar::cases {
namespace {

TEST_F(SmallNet, LoadsOfItsParts) {
  run_.take_row(20);
  const dem::Solids& solids = run_.solids();
  const auto r =
      barrier::response(*run_.simulation->net(), solids.particles(), solids.bonds(), run_.scene.gravity.vector());
  ASSERT_GT(r[barrier::Component::rings].force_sum, 0);
  const Metrics metrics = run_.metrics();
  EXPECT_EQ(metrics.at("peak_rings_sum_kN"), r[barrier::Component::rings].force_sum / 1000);
  EXPECT_EQ(metrics.at("peak_barrier_tension_kN"), r[barrier::Component::barrier].max_tension / 1000);
  EXPECT_EQ(metrics.at("max_elongation_m"), std::max(0.0, r.elongation));
  EXPECT_FALSE(metrics.contains("peak_mesh_sum_kN"));
  run_.observers.finish(run_.folder());
  EXPECT_TRUE(std::filesystem::exists(run_.folder() / "cable_forces.png"));
}

/// Forces that are set by hand on the ends of the cables and elongations of their dissipators: rows have the largest,
/// peaks keep those of the first row when all is let go.
TEST_F(SmallNet, EndsOfCablesAndDissipators) {
  struct End {
    barrier::Side side;
    std::string cable;
    Vec3 at_start, at_end;
    double larger;  ///< N
  };
  const End ends[] = {{barrier::Side::lower, "lower_cable", {3, 4, 0}, {0, 0, 2}, 5},
                      {barrier::Side::upper, "upper_cable", {0, 1, 0}, {0, 6, 8}, 10},
                      {barrier::Side::left, "left_cable", {5, 0, 12}, {0, 0, 0}, 13},
                      {barrier::Side::right, "right_cable", {0, 0, 7}, {8, 15, 0}, 17}};
  dem::Particles& p = run_.solids().particles();
  dem::Bonds& bonds = run_.solids().bonds();
  const barrier::Net& net = *run_.simulation->net();
  const auto load = [&](double times) {
    for (const End& end : ends) {
      const barrier::Wire& cable = *net.cable(end.side);
      p.force.set(p.index(cable.first_bead), times * end.at_start);
      p.force.set(p.index(cable.first_bead + cable.beads - 1), times * end.at_end);
    }
    bonds.elongation[net.dissipators.front()] = times * 1e-3;
    bonds.elongation[net.dissipators.back()] = times * 4e-3;
  };
  load(1);
  run_.take_row();
  load(0.5);
  run_.take_row();
  const Metrics metrics = run_.metrics();
  for (const End& end : ends) {
    const std::vector<double>& force = run_.column(end.cable + "_end_force_N");
    EXPECT_DOUBLE_EQ(force[0], end.larger) << end.cable;
    EXPECT_DOUBLE_EQ(force[1], end.larger / 2) << end.cable;
    EXPECT_DOUBLE_EQ(metrics.at("peak_" + end.cable + "_end_kN"), end.larger / 1000) << end.cable;
  }
  EXPECT_EQ(run_.column("dissipator_elongation_m"), (std::vector<double>{4e-3, 2e-3}));
  EXPECT_EQ(metrics.at("max_dissipator_elongation_m"), 4e-3);
}

/// One bond of a ring that is loaded in every way, one that is broken and one bead that moved: energies by the
/// stiffnesses of Potyondy & Cundall (2004), k A, k A, k I, k J. In the second row half of the elongation is left.
TEST_F(SmallNet, EnergiesOfTheBarrier) {
  dem::Particles& p = run_.solids().particles();
  dem::Bonds& bonds = run_.solids().bonds();
  const barrier::Wire& ring = run_.simulation->net()->ring(2, 1);
  const dem::ParticleIndex bead = p.index(ring.first_bead + 9);
  constexpr double stretch = 1e-5, shear = 6, moment = 2e-3, torque = 5e-4;  // m, N, Nm, Nm
  constexpr double along = 0.02, fall = 0.2, speed = 3, spin = 100;          // m, m, m/s, rad/s
  const double r = 0.0061 / 2, area = M_PI * r * r, inertia = area * r * r / 4, k = 0.01 * 3e11;
  bonds.elongation[ring.first_bond] = stretch;
  bonds.shear_force.set(ring.first_bond, Vec3(0, 0, shear));
  bonds.moment.set(ring.first_bond, Vec3(0, moment, 0));
  bonds.torsion_moment[ring.first_bond] = torque;
  p.position.add(bead, Vec3(along, 0, -fall));
  p.velocity.set(bead, Vec3(0, speed, 0));
  p.angular_velocity.set(bead, Vec3(0, 0, spin));
  run_.take_row();
  bonds.elongation[ring.first_bond] = stretch / 2;
  bonds.shear_force.set(ring.first_bond, Vec3::Zero());
  bonds.moment.set(ring.first_bond, Vec3::Zero());
  bonds.torsion_moment[ring.first_bond] = 0;
  bonds.intact[ring.first_bond + 3] = 0;
  p.position.add(bead, Vec3(-along, 0, fall));
  run_.take_row();
  const double mass = 7800 * M_PI / 6 * std::pow(0.0061, 3);
  const double axial = 0.5 * k * area * stretch * stretch, shearing = 0.5 * shear * shear / (k * area),
               bending = 0.5 * moment * moment / (k * inertia), torsion = 0.5 * torque * torque / (k * 2 * inertia),
               elastic = axial + shearing + bending + torsion, potential = -mass * 9.81 * fall,
               kinetic = 0.5 * mass * (speed * speed + 0.4 * r * r * spin * spin);
  const std::tuple<const char*, double, double> columns[] = {{"barrier_axial_J", axial, axial / 4},
                                                             {"barrier_shear_J", shearing, 0},
                                                             {"barrier_bending_J", bending, 0},
                                                             {"barrier_torsion_J", torsion, 0},
                                                             {"barrier_elastic_J", elastic, axial / 4},
                                                             {"barrier_potential_J", potential, 0},
                                                             {"barrier_kinetic_J", kinetic, kinetic},
                                                             {"barrier_elongation_m", along, 0},
                                                             {"barrier_broken_bonds", 0, 1}};
  for (const auto& [name, first, second] : columns) {
    EXPECT_NEAR(run_.column(name)[0], first, 1e-9 * std::abs(first)) << name;
    EXPECT_NEAR(run_.column(name)[1], second, 1e-9 * std::abs(second) + 1e-15) << name;
  }
  const std::pair<const char*, double> metrics[] = {{"peak_barrier_elastic_J", elastic},
                                                    {"barrier_energy_start_J", elastic + potential},
                                                    {"barrier_energy_end_J", axial / 4},
                                                    {"max_elongation_m", along},
                                                    {"broken_bonds", 1}};
  for (const auto& [name, value] : metrics)
    EXPECT_NEAR(run_.metrics().at(name), value, 1e-9 * std::abs(value) + 1e-15) << name;
}

/// Forces and moments that are set by hand on what stands in the ground: of three clamped posts and five retaining
/// cables the largest count. What pulls at the head of a post, or at the post's end of a cable, is not the ground's.
TEST(BarrierResponse, FeetOfPostsAndAnchorsOfRetainingCables) {
  Sampled run(scene::load(scene::case_file("two_spans/scene.toml"), {"barrier.posts.foot=fixed"}));
  dem::Particles& p = run.solids().particles();
  const barrier::Net& net = *run.simulation->net();
  ASSERT_EQ(net.posts.size(), 3u);
  const std::vector<barrier::Wire>& cables = net.elements.at(0);
  ASSERT_EQ(cables.size(), 5u);
  const auto foot = [&](std::size_t post) { return p.index(net.posts[post].foot_beads.at(0)); };
  p.force.set(foot(0), Vec3(0, 0, -600));
  p.force.set(foot(1), Vec3(300, 0, 400));
  p.force.set(p.index(net.posts[2].head()), Vec3(0, 0, 1e5));
  p.torque.set(foot(1), Vec3(0, 0, 20));
  p.torque.set(foot(2), Vec3(0, 30, 40));
  p.force.set(p.index(cables[1].first_bead), Vec3(100, 0, 0));
  p.force.set(p.index(cables[3].first_bead), Vec3(0, -1200, 500));
  p.force.set(p.index(cables[4].first_bead + cables[4].beads - 1), Vec3(0, 0, 1e5));
  run.take_row();
  p.force.fill(Vec3::Zero()), p.torque.fill(Vec3::Zero());
  run.take_row();
  const std::tuple<const char*, const char*, double> ground[] = {
      {"posts_foot_force_N", "peak_posts_foot_kN", 600},
      {"posts_foot_moment_Nm", "peak_posts_foot_kNm", 50},
      {"retaining_cables_anchor_force_N", "peak_retaining_cables_anchor_kN", 1300}};
  for (const auto& [column, peak, value] : ground) {
    EXPECT_DOUBLE_EQ(run.column(column)[0], value) << column;
    EXPECT_EQ(run.column(column)[1], 0) << column;
    EXPECT_DOUBLE_EQ(run.metrics().at(peak), value / 1000) << peak;
  }
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

/// A piece of a torn ring that flies off is no elongation of the net.
TEST_F(SmallNet, TornWiresDoNotCountInItsElongation) {
  const barrier::Net& net = *run_.simulation->net();
  dem::Particles& p = run_.solids().particles();
  dem::Bonds& bonds = run_.solids().bonds();
  const auto elongation = [&] { return barrier::response(net, p, bonds).elongation; };
  const double before = elongation();
  p.position.x[p.index(net.rings.front().first_bead)] += 5;
  EXPECT_GT(elongation(), 4);
  bonds.intact[net.rings.front().first_bond] = 0;
  EXPECT_NEAR(elongation(), before, 1e-12);
}

/// Moves the upper rings, but for those at its ends, along the upper cable.
void slide_upper_rings(const barrier::Net& net, double way, dem::Particles& p) {
  for (int column = 1; column + 1 < net.columns; ++column) {
    const barrier::Wire& ring = net.ring(column, net.rows - 1);
    for (dem::ParticleId id = ring.first_bead; id < ring.first_bead + ring.beads; ++id)
      p.position.add(p.index(id), way * net.across);
  }
}

/// Rings that were moved along the upper cable have slid by as much.
TEST_F(SmallNet, RingsSlideAlongTheirCables) {
  run_.take_row();
  EXPECT_EQ(run_.metrics().at("max_ring_travel_m"), 0);
  slide_upper_rings(*run_.simulation->net(), 0.01, run_.solids().particles());
  run_.take_row();
  EXPECT_NEAR(run_.metrics().at("max_ring_travel_m"), 0.01, 0.001);
  EXPECT_LT(run_.metrics().at("max_mean_ring_travel_m"), 0.005);
}

TEST_F(SmallNet, TornRingsDoNotSlide) {
  run_.take_row();
  const barrier::Net& net = *run_.simulation->net();
  slide_upper_rings(net, 0.01, run_.solids().particles());
  for (int column = 1; column + 1 < net.columns; ++column)
    run_.solids().bonds().intact[net.ring(column, net.rows - 1).first_bond] = 0;
  run_.take_row();
  EXPECT_EQ(run_.metrics().at("max_ring_travel_m"), 0);
  EXPECT_EQ(run_.metrics().at("max_mean_ring_travel_m"), 0);
}

TEST_F(SmallNet, RingsDoNotSlideAlongATornCable) {
  run_.take_row();
  const barrier::Net& net = *run_.simulation->net();
  slide_upper_rings(net, 0.01, run_.solids().particles());
  run_.solids().bonds().intact[net.cable(barrier::Side::upper)->first_bond + 7] = 0;
  run_.take_row();
  EXPECT_EQ(run_.metrics().at("max_ring_travel_m"), 0);
  EXPECT_EQ(run_.metrics().at("max_mean_ring_travel_m"), 0);
}

constexpr double kRounding = 1e-9;

/// A boulder hits a mesh where there is no weight. Bonds cancel and nothing else touches it: the mesh gets what the
/// boulder loses, and a row the mean of its interval. A step kicks by half of the force at either end of it, so that
/// half of the last one is still to come.
TEST(BarrierLoads, AreWhatABoulderLoses) {
  Sampled run(scene::load(scene::case_file("hexagonal_net/scene.toml"), {"gravity.magnitude_m_s2=0"}));
  const dem::Particles& p = run.solids().particles();
  ASSERT_EQ(p.kind[p.index(0)], dem::ParticleKind::grain);
  const Vec3 before = p.velocity[p.index(0)];
  run.take_rows_until(0.006, 0.001);
  const dem::ParticleIndex boulder = p.index(0);
  const Vec3 lost =
      p.mass[boulder] * (before - p.velocity[boulder]) - 0.5 * run.simulation->time_step() * Vec3(p.force[boulder]);
  ASSERT_GT(lost.x(), 0.1);
  EXPECT_NEAR(run.metrics().at("barrier_contact_impulse_Ns"), lost.x(), kRounding * lost.norm());
  for (const auto& [axis, a] : {std::pair{"x", 0}, std::pair{"y", 1}, std::pair{"z", 2}})
    EXPECT_NEAR(sum_over_time(run.rows(), fmt::format("barrier_contact_force_{}_N", axis)), lost[a],
                kRounding * lost.norm())
        << axis;
}

/// A boulder on a mesh whose width runs to the left or to the right: it bulges and is pushed down the flow.
TEST(BarrierLoads, DoNotDependOnTheWayTheWidthRuns) {
  const auto metrics = [](const std::vector<std::string>& set) {
    Sampled run(scene::load(scene::case_file("hexagonal_net/scene.toml"), set));
    run.take_rows_until(0.006, 0.006);
    return run.metrics();
  };
  const Metrics left = metrics({}),
                right = metrics({"barrier.net.width_direction=[0, -1, 0]", "barrier.net.origin_m=[0, 1, 0]"});
  EXPECT_GT(left.at("max_elongation_m"), 0.01);
  EXPECT_GT(left.at("barrier_contact_impulse_Ns"), 0.1);
  constexpr double other_meshes = 0.05;  // the boulder does not hit the middle
  for (const char* name : {"max_elongation_m", "barrier_contact_impulse_Ns"})
    EXPECT_NEAR(right.at(name), left.at(name), other_meshes * left.at(name)) << name;
}

/// N, of the liquid on all beads along x.
double liquid_on_beads(const dem::Particles& p) {
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.kind[i] == dem::ParticleKind::bead) sum += p.external_force[i].x();
  return sum;
}

/// Before anything arrives only its own bonds pull at a net, and the side walls a little: the bonds cancel. Then grains
/// and water push it along the flow, and the rows together are the whole impulse.
TEST(BarrierLoads, AreThoseFromOutside) {
  Sampled run(scene::load(scene::source_folder() / "tests/integration/small_debris_flow.toml", {"run.duration_s=0.6"}));
  run.take_row();
  double of_liquid = 0, next = 0.01;  // Ns, s
  while (run.simulation->time() < 0.6) {
    run.step();
    of_liquid += run.simulation->time_step() * liquid_on_beads(run.solids().particles());
    if (run.simulation->time() < next) continue;
    run.take_row(), next += 0.01;
  }
  run.take_row();
  double bonds = 0, early = 0;
  for (std::size_t k = 1; k < 10; ++k) {
    bonds = std::max(bonds, run.column("barrier_force_sum_N")[k]);
    early = std::max({early, std::abs(run.column("barrier_contact_force_x_N")[k]),
                      std::abs(run.column("barrier_fluid_force_x_N")[k])});
  }
  EXPECT_GT(bonds, 0);
  EXPECT_LT(early, 1e-3 * bonds);
  ASSERT_GT(of_liquid, 0);
  EXPECT_NEAR(run.metrics().at("barrier_fluid_impulse_Ns"), of_liquid, kRounding * of_liquid);
  for (const char* load : {"fluid", "contact"}) {
    const double impulse = run.metrics().at(fmt::format("barrier_{}_impulse_Ns", load));
    EXPECT_GT(impulse, 0) << load;
    EXPECT_NEAR(sum_over_time(run.rows(), fmt::format("barrier_{}_force_x_N", load)), impulse, kRounding * impulse)
        << load;
  }
}

}  // namespace
}  // namespace lahar::cases
