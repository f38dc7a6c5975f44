// Contact laws against theory, and one behavioural suite over all of them.
#include <gtest/gtest.h>

#include <random>

#include "dem/contact/contact_laws.h"
#include "dem/contact/damping.h"
#include "dem/time_step.h"
#include "tests/alternatives.h"
#include "tests/dem/small_scenes.h"

namespace lahar::dem {
namespace {

using testing::one_material;
using testing::options;
using testing::sphere;

/// Duration of an elastic Hertz impact at `speed`: 2.87 (m*^2 / (R* E*^2 v))^(1/5) (Johnson 1985, Contact Mechanics,
/// Eq. 11.24).
double hertz_contact_time(double effective_mass, double effective_radius, double effective_modulus, double speed) {
  return 2.87 *
         std::pow(effective_mass * effective_mass / (effective_radius * effective_modulus * effective_modulus * speed),
                  0.2);
}

struct Impact {
  double max_overlap = 0, max_force = 0, duration = 0, restitution = 0;
};

/// Head-on impact of two equal spheres, each with `speed`, which touch a share `phase` of a step after one.
Impact collide(double radius, double density, const Materials& materials, double speed, double time_step,
               const ContactLawChoice& law = HertzMindlin{}, double phase = 0.3) {
  Particles p;
  const double gap = phase * speed * time_step;
  p.add(sphere({-radius - gap, 0, 0}, radius, density, {speed, 0, 0}));
  p.add(sphere({radius + gap, 0, 0}, radius, density, {-speed, 0, 0}));
  SolidsOptions o = options(time_step);
  o.contact_law = law;
  Solids solids(p, {}, materials, {}, o);
  Impact result;
  double entry = 0;  // moment of touch, from the last free position
  for (int step = 0; step < 1000000; ++step) {
    solids.step();
    const auto& q = solids.particles();
    const double overlap = 2 * radius - (q.position.x[1] - q.position.x[0]);
    if (overlap > 0 && entry == 0) entry = solids.time() - overlap / (2 * speed);
    result.max_overlap = std::max(result.max_overlap, overlap);
    result.max_force = std::max(result.max_force, std::abs(q.force.x[0]));
    if (overlap <= 0 && entry > 0) {
      result.restitution = q.velocity.x[1] / speed;
      result.duration = solids.time() + overlap / (2 * result.restitution * speed) - entry;
      return result;
    }
  }
  ADD_FAILURE() << "the spheres never parted";
  return result;
}

// Elastic impacts of two equal spheres, 2 x 2.5 m/s, 2500 kg/m^3, nu = 0.3, the debris of Li, Zhao & Kwan (2020) with
// its own and with softened moduli. The numbers were computed apart from this code from Hertz's exact solution (Johnson
// 1985, section 11.4): delta = (15 m* v^2 / (16 E* sqrt(R*)))^(2/5), F = 4/3 E* sqrt(R*) delta^1.5, T = 2.943 delta /
// v.
TEST(HertzMindlin, elastic_impact_follows_hertz) {
  struct Row {
    double radius, modulus, overlap_um, force_n, duration_us;
  };
  for (const Row& row :
       {Row{0.02, 7e10, 145.4753, 8998.0693, 85.6326}, Row{0.04, 7e10, 290.9506, 35992.2772, 171.2652},
        Row{0.02, 7e8, 917.8872, 1426.0979, 540.3051}, Row{0.04, 7e6, 11582.953, 904.0851, 6818.1894}}) {
    const Materials materials = one_material(row.modulus, 0.3, 0, 1);
    const Impact i = collide(row.radius, 2500, materials, 2.5, row.duration_us * 1e-6 / 400);
    EXPECT_NEAR(i.max_overlap * 1e6 / row.overlap_um, 1, 1e-4);
    EXPECT_NEAR(i.max_force / row.force_n, 1, 1e-4);
    EXPECT_NEAR(i.duration * 1e6 / row.duration_us, 1, 2e-4);
    EXPECT_NEAR(i.restitution, 1, 1e-5);
    const double m = 2.0 / 3 * std::numbers::pi * std::pow(row.radius, 3) * 2500;
    const double time = hertz_contact_time(m, row.radius / 2, materials.pair(0, 0).effective_modulus, 5);
    EXPECT_NEAR(time * 1e6 / row.duration_us, 1, 1e-3);
  }
}

// Elastic impact of two glass spheres, r = 10 mm, 2 x 10 m/s: Chung & Ooi 2011 (Granular Matter 13:643), test 1, E = 48
// GPa, nu = 0.2, 2800 kg/m^3; numbers computed from the exact Hertz solution.
TEST(HertzMindlin, chung_and_ooi_test_1_glass) {
  const Impact i = collide(0.01, 2800, one_material(4.8e10, 0.2, 0.35, 1), 10, 40.3384e-6 / 400);
  EXPECT_NEAR(i.max_overlap, 274.1127e-6, 0.001 * 274e-6);
  EXPECT_NEAR(i.max_force, 10696.889, 0.001 * 10697);
  EXPECT_NEAR(i.duration, 40.3384e-6, 0.001 * 40e-6);
}

TEST(Damping, ratio_and_restitution_are_inverse) {
  for (const double e : {0.02, 0.1, 0.1353, 0.14, 0.3, 0.5, 0.7, 0.9, 0.99})
    EXPECT_NEAR(restitution_of_damping(damping_ratio(e)), e, 1e-9);
  EXPECT_EQ(damping_ratio(1), 0);
  EXPECT_EQ(damping_ratio(0), damping_ratio(kLeastRestitution));
}

TEST(Damping, weak_damping_agrees_with_tsuji) {
  const double e = 0.95, ln = std::log(e), beta = -ln / std::sqrt(ln * ln + std::numbers::pi * std::numbers::pi);
  EXPECT_NEAR(damping_ratio(e) / beta, 1, 0.02);
  EXPECT_NEAR(damping_ratio(0.999) / (0.001 / std::numbers::pi), 1, 0.002);
}

class Restitution : public ::testing::TestWithParam<double> {};

TEST_P(Restitution, hertz_is_as_set_at_any_speed) {
  const double e = GetParam(), radius = 0.02, density = 2650;
  const Materials materials = one_material(7e9, 0.2, 0.3, e);
  const double m = 4.0 / 3 * std::numbers::pi * std::pow(radius, 3) * density / 2;
  for (const double speed : {1e-3, 0.1, 10.0}) {
    const double time = hertz_contact_time(m, radius / 2, materials.pair(0, 0).effective_modulus, 2 * speed);
    EXPECT_NEAR(collide(radius, density, materials, speed, time / 400).restitution, e, 0.002 * e) << speed;
    EXPECT_NEAR(collide(radius, density, materials, speed, time / 50).restitution, e, 0.02 * e) << speed;
  }
}

TEST_P(Restitution, linear_is_as_set) {
  const double e = GetParam(), m = 4.0 / 3 * std::numbers::pi * 8e-6 * 2650 / 2, k = 1e5;
  const double time = std::numbers::pi * std::sqrt(m / k);
  const LinearSpringDashpot law{k, 2.0 / 7 * k};
  EXPECT_NEAR(collide(0.02, 2650, one_material(7e9, 0.2, 0.3, e), 0.5, time / 400, law).restitution, e, 0.005 * e);
}

/// Of a damper so strong that the step does not follow it, whatever the moment of the touch: it takes what there is and
/// no more. What a long step adds is the spring's.
TEST(HertzMindlin, strong_dampers_do_not_throw_back) {
  const double radius = 0.02, density = 2650;
  for (const double e : {0.01, 0.02, 0.05, 0.1}) {
    const Materials materials = one_material(5e9, 0.2, 0.3, e);
    for (const double share : {0.14, 0.2, 0.3})
      for (const double speed : {0.1, 1.0, 6.0})
        for (int phase = 0; phase < 8; ++phase) {
          const double dt = share * rayleigh_time_step(radius, density, {"sphere", 5e9, 0.2});
          const double rebound =
              collide(radius, density, materials, speed, dt, HertzMindlin{}, (phase + 0.5) / 8).restitution;
          EXPECT_LT(rebound, share < 0.15 ? e + 0.02 : std::max(e + 0.02, 0.12))
              << e << " at " << share << " of the Rayleigh time, " << speed << " m/s, phase " << phase;
        }
  }
}

INSTANTIATE_TEST_SUITE_P(Damping, Restitution, ::testing::Values(0.1, 0.2, 0.3, 0.5, 0.7, 0.9, 0.95));

// One suite over all laws.
template <class L>
class AnyContactLaw : public ::testing::Test {
 public:
  L law{};
  std::mt19937 random{7};

