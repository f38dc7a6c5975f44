#include "cases/energy_dissipator/report.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "cases/procedure/curves.h"
#include "cases/runner/interrupt.h"
#include "core/timers.h"

namespace lahar::cases {

namespace {

ResultCheck relative(const std::string& name, double value, double reference, double share, const char* source) {
  const double tolerance = share * std::abs(reference);
  return {name, value, reference, tolerance, std::abs(value - reference) <= tolerance, source};
}

ChartSeries line_of(const std::string& name, const std::vector<BrakePoint>& points) {
  ChartSeries line{.name = name};
  for (const BrakePoint& p : points) line.x.push_back(1e3 * p.elongation), line.y.push_back(1e-3 * p.end_force);
  return line;
}

/// The law itself: the ends of its stages.
ChartSeries law_of(const EnergyDissipator& brake) {
  ChartSeries line{.name = "law", .x = {0}, .y = {0}, .mark = Mark::points, .colour = ChartColour::black};
  std::vector<double> corners = brake.force_limit;
  corners.push_back(brake.last_force);
  for (const double f : corners) line.x.push_back(1e3 * brake.elongation_at(f)), line.y.push_back(1e-3 * f);
  return line;
}

/// Loss of a cycle by the law: none, or the area under the curve less what is given back with the first stiffness.
double law_loss(const EnergyDissipator& brake) {
  if (brake.unloading == BrakeUnloading::elastic) return 0;
  return brake.energy_to(brake.last_force) - 0.5 * brake.last_force * brake.last_force / brake.stage_stiffness(0);
}

}  // namespace

std::vector<ResultCheck> dissipator_checks(const BrakeCurve& curve, const EnergyDissipator& brake) {
  constexpr const char* table = "the given law; default Li, Zhao & Kwan 2020, Eq. (1) and Table 2";
  std::vector<ResultCheck> checks;
  for (std::size_t k = 0; k < brake.stiffness.size(); ++k) {
    const std::string stage = "stage_" + std::to_string(k + 1);
    checks.push_back(
        relative(stage + "_slope_N_m", stage_slope(brake, curve.loading, k), brake.stage_stiffness(k), 0.005, table));
    checks.push_back(relative(stage + "_cable_slope_N_m", cable_slope(brake, curve.loading, k),
                              brake.cable_stiffness(k), 0.005, "all bonds in series"));
    if (k + 1 < brake.stiffness.size())
      checks.push_back(
          relative(stage + "_end_force_N", knee(brake, curve.loading, k), brake.force_limit[k], 0.005, table));
  }
  const double area = area_under(curve.loading), exact = brake.energy_to(brake.last_force);
  checks.push_back(relative("largest_force_N", curve.largest_force, brake.last_force, 0.005, table));
  checks.push_back(relative("elongation_at_largest_force_m", curve.largest_elongation,
                            brake.elongation_at(brake.last_force), 0.005, table));
  checks.push_back(relative("energy_by_area_J", area, exact, 0.005, "area under the law"));
  const double loss = area + area_under(curve.unloading), wanted = law_loss(brake);
  ResultCheck cycle{"loss_of_a_cycle_J", loss, wanted, 0.005 * exact, false, "area between there and back, by the law"};
  cycle.pass = std::abs(loss - wanted) <= cycle.tolerance;
  checks.push_back(cycle);
  checks.push_back({"ledger_gap", std::abs(curve.ledger_gap) / curve.work_in, 0, 1e-3,
                    std::abs(curve.ledger_gap) / curve.work_in <= 1e-3, "energy balance"});
  return checks;
}

void draw_dissipator(const std::filesystem::path& file, const BrakeCurve& curve, const EnergyDissipator& brake) {
  ChartSeries back = line_of("let go", curve.unloading);
  back.dash = Dash::dashed;
  Chart{.title = "Energy dissipator in a cable",
        .x = {"elongation", "mm"},
        .y = {"force", "kN"},
        .series = {line_of("stretched", curve.loading), back, law_of(brake)}}
      .write_all(file);
}

bool run_energy_dissipator(const EnergyDissipator& brake, const std::filesystem::path& folder, Summary& summary) {
  Timers timers;
  BrakeCurve curve;
  {
    const ScopedTimer timer(timers.section("stretch"));
    curve = stretch(brake, [] { return !interrupted(); });
  }
  std::vector<CurveColumn> columns{{"displacement_m", "m", "of the pulled end", {}},
                                   {"elongation_m", "m", "of the dissipator", {}},
                                   {"force_N", "N", "in the dissipator", {}},
                                   {"end_force_N", "N", "at the pulled end", {}}};
  std::vector<double> time;
  for (const auto* part : {&curve.loading, &curve.unloading})
    for (const BrakePoint& p : *part) {
      time.push_back(p.time);
      const std::array<double, 4> row{p.displacement, p.elongation, p.force, p.end_force};
      for (std::size_t c = 0; c < row.size(); ++c) columns[c].values.push_back(row[c]);
    }
  write_series(folder, time, columns);
  summary.simulated_seconds = curve.simulated;
  summary.timers = timers.seconds();
  const double work = curve.simulated / curve.time_step * static_cast<double>(2 * brake.cable_beads + 2);
  summary.performance.dem_particle_steps_per_second = work / summary.timers.at("stretch");
  if (curve.interrupted) return false;
  draw_dissipator(folder / "energy_dissipator.png", curve, brake);
  summary.metrics = {{"largest_force_N", curve.largest_force},
                     {"largest_elongation_m", curve.largest_elongation},
                     {"work_in_J", curve.work_in},
                     {"work_back_J", curve.work_out},
                     {"stored_J", curve.stored},
                     {"plastic_loss_J", curve.plastic},
                     {"damping_loss_J", curve.damped},
                     {"cable_energy_J", curve.cable_energy},
                     {"time_step_s", curve.time_step}};
  summary.checks = dissipator_checks(curve, brake);
  return true;
}

}  // namespace lahar::cases
