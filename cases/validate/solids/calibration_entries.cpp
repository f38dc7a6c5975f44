#include "cases/validate/solids/calibration_entries.h"

#include <cmath>

namespace lahar::validate {

std::vector<Row> rows_of(const std::vector<cases::ResultCheck>& checks, const std::string& prefix) {
  std::vector<Row> rows;
  for (const cases::ResultCheck& c : checks) {
    const double unit = c.reference == 0 ? 1.0 : std::abs(c.reference);
    rows.push_back({prefix + c.name, c.value, c.reference, std::abs(c.value - c.reference) / unit, c.tolerance / unit,
                    c.pass && std::isfinite(c.value)});
  }
  return rows;
}

std::vector<Entry> calibration_entries() {
  return {
      {"solids.ring_pull", "Li, Zhao & Kwan 2020, section 3.1; ring theory with shear", ring_pull},
      {"solids.energy_dissipator", "Li, Zhao & Kwan 2020, Eq. (1), section 3.2, Table 2", energy_dissipator},
      {"solids.rockfall", "Li, Zhao & Kwan 2020, section 3.3, Table 3, Fig. 7", rockfall},
      {"solids.net_at_rest", "energy balance; linking numbers", net_at_rest},
  };
}

}  // namespace lahar::validate
