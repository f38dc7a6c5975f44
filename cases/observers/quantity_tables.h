#pragma once
// Tables of the quantities of a run: `lahar quantities`, docs/outputs.md.
#include <string>
#include <vector>

#include "cases/observers/quantity.h"

namespace lahar::cases {

/// Names as they stand in the files of this run, or as docs write them for all (Label).
enum class Naming { names, patterns };

/// Two Markdown tables: columns of series.h5 and metrics of summary.json. What is named alike stands once, with the
/// meanings of its kinds.
std::string quantity_tables(const std::vector<const Quantity*>& quantities, Naming naming);

}  // namespace lahar::cases
