// Yield-stress fluids between two plates, driven by a body force g along x. With h the half width, z the distance from
// the middle and z0 = yield / (rho g) the half width of the plug (Bird, Dai & Yarusso 1983, Rev. Chem. Eng. 1, 1-70):
//   u(z) = n/(n+1) (rho g / K)^(1/n) [ (h - z0)^(1 + 1/n) - (max(|z|, z0) - z0)^(1 + 1/n) ];   n = 1: Bingham.
#include <algorithm>
#include <cmath>
#include <map>

#include "cases/validate/entry.h"
#include "lbm/step/fluid.h"

namespace lahar::validate {
namespace {

/// Lattice units.
struct Channel {
  lbm::FlowLaw law;
  double exponent, plug_share;  ///< n; z0 / h
  const char* name;
};

constexpr double kPeak = 0.02;            ///< speed of the plug
constexpr double kViscosity = 0.1;        ///< effective, at the mean shear rate of the sheared layer
constexpr double kLimitViscosity = 1000;  ///< times kViscosity: below the yield stress

struct Flow {
  double half, plug, exponent, push, consistency;
  [[nodiscard]] double speed(double z) const {
    const double power = 1 + 1 / exponent, sheared = std::max(std::abs(z), plug) - plug;
    return std::pow(push / consistency, 1 / exponent) / power *
           (std::pow(half - plug, power) - std::pow(sheared, power));
  }
};

/// Consistency and push for which the plug has its speed and the sheared layer its mean viscosity.
Flow make_flow(const Channel& c, int cells) {
  Flow f{cells / 2.0, c.plug_share * cells / 2.0, c.exponent, 1, 1};
  const double mean_shear = kPeak / (f.half - f.plug);
  f.consistency = kViscosity * std::pow(mean_shear, 1 - c.exponent);
  f.push = std::pow(kPeak / f.speed(0), c.exponent);  // the speed goes with push^(1/n)
  return f;
}

template <class Real>
std::map<double, double> settled_profile(const Channel& c, const Flow& f, int cells, double steps) {
  lbm::FluidOptions o;
  o.domain.upper = Vec3(8, 8, cells);
  o.domain.cell_size = o.time_step = o.density = 1;
  o.domain.faces.fill(lbm::FaceKind::periodic);
  o.domain.faces[4] = o.domain.faces[5] = lbm::FaceKind::closed;
  o.kinematic_viscosity = f.consistency;
  o.gravity = Vec3(f.push, 0, 0);
  o.rheology = {c.law, f.push * f.plug, f.consistency, c.exponent, kLimitViscosity * kViscosity};
  lbm::Fluid<Real> fluid(o);
  fluid.fill_everything([](const Vec3&) { return Vec3(Vec3::Zero()); }, [](const Vec3&) { return 0.0; });
  for (int s = 0; s < steps; ++s) fluid.step();
  std::map<double, double> profile;
  fluid.for_each_wet_cell([&](const lbm::WetCell& cell) { profile[cell.centre.z() - f.half] = cell.velocity.x(); });
  return profile;
}

/// Place at z > 0 or z < 0 (`side` +-1) where the plug begins: K (du/dz)^n = rho g (|z| - z0) is linear in |z|; a least
/// squares line through the points between 15 and 60 % of its largest value is followed to zero. Needs neither K nor g.
double plug_edge(const std::map<double, double>& profile, double exponent, double side) {
  std::vector<std::pair<double, double>> points;
  double largest = 0;
  for (auto a = profile.begin(), b = std::next(a); b != profile.end(); ++a, ++b) {
    const double z = 0.5 * (a->first + b->first) * side;
    if (z < 0) continue;
    points.emplace_back(z, std::pow(std::abs(b->second - a->second), exponent));
    largest = std::max(largest, points.back().second);
  }
  double n = 0, sz = 0, sv = 0, szz = 0, szv = 0;
  for (const auto& [z, v] : points)
    if (v > 0.15 * largest && v < 0.6 * largest) n += 1, sz += z, sv += v, szz += z * z, szv += z * v;
  const double slope = (n * szv - sz * sv) / (n * szz - sz * sz);
  return (sz - sv / slope) / n;
}

double plug_width(const std::map<double, double>& profile, const Flow& f) {
  return plug_edge(profile, f.exponent, 1) + plug_edge(profile, f.exponent, -1);
}

/// Difference of the speeds at the middle and at 0.9 z0.
double plug_shear(const std::map<double, double>& profile, const Flow& f) {
  double most = 0, least = 1;
  for (const auto& [z, u] : profile)
    if (std::abs(z) < 0.9 * f.plug) most = std::max(most, u), least = std::min(least, u);
  return most - least;
}

std::vector<Row> run_channel(const Channel& c, const Context& context) {
  const int cells = context.quick ? 32 : 64;
  const Flow f = make_flow(c, cells);
  const double steps = 6 * f.half * f.half / kViscosity;
  const auto profile = context.precision == Precision::float32 ? settled_profile<float>(c, f, cells, steps)
                                                               : settled_profile<double>(c, f, cells, steps);
  double square = 0, largest = 0;
  for (const auto& [z, u] : profile) {
    const double error = (u - f.speed(z)) / kPeak;
    square += error * error / static_cast<double>(profile.size());
    largest = std::max(largest, std::abs(error));
  }
  const std::string name = c.name;
  const auto label = [&](const char* what) { return name + ", " + std::to_string(cells) + " cells: " + what; };
  std::vector<Row> rows{at_most_row(label("profile, largest error / peak"), largest, 0.02),
                        at_most_row(label("profile, RMS error / peak"), std::sqrt(square), 0.02)};
  rows.push_back(at_most_row(label("shear inside the plug / peak"), plug_shear(profile, f) / kPeak, 0.002));
  if (!context.quick)
    rows.push_back(relative_row(label("width of the plug, cells"), plug_width(profile, f), 2 * f.plug, 0.02));
  return rows;
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  for (const Channel& c : {Channel{lbm::FlowLaw::bingham, 1, 0.4, "Bingham"},
                           Channel{lbm::FlowLaw::herschel_bulkley, 0.5, 0.3, "Herschel-Bulkley n = 0.5"},
                           Channel{lbm::FlowLaw::herschel_bulkley, 1.5, 0.3, "Herschel-Bulkley n = 1.5"}})
    for (Row& r : run_channel(c, context)) rows.push_back(std::move(r));
  return rows;
}

}  // namespace

Entry bingham_channel() { return {"fluid.bingham_channel", {"Bird, Dai & Yarusso 1983, exact profiles"}, run}; }

}  // namespace lahar::validate
