// One suite over all collision operators.
#include <gtest/gtest.h>

#include <random>

#include "lbm/collision/bounce_back_operators.h"
#include "lbm/collision/central_moments_at_bodies.h"
#include "lbm/collision/operators.h"
#include "lbm/collision/smagorinsky.h"
#include "tests/alternatives.h"

namespace lahar::lbm {
namespace {

template <class Operator>
class Collision : public testing::Test {
 public:
  using V = double;
  /// Equilibrium at a random state, disturbed.
  static void random_state(std::mt19937& random, double (&f)[D3Q19::q], double noise) {
    std::uniform_real_distribution<double> u(-1, 1);
    const double drho = 0.02 * u(random), x = 0.1 * u(random), y = 0.1 * u(random), z = 0.1 * u(random);
    for (int i = 0; i < D3Q19::q; ++i) f[i] = equilibrium(i, drho, x, y, z) + noise * D3Q19::w(i) * u(random);
  }
  static CellForcing<double> no_force() { return {{0, 0, 0}, 0, {0, 0, 0}, {0, 0, 0}}; }
};

/// Every cell touched by a body.
struct AtBodies {
  static constexpr EquilibriumOrder equilibrium_order = CentralMoments::equilibrium_order;
  template <class Viscosity>
  static Departure<double> collide(double (&f)[D3Q19::q], const Moments<double>& m, CellForcing<double> force,
                                   const Viscosity& viscosity) {
    force.near_body = 1;
    return CentralMomentsAtBodies::collide(f, m, force, viscosity);
  }
};

using Operators = AlternativeTypes<CollisionOperator, AtBodies>;
TYPED_TEST_SUITE(Collision, Operators);

TYPED_TEST(Collision, KeepsMassAndMomentum) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 50; ++trial) {
    double f[D3Q19::q];
    this->random_state(random, f, 0.01);
    const auto before = moments(f);
    TypeParam::collide(f, before, this->no_force(), Newtonian<double>{0.501});
    const auto after = moments(f);
    EXPECT_NEAR(after.drho, before.drho, 1e-15);
    for (int a = 0; a < 3; ++a) EXPECT_NEAR(after.u[a], before.u[a], 1e-15);
  }
}

TYPED_TEST(Collision, ForceAddsItsImpulse) {
  std::mt19937 random(2);
  double f[D3Q19::q];
  this->random_state(random, f, 0.01);
  const auto before = moments(f);
  CellForcing<double> force = this->no_force();
  force.acceleration[0] = 1e-3, force.acceleration[2] = -2e-3, force.impulse[1] = 5e-4;
  TypeParam::collide(f, before, force, Smagorinsky<double>{0.6, smagorinsky_factor(0.1)});
  const auto after = moments(f);
  EXPECT_NEAR(after.u[0] - before.u[0], 1e-3, 1e-14);
  EXPECT_NEAR(after.u[1] - before.u[1], 5e-4, 1e-14);
  EXPECT_NEAR(after.u[2] - before.u[2], -2e-3, 1e-14);
}

/// The deviator of the second central moments is what carries the viscosity: it must shrink by 1 - 1/tau.
TYPED_TEST(Collision, RelaxesTheStressAtTheViscousRate) {
  std::mt19937 random(3);
  double f[D3Q19::q];
  this->random_state(random, f, 0.01);
  const auto m = moments(f);
  const auto before = second_central_moments(f, m);
  const double tau = 0.8;
  TypeParam::collide(f, m, this->no_force(), Newtonian<double>{tau});
  const auto after = second_central_moments(f, m);
  EXPECT_NEAR(after.xy, (1 - 1 / tau) * before.xy, 1e-15);
  EXPECT_NEAR(after.yz, (1 - 1 / tau) * before.yz, 1e-15);
  // The default operator corrects the diagonal by a share of 9/2 omega (1 - omega/2) u^2 = 2.1 u^2.
  const double speed2 = m.u[0] * m.u[0] + m.u[1] * m.u[1] + m.u[2] * m.u[2];
  const double size = std::abs(before.xx) + std::abs(before.yy) + std::abs(before.zz);
  const bool central = std::is_same_v<TypeParam, CentralMoments> || std::is_same_v<TypeParam, AtBodies>;
  const double corrected = central ? 5 * speed2 * size : 0;
  EXPECT_NEAR(after.xx - after.yy, (1 - 1 / tau) * (before.xx - before.yy), corrected + 1e-15);
}

