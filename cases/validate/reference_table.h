#pragma once
// Reference data: the tables of cases/validate/reference, read at run time. A file begins with lines `# ...` that say
// where its numbers are from, how they are scaled and how far to trust them; then a line with the names of the columns;
// then one line a row, fields in double quotes where they hold a comma.
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace lahar::validate {

class ReferenceTable {
 public:
  /// Throws InputError with file, line and column where the text is no such table.
  static ReferenceTable read(const std::filesystem::path& file);
  static ReferenceTable parse(const std::string& text, const std::string& file);

  /// The first lines, without `# `.
  [[nodiscard]] const std::vector<std::string>& provenance() const { return provenance_; }
  [[nodiscard]] std::size_t size() const { return lines_.size(); }

  // The following throw InputError: a column or row that is missing, a field that is no number.

  /// The rows whose field in this column is this text.
  [[nodiscard]] ReferenceTable where(const std::string& column, const std::string& text) const;
  [[nodiscard]] std::vector<double> numbers(const std::string& column) const;
  /// Pairs of two columns.
  [[nodiscard]] std::vector<std::pair<double, double>> points(const std::string& x, const std::string& y) const;
  /// Of a table of one row.
  [[nodiscard]] double number(const std::string& column) const;
  [[nodiscard]] const std::string& text(const std::string& column) const;

 private:
  struct Field {
    std::string text;
    int column = 0;  ///< where it begins, from 1
  };
  struct Line {
    int number = 0;  ///< from 1
    std::vector<Field> fields;
  };

  [[noreturn]] void refuse(int line, int column, const std::string& why) const;
  [[nodiscard]] Line fields_of(const std::string& text, int number) const;
  [[nodiscard]] const Line& only_line(const std::string& column) const;
  [[nodiscard]] std::size_t column_of(const std::string& name) const;
  [[nodiscard]] double number_in(const Line& line, std::size_t column) const;

  std::string file_;
  std::vector<std::string> provenance_;
  Line names_;
  std::vector<Line> lines_;
};

/// A table of cases/validate/reference.
ReferenceTable reference(const std::string& file);

}  // namespace lahar::validate
