// A column of water collapses over a dry bed that slips: Martin & Moyce 1952, n^2 = 2. The zero of their time is
// uncertain, so the front is compared after the shift in time that fits best.
#include <fmt/format.h>

#include "cases/speed_error/problems/problems.h"
#include "cases/validate/free_surface/dam_break.h"

namespace lahar::validate {

namespace {

Trial trial(std::vector<Knob> turned, const DamBreak& dam, bool double_precision = false) {
  return {
      std::move(turned), [dam, double_precision] {
        return timed([&] {
          return compare_front(double_precision ? run_dam_break<double>(dam) : run_dam_break<float>(dam)).shifted_rms;
        });
      }};
}

}  // namespace

Problem dam_break_problem(bool quick) {
  Problem p{"dam_break",
            "RMS of the error of the front's place, of its place",
            "measured (Martin & Moyce 1952)",
            "20 cells a column width, 0.1 lu, no eddy viscosity, fixed step, float",
            {}};
  DamBreak standard;
  standard.width = 20;
  p.trials.push_back(trial({}, standard));
  for (const int cells : {10, 14, 28, 40}) {
    if (quick && cells > 14) continue;
    DamBreak d = standard;
    d.width = cells;
    p.trials.push_back(trial({{"cells", fmt::to_string(cells)}}, d));
  }
  for (const double speed : {0.2, 0.05, 0.025}) {
    if (quick && speed < 0.05) continue;
    DamBreak d = standard;
    d.lattice_velocity = speed;
    p.trials.push_back(trial({{"lattice_velocity", fmt::to_string(speed)}}, d));
  }
  for (const double cs : {0.1, 0.16}) {
    DamBreak d = standard;
    d.smagorinsky = cs;
    p.trials.push_back(trial({{"smagorinsky", fmt::to_string(cs)}}, d));
  }
  DamBreak d = standard;
  d.slip = false;
  p.trials.push_back(trial({{"slip", "no_slip"}}, d));
  d = standard;
  d.adaptive = true;
  p.trials.push_back(trial({{"adaptive_time_step", "true"}}, d));
  p.trials.push_back(trial({{"precision", "double"}}, standard, true));
  return p;
}

}  // namespace lahar::validate