/// A cell that a body covers whole leaves with the body's velocity and no stress.
TYPED_TEST(Collision, FullCoverageGivesTheBodysVelocity) {
  std::mt19937 random(4);
  double f[D3Q19::q];
  this->random_state(random, f, 0.02);
  CellForcing<double> force = this->no_force();
  force.coverage_weight = force.nonequilibrium_loss = 1;
  force.solid_velocity[0] = 0.03, force.solid_velocity[2] = -0.02;
  const auto before = moments(f);
  TypeParam::collide(f, before, force, Newtonian<double>{0.55});
  const auto after = moments(f);
  EXPECT_NEAR(after.drho, before.drho, 1e-15);
  EXPECT_NEAR(after.u[0], 0.03, 1e-15);
  EXPECT_NEAR(after.u[1], 0.0, 1e-15);
  EXPECT_NEAR(after.u[2], -0.02, 1e-15);
  EXPECT_NEAR(second_central_moments(f, after).xy, 0, 1e-15);
}

/// Turning the lattice by 90 degrees about z turns the result.
TYPED_TEST(Collision, IsIsotropicUnderLatticeRotation) {
  std::mt19937 random(5);
  double f[D3Q19::q], g[D3Q19::q];
  this->random_state(random, f, 0.01);
  const auto turned = [](int i) {
    for (int j = 0; j < D3Q19::q; ++j)
      if (D3Q19::c[j][0] == -D3Q19::c[i][1] && D3Q19::c[j][1] == D3Q19::c[i][0] && D3Q19::c[j][2] == D3Q19::c[i][2])
        return j;
    return -1;
  };
  for (int i = 0; i < D3Q19::q; ++i) g[turned(i)] = f[i];
  TypeParam::collide(f, moments(f), this->no_force(), Smagorinsky<double>{0.51, smagorinsky_factor(0.15)});
  TypeParam::collide(g, moments(g), this->no_force(), Smagorinsky<double>{0.51, smagorinsky_factor(0.15)});
  for (int i = 0; i < D3Q19::q; ++i) EXPECT_NEAR(g[turned(i)], f[i], 1e-16);
}

/// What sets some of a cell's populations takes the operator's own equilibrium (collision/equilibrium.h): it stays
/// through a collision, population by population.
TYPED_TEST(Collision, EquilibriumOfItsOrderStays) {
  const double u[3] = {0.11, -0.07, 0.05}, drho = 0.03;
  double f[D3Q19::q];
  for (int i = 0; i < D3Q19::q; ++i) f[i] = equilibrium(TypeParam::equilibrium_order, i, drho, u[0], u[1], u[2]);
  double after[D3Q19::q];
  std::copy(f, f + D3Q19::q, after);
  TypeParam::collide(after, moments(f), this->no_force(), Newtonian<double>{0.7});
  for (int i = 0; i < D3Q19::q; ++i) EXPECT_NEAR(after[i], f[i], 1e-16) << "velocity " << i;
}

