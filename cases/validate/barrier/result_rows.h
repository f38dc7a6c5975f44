#pragma once
// The checks of a procedure (cases/ring_pull and its like) as rows.
#include <string>
#include <vector>

#include "cases/runner/summary.h"
#include "cases/validate/entry.h"

namespace lahar::validate {

/// Rows of the same outcome: no more than the tolerance where the reference is 0, at least the reference where there is
/// no tolerance, else near it.
std::vector<Row> rows_of(const std::vector<cases::ResultCheck>& checks, const std::string& prefix);

}  // namespace lahar::validate
