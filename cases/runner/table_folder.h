#pragma once
// Folders of studies that end in a table: what a former sitting found is not replaced unasked.
#include <filesystem>
#include <string>

namespace lahar::cases {

/// Whether a file is a table (CSV, after comment lines that begin with #) whose line of column names is `columns`.
bool holds_table(const std::filesystem::path& file, const std::string& columns);

/// Makes the folder of `--out` ready for a study. Creates it if it is not there. If it is there and not empty, it must
/// hold the table of a former sitting, a file of this name with these columns, and `overwrite` must be set; nothing is
/// removed. Throws InputError otherwise.
void prepare_table_folder(const std::filesystem::path& folder, const std::string& table, const std::string& columns,
                          bool overwrite);

}  // namespace lahar::cases
