#include "cases/validate/reference_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>

#include "cases/files/case_file.h"
#include "core/check.h"

namespace lahar::validate {

void ReferenceTable::refuse(int line, int column, const std::string& why) const {
  throw InputError(std::vector<InputMistake>{{file_, line, column, why}});
}

ReferenceTable ReferenceTable::read(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  if (!in || !(text << in.rdbuf()))
    throw InputError(std::vector<InputMistake>{{file.string(), 0, 0, "cannot be read, expected a table"}});
  return parse(text.str(), file.string());
}

ReferenceTable ReferenceTable::parse(const std::string& text, const std::string& file) {
  ReferenceTable table;
  table.file_ = file;
  std::istringstream in(text);
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty()) continue;
    if (line.front() == '#') {
      if (table.names_.number > 0) table.refuse(number, 1, "remark among the rows, expected all of them at the start");
      table.provenance_.push_back(line.substr(std::min(line.find_first_not_of("# "), line.size())));
    } else if (table.names_.number == 0) {
      table.names_ = table.fields_of(line, number);
    } else {
      table.lines_.push_back(table.fields_of(line, number));
      if (const std::size_t found = table.lines_.back().fields.size(); found != table.names_.fields.size())
        table.refuse(number, 1, fmt::format("{} fields, expected {}", found, table.names_.fields.size()));
    }
  }
  if (table.provenance_.empty()) table.refuse(1, 1, "no provenance, expected lines that begin with #");
  if (table.lines_.empty()) table.refuse(number, 1, "no rows");
  return table;
}

ReferenceTable::Line ReferenceTable::fields_of(const std::string& text, int number) const {
  Line line{number, {{"", 1}}};
  bool quoted = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const bool quote = text[k] == '"';
    if (quote && quoted && k + 1 < text.size() && text[k + 1] == '"') {
      line.fields.back().text += text[++k];
    } else if (quote) {
      quoted = !quoted;
    } else if (text[k] == ',' && !quoted) {
      line.fields.push_back({"", static_cast<int>(k) + 2});
    } else {
      line.fields.back().text += text[k];
    }
  }
  if (quoted) refuse(number, line.fields.back().column, "a quote that is not closed");
  return line;
}

std::size_t ReferenceTable::column_of(const std::string& name) const {
  const auto found =
      std::find_if(names_.fields.begin(), names_.fields.end(), [&](const Field& f) { return f.text == name; });
  if (found == names_.fields.end()) refuse(names_.number, 1, fmt::format("no column \"{}\"", name));
  return static_cast<std::size_t>(found - names_.fields.begin());
}

double ReferenceTable::number_in(const Line& line, std::size_t column) const {
  const Field& field = line.fields[column];
  double value = 0;
  const char* const end = field.text.data() + field.text.size();
  if (const auto [last, error] = std::from_chars(field.text.data(), end, value); error != std::errc() || last != end)
    refuse(line.number, field.column,
           fmt::format("{} is \"{}\", expected a number", names_.fields[column].text, field.text));
  return value;
}

ReferenceTable ReferenceTable::where(const std::string& column, const std::string& text) const {
  const std::size_t at = column_of(column);
  ReferenceTable table = *this;
  std::erase_if(table.lines_, [&](const Line& line) { return line.fields[at].text != text; });
  if (table.lines_.empty())
    refuse(names_.number, names_.fields[at].column, fmt::format("no row whose {} is \"{}\"", column, text));
  return table;
}

std::vector<double> ReferenceTable::numbers(const std::string& column) const {
  const std::size_t at = column_of(column);
  std::vector<double> values;
  for (const Line& line : lines_) values.push_back(number_in(line, at));
  return values;
}

std::vector<std::pair<double, double>> ReferenceTable::points(const std::string& x, const std::string& y) const {
  const std::vector<double> xs = numbers(x), ys = numbers(y);
  std::vector<std::pair<double, double>> pairs;
  for (std::size_t k = 0; k < xs.size(); ++k) pairs.emplace_back(xs[k], ys[k]);
  return pairs;
}

const ReferenceTable::Line& ReferenceTable::only_line(const std::string& column) const {
  if (lines_.size() != 1)
    refuse(names_.number, 1, fmt::format("{} rows to take \"{}\" from, expected one", lines_.size(), column));
  return lines_.front();
}

double ReferenceTable::number(const std::string& column) const {
  return number_in(only_line(column), column_of(column));
}

const std::string& ReferenceTable::text(const std::string& column) const {
  return only_line(column).fields[column_of(column)].text;
}

ReferenceTable reference(const std::string& file) {
  return ReferenceTable::read(cases::case_file("validate/reference") / file);
}

}  // namespace lahar::validate
