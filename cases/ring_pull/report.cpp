#include "cases/ring_pull/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/procedure/curves.h"
#include "cases/runner/interrupt.h"
#include "core/timers.h"
#include "core/worst.h"

namespace lahar::cases {

namespace {

ResultCheck within(const std::string& name, double value, double reference, double tolerance, const char* source) {
  return {name, value, reference, tolerance, std::abs(value - reference) <= tolerance, source};
}

/// m, 5 mm of a ring of 0.3 m: inertia spoils anything nearer to the start.
double first_secant(const RingPull& ring) { return ring.perimeter / 188.5; }

/// Stiffness at no displacement, from the secants at this displacement and twice it.
double measured_first_stiffness(const PullCurve& curve, const RingPull& ring) {
  const double d = first_secant(ring);
  return 2 * curve.force_at(d) / d - curve.force_at(2 * d) / (2 * d);
}

double worst_imbalance(const PullCurve& curve) {
  double worst = 0;
  for (std::size_t k = curve.force.size() / 10; k < curve.force.size(); ++k)
    keep_worst(worst, std::abs(curve.force[k] - curve.anchor_force[k]) / curve.force[k]);
  return worst;
}

void print_curve(const PullCurve& curve, const RingPull& ring) {
  fmt::print("  displacement   force\n");
  for (int k = 1; k <= 10; ++k) {
    const double d = 0.1 * k * ring.stroke;
    fmt::print("  {:7.1f} mm  {:9.3f} kN\n", 1e3 * d, 1e-3 * curve.force_at(d));
  }
}

}  // namespace

std::vector<ResultCheck> ring_pull_checks(const PullCurve& curve, const RingPull& ring) {
  constexpr const char* theory = "ring theory with shear (Timoshenko 1955)";
  const double first = first_stiffness(ring), last = last_stiffness(ring), end = curve.displacement.back();
  std::vector<ResultCheck> checks{
      within("ledger_gap", std::abs(curve.ledger_gap) / curve.work, 0, 1e-3, "energy balance")};
  const bool far_enough = ring.stroke >= 2.5 * first_secant(ring);  // else inertia is all there is
  constexpr std::int64_t smooth = 24;                               // beads; theory knows a round ring
  if (far_enough && ring.beads >= smooth)
    checks.push_back(within("first_stiffness_N_m", measured_first_stiffness(curve, ring), first, 0.02 * first, theory));
  if (far_enough)
    checks.push_back(within("end_imbalance", worst_imbalance(curve), 0, 0.01,
                            "both ends carry the same force where it is quasi-static"));
  if (ring.beads >= smooth && ring.stroke > 1.15 * straight_displacement(ring)) {
    checks.push_back(within("last_stiffness_N_m", curve.slope(0.97 * end, end), last, 0.02 * last,
                            "two straight strands: 4 EA / perimeter"));
    if (as_in_paper(ring))
      checks.push_back(within("transition_tenfold_tangent_m", transition_of(curve, ring).tenfold_tangent,
                              paper_transition, 0.01, "Li, Zhao & Kwan 2020, section 3.1: about 140 mm"));
  }
  return checks;
}

double largest_difference(const PullCurve& a, const PullCurve& b, double stroke) {
  double worst = 0;
  for (int k = 10; k < 100; ++k) {
    const double d = 0.01 * k * stroke;
    keep_worst(worst, std::abs(a.force_at(d) - b.force_at(d)) / a.force_at(d));
  }
  return worst;
}

void draw_ring_pull(const std::filesystem::path& folder, const PullCurve& curve, const RingPull& ring) {
  const ChartSeries line = scaled_line("ring", curve.displacement, curve.force, 1e3, 1e-3);
  const double straight = 1e3 * straight_displacement(ring);
  const ChartGuide in_paper{1e3 * paper_transition, "paper: end of the first stage"};
  const ChartGuide unstretched{straight, "straight without stretching"};
  const Axis displacement{.label = "displacement", .unit = "mm"}, force{.label = "force", .unit = "kN"};
  Chart chart{.title = "Ring pulled open", .x = displacement, .y = force, .series = {line}, .x_guides = {unstretched}};
  if (as_in_paper(ring)) chart.x_guides = {in_paper, unstretched};
  chart.write_all(folder / "ring_pull.png");
  ChartSeries first{.name = "ring"}, theory{.name = "theory of small displacements", .dash = Dash::dashed};
  for (std::size_t k = 0; k < line.x.size() && line.x[k] < 0.95 * straight; ++k) {
    first.x.push_back(line.x[k]), first.y.push_back(line.y[k]);
    theory.x.push_back(line.x[k]), theory.y.push_back(1e-6 * first_stiffness(ring) * line.x[k]);
  }
  Chart{.title = "Ring pulled open: first stage", .x = displacement, .y = force, .series = {first, theory}}.write_all(
      folder / "ring_pull_first_stage.png");
}

bool run_ring_pull(const RingPull& ring, const std::filesystem::path& folder, bool quiet, Summary& summary) {
  Timers timers;
  PullCurve curve;
  {
    const ScopedTimer timer(timers.section("pull"));
    curve = pull_ring(ring, [] { return !interrupted(); });
  }
  write_series(folder, curve.time,
               {{"displacement_m", "m", "of the pulled bead", curve.displacement},
                {"force_N", "N", "at the pulled bead", curve.force},
                {"anchor_force_N", "N", "at the held bead", curve.anchor_force},
                {"axial_energy_J", "J", "in the bonds", curve.axial},
                {"shear_energy_J", "J", "in the bonds", curve.shear},
                {"bending_energy_J", "J", "in the bonds", curve.bending}});
  summary.simulated_seconds = static_cast<double>(curve.steps) * curve.time_step;
  summary.timers = timers.seconds();
  const double work = static_cast<double>(curve.steps) * static_cast<double>(ring.beads);
  summary.performance.dem_particle_steps_per_second = work / summary.timers.at("pull");
  if (curve.interrupted) return false;
  draw_ring_pull(folder, curve, ring);
  const Transition t = transition_of(curve, ring);
  const WireStiffness wire = wire_stiffness(ring);
  summary.metrics = {{"largest_force_N", curve.force.back()},
                     {"work_J", curve.work},
                     {"transition_tenfold_tangent_m", t.tenfold_tangent},
                     {"transition_half_axial_m", t.half_axial},
                     {"transition_tangents_cross_m", t.tangents_cross},
                     {"straight_displacement_m", straight_displacement(ring)},
                     {"wire_axial_stiffness_N", wire.axial},
                     {"wire_bending_stiffness_N_m2", wire.bending},
                     {"wire_shear_stiffness_N", wire.shear},
                     {"time_step_s", curve.time_step}};
  summary.checks = ring_pull_checks(curve, ring);
  if (!quiet) print_curve(curve, ring);
  return true;
}

}  // namespace lahar::cases
