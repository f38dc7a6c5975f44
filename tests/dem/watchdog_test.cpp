#include "dem/watchdog.h"

#include <gtest/gtest.h>

#include "tests/dem/small_scenes.h"

namespace lahar::dem {
namespace {

/// Runs `work` and returns what the watchdog said.
template <class Work>
NumericalFailure failure_of(const Work& work) {
  try {
    work();
  } catch (const NumericalFailure& failure) {
    return failure;
  }
  ADD_FAILURE() << "no failure was reported";
  return {"", 0, ""};
}

Particles row_of(int n) {
  Particles p;
  for (int i = 0; i < n; ++i) p.add(testing::sphere({0.1 * i, 0, 0.5}, 0.02, 2650));
  return p;
}

TEST(Watchdog, is_quiet_about_sound_numbers) {
  Particles p = row_of(3);
  p.velocity.set(1, {0, 9, 0});
  p.angular_velocity.set(1, {0, 450, 0});  // of a sphere of 0.02 m: 9 m/s at its surface
  WatchdogOptions o;
  o.speed_limit = 10;
  EXPECT_NO_THROW(check_motion(p, o, 1));
  EXPECT_NO_THROW(check_motion(p, WatchdogOptions{}, 1));
  EXPECT_NO_THROW(check_overlap(p, {0.49, 0, 1, false}, o, 1));
}

TEST(Watchdog, names_the_particle_its_place_the_step_and_the_cause) {
  Particles p = row_of(9);
  p.kind[7] = ParticleKind::bead;
  p.velocity.set(7, {0, 0, 12});
  WatchdogOptions o;
  o.speed_limit = 10;
  const auto f = failure_of([&] { check_motion(p, o, 42); });
  EXPECT_EQ(f.where(), "bead 7 at (0.7, 0, 0.5)");
  EXPECT_EQ(f.step(), 42);
  EXPECT_EQ(f.cause(), "speed 12 m/s exceeds the limit of 10 m/s");
}

TEST(Watchdog, names_a_particle_whose_spin_is_too_fast) {
  Particles p = row_of(4);
  p.angular_velocity.set(2, {0, 360, 480});
  WatchdogOptions o;
  o.speed_limit = 10;
  const auto f = failure_of([&] { check_motion(p, o, 42); });
  EXPECT_EQ(f.where(), "grain 2 at (0.2, 0, 0.5)");
  EXPECT_EQ(f.cause(), "spin of 600 rad/s moves its surface at 12 m/s, which exceeds the limit of 10 m/s");
  EXPECT_NO_THROW(check_motion(p, WatchdogOptions{}, 42));
  p.angular_velocity.set(2, {1e200, 0, 0});  // its square is beyond all numbers
  EXPECT_NE(failure_of([&] { check_motion(p, o, 42); }).cause().find("exceeds the limit"), std::string::npos);
  EXPECT_NO_THROW(check_motion(p, WatchdogOptions{}, 42));
}

TEST(Watchdog, finds_numbers_that_are_not_finite) {
  for (int what = 0; what < 3; ++what) {
    Particles p = row_of(4);
    (what == 0   ? p.position
     : what == 1 ? p.velocity
                 : p.angular_velocity)
        .y[2] = what == 1 ? std::numeric_limits<double>::infinity() : std::nan("");
    const auto f = failure_of([&] { check_motion(p, {}, 5); });
    EXPECT_NE(f.where().find("grain 2 at"), std::string::npos);
    EXPECT_NE(f.cause().find("not finite"), std::string::npos);
  }
}

TEST(Watchdog, stops_a_run_whose_contact_is_too_deep) {
  Particles p = row_of(2);
  p.position.set(1, {0.015, 0, 0.5});  // overlap 0.025 of radius 0.02
  SolidsOptions o = testing::options(1e-7);
  o.watchdog.interval = 2;
  Solids solids(p, {}, testing::one_material(1e5, 0.2, 0, 1), {}, o);
  solids.step();
  const auto f = failure_of([&] { solids.step(); });
  EXPECT_NE(f.where().find("grain 0 at (-"), std::string::npos) << f.where();
  EXPECT_NE(f.cause().find("overlap with grain 1"), std::string::npos) << f.cause();
}

/// A torn bond goes on measuring how far its ends are apart.
TEST(Watchdog, names_the_bond_that_is_drawn_out_farthest_of_those_that_are_whole) {
  Particles p = row_of(4);
  Bonds bonds;
  BondSort sort;
  sort.axial.stiffness = {1e9, 1e9, 1e9};
  sort.bond_radius = 0.01;
  bonds.add_sort(sort);
  bonds.add({0, 1, 0}, p), bonds.add({1, 2, 0}, p), bonds.add({2, 3, 0}, p);
  bonds.intact[0] = 0;
  bonds.elongation = {7, 0.01, 0.02};
  EXPECT_NO_THROW(check_bonds(bonds, p, 1e-9, 42));
  const auto f = failure_of([&] { check_bonds(bonds, p, 1, 42); });
  EXPECT_EQ(f.where(), "grain 2 at (0.2, 0, 0.5)");
  EXPECT_NE(f.cause().find("by 0.02 m here"), std::string::npos) << f.cause();
}

TEST(Watchdog, stops_a_run_before_lists_are_built_of_nonsense) {
  Solids solids(row_of(3), {}, testing::one_material(1e7, 0.2, 0, 1), {}, testing::options(1e-5));
  solids.step();
  solids.particles().velocity.x[1] = std::nan("");
  EXPECT_THROW(solids.step(), NumericalFailure);
}

}  // namespace
}  // namespace lahar::dem
