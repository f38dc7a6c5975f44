// The benchmark tests 1 to 4 of Chung & Ooi (2011, Granular Matter 13:643-656): impacts of spheres whose outcome is
// known.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "cases/validate/solids/entries.h"
#include "cases/validate/solids/impact.h"
#include "cases/validate/solids/ledger_watch.h"

namespace lahar::validate {

namespace {

constexpr const char* kSource = "Chung & Ooi 2011, Granular Matter 13:643";

/// Elastic impact after Hertz, computed apart from this code (delta = (15 m* v^2 / (16 E* sqrt(R*)))^(2/5), Johnson
/// 1985, section 11.4). The digitised curves of the paper end within 5 % of these.
struct Hertz {
  const char* material;
  double radius, density, youngs_modulus, poisson_ratio, speed;
  bool pair;
  double overlap_um, force_n, duration_us;
};

std::vector<Row> hertz_rows(const Hertz& h, ImpactLedger& ledger) {
  const ImpactSpec spec{.radius = h.radius,
                        .density = h.density,
                        .youngs_modulus = h.youngs_modulus,
                        .poisson_ratio = h.poisson_ratio,
                        .speed = h.speed,
                        .pair = h.pair};
  const Impact i = run_impact(spec);
  const std::string name = h.material;
  ledger.add(spec, i);
  return {relative_row(name + ": largest overlap, um", 1e6 * i.max_overlap, h.overlap_um, 0.01),
          relative_row(name + ": largest force, N", i.max_force, h.force_n, 0.01),
          relative_row(name + ": duration, us", 1e6 * i.duration, h.duration_us, 0.01),
          relative_row(name + ": restitution", i.restitution, 1, 0.01)};
}

std::vector<Row> both(const Hertz& a, const Hertz& b) {
  ImpactLedger ledger;
  std::vector<Row> rows = hertz_rows(a, ledger);
  for (Row& r : hertz_rows(b, ledger)) rows.push_back(std::move(r));
  ledger.rows(rows);
  return rows;
}

std::vector<Row> run_1(const Context&) {
  return both({"glass", 0.01, 2800, 48e9, 0.20, 10, true, 274.1127, 10696.889, 40.3384},
              {"limestone", 0.01, 2500, 20e9, 0.25, 10, true, 368.304, 7108.2413, 54.1996});
}

std::vector<Row> run_2(const Context&) {
  return both({"aluminium alloy", 0.1, 2699, 70e9, 0.30, 0.2, false, 49.7172, 11369.8583, 731.638},
              {"magnesium alloy", 0.1, 1800, 40e9, 0.35, 0.2, false, 52.1233, 7232.681, 767.0463});
}

ImpactSpec aluminium_oxide() {
  return {.radius = 0.0025, .density = 4000, .youngs_modulus = 380e9, .poisson_ratio = 0.23, .speed = 3.9};
}
ImpactSpec cast_iron() {
  return {.radius = 0.0025, .density = 7000, .youngs_modulus = 100e9, .poisson_ratio = 0.25, .speed = 3.9};
}

std::vector<Row> run_3(const Context&) {
  std::vector<Row> rows;
  ImpactLedger ledger;
  for (const auto& [name, sphere] : {std::pair{"aluminium oxide", aluminium_oxide()}, {"cast iron", cast_iron()}}) {
    for (const double e : {0.2, 0.4, 0.6, 0.8, 1.0}) {
      ImpactSpec s = sphere;
      s.restitution = e;
      const Impact i = run_impact(s);
      rows.push_back(relative_row(fmt::format("{}: restitution", name), i.restitution, e, 0.01));
      ledger.add(s, i);
    }
  }
  ledger.rows(rows);
  return rows;
}

// Test 4, aluminium oxide: digitised from the paper's figures (READ in KratosMultiphysics/Kratos
// DEM3D_chung_ooi_tests/test4_data/paper_data), trusted to 2 %.
struct Point {
  double degrees, value;
};
constexpr std::array<Point, 13> kTangentialRestitution{{{5.168, 0.9481},
                                                        {10.158, 0.6870},
                                                        {14.990, 0.6244},
                                                        {20.059, 0.6161},
                                                        {25.050, 0.6343},
                                                        {30.119, 0.6837},
                                                        {35.030, 0.7372},
                                                        {40.020, 0.7809},
                                                        {50, 0.8451},
                                                        {59.980, 0.8929},
                                                        {69.960, 0.9316},
                                                        {80.020, 0.9662},
                                                        {85.010, 0.9827}}};
constexpr std::array<Point, 13> kSpin{{{4.951, -19.27},
                                       {10.079, -213.0},
                                       {14.970, -377.8},
                                       {19.941, -510.6},
                                       {24.911, -599.4},
                                       {29.961, -616.5},
                                       {34.931, -582.3},
                                       {39.980, -544.8},
                                       {50, -457.0},
                                       {60.020, -357.5},
                                       {69.961, -246.2},
                                       {80.059, -126.3},
                                       {85.030, -63.1}}};
constexpr double kLargestSpin = 616.5;  // rad/s

ImpactSpec oblique(double degrees) {
  ImpactSpec s = aluminium_oxide();
  s.restitution = 0.98;
  s.friction = 0.092;
  s.angle = degrees * std::numbers::pi / 180;
  return s;
}

/// A sphere that slides all along loses mu (1 + e) of its normal velocity sideways and gets 5/2 of that as spin.
void theory_rows(std::vector<Row>& rows) {
  for (const double degrees : {40.0, 50.0, 60.0, 70.0, 80.0}) {
    const ImpactSpec s = oblique(degrees);
    const double loss = s.friction * (1 + s.restitution);
    const Impact i = run_impact(s);
    rows.push_back(relative_row(fmt::format("{:.0f} degrees, slides: tangential restitution", degrees),
                                i.tangential_ratio, 1 - loss / std::tan(s.angle), 0.01));
    rows.push_back(relative_row(fmt::format("{:.0f} degrees, slides: spin, rad/s", degrees), i.spin,
                                -2.5 * loss * s.speed * std::cos(s.angle) / s.radius, 0.01));
  }
}

std::vector<Row> run_4(const Context&) {
  std::vector<Row> rows;
  theory_rows(rows);
  ImpactLedger ledger;
  for (const Point& p : kTangentialRestitution) {
    const Impact i = run_impact(oblique(p.degrees));
    rows.push_back(relative_row(fmt::format("{:.1f} degrees: tangential restitution", p.degrees), i.tangential_ratio,
                                p.value, 0.03));
    ledger.add(oblique(p.degrees), i);
  }
  for (const Point& p : kSpin) {
    const double spin = run_impact(oblique(p.degrees)).spin;
    rows.push_back(absolute_row(fmt::format("{:.1f} degrees: spin / {} rad/s", p.degrees, kLargestSpin),
                                spin / kLargestSpin, p.value / kLargestSpin, 0.03));
  }
  ledger.rows(rows);
  return rows;
}

}  // namespace

std::vector<Entry> chung_ooi() {
  return {{"solids.chung_ooi_1", kSource, run_1},
          {"solids.chung_ooi_2", kSource, run_2},
          {"solids.chung_ooi_3", kSource, run_3},
          {"solids.chung_ooi_4", kSource, run_4}};
}

}  // namespace lahar::validate
