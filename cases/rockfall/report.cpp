#include "cases/rockfall/report.h"

#include <cmath>

#include "cases/procedure/curves.h"
#include "cases/runner/interrupt.h"
#include "cases/runner/progress.h"
#include "core/check.h"
#include "core/timers.h"

namespace lahar::cases {

namespace {

constexpr const char* kPaper = "Li, Zhao & Kwan 2020, section 3.3, Fig. 7";
constexpr double kPaperLowestTime = 0.25;  // s

ResultCheck at_most(const std::string& name, double value, double bar, const char* source) {
  return {name, value, 0, bar, value <= bar, source};
}

ResultCheck at_least(const std::string& name, double value, double bar, const char* source) {
  return {name, value, bar, 0, value >= bar, source};
}

std::vector<CurveColumn> columns_of(const RockfallSeries& s) {
  return {
      {"ball_displacement_m", "m", "of the ball since its bottom was in the net's plane, upwards", s.ball_displacement},
      {"ball_energy_J", "J", "kinetic and potential energy of the ball about the net's plane", s.ball_energy},
      {"ball_force_N", "N", "of the net on the ball, upwards", s.ball_force},
      {"brake_elongation_m", "m", "mean over the dissipators", s.brake_elongation},
      {"brake_energy_J", "J", "stored and plastically dissipated in all dissipators", s.brake_energy},
      {"bond_energy_J", "J", "elastic energy of all bonds", s.bond_energy},
      {"friction_loss_J", "J", "dissipated by slip", s.friction_loss},
      {"contact_loss_J", "J", "dissipated by contact damping", s.contact_loss},
      {"bond_loss_J", "J", "dissipated in bonds", s.bond_loss},
      {"ledger_gap_J", "J", "total energy less that at time zero", s.ledger_gap},
      {"ring_travel_m", "m", "mean sliding of the edge rings along their cables", s.ring_travel}};
}

}  // namespace

std::vector<ResultCheck> rockfall_sanity(const RockfallResult& result, const Rockfall& rockfall) {
  const double no_slack = rockfall.tied ? 2 * rockfall.wire_diameter : 0.0;
  std::vector<ResultCheck> checks{
      at_most("rings_passed_through_each_other", result.lost_links.empty() ? 0 : 1, 0, "linking numbers"),
      at_most("ledger_gap", result.largest_gap, 1e-3, "energy balance, share of the ball's kinetic energy"),
      at_least("rebound_energy_J", result.rebound_energy, 1, kPaper),
      at_least("active_dissipators", static_cast<double>(result.active_brakes), 1, kPaper),
      at_most("lowest_and_least_energy_apart_s", std::abs(result.lowest_time - result.least_energy_time), 0.005,
              kPaper)};
  if (rockfall.tied)
    checks.push_back(at_most("largest_ring_travel_m", result.largest_travel, no_slack, "rings are tied"));
  else
    checks.push_back(at_least("mean_ring_travel_m", result.mean_travel, rockfall.wire_diameter, kPaper));
  return checks;
}

std::vector<ResultCheck> rockfall_paper_checks(const RockfallResult& result) {
  const double late = std::abs(result.lowest_time - kPaperLowestTime);
  return {{"lowest_point_s", result.lowest_time, kPaperLowestTime, 0.03, late <= 0.03, kPaper},
          at_most("energy_lost_until_0_05_s", result.lost_until_50_ms, 0.01, kPaper)};
}

void draw_rockfall(const std::filesystem::path& folder, const RockfallResult& result) {
  const RockfallSeries& s = result.series;
  const Axis time{.label = "time", .unit = "s"};
  Chart displacement{.title = "Ball on a ring net",
                     .x = time,
                     .y = {"displacement", "m"},
                     .series = {{.name = "ball", .x = s.time, .y = s.ball_displacement}}};
  if (result.as_in_paper) displacement.x_guides = {{kPaperLowestTime, "paper: lowest point"}};
  displacement.write_all(folder / "rockfall_displacement.png");
  const auto energy = [&](const char* name, const std::vector<double>& joule) {
    return scaled_line(name, s.time, joule, 1, 1e-3);
  };
  Chart chart{.title = "Ball on a ring net",
              .x = time,
              .y = {"energy", "kJ"},
              .series = {energy("ball", s.ball_energy), energy("bonds", s.bond_energy),
                         energy("dissipators", s.brake_energy), energy("lost to friction", s.friction_loss),
                         energy("lost in contacts", s.contact_loss), energy("lost in bonds", s.bond_loss)}};
  chart.series[2].dash = Dash::dashed;
  chart.series[2].colour = ChartColour::vermilion;
  chart.write_all(folder / "rockfall_energy.png");
}

bool run_rockfall_to(const Rockfall& rockfall, const std::filesystem::path& folder, bool quiet, Summary& summary) {
  Timers timers;
  Progress progress(rockfall.settling_time + rockfall.duration, progress_style(quiet, stdout));
  RockfallResult result;
  {
    const ScopedTimer timer(timers.section("particles"));
    result = run_rockfall(rockfall, [&](double time) {
      progress.update(time);
      return !interrupted();
    });
  }
  progress.finish();
  summary.simulated_seconds = result.simulated;
  summary.timers = timers.seconds();
  summary.performance.dem_particle_steps_per_second =
      static_cast<double>(result.steps) * static_cast<double>(result.beads) / summary.timers.at("particles");
  if (result.series.time.empty()) return false;
  draw_rockfall(folder, result);
  write_series(folder, result.series.time, columns_of(result.series));
  summary.metrics = {{"lowest_point_s", result.lowest_time},
                     {"depth_m", result.depth},
                     {"least_energy_s", result.least_energy_time},
                     {"rebound_energy_J", result.rebound_energy},
                     {"net_sag_before_m", result.settled_sag},
                     {"net_speed_before_m_s", result.settled_speed},
                     {"largest_cable_tension_N", result.largest_tension},
                     {"mean_dissipator_elongation_m", result.brake_elongation},
                     {"largest_dissipator_elongation_m", result.largest_brake_elongation},
                     {"largest_dissipator_force_N", result.brake_force},
                     {"dissipator_energy_J", result.brake_energy},
                     {"mean_ring_travel_m", result.mean_travel},
                     {"largest_ring_travel_m", result.largest_travel},
                     {"energy_lost_until_50_ms", result.lost_until_50_ms},
                     {"energy_lost_until_50_ms_of_centre", result.lost_until_50_ms_of_centre},
                     {"largest_overlap_of_radius", result.worst_overlap},
                     {"time_step_s", result.time_step}};
  if (result.interrupted) return false;
  summary.checks = rockfall_sanity(result, rockfall);
  if (result.as_in_paper)
    for (ResultCheck& c : rockfall_paper_checks(result)) summary.checks.push_back(std::move(c));
  if (!result.lost_links.empty())
    throw NumericalFailure("ring net", result.steps, "wires passed through each other: " + result.lost_links);
  return true;
}

}  // namespace lahar::cases
