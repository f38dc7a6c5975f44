#include "coupling/grains/bed_drag.h"

#include <gtest/gtest.h>

#include <functional>

namespace lahar::coupling {
namespace {

constexpr double kDensity = 1000, kViscosity = 1e-6, kDiameter = 0.001;
constexpr BedDrag kLaws[] = {BedDrag::di_felice, BedDrag::gidaspow, BedDrag::beetstra};

BedFlow flow(double phi, double speed) {
  return {.diameter = kDiameter, .solid_fraction = phi, .speed = speed, .density = kDensity, .viscosity = kViscosity};
}

/// Stokes' 3 pi mu d; Dallavalle's fit is 4 % below.
TEST(BedDrag, LoneGrainInCreepingFlow) {
  const double stokes = 3 * std::numbers::pi * kDensity * kViscosity * kDiameter;
  for (const BedDrag law : kLaws) EXPECT_NEAR(bed_drag(law, flow(0, 1e-9)) / stokes, 1, 0.045);
}

/// Newton's range: Cd 0.44 (Gidaspow), 0.63^2 (Di Felice).
TEST(BedDrag, LoneGrainInFastFlow) {
  const double speed = 100, newton = std::numbers::pi / 8 * kDensity * kDiameter * kDiameter * speed;
  EXPECT_NEAR(bed_drag(BedDrag::gidaspow, flow(0, speed)) / newton, 0.44, 1e-6);
  EXPECT_NEAR(bed_drag(BedDrag::di_felice, flow(0, speed)) / newton, 0.4, 0.03);
}

/// Pressure drop of a packed bed, Ergun 1952: 150 phi^2/eps^3 mu U/d^2 + 1.75 phi/eps^3 rho U^2/d. Others lie around
/// it.
TEST(BedDrag, PressureDropOfAPackedBed) {
  for (const double phi : {0.4, 0.5, 0.6})
    for (const double speed : {1e-4, 1e-2, 0.3}) {
      const double eps = 1 - phi, u = eps * speed;
      const double ergun = 150 * phi * phi / (eps * eps * eps) * kDensity * kViscosity * u / (kDiameter * kDiameter) +
                           1.75 * phi / (eps * eps * eps) * kDensity * u * u / kDiameter;
      const double volume = std::numbers::pi / 6 * kDiameter * kDiameter * kDiameter;
      const auto drop = [&](BedDrag law) { return phi / volume * bed_drag(law, flow(phi, speed)) * speed; };
      EXPECT_NEAR(drop(BedDrag::gidaspow) / ergun, 1, 1e-9);
      EXPECT_NEAR(drop(BedDrag::beetstra) / ergun, 1, 0.35);
      EXPECT_NEAR(drop(BedDrag::di_felice) / ergun, 1, 0.45);
    }
}

/// Beetstra's drag over Stokes' by porosity and Reynolds number, worked out apart from this code.
TEST(BedDrag, BeetstrasNumbers) {
  struct Known {
    double phi, reynolds, factor;
  };
  constexpr Known known[] = {{0.1, 1, 2.4982},    {0.1, 1000, 47.745}, {0.5, 0.1, 20.5153}, {0.5, 10, 22.774},
                             {0.5, 100, 50.4134}, {0.6, 0.1, 37.846},  {0.6, 100, 89.7894}, {0.6, 1000, 468.4559}};
  for (const Known& k : known) {
    const BedFlow f = flow(k.phi, k.reynolds * kViscosity / (kDiameter * (1 - k.phi)));
    const double stokes = 3 * std::numbers::pi * kDensity * kViscosity * kDiameter;
    EXPECT_NEAR(beetstra_drag(f) / stokes / k.factor, 1, 1e-4) << k.phi << ' ' << k.reynolds;
  }
}

/// Speed at which grains under their weight in water move through it, times eps: of the mean flow that holds them up.
double settling(BedDrag law, double phi, double diameter, double viscosity) {
  const double weight = std::numbers::pi / 6 * diameter * diameter * diameter * 1650 * 9.81;
  double low = 0, high = 1e3;
  for (int k = 0; k < 100; ++k) {
    const double u = (low + high) / 2;
    BedFlow f{.diameter = diameter, .solid_fraction = phi, .speed = u, .density = kDensity, .viscosity = viscosity};
    (bed_drag(law, f) * u < weight ? low : high) = u;
  }
  return (1 - phi) * low;
}

/// A bed settles with the power n of eps: 4.65 in creeping and 2.4 in fast flow (Richardson & Zaki 1954). Held grains,
/// which Beetstra's law is of, are in the way more.
TEST(BedDrag, HinderedSettling) {
  const auto power = [](BedDrag law, double phi, double diameter, double viscosity) {
    return std::log(settling(law, phi, diameter, viscosity) / settling(law, 0, diameter, viscosity)) /
           std::log(1 - phi);
  };
  EXPECT_NEAR(power(BedDrag::di_felice, 0.3, 1e-4, 1e-3), 4.65, 0.2);
  EXPECT_NEAR(power(BedDrag::di_felice, 0.3, 0.05, 1e-6), 2.4, 0.1);
  EXPECT_NEAR(power(BedDrag::gidaspow, 0.15, 1e-4, 1e-3), 4.65, 0.2);
  EXPECT_NEAR(power(BedDrag::gidaspow, 0.15, 0.05, 1e-6), 2.4, 0.1);
  EXPECT_GT(power(BedDrag::beetstra, 0.3, 1e-4, 1e-3), 4.65);
  EXPECT_GT(power(BedDrag::beetstra, 0.3, 0.05, 1e-6), 2.4);
}

}  // namespace
}  // namespace lahar::coupling
