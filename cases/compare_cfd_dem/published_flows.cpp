#include "cases/compare_cfd_dem/published_flows.h"

#include <cmath>
#include <utility>

#include "cases/compare_cfd_dem/study_case.h"
#include "cases/files/case_file.h"
#include "cases/validate/reference_table.h"
#include "core/check.h"

namespace lahar::study {

const std::vector<Flow>& published_flows() {
  static const std::vector<Flow> all = [] {
    const auto table = validate::ReferenceTable::read(cases::case_file("compare_cfd_dem/li2020_table5.csv"));
    std::vector<Flow> flows(table.size());
    constexpr std::pair<const char*, double Flow::*> columns[] = {
        {"L_m", &Flow::release}, {"Fr", &Flow::froude},  {"E_in_kJ", &Flow::e_in}, {"E_out_kJ", &Flow::e_out},
        {"E_d_kJ", &Flow::e_d},  {"E_b_kJ", &Flow::e_b}, {"eta", &Flow::eta},      {"zeta", &Flow::zeta}};
    for (const auto& [name, part] : columns) {
      const std::vector<double> numbers = table.numbers(name);
      for (std::size_t k = 0; k < flows.size(); ++k) flows[k].*part = numbers[k];
    }
    require(flows.size() == release_distances().size(), "li2020_table5.csv does not hold the paper's flows");
    return flows;
  }();
  return all;
}

const Flow* published(double release) {
  for (const Flow& f : published_flows())
    if (std::abs(f.release - release) < 1e-6) return &f;
  return nullptr;
}

}  // namespace lahar::study
