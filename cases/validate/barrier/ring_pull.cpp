// A ring pulled open between two beads to 200 mm: is the curve that of a ring, does it depend on how fast it is pulled
// or on the number of beads, and where does it turn (paper: 140 mm)?
#include "cases/ring_pull/ring_pull.h"

#include "cases/ring_pull/report.h"
#include "cases/validate/barrier/result_rows.h"

namespace lahar::validate {

namespace {

void add_independent_figures(std::vector<Row>& rows, const cases::PullCurve& curve) {
  // A throw-away code written beforehand, with its own bonds and its own speed; figures as it printed them.
  for (const auto& [mm, kilonewton] : {std::pair{20, 0.38}, {80, 1.99}, {140, 6.5}, {160, 13.2}, {180, 155.0}})
    rows.push_back(relative_row("force at " + std::to_string(mm) + " mm, kN, against an independent code",
                                1e-3 * curve.force_at(1e-3 * mm), kilonewton, 0.02));
}

std::vector<Row> run(const Context& context) {
  cases::RingPull ring;
  const cases::PullCurve curve = cases::pull_ring(ring);
  if (!context.plots.empty()) cases::draw_ring_pull(context.plots, curve, ring);
  std::vector<Row> rows = rows_of(cases::ring_pull_checks(curve, ring), "");
  add_independent_figures(rows, curve);
  const cases::Transition turn = cases::transition_of(curve, ring);
  rows.push_back(relative_row("tangents of both ends cross, m, against straight without stretching",
                              turn.tangents_cross, cases::straight_displacement(ring), 0.01));

  cases::RingPull slow = ring;
  slow.speed *= 0.5;
  rows.push_back(at_most_row("half the speed: largest change of the force",
                             cases::largest_difference(curve, cases::pull_ring(slow), ring.stroke), 0.03));
  if (context.quick) return rows;
  cases::RingPull fine = ring;
  fine.beads = 120;
  fine.speed = 0.5;  // the row above says what that changes
  rows.push_back(at_most_row("120 beads: largest change of the force",
                             cases::largest_difference(curve, cases::pull_ring(fine), ring.stroke), 0.05));
  return rows;
}

}  // namespace

Entry ring_pull() { return {"barrier.ring_pull", {"Li, Zhao & Kwan 2020, section 3.1; ring theory with shear"}, run}; }

}  // namespace lahar::validate
