// A sphere of glass meets its like at 10 m/s (Chung & Ooi 2011, test 1): force, overlap and duration against Hertz.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/speed_error/problems/problems.h"
#include "cases/validate/dem/impact.h"
#include "cases/validate/reference_table.h"

namespace lahar::validate {

namespace {

constexpr int kImpacts = 200;  // one takes too little time to be measured

ImpactSpec glass() {
  return {.radius = 0.01, .density = 2800, .youngs_modulus = 48e9, .poisson_ratio = 0.20, .speed = 10, .pair = true};
}

/// Largest of the errors of force, overlap and duration, of a sphere as stiff as glass.
double error_of(const ImpactSpec& spec) {
  Impact found;
  for (int k = 0; k < kImpacts; ++k) found = run_impact(spec);
  const ReferenceTable known = reference("dem_hertz.csv").where("case", "ChungOoi1_glass (2 spheres r=10mm, +-10 m/s)");
  const auto error = [&](double value, const char* column, double unit) {
    return std::abs(value / (unit * known.number(column)) - 1);
  };
  return std::max({error(found.max_force, "F_max_N", 1), error(found.max_overlap, "delta_max_um", 1e-6),
                   error(found.duration, "duration_us", 1e-6)});
}

}  // namespace

Problem elastic_impact_problem(bool quick) {
  Problem p{"elastic_impact",
            "largest of the errors of force, overlap and duration",
            "exact (Hertz)",
            "contact_safety 0.14, full stiffness, Hertz-Mindlin",
            {}};
  const auto trial = [](std::vector<Knob> turned, const ImpactSpec& spec) {
    return Trial{std::move(turned), [spec] { return timed([&] { return error_of(spec); }); }};
  };
  p.trials.push_back(trial({}, glass()));
  for (const double safety : {0.05, 0.2, 0.3, 0.5}) {
    ImpactSpec spec = glass();
    spec.step_share = safety / 0.14;
    p.trials.push_back(trial({{"contact_safety", fmt::to_string(safety)}}, spec));
  }
  for (const double scale : {0.1, 0.01}) {
    if (quick && scale < 0.1) continue;
    ImpactSpec spec = glass();
    spec.youngs_modulus *= scale;
    p.trials.push_back(trial({{"contact_modulus_scale", fmt::to_string(scale)}}, spec));
  }
  return p;
}

}  // namespace lahar::validate
