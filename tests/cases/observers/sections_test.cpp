#include "cases/observers/sections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "cases/assembly/build.h"
#include "tests/cases/observers/heap_of_water.h"
#include "tests/cases/observers/sampled.h"

namespace lahar::cases {
namespace {

Vec3 velocity_of(const lbm::WetCell& cell) { return cell.velocity; }

/// Water that falls out of a step, measured by a section.
const std::string dam = R"([scene]
name = "gauged"
[run]
duration_s = 0.4
series_interval_s = 0.005
precision = "double"
[domain]
lower_m = [0, 0, 0]
upper_m = [1, 0.16, 0.5]
open_faces = ["z+"]
[fluid]
enabled = true
cell_size_m = 0.02
[[fluid.region]]
lower_m = [0, 0, 0]
upper_m = [0.3, 0.16, 0.4]
)";

/// What has passed a section is what lies behind it. Upright on a cell face, upright through cell centres, oblique.
TEST(Sections, DischargeIsTheVolumeThatArrives) {
  const scene::Scene scene = scene::load_text(dam);
  const Vec3 normals[] = {Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(1, 0.2, 0.3)};
  const double places[] = {0.4, 0.43, 0.45};
  for (int k = 0; k < 3; ++k) {
    lbm::Fluid<double> fluid(fluid_options(scene));
    const auto view = view_of(fluid);
    fluid.fill(liquid_regions(scene));
    const SectionFrame frame = frame_of({"s", Vec3(places[k], 0.08, 0.2), normals[k], 0, 0}, scene.domain);
    double passed = 0;
    while (static_cast<double>(fluid.steps()) * fluid.units().time_step < 0.4) {
      fluid.step();
      passed += fluid.units().time_step *
                liquid_flux(*view, velocity_of, nullptr, frame, scene.domain, Vec3::UnitZ(), 0).volume;
    }
    double behind = 0;
    fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
      const double depth = (c.centre - frame.centre).dot(frame.normal) / scene.fluid.cell_size;
      behind += c.liquid_volume * std::clamp(depth + 0.5, 0.0, 1.0);
    });
    ASSERT_GT(behind, 0.003);
    EXPECT_NEAR(passed, behind, 0.03 * behind) << k;  // compression and flying drops are in neither
  }
}

/// A layer of two cells that slides along as a whole: each plane across it sees the same discharge.
TEST(Sections, ObliquePlanesSeeTheDischargeOfAPlug) {
  const scene::Scene scene =
      scene::load_text(dam, {"fluid.region[0].lower_m=[0.1, 0, 0]", "fluid.region[0].upper_m=[0.9, 0.16, 0.04]",
                             "fluid.region[0].velocity_m_s=[1, 0, 0]", "gravity.magnitude_m_s2=0"});
  lbm::Fluid<double> fluid(fluid_options(scene));
  const auto view = view_of(fluid);
  fluid.fill(liquid_regions(scene));
  const Vec3 normals[] = {Vec3(1, 0, 0), Vec3(1, 0, 0.2), Vec3(1, 0, 1), Vec3(1, 0.3, -0.7), Vec3(1, -1, 0)};
  for (const Vec3& normal : normals)
    for (const double z : {0.0, 0.013, 0.2}) {
      const SectionFrame frame = frame_of({"s", Vec3(0.5, 0.08, z), normal, 0, 0}, scene.domain);
      const Flux flux = liquid_flux(*view, velocity_of, nullptr, frame, scene.domain, Vec3::UnitZ(), 0);
      EXPECT_NEAR(flux.volume, 0.16 * 0.04, 1e-6) << normal.transpose() << ", " << z;
      EXPECT_NEAR(flux.area * frame.normal.x(), 0.16 * 0.04, 1e-6) << normal.transpose() << ", " << z;
    }
}