/// What a body covers whole comes back as it went, but for the equilibrium of the body's velocity; a cell covered by
/// half is half of each.
TEST(BounceBack, PopulationsComeBackAsTheOperatorsSay) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> noise(-0.02, 0.02);
  double start[D3Q19::q];
  for (int i = 0; i < D3Q19::q; ++i) start[i] = equilibrium(i, 0.01, 0.05, -0.02, 0.03) + D3Q19::w(i) * noise(random);
  const Moments<double> m = moments(start);
  CellForcing<double> force{{0, 0, 0}, 0, {0.03, 0.01, -0.02}, {0, 0, 0}};
  const double(&s)[3] = force.solid_velocity;
  double free[D3Q19::q];
  std::copy(start, start + D3Q19::q, free);
  CentralMoments::collide(free, m, force, Newtonian<double>{0.55});
  for (const bool at_wall_velocity : {false, true})
    for (const double b : {1.0, 0.5}) {
      force.coverage_weight = b;
      double f[D3Q19::q];
      std::copy(start, start + D3Q19::q, f);
      collide_bouncing_back<CentralMoments>(f, m, force, Newtonian<double>{0.55}, at_wall_velocity);
      const double(&w)[3] = at_wall_velocity ? s : m.u;
      for (int i = 0; i < D3Q19::q; ++i) {
        const int back = D3Q19::opposite(i);
        const double bounced =
            start[back] + equilibrium(i, m.drho, s[0], s[1], s[2]) - equilibrium(back, m.drho, w[0], w[1], w[2]);
        EXPECT_NEAR(f[i], b * bounced + (1 - b) * free[i], 1e-16) << "velocity " << i;
      }
    }
}

TEST(HigherMoments, PairSumIsThatOfItsPopulations) {
  const HigherMoments<double> higher(EquilibriumOrder::fourth, 0.11, -0.07, 0.05);
  for (int i = 0; i < D3Q19::q; ++i)
    EXPECT_NEAR(higher.pair_sum(i), higher.of(i) + higher.of(D3Q19::opposite(i)), 1e-17) << "velocity " << i;
}

TYPED_TEST(Collision, EquilibriumAtRestStays) {
  double f[D3Q19::q];
  for (int i = 0; i < D3Q19::q; ++i) f[i] = equilibrium(i, 0.01, 0.0, 0.0, 0.0);
  TypeParam::collide(f, moments(f), this->no_force(), Newtonian<double>{0.5001});
  for (int i = 0; i < D3Q19::q; ++i) EXPECT_NEAR(f[i], equilibrium(i, 0.01, 0.0, 0.0, 0.0), 1e-17);
}

/// Slow flow: the part that is odd in the velocities is that of two relaxation times.
TEST(CentralMomentsAtBodies, OddPartIsThatOfTrtInSlowFlow) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> u(-1, 1);
  double f[D3Q19::q], g[D3Q19::q];
  for (int i = 0; i < D3Q19::q; ++i) f[i] = g[i] = 1e-7 * D3Q19::w(i) * u(random);
  const CellForcing<double> force{{0, 0, 0}, 0, {0, 0, 0}, {0, 0, 0}};
  AtBodies::collide(f, moments(f), force, Newtonian<double>{0.51});
  Trt::collide(g, moments(g), force, Newtonian<double>{0.51});
  for (int i = 1; i < D3Q19::q; i += 2) EXPECT_NEAR(f[i] - f[i + 1], g[i] - g[i + 1], 1e-13);
}

/// Away from bodies it is the default operator, bit by bit; at them a large disturbance is not handed on in full.
TEST(CentralMomentsAtBodies, IsTheDefaultAwayFromBodiesAndLimitedAtThem) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  double f[D3Q19::q], away[D3Q19::q], at[D3Q19::q];
  for (int i = 0; i < D3Q19::q; ++i)
    f[i] = away[i] = at[i] = equilibrium(i, 0.01, 0.05, -0.02, 0.03) + D3Q19::w(i) * u(random);
  const CellForcing<double> force{{0, 0, 0}, 0, {0, 0, 0}, {0, 0, 0}};
  const auto m = moments(f);
  const double share = third_moments(f, m, stress(f, m)).share;
  EXPECT_GT(share, 0);
  EXPECT_LT(share, 0.4);
  CentralMoments::collide(f, m, force, Newtonian<double>{0.5001});
  CentralMomentsAtBodies::collide(away, m, force, Newtonian<double>{0.5001});
  AtBodies::collide(at, m, force, Newtonian<double>{0.5001});
  double difference = 0;
  for (int i = 0; i < D3Q19::q; ++i) {
    EXPECT_EQ(away[i], f[i]);
    difference = std::max(difference, std::abs(at[i] - f[i]));
  }
  EXPECT_GT(difference, 1e-4);
}

}  // namespace
}  // namespace lahar::lbm
