#pragma once
// The paper's ten flows: Li, Zhao & Kwan 2020, Table 5.
#include <vector>

namespace lahar::study {

/// A row of the table, by release distance.
struct Flow {
  double release, froude, e_in, e_out, e_d, e_b, eta, zeta;  ///< m, 1, kJ, kJ, kJ, kJ, 1, 1
};
/// Of li2020_table5.csv.
const std::vector<Flow>& published_flows();
/// The flow of a release distance, if the paper has it.
const Flow* published(double release);

}  // namespace lahar::study