/// Of a tank of water with a heavy ball, two diameters above a level section and then two below it.
const std::string sinking = R"([scene]
name = "sinking"
[run]
duration_s = 1
precision = "double"
[gravity]
magnitude_m_s2 = 9.81
[domain]
lower_m = [0, 0, 0]
upper_m = [0.32, 0.32, 0.6]
open_faces = ["z+"]
[fluid]
enabled = true
cell_size_m = 0.02
max_speed_m_s = 3
[[fluid.region]]
lower_m = [0, 0, 0]
upper_m = [0.32, 0.32, 0.54]
[materials.rock]
youngs_modulus_Pa = 1e7
poisson_ratio = 0.2
[[contact]]
materials = ["rock", "rock"]
friction = 0.5
restitution = 0.5
[[grains.sphere]]
position_m = [0.16, 0.16, 0.4]
diameter_m = 0.1
density_kg_m3 = 8000
material = "rock"
[coupling]
enabled = true
)";

/// As much water as the ball displaces goes up past it, however the ball is coupled.
TEST(Sections, WaterGoesUpWhereABallSinks) {
  const std::vector<std::string> couplings[] = {{"coupling.body_weighting=wall_distance"},
                                                {"coupling.body_weighting=inertial"},
                                                {"coupling.grains=averaged", "coupling.averaging_length_m=0.1"}};
  for (const std::vector<std::string>& coupling : couplings) {
    const scene::Scene scene = scene::load_text(sinking, coupling);
    const auto simulation = build_simulation(scene);
    const dem::Particles& ball = simulation->solids()->particles();
    const SectionFrame frame = frame_of({"s", Vec3(0.16, 0.16, 0.28), Vec3::UnitZ(), 0, 0}, scene.domain);
    double passed = 0;
    while (ball.position[ball.index(0)].z() > 0.16) {
      simulation->advance();
      passed += simulation->time_step() *
                liquid_flux(*simulation->fluid(), velocity_of, &ball, frame, scene.domain, Vec3::UnitZ(), 0).volume;
    }
    const double volume = std::numbers::pi / 6 * 1e-3;
    EXPECT_NEAR(passed, volume, 0.05 * volume) << coupling.front();
  }
}

/// Where averaged grains are, cells hold the mixture: gauges tell of the liquid between them.
TEST(Sections, TheLiquidIsThatBetweenAveragedGrains) {
  const Vec3 point(0.22, 0.16, 0.36);  // beside the ball
  Sampled run(scene::load_text(sinking + R"([[probe]]
name = "gauge"
kind = "velocity"
position_m = [0.22, 0.16, 0.36]
)",
                               {"coupling.grains=averaged", "coupling.averaging_length_m=0.1"}));
  while (run.simulation->time() < 0.1) run.step();
  run.take_row();
  const FluidView& fluid = *run.simulation->fluid();
  const auto cell = fluid.cell_at(point);
  ASSERT_GT((run.simulation->liquid_velocity(*cell) - cell->velocity).norm(), 0.02);
  const auto liquid = [&](const lbm::WetCell& c) { return run.simulation->liquid_velocity(c); };
  EXPECT_EQ(run.metrics().at("gauge_speed_peak_m_s"), velocity_at(fluid, liquid, point).norm());
  // The section carries the energy of that velocity, the volume of the mixture's less the grains'.
  const SectionFrame frame = frame_of({"s", point, Vec3::UnitZ(), 0, 0}, run.scene.domain);
  const auto flux = [&](double times) {
    return liquid_flux(
        fluid, [&](const lbm::WetCell& c) { return Vec3(times * c.velocity); }, nullptr, frame, run.scene.domain,
        Vec3::UnitZ(), 0.36);
  };
  EXPECT_EQ(flux(2).volume, flux(1).volume);
  EXPECT_NEAR((flux(2).energy - flux(0).energy) / (flux(1).energy - flux(0).energy), 4, 1e-9);
}

/// Discs where the plane cuts spheres whose centre is opposite the rectangle; beads and those that are gone do not
/// count.
TEST(Sections, AreaThatGrainsTake) {
  const SectionFrame frame = frame_of({"s", Vec3(0.5, 0, 0), Vec3(1, 0, 0), 0.4, 0.4}, scene::load_text(dam).domain);
  dem::Particles p;
  p.add({.position = Vec3(0.5, 0, 0), .radius = 0.02, .density = 2500});
  p.add({.position = Vec3(0.512, 0.1, 0), .radius = 0.02, .density = 2500});
  p.add({.position = Vec3(0.53, 0.1, 0.1), .radius = 0.02, .density = 2500});
  p.add({.position = Vec3(0.5, 0.3, 0), .radius = 0.02, .density = 2500});
  p.add({.position = Vec3(0.5, 0.1, 0), .radius = 0.02, .density = 2500, .kind = dem::ParticleKind::bead});
  EXPECT_NEAR(grain_area(p, frame), std::numbers::pi * (4e-4 + 4e-4 - 1.44e-4), 1e-12);
  p.remove(0);
  EXPECT_NEAR(grain_area(p, frame), std::numbers::pi * (4e-4 - 1.44e-4), 1e-12);
}

