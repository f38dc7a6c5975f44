#include "cases/validate/entry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "cases/runner/machine.h"
#include "cases/scene/names.h"
#include "core/timers.h"

namespace lahar::validate {

Row relative_row(std::string label, double value, double reference, double tolerance) {
  const double error = std::abs(value - reference) / std::abs(reference);
  return {std::move(label), value, reference, error, tolerance, error <= tolerance};
}

Row absolute_row(std::string label, double value, double reference, double tolerance) {
  const double error = std::abs(value - reference);
  return {.label = std::move(label),
          .value = value,
          .reference = reference,
          .error = error,
          .tolerance = tolerance,
          .pass = error <= tolerance,
          .absolute = true};
}

Row at_least_row(std::string label, double value, double bar) {
  return {.label = std::move(label),
          .value = value,
          .reference = bar,
          .error = std::isnan(value) ? value : std::max(0.0, bar - value),
          .tolerance = 0,
          .pass = value >= bar,
          .absolute = true};
}

Row at_most_row(std::string label, double value, double bar) {
  return {.label = std::move(label),
          .value = value,
          .reference = 0,
          .error = value,
          .tolerance = bar,
          .pass = value <= bar,
          .absolute = true};
}

Row note_row(std::string label, double value, double reference) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const bool known = std::isfinite(value);
  return {std::move(label), value, reference, none, none, known, known};
}

std::size_t Outcome::asked() const {
  return static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), [](const Row& r) { return !r.note; }));
}

std::size_t Outcome::reached() const {
  return static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [](const Row& r) { return !r.note && r.pass; }));
}

bool Outcome::pass() const { return failure.empty() && asked() > 0 && reached() == asked(); }

std::string Source::line() const {
  std::string text_and_files = text;
  for (const std::string& file : files) text_and_files += (&file == &files.front() ? " (" : ", ") + file;
  return files.empty() ? text : text_and_files + ")";
}

namespace {

std::string group_of(const std::string& name) { return name.substr(0, name.find('.')); }

[[noreturn]] void refuse(const std::vector<Entry>& entries, const std::string& name) {
  std::vector<std::string> known;
  for (const Entry& e : entries) {
    for (const std::string& known_name : {e.name, e.alias})
      if (!known_name.empty()) known.insert(known.end(), {known_name, group_of(known_name)});
  }
  const std::string nearest = scene::nearest_name(name, known);
  throw std::invalid_argument(
      fmt::format("no entry or group is called '{}'{}", name,
                  nearest.empty() ? "; --list shows all" : ", did you mean '" + nearest + "'?"));
}

nlohmann::json number(double x) { return std::isfinite(x) ? nlohmann::json(x) : nlohmann::json(nullptr); }

nlohmann::json row_json(const Row& r) {
  nlohmann::json row{{"label", r.label},         {"value", number(r.value)},         {"reference", number(r.reference)},
                     {"error", number(r.error)}, {"tolerance", number(r.tolerance)}, {"pass", r.pass}};
  if (r.note) row["note"] = true;
  if (r.absolute) row["absolute"] = true;
  return row;
}

}  // namespace

const char* name_of(Precision precision) { return precision == Precision::float32 ? "float" : "double"; }

std::vector<Entry> select_entries(const std::vector<Entry>& entries, const std::vector<std::string>& names) {
  const auto asks_for = [](const std::string& name, const Entry& e) {
    return name == e.name || name == e.alias || name == group_of(e.name) || name == group_of(e.alias);
  };
  for (const std::string& name : names)
    if (std::none_of(entries.begin(), entries.end(), [&](const Entry& e) { return asks_for(name, e); }))
      refuse(entries, name);
  std::vector<Entry> chosen;
  for (const Entry& e : entries)
    if (names.empty() || std::any_of(names.begin(), names.end(), [&](const auto& name) { return asks_for(name, e); }))
      chosen.push_back(e);
  return chosen;
}

Outcome run_entry(const Entry& entry, const Context& context) {
  Outcome outcome{
      .name = entry.name, .alias = entry.alias, .source = entry.source.line(), .rows = {}, .seconds = 0, .failure = {}};
  Timers timers;
  try {
    const ScopedTimer timer(timers.section("entry"));
    outcome.rows = entry.run(context);
  } catch (const std::exception& e) {
    outcome.failure = e.what();
  }
  outcome.seconds = timers.seconds().at("entry");
  return outcome;
}

std::string figure_text(const Row& row, double figure, int digits) {
  return row.note && std::isnan(figure) ? "-" : fmt::format("{:.{}g}", figure, digits);
}

std::string outcome_text(const Outcome& o) {
  std::string text = fmt::format("{} {}  ({:.1f} s; {})\n", o.pass() ? "pass " : "SHORT", o.name, o.seconds, o.source);
  for (const Row& r : o.rows)
    text += fmt::format("      {}  {:<52} {:>12.5g}  reference {:>10}  error {:>9}  tolerance {:>8}\n",
                        r.pass ? "    " : "MISS", r.label, r.value, figure_text(r, r.reference, 5),
                        figure_text(r, r.error, 3), figure_text(r, r.tolerance, 3));
  if (!o.failure.empty()) text += "      stopped: " + o.failure + "\n";
  return text;
}

std::string csv_field(std::string text) {
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at)) text.replace(at, 1, "; ");
  if (text.find_first_of(",\"") == std::string::npos) return text;
  for (std::size_t at = text.find('"'); at != std::string::npos; at = text.find('"', at + 2)) text.insert(at, 1, '"');
  return "\"" + text + "\"";
}

std::string outcomes_json(const std::vector<Outcome>& outcomes, const Context& context) {
  nlohmann::json entries = nlohmann::json::array();
  for (const Outcome& o : outcomes) {
    nlohmann::json rows = nlohmann::json::array();
    for (const Row& r : o.rows) rows.push_back(row_json(r));
    nlohmann::json entry = {
        {"name", o.name}, {"rows", rows}, {"pass", o.pass()}, {"seconds", o.seconds}, {"source", o.source}};
    if (!o.alias.empty()) entry["alias"] = o.alias;
    if (!o.failure.empty()) entry["failure"] = o.failure;
    entries.push_back(entry);
  }
  return nlohmann::json({{"machine", cases::machine_name()},
                         {"commit", cases::commit()},
                         {"precision", name_of(context.precision)},
                         {"quick", context.quick},
                         {"entries", entries}})
             .dump(2) +
         "\n";
}

bool is_outcomes_json(const std::string& text) {
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("entries") || !json["entries"].is_array()) return false;
  const auto is_outcome = [](const nlohmann::json& e) { return e.is_object() && e.contains("rows"); };
  return json.contains("machine") && json.contains("commit") &&
         std::all_of(json["entries"].begin(), json["entries"].end(), is_outcome);
}

}  // namespace lahar::validate
