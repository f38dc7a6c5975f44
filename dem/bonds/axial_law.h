#pragma once
// The axial law of a bond in force over elongation: the piecewise linear curve of Li, Zhao & Kwan (2020), Eq. (1),
// followed back elastically, or left along a line of the first stiffness (plastic unloading). Pure functions without
// branches, so that loops over bonds vectorize.
#include <algorithm>
#include <limits>

#include "core/check.h"
#include "dem/bonds/bonds.h"

namespace lahar::dem {

/// An AxialLaw times the area of a bond: stiffness in N/m and the elongations at which the branches change.
struct AxialCurve {
  double k1 = 0, k2 = 0, k3 = 0;                             ///< N/m
  double e1 = std::numeric_limits<double>::infinity();       ///< m, end of the first branch
  double width = std::numeric_limits<double>::infinity();    ///< m, of the second branch
  double f1 = 0, f2 = 0;                                     ///< N, at the ends of the branches; 0 where there is none
  double lowest = -std::numeric_limits<double>::infinity();  ///< N and m, where it goes slack: 0 for a wire
  [[nodiscard]] bool linear() const {
    return e1 == std::numeric_limits<double>::infinity() && lowest == -std::numeric_limits<double>::infinity();
  }
};

/// Throws std::logic_error where the law cannot be followed: first stiffness not positive, negative later ones, falling
/// force limits, or plastic unloading with a later branch as stiff as the first or stiffer (plastic elongation would
/// not grow under load).
inline AxialCurve axial_curve(const AxialLaw& law, double area) {
  const auto& k = law.stiffness;
  const auto& f = law.force_limit;
  constexpr double kNone = std::numeric_limits<double>::infinity();
  AxialCurve c{k[0] * area, k[1] * area, k[2] * area, kNone, kNone, 0, 0, law.tension_only ? 0 : -kNone};
  require(c.k1 > 0 && c.k2 >= 0 && c.k3 >= 0, "a bond's axial stiffness must be positive");
  require(f[0] > 0 && f[1] >= f[0], "the force limits of an axial law must be positive and rise");
  require(!law.plastic_unloading || (c.k2 < c.k1 && c.k3 <= c.k1), "plastic unloading needs k2 < k1 and k3 <= k1");
  if (f[0] == kNone) return c;
  c.f1 = f[0];
  c.e1 = c.f1 / c.k1;
  if (f[1] == kNone) return c;
  c.f2 = f[1];
  c.width = c.f2 > c.f1 ? (c.f2 - c.f1) / c.k2 : 0.0;  // a level second branch never ends: infinite width
  return c;
}

/// Elongation spent on each branch of the curve.
struct BranchElongation {
  double first, second, third;
};

inline BranchElongation branches(const AxialCurve& c, double elongation) {
  const double beyond = std::max(elongation - c.e1, 0.0);
  return {std::max(std::min(elongation, c.e1), c.lowest), std::min(beyond, c.width), std::max(beyond - c.width, 0.0)};
}

/// Force on the curve (N, tension positive). Compression follows the first branch, down to where a wire goes slack.
inline double curve_force(const AxialCurve& c, double elongation) {
  const BranchElongation e = branches(c, elongation);
  return c.k1 * e.first + c.k2 * e.second + c.k3 * e.third;
}

/// Area under the curve from rest (J).
inline double curve_energy(const AxialCurve& c, double elongation) {
  const BranchElongation e = branches(c, elongation);
  return 0.5 * c.k1 * e.first * e.first + e.second * (c.f1 + 0.5 * c.k2 * e.second) +
         e.third * (c.f2 + 0.5 * c.k3 * e.third);
}

struct PlasticStep {
  double force;               ///< N
  double plastic_elongation;  ///< m
};

/// Plastic unloading: force along the line of stiffness k1 through the plastic elongation, capped by the curve. Drawn
/// out and let go it is slack down to its first length, and pushes below that alone.
inline PlasticStep plastic_step(const AxialCurve& c, double elongation, double plastic_elongation) {
  const double trial = c.k1 * (elongation - plastic_elongation);
  const double limit = curve_force(c, elongation);
  const double least = std::max(std::min(c.k1 * elongation, 0.0), c.lowest);
  return {std::max(std::min(trial, limit), least), trial > limit ? elongation - limit / c.k1 : plastic_elongation};
}

/// Work that plastic elongation has dissipated (J): the area under the curve up to the point that it was left at, less
/// the elastic part there. A function of the plastic elongation alone, so that the ledger has no path error.
inline double plastic_work(const AxialCurve& c, double plastic_elongation) {
  if (plastic_elongation <= 0) return 0;
  const double plastic_share = 1 - c.k2 / c.k1;  // of the elongation on the second branch; likewise on the third
  const double second = std::min(plastic_elongation / plastic_share, c.width);
  const double third = c.k3 < c.k1 ? (plastic_elongation - second * plastic_share) / (1 - c.k3 / c.k1) : 0.0;
  const double elongation = c.e1 + second + third;
  const double force = curve_force(c, elongation);
  return curve_energy(c, elongation) - 0.5 * force * force / c.k1;
}

}  // namespace lahar::dem