/// Where the domain is no whole number of cells its last face lies within one, and all that goes through that counts
/// once.
TEST(Sections, AFaceWithinACellCountsOnce) {
  const scene::Scene scene =
      scene::load_text(dam, {"domain.upper_m=[0.805, 0.16, 0.5]", "domain.open_faces=['x+', 'z+']"});
  lbm::Fluid<double> fluid(fluid_options(scene));
  const auto view = view_of(fluid);
  fluid.fill_everything([](const Vec3&) { return Vec3(0.05, 0, 0); }, [](const Vec3&) { return 0.0; });
  const double speed = fluid.units().velocity_to_si(0.05);
  const SectionFrame face = frame_of({"s", Vec3(0.805, 0.08, 0.2), Vec3::UnitX(), 0.08, 0.2}, scene.domain);
  EXPECT_NEAR(liquid_flux(*view, velocity_of, nullptr, face, scene.domain, Vec3::UnitZ(), 0.2).volume,
              speed * 0.08 * 0.2, 1e-9 * speed);
}

TEST(Sections, OnlyTheRectangleCounts) {
  const scene::Scene scene = scene::load_text(dam);
  lbm::Fluid<double> fluid(fluid_options(scene));
  const auto view = view_of(fluid);
  fluid.fill_everything([](const Vec3&) { return Vec3(0.05, 0, 0); }, [](const Vec3&) { return 0.0; });
  // Between two steps the velocity is that after half of the force, which here is gravity: u_x is untouched by it.
  const double speed = fluid.units().velocity_to_si(0.05), width = 0.08, height = 0.2;
  const auto flux = [&](const Vec3& normal) {
    const SectionFrame frame = frame_of({"s", Vec3(0.5, 0.08, 0.2), normal, width, height}, scene.domain);
    return liquid_flux(*view, velocity_of, nullptr, frame, scene.domain, Vec3::UnitZ(), 0.2);
  };
  EXPECT_NEAR(flux(Vec3(3, 0, 0)).volume, speed * width * height, 1e-9 * speed);
  EXPECT_NEAR(flux(Vec3(-1, 0, 0)).volume, -speed * width * height, 1e-9 * speed);
  EXPECT_NEAR(flux(Vec3(0, 1, 0)).volume, 0, 1e-9 * speed);
  // On a face of the domain there are cells on one side only: all that goes through them counts.
  for (const double x : {scene.domain.lower.x(), scene.domain.upper.x()}) {
    const SectionFrame face = frame_of({"s", Vec3(x, 0.08, 0.2), Vec3::UnitX(), width, height}, scene.domain);
    EXPECT_NEAR(liquid_flux(*view, velocity_of, nullptr, face, scene.domain, Vec3::UnitZ(), 0.2).volume,
                speed * width * height, 1e-9 * speed);
  }
  // The section is centred at the datum: the potential energy that passes is 0, what is left is kinetic (the fall of
  // half a step included).
  const double fall = 0.5 * fluid.units().time_step * 9.81, rho = scene.fluid.density;
  EXPECT_NEAR(flux(Vec3::UnitX()).energy, speed * width * height * 0.5 * rho * (speed * speed + fall * fall), 1e-6);
}

