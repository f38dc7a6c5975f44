#include "dem/time_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/dem/small_scenes.h"

namespace lahar::dem {
namespace {

// Li, Zhao & Kwan (2020): debris of 40 mm, 2500 kg/m^3, E = 70 GPa, nu = 0.3; 2.07e-5 s was computed apart from this
// code.
TEST(TimeStep, rayleigh_time_of_the_smallest_debris) {
  EXPECT_NEAR(rayleigh_time_step(0.02, 2500, {"debris", 7e10, 0.3}), 2.07e-5, 0.01e-5);
}

TEST(TimeStep, rayleigh_time_of_all_is_the_smallest_and_forgets_removed_particles) {
  Particles p;
  p.add(testing::sphere(Vec3::Zero(), 0.02, 2650));
  p.add(testing::sphere(Vec3::Zero(), 0.01, 2650));
  const Materials m = testing::one_material(7e10, 0.2, 0, 1);
  EXPECT_NEAR(rayleigh_time_step(p, m), rayleigh_time_step(0.01, 2650, m[0]), 1e-18);
  p.remove(1);
  EXPECT_NEAR(rayleigh_time_step(p, m), rayleigh_time_step(0.02, 2650, m[0]), 1e-18);
}

TEST(TimeStep, a_bond_is_limited_by_translation_or_rotation) {
  BondSort sort;
  sort.axial.stiffness = {2e9, 0, 0};
  sort.bond_radius = 0.003;
  const double area = std::numbers::pi * 9e-6, m = 0.002;
  EXPECT_NEAR(bond_time_step(sort, m), std::sqrt(m / (2e9 * area)), 1e-12);
  sort.shear_stiffness = 2e9;
  EXPECT_NEAR(bond_time_step(sort, m), std::sqrt(0.4 * m / (2e9 * area)), 1e-12);
  EXPECT_NEAR(bond_time_step(sort, m, 2), std::sqrt(0.8 * m / (2e9 * area)), 1e-12);
  EXPECT_NEAR(bond_time_step(sort, m, 5), std::sqrt(m / (2e9 * area)), 1e-12);
  // A chain whose beads move across it by turns: omega^2 = 4 K_s / m, whatever resists turning.
  sort.shear_stiffness = 6e9;
  EXPECT_NEAR(bond_time_step(sort, m, 10), std::sqrt(m / (6e9 * area)), 1e-12);
  sort.shear_stiffness = 2e9;
  sort.axial.stiffness = {2e9, 5e10, 1e12};
  sort.axial.force_limit[0] = 1e3;  // the second branch can be reached, the third cannot
  EXPECT_NEAR(bond_time_step(sort, m), std::sqrt(m / (5e10 * area)), 1e-12);
}

TEST(TimeStep, the_lightest_free_end_of_an_intact_bond_counts) {
  Particles p;
  p.add(testing::sphere({0, 0, 0}, 0.01, 2650));
  p.add(testing::sphere({0.03, 0, 0}, 0.02, 2650));
  Bonds bonds;
  BondSort sort;
  sort.axial.stiffness = {1e9, 1e9, 1e9};
  sort.bond_radius = 0.01;
  bonds.add_sort(sort);
  bonds.add({0, 1, 0}, p);
  EXPECT_NEAR(bond_time_step(bonds, p), bond_time_step(sort, p.mass[0]), 1e-18);
  p.inverse_mass[0] = 0;
  EXPECT_NEAR(bond_time_step(bonds, p), bond_time_step(sort, p.mass[1]), 1e-18);
  bonds.intact[0] = 0;
  EXPECT_EQ(bond_time_step(bonds, p), std::numeric_limits<double>::infinity());
}

TEST(TimeStep, all_bonds_of_a_bead_count) {
  // A bead between six others: three times the bonds of a bead in a chain.
  Particles p;
  Bonds bonds;
  BondSort sort;
  sort.axial.stiffness = {1e9, 1e9, 1e9};
  sort.bond_radius = 0.01;
  bonds.add_sort(sort);
  p.add(testing::sphere(Vec3::Zero(), 0.01, 2650));
  for (unsigned k = 0; k < 6; ++k) {
    Vec3 place = Vec3::Zero();
    place[k / 2] = k % 2 == 0 ? 0.02 : -0.02;
    p.add(testing::sphere(place, 0.01, 2650));
    bonds.add({0, k + 1, 0}, p);
  }
  EXPECT_NEAR(bond_time_step(bonds, p), bond_time_step(sort, p.mass[0]) / std::sqrt(3.0), 1e-15);
}

TEST(TimeStep, bonds_thicker_than_their_beads_are_bound_by_bending) {
  Particles p;
  p.add(testing::sphere({0, 0, 0}, 0.01, 2650));
  p.add(testing::sphere({0.02, 0, 0}, 0.01, 2650));
  Bonds bonds;
  BondSort sort;
  sort.axial.stiffness = {1e9, 1e9, 1e9};
  sort.bond_radius = 0.02;
  bonds.add_sort(sort);
  bonds.add({0, 1, 0}, p);
  const double second_moment = 0.25 * std::numbers::pi * std::pow(0.02, 4);
  EXPECT_NEAR(bond_time_step(bonds, p), std::sqrt(p.inertia[0] / (1e9 * second_moment)), 1e-15);
  EXPECT_LT(bond_time_step(bonds, p), bond_time_step(sort, p.mass[0]));
  bonds.sorts[0].shear_stiffness = 2e9;  // then torsion does: twice the second moment
  EXPECT_NEAR(bond_time_step(bonds, p), std::sqrt(p.inertia[0] / (4e9 * second_moment)), 1e-15);
}

}  // namespace
}  // namespace lahar::dem
