#include "cases/observers/quantity_tables.h"

#include <fmt/format.h>

#include <algorithm>

namespace lahar::cases {

namespace {

/// Rows in the order of their first appearance, none twice.
class Table {
 public:
  explicit Table(Naming naming) : naming_(naming) {}
  void add(const Label& label, const std::string& unit, const std::string& meaning) {
    const std::string& name = naming_ == Naming::names ? label.name : label.pattern;
    const std::string row = fmt::format("| `{}` | {} | {} |\n", name, unit, meaning);
    if (std::find(rows_.begin(), rows_.end(), row) == rows_.end()) rows_.push_back(row);
  }
  [[nodiscard]] std::string text(const std::string& head) const {
    std::string all = "| " + head + " | Unit | Meaning |\n|---|---|---|\n";
    for (const std::string& row : rows_) all += row;
    return all;
  }

 private:
  Naming naming_;
  std::vector<std::string> rows_;
};

}  // namespace

std::string quantity_tables(const std::vector<const Quantity*>& quantities, Naming naming) {
  Table columns(naming), metrics(naming);
  for (const Quantity* q : quantities) {
    if (q->is_column) columns.add(q->label, q->unit, q->meaning);
    for (const Metric& m : q->metrics) metrics.add(m.label, m.unit, m.meaning);
  }
  return columns.text("Column of `series.h5`") + "\n" + metrics.text("Metric of `summary.json`");
}

}  // namespace lahar::cases
