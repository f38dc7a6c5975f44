// A ring of a net pulled open between two beads (section 3.1 of Li, Zhao & Kwan 2020): force over displacement against
// the same ring of twice the beads, pulled at half the speed.
#include <fmt/format.h>

#include "cases/ring_pull/report.h"
#include "cases/ring_pull/ring_pull.h"
#include "cases/speed_error/problems/problems.h"
#include "cases/speed_error/reference_run.h"

namespace lahar::validate {

Problem ring_pull_problem(bool quick) {
  Problem p{"ring_pull",
            "largest error of the force from a tenth of the stroke on, of the force",
            "finest-grid (120 beads, 0.125 m/s)",
            "60 beads, 0.25 m/s, 0.6 of the critical time step",
            {}};
  const cases::RingPull standard;
  const ReferenceRun<cases::PullCurve> finest([standard, quick] {
    cases::RingPull ring = standard;
    ring.beads *= 2;
    if (!quick) ring.speed /= 2;
    return cases::pull_ring(ring);
  });
  const auto trial = [&](std::vector<Knob> turned, const cases::RingPull& ring) {
    return Trial{std::move(turned), [finest, ring] {
                   const cases::PullCurve& known = finest.result();
                   return timed([&] { return cases::largest_difference(known, cases::pull_ring(ring), ring.stroke); });
                 }};
  };
  p.trials.push_back(trial({}, standard));
  for (const std::int64_t beads : {20, 36, 90}) {
    cases::RingPull r = standard;
    r.beads = beads;
    p.trials.push_back(trial({{"beads", fmt::to_string(beads)}}, r));
  }
  for (const double speed : {1.0, 0.5, 0.125}) {
    if (quick && speed < 0.5) continue;
    cases::RingPull r = standard;
    r.speed = speed;
    p.trials.push_back(trial({{"speed_m_s", fmt::to_string(speed)}}, r));
  }
  for (const double safety : {0.8, 0.3}) {
    cases::RingPull r = standard;
    r.safety = safety;
    p.trials.push_back(trial({{"bond_safety", fmt::to_string(safety)}}, r));
  }
  return p;
}

}  // namespace lahar::validate
