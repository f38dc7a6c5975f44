#include "cases/speed_error/problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "cases/speed_error/problems/problems.h"

namespace lahar::validate {

std::string Trial::name() const {
  std::string text;
  for (const Knob& k : turned) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", k.name, k.value);
  return text.empty() ? "defaults" : text;
}

Measurement timed(const std::function<double()>& ask) {
  const auto start = std::chrono::steady_clock::now();
  const double error = ask();
  return {error, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
}

std::vector<Problem> all_problems(bool quick) {
  return {taylor_green_problem(quick),    gravity_wave_problem(quick), dam_break_problem(quick),
          sphere_array_problem(quick),    random_pack_problem(quick),  gravel_bed_problem(quick),
          settling_sphere_problem(quick), wire_screen_problem(quick),  ring_in_hole_problem(quick),
          elastic_impact_problem(quick),  ring_pull_problem(quick),    rockfall_problem(quick),
          wet_column_problem(quick),      debris_flow_problem(quick)};
}

std::vector<Problem> select_problems(const std::vector<std::string>& names, bool quick) {
  const std::vector<Problem> all = all_problems(quick);
  std::string known;
  for (const Problem& p : all) known += (known.empty() ? "" : ", ") + p.name;
  for (const std::string& name : names)
    if (std::none_of(all.begin(), all.end(), [&](const Problem& p) { return p.name == name; }))
      throw std::invalid_argument(fmt::format("no problem is called '{}', expected one of {}", name, known));
  std::vector<Problem> chosen;
  for (const Problem& p : all)
    if (names.empty() || std::find(names.begin(), names.end(), p.name) != names.end()) chosen.push_back(p);
  return chosen;
}

}  // namespace lahar::validate
