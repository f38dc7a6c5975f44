#pragma once
// An entry of the ladder: one question with a known answer, asked of the same code that runs a scene.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace lahar::validate {

/// One figure held against its reference. `error` and `tolerance` are in one unit: a fraction unless the label names
/// one.
struct Row {
  std::string label;
  double value = 0, reference = 0, error = 0, tolerance = 0;
  bool pass = false;
};

/// |value - reference| / |reference| <= tolerance.
Row relative_row(std::string label, double value, double reference, double tolerance);
/// |value - reference| <= tolerance; name the unit in the label.
Row absolute_row(std::string label, double value, double reference, double tolerance);
/// value >= bar; `error` is what is missing, the tolerance 0.
Row at_least_row(std::string label, double value, double bar);
/// value <= bar; `error` is the value, `tolerance` the bar, the reference 0.
Row at_most_row(std::string label, double value, double bar);

enum class Precision { float32, float64 };

struct Context {
  Precision precision = Precision::float64;  ///< of entries that do not compare both
  bool quick = false;  ///< coarser grids and fewer steps, for the test suite; bars that need the full size are left out
  std::filesystem::path plots;  ///< where to draw charts; empty for none
};

struct Entry {
  std::string name;    ///< group.name, for example fluid.cavity_re1000
  std::string source;  ///< where the reference is from
  std::function<std::vector<Row>(const Context&)> run;
};

/// What an entry found.
struct Outcome {
  std::string name, source;
  std::vector<Row> rows;
  double seconds = 0;
  std::string failure;  ///< why it stopped before its end; empty otherwise
  [[nodiscard]] bool pass() const;
};

/// All entries, group by group in the order of the ladder.
std::vector<Entry> all_entries();

/// The entries that the names ask for: an entry's name, a group (fluid), or nothing for all. Throws
/// std::invalid_argument for a name that is none, with the nearest known one.
std::vector<Entry> select_entries(const std::vector<Entry>& entries, const std::vector<std::string>& names);

/// Runs an entry; what it throws becomes its failure.
Outcome run_entry(const Entry& entry, const Context& context);

/// Table for the terminal.
std::string outcome_text(const Outcome& outcome);
/// {"machine", "commit", "entries": [...]}; numbers that are not finite become null.
std::string outcomes_json(const std::vector<Outcome>& outcomes);

}  // namespace lahar::validate
