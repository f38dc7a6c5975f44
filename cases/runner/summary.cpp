#include "cases/runner/summary.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cases/files/output_file.h"

namespace lahar::cases {
namespace {

using Json = nlohmann::ordered_json;

Json finite_only(const std::map<std::string, double>& values) {
  Json object = Json::object();
  for (const auto& [name, value] : values)
    if (std::isfinite(value)) object[name] = value;
  return object;
}

Json check_to_json(const ResultCheck& c) {
  return {{"name", c.name},
          {"value", c.value},
          {"reference", c.reference},
          {"tolerance", c.tolerance},
          {"pass", c.pass && std::isfinite(c.value)},
          {"source", c.source}};
}

Json performance_to_json(const Performance& p) {
  return {{"mlups", p.mlups},
          {"dem_particle_steps_per_second", p.dem_particle_steps_per_second},
          {"peak_rss_bytes", p.peak_rss_bytes},
          {"wet_cells_max", p.wet_cells_max},
          {"blocks_max", p.blocks_max}};
}

}  // namespace

std::string to_json(const Summary& s) {
  Json checks = Json::array();
  for (const ResultCheck& c : s.checks) checks.push_back(check_to_json(c));
  const Json all = {{"case", s.case_name},
                    {"version", s.version},
                    {"commit", s.commit},
                    {"machine", s.machine},
                    {"threads", s.threads},
                    {"precision", s.precision},
                    {"wall_seconds", s.wall_seconds},
                    {"simulated_seconds", s.simulated_seconds},
                    {"metrics", finite_only(s.metrics)},
                    {"checks", checks},
                    {"timers", finite_only(s.timers)},
                    {"performance", performance_to_json(s.performance)}};
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_summary(const std::filesystem::path& folder, const Summary& summary) {
  replace_text_file(folder / "summary.json", to_json(summary));
}

std::string results_table(const Summary& s) {
  std::size_t width = 16;
  for (const auto& [name, value] : s.metrics) width = std::max(width, name.size());
  for (const ResultCheck& c : s.checks) width = std::max(width, c.name.size());
  std::string table = fmt::format("  {:<{}}  {:.6g} s\n", "simulated", width, s.simulated_seconds);
  table += fmt::format("  {:<{}}  {:.6g} s\n", "wall time", width, s.wall_seconds);
  for (const auto& [name, value] : s.metrics) table += fmt::format("  {:<{}}  {:.6g}\n", name, width, value);
  for (const ResultCheck& c : s.checks)
    table += fmt::format("  {:<{}}  {:.6g}  (reference {:.6g}, {})\n", c.name, width, c.value, c.reference,
                         c.pass ? "pass" : "FAIL");
  return table;
}

}  // namespace lahar::cases
