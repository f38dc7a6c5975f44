#include "cases/validate/barrier/result_rows.h"

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

}  // namespace lahar::validate
