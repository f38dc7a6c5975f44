#include "lbm/rheology/rheology.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "lbm/collision/bgk.h"
#include "lbm/rheology/herschel_bulkley.h"
#include "tests/alternatives.h"
#include "tests/lbm/flows.h"

namespace lahar::lbm {
namespace {

TEST(Power, LogarithmAndExponential) {
  for (double x = -90; x < 90; x += 0.37) {
    EXPECT_NEAR(exp2_of(x) / std::exp2(x), 1, 1e-13) << x;
    EXPECT_NEAR(exp2_of(static_cast<float>(x)) / std::exp2(static_cast<float>(x)), 1, 1e-6) << x;
    EXPECT_NEAR(log2_of(std::exp2(x)), x, 1e-13 * std::max(1.0, std::abs(x))) << x;
    EXPECT_NEAR(log2_of(std::exp2(static_cast<float>(x))), static_cast<float>(x), 3e-7 * std::max(1.0, std::abs(x)));
  }
}

/// Stress of a cell at rest whose loading is q.
Symmetric<double> sheared(double q) { return {0, 0, 0, q / 3, 0, 0}; }

struct Parameters {
  RheologyParameters rheology;
};

/// The rate that a model gives must belong to the viscosity that the flow law gives at the shear rate that it implies.
template <class Model>
void expect_law(const RheologyParameters& p, double tolerance) {
  const Model model = Model::of(Parameters{p});
  for (double q = 1e-7; q < 0.1; q *= 1.3) {
    const double density = 1.02, rate = model.rate(sheared(q * density), 1 / density), shear = q * rate;
    const double wanted =
        std::min((p.limit_tau - 0.5) / 3, p.yield / shear + p.consistency * std::pow(shear, p.exponent - 1));
    const double tau = 1 / rate;
    EXPECT_NEAR(tau / (0.5 + 3 * wanted), 1, tolerance) << "q " << q << " n " << p.exponent;
  }
}

TEST(Rheology, BinghamSolvesItsLaw) {
  expect_law<Bingham<double>>({FlowLaw::bingham, 1e-5, 0.01, 1, 30.5}, 1e-10);
  expect_law<Bingham<double>>({FlowLaw::bingham, 1e-3, 1e-6, 1, 3.5}, 1e-10);
  expect_law<Bingham<double>>({FlowLaw::bingham, 0, 0.02, 1, 3.5}, 1e-10);
}

TEST(Rheology, HerschelBulkleySolvesItsLaw) {
  for (const double n : {0.3, 0.5, 0.8, 1.0, 1.5, 2.0})
    for (const double consistency : {1e-5, 1e-3, 0.1})
      expect_law<HerschelBulkley<double>>({FlowLaw::herschel_bulkley, 1e-5, consistency, n, 30.5}, 1e-7);
}

TEST(Rheology, PacksGiveWhatNumbersGive) {
  using V = Pack<float, 16>;
  const Parameters p{{FlowLaw::herschel_bulkley, 1e-5, 1e-3, 0.4, 30.5}};
  Symmetric<V> s{V(0), V(0), V(0), V(0), V(0), V(0)};
  for (std::size_t k = 0; k < V::size(); ++k) s.xy.set(k, 1e-6F * std::pow(2.5F, static_cast<float>(k)));
  const V rate = HerschelBulkley<V>::of(p).rate(s, V(1));
  for (std::size_t k = 0; k < V::size(); ++k) {
    const Symmetric<double> one{0, 0, 0, static_cast<double>(s.xy[k]), 0, 0};
    EXPECT_NEAR(rate[k] / HerschelBulkley<double>::of(p).rate(one, 1.0), 1, 1e-5);
  }
}

/// Mud of 2000 kg/m^3 in cells of 1 cm and steps of 0.5 ms.
TEST(Rheology, LawsInLatticeUnits) {
  const LatticeUnits units{0.01, 5e-4, 2000};
  const RheologyParameters mud = rheology_to_lu({FlowLaw::herschel_bulkley, 40, 20, 0.5, 2}, 1e-6, units);
  EXPECT_NEAR(mud.yield, 5e-5, 1e-15);                // 40/2000 dt^2/dx^2
  EXPECT_NEAR(mud.consistency, 1.1180340e-3, 1e-10);  // 20/2000 dt^1.5/dx^2
  EXPECT_EQ(mud.exponent, 0.5);
  EXPECT_NEAR(mud.limit_tau, 30.5, 1e-12);  // 1/2 + 3 * 2 dt/dx^2
  const RheologyParameters bingham = rheology_to_lu({FlowLaw::bingham, 40, 20, 0.5, 2}, 0.004, units);
  EXPECT_NEAR(bingham.yield, 5e-5, 1e-15);
  EXPECT_NEAR(bingham.consistency, 0.02, 1e-15);  // its viscosity; consistency and exponent are of the other law
  EXPECT_EQ(bingham.exponent, 1);
}

FluidOptions channel_options(const RheologyOptions& rheology, double viscosity, double push) {
  FluidOptions o = lattice_options({8, 8, 16}, viscosity);
  o.domain.faces[4] = o.domain.faces[5] = FaceKind::closed;
  o.gravity = Vec3(push, 0, 0);
  o.rheology = rheology;
  return o;
}

/// Peak of the speed in a channel of 16 cells after it has settled.
template <class Real>
double channel_peak(const FluidOptions& o) {
  Fluid<Real> fluid(o);
  fluid.fill_everything([](const Vec3&) { return Vec3(Vec3::Zero()); }, no_pressure);
  for (int s = 0; s < 4000; ++s) fluid.step();
  return largest_speed(fluid);
}

/// A push below the yield stress at the wall, rho g h, creeps at the limit viscosity; above it the plug moves as it
/// should.
TEST(Rheology, ChannelYieldsWhereItsWallDoes) {
  const double viscosity = 0.1, push = 1e-5, half = 8, wall_stress = push * half;
  const double creep =
      channel_peak<double>(channel_options({FlowLaw::bingham, 1.2 * wall_stress, 0, 1, 10}, viscosity, push));
  // Walls of fluids with a large tau slip, as half-way walls do: half as fast again is allowed for.
  EXPECT_LT(creep, 1.5 * push * half * half / (2 * 10));
  const double yielding = 0.4 * wall_stress, sheared_depth = 0.6 * half;
  const double plug = channel_peak<double>(channel_options({FlowLaw::bingham, yielding, 0, 1, 50}, viscosity, push));
  EXPECT_NEAR(plug / (push * sheared_depth * sheared_depth / (2 * viscosity)), 1, 0.05);
}

TEST(Rheology, TrtTakesItToo) {
  const double push = 1e-5, yield = 0.4 * push * 8;
  const RheologyOptions law{FlowLaw::herschel_bulkley, yield, 0.1, 1, 1};  // n = 1: the Bingham fluid again
  FluidOptions o = channel_options({FlowLaw::bingham, yield, 0, 1, 1}, 0.1, push);
  const double expected = channel_peak<double>(o);
  o.rheology = law;
  for (const CollisionOperator& op : alternatives<CollisionOperator>()) {
    if (!takes_flow_laws(op)) continue;
    o.collision = op;
    EXPECT_NEAR(channel_peak<double>(o) / expected, 1, 0.05);
    EXPECT_NEAR(channel_peak<float>(o) / expected, 1, 0.05);
  }
}

/// Compression is no shear: with two relaxation times, too, a cell that is only squeezed has the limit viscosity.
TEST(Rheology, TrtYieldsToShearAlone) {
  Parameters p;
  p.rheology = {FlowLaw::bingham, 1e-5, 0.1, 1, 30.5};
  const auto law = Bingham<double>::of(p);
  double f[D3Q19::q];
  for (int i = 0; i < D3Q19::q; ++i) f[i] = equilibrium(i, 0.0, 0.0, 0.0, 0.0);
  // What adds t to each of the three normal stresses, and nothing to density and velocity.
  const double t = 1e-4;
  for (int i = 1; i < D3Q19::q; ++i)
    if (std::abs(D3Q19::c[i][0]) + std::abs(D3Q19::c[i][1]) + std::abs(D3Q19::c[i][2]) == 1) f[i] += t / 2;
  f[0] -= 3 * t;
  const Moments<double> m = moments(f);
  ASSERT_NEAR(second_central_moments(f, m).xx, t, 1e-12);
  EXPECT_NEAR(viscous_rate(f, m, law), 1 / 30.5, 1e-12);
}

/// Far below the yield stress of a strongly thinning mud the solution is beyond the range of powers in float.
TEST(Rheology, HerschelBulkleyStaysInRange) {
  for (const double exponent : {0.1, 0.12, 0.3, 0.4}) {
    Parameters p;
    p.rheology = {FlowLaw::herschel_bulkley, 1e-5, 0.1, exponent, 30.5};
    const float g = HerschelBulkley<float>::of(p).shear_rate(1e-15F);
    EXPECT_GE(g, 0) << exponent;
    EXPECT_LT(g, 1e-10F) << exponent;
  }
}

/// Its walls slip where the viscosity is large.
TEST(Rheology, RefusesBgk) {
  FluidOptions o = channel_options({FlowLaw::bingham, 1e-5, 0, 1, 10}, 0.1, 1e-5);
  o.collision = Bgk{};
  EXPECT_THROW(Fluid<float>{o}, std::logic_error);
}

TEST(Rheology, RefusesAnEddyViscosity) {
  FluidOptions o = channel_options({FlowLaw::bingham, 1e-5, 0, 1, 10}, 0.1, 1e-5);
  o.smagorinsky = 0.1;
  EXPECT_THROW(Fluid<float>{o}, std::logic_error);
}

}  // namespace
}  // namespace lahar::lbm
