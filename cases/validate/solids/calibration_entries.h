#pragma once
// Entries of the barrier's calibration (Li, Zhao & Kwan 2020, section 3) and of its net left to itself, one file each.
#include <string>
#include <vector>

#include "cases/runner/summary.h"
#include "cases/validate/entry.h"

namespace lahar::validate {

std::vector<Row> ring_pull(const Context& context);
std::vector<Row> energy_dissipator(const Context& context);
std::vector<Row> rockfall(const Context& context);
std::vector<Row> net_at_rest(const Context& context);

/// The checks of a procedure as rows, the tolerance relative where the reference is not 0.
std::vector<Row> rows_of(const std::vector<cases::ResultCheck>& checks, const std::string& prefix);

/// All entries of this header.
std::vector<Entry> calibration_entries();

}  // namespace lahar::validate