  double uniform(double a, double b) { return a + (b - a) * static_cast<double>(random()) / 4294967296.0; }
  Triple vector(double size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }

  ContactState state() {
    ContactState s;
    const Triple n = vector(1);
    s.normal_ij = (1 / length(n)) * n;
    s.overlap = uniform(1e-7, 1e-4);
    s.closing_speed = uniform(-1, 1);
    s.tangential_velocity = normal_part(vector(1), s.normal_ij);
    s.tangential_velocity_end = s.tangential_velocity;
    s.twist_rate = uniform(-10, 10);
    s.effective_radius = 0.01;
    s.effective_mass = 0.05, s.tangential_mass = 0.04;
    s.effective_modulus = 1e9;
    s.effective_shear_modulus = 2e8;
    s.friction = 0.4;
    s.damping_ratio = 0.2;
    return s;
  }
};

using AllLaws = AlternativeTypes<ContactLawChoice>;
TYPED_TEST_SUITE(AnyContactLaw, AllLaws);

TYPED_TEST(AnyContactLaw, never_pulls_and_stays_inside_coulombs_cone) {
  ContactHistory history;
  for (int n = 0; n < 2000; ++n) {
    const ContactState s = this->state();
    const ContactForce f = this->law(s, history, 1e-6);
    EXPECT_GE(f.normal, 0);
    EXPECT_LE(length(f.tangential), s.friction * f.normal * (1 + 1e-12));
    EXPECT_NEAR(dot(f.tangential, s.normal_ij), 0, 1e-9 * (1 + f.normal));
  }
}

TYPED_TEST(AnyContactLaw, only_dissipates) {
  ContactHistory history;
  for (int n = 0; n < 2000; ++n) {
    const ContactForce f = this->law(this->state(), history, 1e-6);
    EXPECT_GE(f.damping_work, -1e-18);
    EXPECT_GE(f.friction_work, -1e-18);
    EXPECT_GE(f.elastic_normal, 0);
    EXPECT_GE(f.elastic_tangential, 0);
  }
}

TYPED_TEST(AnyContactLaw, vanishes_with_the_overlap) {
  ContactHistory history;
  ContactState s = this->state();
  s.overlap = 1e-18;
  s.closing_speed = 0;
  const ContactForce f = this->law(s, history, 1e-6);
  EXPECT_LT(f.normal, 1e-9);
  EXPECT_LT(length(f.tangential), 1e-9);
}

/// The law on eight contacts side by side is the law on each of them.
TYPED_TEST(AnyContactLaw, rows_agree_with_numbers) {
  ContactHistory history[kRow];
  ContactHistoryOf<Row<double>> rows;
  for (int n = 0; n < 200; ++n) {
    ContactStateOf<Row<double>> all;
    ContactForce f[kRow];
    for (std::size_t l = 0; l < kRow; ++l) {
      const ContactState s = this->state();
      f[l] = this->law(s, history[l], 1e-6);
      for (auto [to, from] : {std::pair{&all.normal_ij, &s.normal_ij},
                              {&all.tangential_velocity, &s.tangential_velocity},
                              {&all.tangential_velocity_end, &s.tangential_velocity_end}})
        to->x.set(l, from->x), to->y.set(l, from->y), to->z.set(l, from->z);
      all.overlap.set(l, s.overlap), all.closing_speed.set(l, s.closing_speed), all.twist_rate.set(l, s.twist_rate);
      all.effective_radius.set(l, s.effective_radius);
      all.effective_mass.set(l, s.effective_mass), all.tangential_mass.set(l, s.tangential_mass);
      all.effective_modulus.set(l, s.effective_modulus), all.effective_shear_modulus.set(l, s.effective_shear_modulus);
      all.friction.set(l, s.friction), all.damping_ratio.set(l, s.damping_ratio);
    }
    const ContactForceOf<Row<double>> g = this->law(all, rows, 1e-6);
    for (std::size_t l = 0; l < kRow; ++l) {
      EXPECT_NEAR(g.normal[l], f[l].normal, 1e-10 * (1 + f[l].normal));
      EXPECT_NEAR(g.tangential.x[l], f[l].tangential.x, 1e-9 * (1 + f[l].normal));
      EXPECT_NEAR(g.tangential.z[l], f[l].tangential.z, 1e-9 * (1 + f[l].normal));
      EXPECT_NEAR(g.friction_work[l], f[l].friction_work, 1e-9 * (1e-6 + f[l].friction_work));
      EXPECT_NEAR(rows.tangential_stiffness[l], history[l].tangential_stiffness,
                  1e-10 * (1 + history[l].tangential_stiffness));
    }
  }
}

TYPED_TEST(AnyContactLaw, does_not_depend_on_the_frame) {
  const Eigen::AngleAxisd turn(1.1, Vec3(1, 2, 3).normalized());
  const auto turned = [&](const Triple& t) {
    const Vec3 v = turn * Vec3(t.x, t.y, t.z);
    return Triple{v.x(), v.y(), v.z()};
  };
  ContactHistory here, there;
  for (int n = 0; n < 50; ++n) {
    const ContactState s = this->state();
    ContactState t = s;
    for (Triple ContactState::*member :
         {&ContactState::normal_ij, &ContactState::tangential_velocity, &ContactState::tangential_velocity_end})
      t.*member = turned(s.*member);
    const ContactForce f = this->law(s, here, 1e-5), g = this->law(t, there, 1e-5);
    EXPECT_NEAR(f.normal, g.normal, 1e-9 * (1 + f.normal));
    EXPECT_LT(length(turned(f.tangential) - g.tangential), 1e-8 * (1 + length(f.tangential)));
  }
}

TYPED_TEST(AnyContactLaw, spring_remembers_and_reverses) {
  ContactState s = this->state();
  s.normal_ij = {0, 0, 1};
  s.closing_speed = s.twist_rate = s.damping_ratio = 0;
  s.overlap = 1e-4;
  s.friction = 1e9;
  ContactHistory history;
  s.tangential_velocity = s.tangential_velocity_end = {0.02, 0, 0};
  const double first = this->law(s, history, 1e-5).tangential.x;
  const double second = this->law(s, history, 1e-5).tangential.x;
  s.tangential_velocity = s.tangential_velocity_end = {-0.04, 0, 0};
  const double third = this->law(s, history, 1e-5).tangential.x;
  EXPECT_LT(first, 0);
  EXPECT_NEAR(second / first, 2, 1e-12);
  EXPECT_NEAR(third, 0, 1e-12 * std::abs(first));
}

/// Without a stiffness of its own the tangential spring has 2/7 of the normal one: both swing with the same period.
TEST(LinearSpringDashpot, tangential_stiffness_of_its_own_and_by_default) {
  ContactState s{};
  s.normal_ij = {0, 0, 1};
  s.overlap = 1e-4, s.effective_radius = 0.01, s.effective_mass = 0.01, s.tangential_mass = 0.01 * 2 / 7;
  s.friction = 1e9;
  s.tangential_velocity = s.tangential_velocity_end = {0.02, 0, 0};
  const auto first_force = [&](double tangential_stiffness) {
    ContactHistory history;
    return LinearSpringDashpot{1e6, tangential_stiffness}(s, history, 1e-5).tangential.x;
  };
  EXPECT_NEAR(first_force(0) / (-2.0 / 7 * 1e6 * 0.02 * 1e-5), 1, 1e-9);
  EXPECT_NEAR(first_force(3e5) / (-3e5 * 0.02 * 1e-5), 1, 1e-9);
  const double mass = std::numbers::pi / 6 * 1e-6 * 2500;  // of a sphere of 1 cm
  EXPECT_NEAR((LinearSpringDashpot{1e6, 0}.time_limit(0.005, 2500, {})),
              0.35 * std::numbers::pi * std::sqrt(mass / 2 / 1e6), 1e-12);
  EXPECT_NEAR((LinearSpringDashpot{1e6, 1e6}.time_limit(0.005, 2500, {})),
              0.35 * std::numbers::pi * std::sqrt(mass / 2 / 3.5e6), 1e-12);
}

TYPED_TEST(AnyContactLaw, cycles_of_load_never_give_energy_back) {
  ContactState s = this->state();
  s.normal_ij = {0, 0, 1};
  s.closing_speed = s.twist_rate = s.damping_ratio = 0;
  s.friction = 0.5;
  ContactHistory history;
  double work = 0;  // done on the tangential spring by the bodies
  ContactForce f;
  Triple before{0, 0, 0};
  const double dt = 1e-5;
  for (int n = 0; n < 40000; ++n) {  // the normal load swings at another period than the shear
    s.overlap = 5e-5 * (1.2 + std::sin(0.003 * n));
    s.tangential_velocity = s.tangential_velocity_end = {1e-2 * std::cos(0.007 * n), 0, 0};
    f = this->law(s, history, dt);
    work -= 0.5 * dt * dot(f.tangential + before, s.tangential_velocity);
    before = f.tangential;
    EXPECT_GE(work, -1e-12);
  }
  EXPECT_GT(work, f.elastic_tangential);
}

TEST(LinearSpringDashpot, impact_lasts_half_a_period) {
  const double mass = 4.0 / 3 * std::numbers::pi * std::pow(0.02, 3) * 2500, limit = linear_contact_time(mass / 2, 1e6);
  const Impact impact =
      collide(0.02, 2500, one_material(7e10, 0.3, 0, 1), 2.5, limit / 200, LinearSpringDashpot{1e6, 2e6 / 7});
  EXPECT_NEAR(impact.duration / limit, 1, 1e-3);
}

// A damper solved for the speed that it meets needs no shorter step than the spring: over-damped steel at the step of
// an elastic contact, 0.2 of the Rayleigh time, three times what explicit damping would leave.
TEST(NormalDamper, strong_damping_needs_no_shorter_step) {
  const Materials steel = one_material(2e11, 0.3, 0.0, 0.1);
  const double step = 0.2 * rayleigh_time_step(0.00305, 7800, steel[0]);
  for (const ContactLawChoice& law :
       {ContactLawChoice{HertzMindlin{}}, ContactLawChoice{LinearSpringDashpot{2e6, 6e5}}})
    for (const double speed : {0.1, 1.0, 10.0}) {
      EXPECT_NEAR(collide(0.00305, 7800, steel, speed, step, law).restitution, 0.1, 0.01) << speed;
    }
}

}  // namespace
}  // namespace lahar::dem
