#include "cases/validate/barrier/result_rows.h"

#include <cmath>

#include "core/check.h"

namespace lahar::validate {

namespace {

/// A check without a tolerance asks for its reference at least.
Row row_of(const std::string& label, const cases::ResultCheck& c) {
  if (c.reference == 0) return at_most_row(label, c.value, c.tolerance);
  if (c.tolerance == 0) return at_least_row(label, c.value, c.reference);
  return relative_row(label, c.value, c.reference, c.tolerance / std::abs(c.reference));
}

}  // namespace

std::vector<Row> rows_of(const std::vector<cases::ResultCheck>& checks, const std::string& prefix) {
  std::vector<Row> rows;
  for (const cases::ResultCheck& c : checks) {
    rows.push_back(row_of(prefix + c.name, c));
    require(rows.back().pass == c.pass, "rows_of: row and check disagree");
  }
  return rows;
}

}  // namespace lahar::validate
