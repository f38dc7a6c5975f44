// A sphere meets a rigid plate head-on, without loss: test 2 of Chung & Ooi (2011, Granular Matter 13:643-656).
#include "cases/validate/dem/elastic_impact.h"

namespace lahar::validate {
namespace {

std::vector<Row> run(const Context&) {
  return elastic_rows({
      {"aluminium alloy",
       "ChungOoi2_AlAlloy (r=0.1m,0.2 m/s, rigid wall)",
       {.radius = 0.1, .density = 2699, .youngs_modulus = 70e9, .poisson_ratio = 0.30, .speed = 0.2, .pair = false}},
      {"magnesium alloy",
       "ChungOoi2_MgAlloy",
       {.radius = 0.1, .density = 1800, .youngs_modulus = 40e9, .poisson_ratio = 0.35, .speed = 0.2, .pair = false}},
  });
}

}  // namespace

Entry elastic_impact_on_plate() {
  return {"dem.elastic_impact_on_plate",
          {"Hertz; Chung & Ooi 2011, Granular Matter 13:643, test 2", {"dem_hertz.csv"}},
          run};
}

}  // namespace lahar::validate