/// A block of water 0.3 m deep at 0.5 m/s, as it begins: potential energy about a datum 0.05 m above the floor and the
/// pressure at each height together are that of 0.25 m, and each piece carries rho (u^2/2 + g 0.25 m). Under its own
/// weight the water is compressed, at the floor by 1.1 %. What has passed is the trapezoidal rule over the rows.
TEST(Sections, LiquidByRows) {
  Sampled run(scene::load_text(heap_of_water + R"([[section]]
name = "gate"
point_m = [0.2, 0.08, 0.25]
normal = [1, 0, 0]
)"));
  run.take_row();
  for (int row = 0; row < 5; ++row) run.take_row(2);
  const double area = 0.16 * 0.3, speed = 0.5;
  EXPECT_NEAR(run.column("gate_liquid_area_m2")[0], area, 1e-9);
  EXPECT_NEAR(run.column("gate_discharge_m3_s")[0], area * speed, 1e-9);
  const std::vector<double>&power = run.column("gate_liquid_power_W"), &discharge = run.column("gate_discharge_m3_s");
  EXPECT_NEAR(power[0], area * speed * 1000 * (0.5 * speed * speed + 9.81 * 0.25), 0.01 * power[0]);
  const auto passed = [&](const std::vector<double>& rate) {
    double sum = 0;
    for (std::size_t k = 1; k < rate.size(); ++k)
      sum += 0.5 * (rate[k - 1] + rate[k]) * (run.rows().time_s[k] - run.rows().time_s[k - 1]);
    return sum;
  };
  EXPECT_NE(power.back(), power.front());
  EXPECT_NEAR(1000 * run.metrics().at("gate_liquid_energy_kJ"), passed(power), 1e-9 * passed(power));
  EXPECT_NEAR(run.metrics().at("gate_volume_m3"), passed(discharge), 1e-9 * passed(discharge));
}

/// A ball that flies through a section, and one that passes beside it. Where the plane cuts it, it is a disc; in the
/// row after its centre has passed stands all of its mass and energy.
TEST(Sections, GrainsAreCountedOnce) {
  Sampled run(scene::load_text(scene::small_scene + R"(velocity_m_s = [2, 0, 0]
[gravity]
magnitude_m_s2 = 0
[[section]]
name = "door"
point_m = [0.7, 0.5, 0.5]
normal = [1, 0, 0]
width_m = 0.2
height_m = 0.2
[[section]]
name = "beside"
point_m = [0.7, 0.9, 0.5]
normal = [1, 0, 0]
width_m = 0.2
height_m = 0.2
[[section]]
name = "against"
point_m = [0.6, 0.5, 0.5]
normal = [-1, 0, 0]
)"));
  run.take_rows_until(0.2, 0.01);
  const double mass = 2500 * M_PI / 6 * 0.1 * 0.1 * 0.1, energy = 0.5 * mass * 4, radius = 0.05;
  const Metrics metrics = run.metrics();
  const std::tuple<const char*, double> sections[] = {{"door", 1}, {"beside", 0}, {"against", -1}};
  for (const auto& [name, passed] : sections) {
    const std::string section = name;
    EXPECT_NEAR(metrics.at(section + "_grains_kg"), passed * mass, 1e-9) << section;
    EXPECT_NEAR(metrics.at(section + "_grains_energy_kJ"), passed * energy / 1000, 1e-9) << section;
    EXPECT_NEAR(sum_over_time(run.rows(), section + "_grains_kg_s"), passed * mass, 1e-9) << section;
    EXPECT_NEAR(sum_over_time(run.rows(), section + "_grains_power_W"), passed * energy, 1e-9) << section;
  }
  double largest = 0;
  for (std::size_t row = 0; row < run.rows().time_s.size(); ++row) {
    const double off = 0.5 + 2 * run.rows().time_s[row] - 0.7, disc = M_PI * (radius * radius - off * off);
    EXPECT_NEAR(run.column("door_grains_area_m2")[row], std::max(0.0, disc), 1e-12) << off;
    EXPECT_EQ(run.column("beside_grains_area_m2")[row], 0);
    largest = std::max(largest, disc);
  }
  EXPECT_GT(largest, 0.9 * M_PI * radius * radius);
}

/// A ball that falls as it flies: where it passes, it has lost in height what it has won in speed.
TEST(Sections, GrainsCarryTheirHeight) {
  Sampled run(scene::load_text(scene::small_scene + R"(velocity_m_s = [2, 0, 0]
[measure]
section_x_m = 0.7
outflow_distance_m = 0.1
energy_datum_z_m = 0.2
[[section]]
name = "door"
point_m = [0.7, 0.5, 0.5]
normal = [1, 0, 0]
)"));
  const auto& p = run.solids().particles();
  const double start = p.position.z[0];
  run.take_rows_until(0.2, 0.01);
  const double mass = 2500 * M_PI / 6 * 0.1 * 0.1 * 0.1, energy = mass * (0.5 * 4 + 9.81 * (start - 0.2));
  EXPECT_NEAR(run.metrics().at("door_grains_energy_kJ"), energy / 1000, 1e-3 * energy / 1000);
  EXPECT_NEAR(sum_over_time(run.rows(), "door_grains_power_W"), energy, 1e-3 * energy);
}

TEST(Sections, DiscsEndAtTheEdgesOfTheRectangle) {
  constexpr double r = 0.05, disc = std::numbers::pi * r * r, far = 1e9;
  EXPECT_NEAR(disc_in_rectangle(r, {-far, far}, {-far, far}), disc, 1e-15);
  EXPECT_NEAR(disc_in_rectangle(r, {-far, far}, {0, far}), disc / 2, 1e-15);
  EXPECT_NEAR(disc_in_rectangle(r, {-far, 0}, {0, far}), disc / 4, 1e-15);
  EXPECT_NEAR(disc_in_rectangle(r, {-0.01, 0.01}, {-0.02, 0.005}), 0.02 * 0.025, 1e-15);
  EXPECT_EQ(disc_in_rectangle(r, {0.06, 0.08}, {-far, far}), 0);
  EXPECT_NEAR(disc_in_rectangle(r, {0.03, 0.08}, {0.04, 0.08}), 0, 1e-15);  // its corner lies on the edge
  const double segment = r * r * std::acos(0.6) - 0.03 * 0.04;              // beyond 3 of 5 parts of the radius
  EXPECT_NEAR(disc_in_rectangle(r, {0.03, far}, {-far, far}), segment, 1e-15);
  EXPECT_NEAR(disc_in_rectangle(r, {-far, far}, {-far, -0.03}), segment, 1e-15);
  EXPECT_NEAR(disc_in_rectangle(r, {-far, 0.03}, {-far, far}), disc - segment, 1e-15);
  const double half = disc_in_rectangle(r, {-0.02, 0.03}, {-0.045, 0.01});
  double sum = 0;  // column by column
  for (int k = 0; k < 100000; ++k) {
    const double x = -0.02 + 0.05 * (k + 0.5) / 100000, edge = std::sqrt(r * r - x * x);
    sum += 0.05 / 100000 * (std::min(0.01, edge) - std::max(-0.045, -edge));
  }
  EXPECT_NEAR(half, sum, 1e-9);
}

/// A ball that passes and leaves the domain between two rows is counted with the speed that it passed with.
TEST(Sections, AGrainThatLeavesBetweenRowsHasPassed) {
  Sampled run(scene::load_text(scene::small_scene + R"(velocity_m_s = [2, 0, 0]
[gravity]
magnitude_m_s2 = 0
[[section]]
name = "door"
point_m = [0.9, 0.5, 0.5]
normal = [1, 0, 0]
)"));
  run.take_row();
  run.solids().particles().position.x[0] = 1.06;
  run.observers.after_step();
  run.solids().remove(0);
  run.take_row();
  const double mass = 2500 * M_PI / 6 * 0.1 * 0.1 * 0.1;
  EXPECT_NEAR(run.metrics().at("door_grains_kg"), mass, 1e-9);
  EXPECT_NEAR(1000 * run.metrics().at("door_grains_energy_kJ"), 0.5 * mass * 4, 1e-9);
}

/// Two balls change places in the arrays while one of them passes.
TEST(Sections, GrainsAreKnownById) {
  Sampled run(scene::load_text(scene::small_scene + R"([[grains.sphere]]
position_m = [0.9, 0.5, 0.5]
diameter_m = 0.05
density_kg_m3 = 2500
material = "rock"
[[section]]
name = "door"
point_m = [0.7, 0.5, 0.5]
normal = [1, 0, 0]
)"));
  run.take_row();
  run.solids().particles().position.x[0] = 0.75;
  run.solids().renumber(dem::Renumbering({1, 0}));
  run.take_row();
  EXPECT_NEAR(run.metrics().at("door_grains_kg"), 2500 * M_PI / 6 * 0.1 * 0.1 * 0.1, 1e-9);
}

}  // namespace
}  // namespace lahar::cases
