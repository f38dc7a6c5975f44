// Two equal spheres meet head-on, without loss: test 1 of Chung & Ooi (2011, Granular Matter 13:643-656).
#include "cases/validate/dem/elastic_impact.h"

namespace lahar::validate {
namespace {

std::vector<Row> run(const Context&) {
  return elastic_rows({
      {"glass",
       "ChungOoi1_glass (2 spheres r=10mm, +-10 m/s)",
       {.radius = 0.01, .density = 2800, .youngs_modulus = 48e9, .poisson_ratio = 0.20, .speed = 10, .pair = true}},
      {"limestone",
       "ChungOoi1_limestone",
       {.radius = 0.01, .density = 2500, .youngs_modulus = 20e9, .poisson_ratio = 0.25, .speed = 10, .pair = true}},
  });
}

}  // namespace

Entry elastic_impact_of_spheres() {
  return {"dem.elastic_impact_of_spheres",
          {"Hertz; Chung & Ooi 2011, Granular Matter 13:643, test 1", {"dem_hertz.csv"}},
          run};
}

}  // namespace lahar::validate
