#include "cases/validate/outcome_table.h"

#include <fmt/format.h>

#include "cases/runner/machine.h"

namespace lahar::validate {
namespace {

/// A bar in a cell of a table would end the cell.
std::string cell_text(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '|') safe += '\\';
    safe += c == '\n' ? ' ' : c;
  }
  return safe;
}

std::string entry_markdown(const Outcome& o) {
  std::string text =
      fmt::format("\n## {}\n{}; {:.0f} s; {}.\n", o.name, o.pass() ? "Reached" : "**Short**", o.seconds, o.source);
  if (!o.failure.empty()) text += "\nStopped: " + o.failure + "\n";
  if (o.rows.empty()) return text;
  text += "\n| Row | Value | Reference | Error | Tolerance | |\n|---|---|---|---|---|---|\n";
  for (const Row& r : o.rows)
    text += fmt::format("| {} | {:.5g} | {:.5g} | {:.3g} | {:.3g} | {} |\n", cell_text(r.label), r.value, r.reference,
                        r.error, r.tolerance, r.pass ? "" : "**short**");
  return text;
}

}  // namespace

std::string outcomes_markdown(const std::vector<Outcome>& outcomes, const Context& context) {
  std::size_t reached = 0;
  for (const Outcome& o : outcomes) reached += o.pass();
  std::string text =
      fmt::format("Written by `bin/validate{} --table`. {}, commit {}. {} of {} entries reach their bars.\n",
                  context.quick ? " --quick" : "", cases::machine_name(), cases::commit(), reached, outcomes.size());
  for (const Outcome& o : outcomes) text += entry_markdown(o);
  return text;
}

}  // namespace lahar::validate
