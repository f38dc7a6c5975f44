// Speed of the grains, rings, cables and brakes: particle-steps per second, in total over all threads, against LAMMPS
// on the same particles in the same run. Bonds of LAMMPS here are plain springs, ours carry moments too.
#include <algorithm>
#include <cstdio>
#include <functional>

#include "core/parallel.h"
#include "tests/performance/benchmark.h"
#include "tests/performance/lammps.h"
#include "tests/performance/solids_scenes.h"

namespace lahar::performance {

namespace {

/// Particle-steps per second, best of the session's repeats.
double rate(dem::Solids& solids, int steps, const Session& session) {
  solids.advance(steps / 10 + 1);
  const double seconds = best_seconds(session.repeats, [&] { solids.advance(steps); });
  return static_cast<double>(solids.particles().size()) * steps / seconds;
}

/// The scene on `threads` threads against LAMMPS on as many processes. LAMMPS starts from the state that we start from.
Figure compare(const std::string& name, const std::function<dem::Solids()>& scene, const ScenePair& pair, int threads,
               int steps, double bar, const Session& session) {
  dem::Solids solids = scene();
  const bool found = have_lammps();
  double theirs = 0;
  for (int r = 0; found && r < session.repeats; ++r)
    theirs = std::max(theirs, lammps_rate(solids, pair, threads, steps).value_or(0.0));
  const ThreadLimit limit(threads);
  const double ours = rate(solids, steps, session);
  if (theirs == 0) {
    Figure figure{name, ours / 1e6, "M/s", 0, "LAMMPS", bar};
    figure.missing = found ? "lmp failed" : "lmp not found: Debian package lammps";
    return figure;
  }
  char against[80];
  std::snprintf(against, sizeof against, "LAMMPS on %d core%s: %.3g M/s", threads, threads > 1 ? "s" : "",
                theirs / 1e6);
  return {name, ours / 1e6, "M/s", ours / theirs, against, bar};
}

Benchmark grains(const std::string& name, int count, int threads, int steps) {
  return {name, {}, [=](Session& s) {
            return compare(
                name, [count] { return settled_grains(count); }, kRock, threads, steps, 3.0, s);
          }};
}

Benchmark rings(const std::string& name, int threads) {
  return {name, {}, [=](Session& s) { return compare(name, hanging_rings, kSteel, threads, 1000, 2.0, s); }};
}

}  // namespace

std::vector<Benchmark> solids_benchmarks() {
  return {grains("solids.grains_5k", 5000, 1, 2000),
          grains("solids.grains_5k_2", 5000, 2, 2000),
          grains("solids.grains_50k", 50000, 1, 200),
          grains("solids.grains_50k_2", 50000, 2, 200),
          rings("solids.ring_net", 1),
          rings("solids.ring_net_2", 2)};
}

}  // namespace lahar::performance
