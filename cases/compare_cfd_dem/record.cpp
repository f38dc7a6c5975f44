#include "cases/compare_cfd_dem/record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "cases/files/output_file.h"
#include "cases/files/text_file.h"
#include "cases/runner/messages.h"

namespace lahar::study {

namespace {

constexpr double kRowInterval = 0.01;  // s
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// The first row, then each that comes at least an interval after the one before, and the last.
std::vector<std::size_t> kept_rows(const std::vector<double>& time) {
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < time.size(); ++k)
    if (rows.empty() || time[k] >= time[rows.back()] + kRowInterval * (1 - 1e-6) || k + 1 == time.size())
      rows.push_back(k);
  return rows;
}

std::string list_of(const std::vector<double>& values, const std::vector<std::size_t>& rows) {
  std::string text;
  for (const std::size_t k : rows) {
    text += text.empty() ? "" : ", ";
    text += std::isfinite(values[k]) ? fmt::format("{:.5g}", values[k]) : "null";
  }
  return "[" + text + "]";
}

/// Of values that are means since the row before: at kept rows the means since the kept row before.
std::vector<double> means_between(const std::vector<std::size_t>& rows, const std::vector<double>& time,
                                  std::vector<double> values) {
  for (std::size_t n = 1; n < rows.size(); ++n) {
    const std::size_t first = rows[n - 1], last = rows[n];
    if (last == first + 1) continue;
    double sum = 0;
    for (std::size_t k = first + 1; k <= last; ++k) sum += values[k] * (time[k] - time[k - 1]);
    values[last] = sum / (time[last] - time[first]);
  }
  return values;
}

std::vector<double> numbers_of(const nlohmann::json& list) {
  std::vector<double> numbers;
  for (const auto& item : list) numbers.push_back(item.is_null() ? kUnknown : item.get<double>());
  return numbers;
}

}  // namespace

void write_record(const CaseResult& result, const std::filesystem::path& folder) {
  const std::vector<std::size_t> rows = kept_rows(result.curves.time_s);
  std::string curves = fmt::format("  \"time_s\": {}", list_of(result.curves.time_s, rows));
  for (const auto& column : result.curves.columns) {
    const auto values = is_mean(column.name) ? means_between(rows, result.curves.time_s, column.values) : column.values;
    curves += fmt::format(",\n  \"{}\": {}", column.name, list_of(values, rows));
  }
  std::filesystem::create_directories(folder);
  cases::replace_text_file(
      folder / (result.study_case.name() + ".json"),
      fmt::format("{{\n\"ended\": \"{}\",\n\"summary\": {},\n\"values\": {},\n\"curves\": {{\n{}\n}}\n}}\n",
                  result.ended, nlohmann::ordered_json::parse(result.summary).dump(1),
                  nlohmann::json(result.values).dump(1), curves));
}

CaseResult read_record(const StudyCase& study_case, const std::filesystem::path& file) {
  CaseResult result;
  result.study_case = study_case;
  try {
    const auto record = nlohmann::ordered_json::parse(cases::read_text_file(file));
    take_summary(result, record.at("summary").dump(1), file);
    result.ended = record.value("ended", "");
    record.at("values").get_to(result.values);
    const auto& curves = record.at("curves");
    result.curves.time_s = numbers_of(curves.at("time_s"));
    for (const ShownColumn& shown : shown_columns()) {
      if (!curves.contains(shown.name)) continue;
      result.curves.columns.push_back({shown.name, "", "", numbers_of(curves.at(shown.name))});
      if (result.curves.columns.back().values.size() != result.curves.time_s.size())
        throw cases::FileError(file, shown.name + " has not as many values as there are times");
    }
    // What quantities are asked for since, of what was kept: of the scene's grains only the mass.
    CaseRun kept{study_case, metrics_of(result.summary, file), kUnknown, kUnknown, result.curves};
    kept.grain_mass =
        mass_by_energies(result.value("e_in"), result.value("e_in_lower")) - kept.metric("liquid_mass_start_kg");
    for (const auto& [name, value] : result_of(kept).values) result.values.emplace(name, value);
  } catch (const nlohmann::json::exception&) {
    throw cases::FileError(file, "not the record of a case");
  }
  return result;
}

std::vector<CaseResult> read_records(const std::filesystem::path& folder) {
  std::vector<CaseResult> results;
  if (!std::filesystem::is_directory(folder)) return results;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (const auto study_case = case_named(entry.path().stem().string(), {});
        study_case && entry.path().extension() == ".json")
      results.push_back(read_record(*study_case, entry.path()));
  std::sort(results.begin(), results.end(),
            [](const CaseResult& a, const CaseResult& b) { return comes_before(a.study_case, b.study_case); });
  return results;
}

std::vector<CaseResult> share(std::vector<CaseResult> results, const std::filesystem::path& folder) {
  for (CaseResult& former : read_records(folder)) {
    const auto here = std::find_if(results.begin(), results.end(),
                                   [&](const CaseResult& c) { return c.study_case == former.study_case; });
    if (here == results.end()) {
      results.push_back(std::move(former));
      continue;
    }
    if (former.commit == here->commit) continue;
    const std::string name = former.study_case.name();
    if (!here->ended.empty() && former.ended > here->ended) {
      cases::tell(fmt::format("warning: the record of {}, of commit {}, stays: the run here, of commit {}, is older\n",
                              name, former.commit, here->commit));
      *here = std::move(former);
    } else {
      cases::tell(
          fmt::format("warning: the record of {} was of commit {}, is now of {}\n", name, former.commit, here->commit));
    }
  }
  for (const CaseResult& c : results)
    if (!c.folder.empty()) write_record(c, folder);
  return results;
}

}  // namespace lahar::study
