#include "cases/compare_cfd_dem/over_seeds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace lahar::study {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

using Runs = std::vector<const CaseResult*>;

/// The runs of a flow in one coupling that differ by their seed alone, of the program that ran the most; less than two
/// are none.
Runs seeds_of(const StudyCase& flow, const std::vector<CaseResult>& results) {
  std::map<std::string, Runs> programs;
  for (const CaseResult& c : results) {
    StudyCase same = flow;
    same.seed = c.study_case.seed;
    if (c.study_case == same && !c.commit.empty() && !c.commit.ends_with("-dirty")) programs[c.commit].push_back(&c);
  }
  Runs most;
  for (const auto& [commit, runs] : programs)
    if (runs.size() > most.size()) most = runs;
  return most.size() < 2 ? Runs{} : most;
}

struct Moments {
  std::size_t count = 0;
  double mean = kNone, deviation = kNone;
  [[nodiscard]] double variance_of_mean() const { return deviation * deviation / static_cast<double>(count); }
};

Moments moments_of(const std::string& quantity, const Runs& runs) {
  std::vector<double> values;
  for (const CaseResult* c : runs)
    if (const double x = c->value(quantity); std::isfinite(x)) values.push_back(x);
  Moments m{.count = values.size()};
  if (m.count < 2) return m;
  const auto n = static_cast<double>(m.count);
  double sum = 0, squares = 0;
  for (const double x : values) sum += x;
  m.mean = sum / n;
  for (const double x : values) squares += (x - m.mean) * (x - m.mean);
  m.deviation = std::sqrt(squares / (n - 1));
  return m;
}

/// Rows of one coupling of a flow; `resolved` are the runs that they are held against, none for these themselves.
void add_rows(std::vector<OverSeeds>& all, const StudyCase& flow, const Runs& runs, const Runs& resolved) {
  const bool comparable = !resolved.empty() && resolved.front()->commit == runs.front()->commit;
  for (const Compared& q : compared_quantities()) {
    const Moments m = moments_of(q.name, runs);
    if (m.count < 2) continue;
    OverSeeds row{q.name,       q.unit,  flow.sweep, flow.preset, flow.coupling, runs.front()->commit,
                  flow.release, m.count, m.mean,     m.deviation, kNone,         kNone};
    if (const Moments r = moments_of(q.name, resolved); comparable && r.count > 1 && r.mean != 0) {
      const double ratio = m.mean / r.mean;
      row.change = ratio - 1;
      row.change_error = std::sqrt(m.variance_of_mean() + ratio * ratio * r.variance_of_mean()) / std::abs(r.mean);
    }
    all.push_back(std::move(row));
  }
}

}  // namespace

std::vector<OverSeeds> over_seeds(const std::vector<CaseResult>& results) {
  std::vector<StudyCase> flows;  // of resolved runs and of others, in the order of tables
  for (const CaseResult& c : results) {
    StudyCase flow = c.study_case;
    flow.seed = 0;
    if (flow.variant == variants().front().name && std::find(flows.begin(), flows.end(), flow) == flows.end())
      flows.push_back(flow);
  }
  std::stable_sort(flows.begin(), flows.end(), comes_before);
  std::vector<OverSeeds> all;
  for (const StudyCase& flow : flows) {
    const Runs runs = seeds_of(flow, results);
    if (runs.empty()) continue;
    StudyCase base = flow;
    base.coupling = couplings().front().name;
    add_rows(all, flow, runs, flow == base ? Runs{} : seeds_of(base, results));
  }
  return all;
}

std::string over_seeds_csv(const std::vector<OverSeeds>& all) {
  const auto number = [](double x) { return std::isfinite(x) ? fmt::format("{:.6g}", x) : std::string(); };
  std::string text = "quantity,unit,sweep,preset,release_m,coupling,seeds,mean,deviation,change,change_error,commit\n";
  for (const OverSeeds& s : all)
    text += fmt::format("{},{},{},{},{:.2f},{},{},{},{},{},{},\"{}\"\n", s.quantity, s.unit, s.sweep, s.preset,
                        s.release, s.coupling, s.seeds, number(s.mean), number(s.deviation), number(s.change),
                        number(s.change_error), s.commit);
  return text;
}

}  // namespace lahar::study
