#pragma once
// Scenes that break codes of this kind: the twenty of hard_cases.csv and those on which Lahar itself once failed. A
// case is a set of entries of the ladder (bin/validate); it is passed where all their rows reach their bars.
#include <string>
#include <vector>

#include "cases/validate/entry.h"

namespace lahar::validate {

struct HardCase {
  std::string id;         ///< H1 to H20: a row of hard_cases.csv; L1 and on: found here
  std::string question;   ///< what is run
  std::string criterion;  ///< when it counts as passed; the entries' bars are these or tighter, where they say so
  std::vector<std::string> entries;
};

/// In order of their ids.
std::vector<HardCase> hard_cases();

/// Those that the ids ask for, all where there are none. Throws std::invalid_argument for an id that is none.
std::vector<HardCase> select_hard_cases(const std::vector<std::string>& ids);

struct HardCaseResult {
  HardCase hard_case;
  std::vector<Outcome> outcomes;  ///< of its entries
  [[nodiscard]] bool pass() const;
  [[nodiscard]] double seconds() const;
};

/// Runs its entries.
HardCaseResult run_hard_case(const HardCase& hard_case, const Context& context);

/// A line for the terminal, and one for each row that falls short or entry that stopped.
std::string result_text(const HardCaseResult& result);

/// The table's name and columns; seconds are those of the entry.
inline constexpr const char* kHardCasesTable = "hard_cases.csv";
inline constexpr const char* kHardCasesColumns =
    "id,case,criterion,entry,row,value,reference,error,tolerance,pass,seconds";

/// Machine, commit, date, form and precision, then the columns, then a row for each row of an entry; notes have "-" for
/// what they lack.
std::string results_csv(const std::vector<HardCaseResult>& results, const Context& context, const std::string& date);

}  // namespace lahar::validate
