#pragma once
// The checks of a procedure (cases/ring_pull and its like) as rows.
#include <string>
#include <vector>

#include "cases/runner/summary.h"
#include "cases/validate/entry.h"

namespace lahar::validate {

/// The tolerance is relative where the reference is not 0.
std::vector<Row> rows_of(const std::vector<cases::ResultCheck>& checks, const std::string& prefix);

}  // namespace lahar::validate
