#include "cases/compare_cfd_dem/trends.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace lahar::study {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A quantity over the release distance.
using Points = std::vector<std::pair<double, double>>;

double kendall(const Points& points) {
  double sum = 0, pairs = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double a = points[i].first - points[j].first, b = points[i].second - points[j].second;
      sum += b == 0 ? 0 : (a > 0) == (b > 0) ? 1 : -1, pairs += 1;
    }
  return points.size() < 3 ? kNone : sum / pairs;
}

/// Of a line through points by least squares; NaN for less than two.
double slope(const Points& points) {
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& [a, b] : points) x += a, y += b, xx += a * a, xy += a * b;
  const auto n = static_cast<double>(points.size());
  return n < 2 ? kNone : (n * xy - x * y) / (n * xx - x * x);
}

/// The slope from `bend` on over that up to it; NaN where there are less than two flows on a side, infinite where it
/// does not rise up to there.
double slope_beyond(const Points& points, double bend) {
  Points before, beyond;
  for (const auto& p : points) {
    if (p.first <= bend + 1e-6) before.push_back(p);
    if (p.first >= bend - 1e-6) beyond.push_back(p);
  }
  const double rise = slope(before), rest = slope(beyond);
  return rise <= 0 && !std::isnan(rest) ? INFINITY : rest / rise;
}

double least(const Points& points) {
  double value = points.size() < 3 ? kNone : INFINITY;
  for (const auto& p : points) value = std::min(value, p.second);
  return value;
}

enum class Says { rises, falls, levels_off, is_greater_part };

struct Statement {
  const char *text, *quantity;
  Says says;
};

constexpr Statement kStatements[] = {
    {"retained mass falls with the Froude number (4.2)", "retained_mass", Says::falls},
    {"the share of the large grains that is retained falls (4.2)", "retained_large", Says::falls},
    {"the share of the small grains that is retained falls (4.2)", "retained_small", Says::falls},
    {"the peak in the lower cable falls (4.3)", "lower_cable_sum", Says::falls},
    {"the peak in the whole barrier rises (4.3)", "barrier_sum", Says::rises},
    {"the peak in the whole barrier rises (4.3), read as the largest mean over 0.2 s", "barrier_sum_mean", Says::rises},
    {"E_b rises (Table 5)", "e_b", Says::rises},
    {"eta rises (4.4), about the bed at the net", "eta", Says::rises},
    {"eta rises (4.4), about the bed 1.30 m downstream", "eta_lower", Says::rises},
    {"eta levels off (4.4), about the bed 1.30 m downstream", "eta_lower", Says::levels_off},
    {"zeta falls (4.4), about the bed at the net", "zeta", Says::falls},
    {"zeta falls (4.4), about the bed 1.30 m downstream", "zeta_lower", Says::falls},
    {"what leaves is mainly fluid (4.4), by its energy about the bed 1.30 m downstream", "outflow_liquid_share",
     Says::is_greater_part},
    {"what leaves is mainly fluid (4.4), by its kinetic energy", "outflow_liquid_share_kinetic", Says::is_greater_part},
    {"kinetic energy of the fluid that leaves rises, of E_in (4.4)", "out_liquid_kinetic", Says::rises},
    {"potential energy of the fluid that leaves falls, of E_in (4.4)", "out_liquid_potential", Says::falls},
};

constexpr double kBend = 6.35;  // m: Fr = 5.866, from which on eta no longer rises (4.4)

double measure_of(Says says, const Points& points) {
  switch (says) {
    case Says::levels_off:
      return slope_beyond(points, kBend);
    case Says::is_greater_part:
      return least(points);
    case Says::rises:
    case Says::falls:
      break;
  }
  return kendall(points);
}

Agreement agreement_of(Says says, const Points& points) {
  const double measure = measure_of(says, points);
  if (std::isnan(measure)) return Agreement::unknown;
  const auto chosen = [](bool yes, bool mostly) {
    return yes ? Agreement::yes : mostly ? Agreement::mostly : Agreement::no;
  };
  if (says == Says::levels_off) return chosen(std::abs(measure) < 0.25, std::abs(measure) < 0.5);
  if (says == Says::is_greater_part) {
    const auto above = std::count_if(points.begin(), points.end(), [](const auto& p) { return p.second > 0.5; });
    return chosen(measure > 0.5, 2 * above > std::ssize(points));
  }
  const double with_the_paper = says == Says::rises ? measure : -measure;
  // Of ten flows without a trend one in 20 has 0.47 by chance; of three flows one in six has 1.
  constexpr double all_pairs = 1 - 1e-9, three_of_four = 0.5 - 1e-9;
  return chosen(with_the_paper > all_pairs, with_the_paper > three_of_four);
}

}  // namespace

const char* name_of(Agreement agreement) {
  switch (agreement) {
    case Agreement::yes:
      return "yes";
    case Agreement::mostly:
      return "mostly";
    case Agreement::no:
      return "no";
    case Agreement::unknown:
      break;
  }
  return "-";
}

std::vector<Trend> trends(const std::vector<CaseResult>& results) {
  std::vector<Trend> all;
  for (const Choice& sweep : sweeps())
    for (const Choice& preset : presets())
      for (const Choice& coupling : couplings()) {
        std::map<double, const CaseResult*> flows;  // by distance, the lowest seed
        for (const CaseResult& c : results) {
          const StudyCase& s = c.study_case;
          if (s.sweep != sweep.name || s.preset != preset.name || s.coupling != coupling.name ||
              s.variant != variants().front().name || is_strip(s))
            continue;
          const CaseResult*& kept = flows[s.release];
          if (!kept || s.seed < kept->study_case.seed) kept = &c;
        }
        if (flows.size() < 3) continue;
        for (const Statement& s : kStatements) {
          Points points;
          std::set<std::string> programs;
          for (const auto& [release, c] : flows)
            if (const double value = c->value(s.quantity); std::isfinite(value))
              points.emplace_back(release, value), programs.insert(c->commit);
          all.push_back({s.text, sweep.name, coupling.name, preset.name, points.size(), programs.size(),
                         measure_of(s.says, points), agreement_of(s.says, points)});
        }
      }
  return all;
}

std::string trends_csv(const std::vector<Trend>& all) {
  std::string text = "trend,sweep,coupling,preset,flows,programs,measure,agrees\n";
  for (const Trend& t : all)
    text += fmt::format("\"{}\",{},{},{},{},{},{:.2f},{}\n", t.statement, t.sweep, t.coupling, t.preset, t.flows,
                        t.programs, t.measure, name_of(t.agrees));
  return text;
}

}  // namespace lahar::study
