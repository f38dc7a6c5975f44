#pragma once
// What a run of the ladder found, as a page of the documentation (docs/ladder).
#include <string>
#include <vector>

#include "cases/validate/entry.h"

namespace lahar::validate {

/// Markdown: machine and commit, how many entries reach their bars, and per entry a table of its rows with value,
/// reference, error and tolerance (entry.h, Row). Rows that miss their bar are marked **short**.
std::string outcomes_markdown(const std::vector<Outcome>& outcomes, const Context& context);

}  // namespace lahar::validate
