#pragma once
// An entry of the ladder: one question with a known answer, asked of the same code that runs a scene. A file of
// cases/validate/<group> exports one entry; entries.txt lists the files.
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace lahar::validate {

/// One figure held against its reference.
struct Row {
  std::string label;
  double value = 0, reference = 0;
  double error = 0, tolerance = 0;  ///< fractions of the reference, or
  bool pass = false;                ///< error <= tolerance, but for notes
  bool note = false;                ///< shown without a bar: neither reached nor missed
  bool absolute = false;            ///< error and tolerance are in the value's own unit
};

/// |value - reference| / |reference| <= tolerance.
Row relative_row(std::string label, double value, double reference, double tolerance);
/// |value - reference| <= tolerance.
Row absolute_row(std::string label, double value, double reference, double tolerance);
/// value >= bar; `error` is what is missing, the tolerance 0.
Row at_least_row(std::string label, double value, double bar);
/// value <= bar; `error` is the value, `tolerance` the bar, the reference 0.
Row at_most_row(std::string label, double value, double bar);
/// A value without a bar, perhaps beside a reference: error and tolerance are not numbers. A value that is not a number
/// is no note but a miss.
Row note_row(std::string label, double value, double reference = std::numeric_limits<double>::quiet_NaN());

enum class Precision { float32, float64 };
/// As on the command line: float, double.
const char* name_of(Precision precision);

struct Context {
  Precision precision = Precision::float64;  ///< of entries that do not compare both
  bool quick = false;  ///< coarser grids and fewer steps, for the test suite; bars that need the full size are left out
  std::filesystem::path plots;  ///< where to draw charts; empty for none
};

/// Runs a templated question in the precision that the context asks for: ask.operator()<float>() or <double>().
template <class Ask>
auto in_precision(const Context& context, const Ask& ask) {
  return context.precision == Precision::float32 ? ask.template operator()<float>() : ask.template operator()<double>();
}

/// Where a reference is from.
struct Source {
  std::string text;                     ///< author and year, or the law
  std::vector<std::string> files = {};  ///< of cases/validate/reference, whose first lines give the provenance

  /// The text, then the files in brackets.
  [[nodiscard]] std::string line() const;
};

struct Entry {
  std::string name;  ///< group.name, for example fluid.cavity_re1000; group and name are those of its file
  Source source;
  std::function<std::vector<Row>(const Context&)> run;
  std::string alias = {};  ///< another name that asks for it (entries.txt)
};

/// What an entry found.
struct Outcome {
  std::string name, alias, source;
  std::vector<Row> rows;
  double seconds = 0;
  std::string failure;  ///< why it stopped before its end; empty otherwise
  /// Rows with a bar, and those of them that reach it.
  [[nodiscard]] std::size_t asked() const;
  [[nodiscard]] std::size_t reached() const;
  /// Something was asked, all of it is reached, and nothing failed.
  [[nodiscard]] bool pass() const;
};

/// All entries in the order of entries.txt, from which the build makes this function.
std::vector<Entry> all_entries();

/// The entries that the names ask for: an entry's name or alias, the group of either (fluid), or nothing for all.
/// Throws std::invalid_argument for a name that is none, with the nearest known one.
std::vector<Entry> select_entries(const std::vector<Entry>& entries, const std::vector<std::string>& names);

/// Runs an entry; what it throws becomes its failure.
Outcome run_entry(const Entry& entry, const Context& context);

/// Reference, error or tolerance of a row in so many digits; "-" where a note has none.
std::string figure_text(const Row& row, double figure, int digits);
/// Table for the terminal.
std::string outcome_text(const Outcome& outcome);
/// A field of a table of results (CSV), in double quotes where it needs them. A row stays one line: line ends become
/// "; ".
std::string csv_field(std::string text);
/// {"machine", "commit", "precision", "quick", "entries": [...]}; numbers that are not finite become null. Rows that
/// are notes pass, with neither error nor tolerance, and have "note": true.
std::string outcomes_json(const std::vector<Outcome>& outcomes, const Context& context);
/// Whether a text is what outcomes_json writes.
bool is_outcomes_json(const std::string& text);

}  // namespace lahar::validate
