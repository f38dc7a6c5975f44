#include "cases/validate/wires_in_fluid/loss_of_screens.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "cases/validate/reference_table.h"

namespace lahar::validate {

double loss_of_screen(double solidity, double reynolds) {
  const ReferenceTable table = reference("screen_net.csv").where("quantity", "Blevins_beta");
  const std::vector<double> re = table.numbers("Re"), beta = table.numbers("value");
  std::size_t k = 0;
  while (k + 2 < re.size() && reynolds > re[k + 1]) ++k;
  const double share = std::clamp(std::log(reynolds / re[k]) / std::log(re[k + 1] / re[k]), 0.0, 1.0);
  const double open = 1 - solidity;
  return (beta[k] + share * (beta[k + 1] - beta[k])) * (1 - open * open) / (open * open);
}

}  // namespace lahar::validate
