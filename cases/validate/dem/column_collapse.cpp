// A dry column of grains collapses along a rough channel: run-out over aspect ratio.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "cases/validate/dem/ledger_watch.h"
#include "cases/validate/dem/solid_scenes.h"
#include "cases/validate/entry.h"
#include "cases/validate/reference_table.h"
#include "dem/packing/packing.h"
#include "dem/time_step.h"

namespace lahar::validate {

namespace {

// Glass beads of 5 mm, softened: a grain under 20 others is pressed in by 1 % of its radius.
constexpr double kRadius = 0.0025, kDensity = 2500, kModulus = 1e7, kFriction = 0.5, kRestitution = 0.5;
constexpr double kSolidFraction = 0.6;

struct Channel {
  double start = 0;   ///< m, length of the column, x from 0
  double height = 0;  ///< m, of the column
  double width = 0;   ///< m, of the channel
  double run = 0;     ///< m, length of the rough bed
};

/// Fixed grains, touching, side by side: the bed of the experiments is covered with the grains themselves.
void add_bed(const Channel& c, dem::Particles& p) {
  const int columns = static_cast<int>(c.run / (2 * kRadius)),
            rows = static_cast<int>(std::lround(c.width / (2 * kRadius)));
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      dem::ParticleSpec s;
      s.position = Vec3((2 * i + 1) * kRadius, (2 * j + 1) * kRadius, -kRadius);
      s.radius = kRadius;
      s.density = kDensity;
      s.state = dem::ParticleState::fixed;
      p.add(s);
    }
}

struct Column {
  dem::Solids solids;
  double height = 0;  ///< m, of its mean surface: the packing is denser than kSolidFraction and stands lower than asked
};

Column column(const Channel& c, std::uint64_t seed) {
  dem::PackingSpec packing;
  packing.upper = Vec3(c.start, c.width, 2 * c.height);
  const double volume = 4.0 / 3 * std::numbers::pi * std::pow(kRadius, 3);
  packing.classes = {{kRadius, static_cast<int>(kSolidFraction * c.start * c.width * c.height / volume), kDensity, 0}};
  packing.seed = seed;
  dem::Particles p;
  const std::vector<dem::ParticleSpec> grains = dem::pack(packing);
  for (const dem::ParticleSpec& s : grains) p.add(s);
  add_bed(c, p);
  dem::Materials m;
  m.add({"glass", kModulus, 0.25});
  m.add({"side", kModulus, 0.25});
  m.set_pair(0, 0, kFriction, kRestitution);
  m.set_pair(0, 1, 0, kRestitution);  // planar flow: the sides hold and do not brake
  Walls walls;
  walls.add({"back", HalfSpace{Vec3::Zero(), Vec3::UnitX()}, WallSlip::no_slip, 1});
  walls.add({"left", HalfSpace{Vec3::Zero(), Vec3::UnitY()}, WallSlip::no_slip, 1});
  walls.add({"right", HalfSpace{Vec3(0, c.width, 0), -Vec3::UnitY()}, WallSlip::no_slip, 1});
  const double step = 0.15 * dem::rayleigh_time_step(kRadius, kDensity, m[0]);
  return {dem::Solids(p, {}, m, walls, solids_options(step, Vec3(0, 0, -kGravity))),
          dem::measure_packing(packing, grains).surface_height};
}

/// How far the deposit reaches without a gap: to where its depth, in slices two grains wide and straight between their
/// middles, first falls below half a layer. Grains that rolled on alone do not count, as in the experiments.
double front(const Channel& c, const dem::Particles& p) {
  const double slice = 4 * kRadius, volume = 4.0 / 3 * std::numbers::pi * std::pow(kRadius, 3);
  std::vector<double> depth(static_cast<std::size_t>(c.run / slice) + 1, 0.0);
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.state[i] == dem::ParticleState::free) {
      const auto k =
          static_cast<std::size_t>(std::clamp(p.position.x[i] / slice, 0.0, static_cast<double>(depth.size() - 1)));
      depth[k] += volume / kSolidFraction / (slice * c.width);
    }
  std::size_t k = 0;
  while (k < depth.size() && depth[k] >= kRadius) ++k;
  if (k == 0 || k == depth.size()) return static_cast<double>(k) * slice;
  const double past = (depth[k - 1] - kRadius) / (depth[k - 1] - depth[k]);
  return (static_cast<double>(k) - 0.5 + past) * slice;
}

double height(const dem::Particles& p) {
  double top = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.state[i] == dem::ParticleState::free) top = std::max(top, p.position.z[i] + kRadius);
  return top;
}

struct Outcome {
  double run_out = 0, aspect = 0, height = 0;
  std::size_t grains = 0;
};

Outcome collapse(const Channel& c, std::vector<Row>& rows, const std::string& name) {
  Column start = column(c, 1);
  dem::Solids& solids = start.solids;
  LedgerWatch watch(solids);
  const double time =
      3.5 * std::sqrt(c.height / kGravity) + 1.5 * std::sqrt(c.start / kGravity);  // s; all is over at 3.3 sqrt(H / g)
  advance_watched(solids, watch, static_cast<int>(time / solids.options().time_step), 50);
  const dem::Particles& p = solids.particles();
  double kinetic = solids.ledger().kinetic, lost = solids.ledger().dissipated();
  rows.push_back(at_most_row(name + ": kinetic energy left / energy lost", kinetic / lost, 0.02));
  rows.push_back(watch.row(name));
  Outcome o;
  o.run_out = (front(c, p) - c.start) / c.start;
  o.aspect = start.height / c.start;
  o.height = height(p) / c.start;
  for (const auto state : p.state) o.grains += state == dem::ParticleState::free;
  return o;
}

/// Run-out over length: lambda_1 a of low columns, lambda_2 a^(2/3) of high ones.
struct RunOutLaw {
  double low, high, limit;
  [[nodiscard]] double operator()(double aspect) const {
    return aspect < limit ? low * aspect : high * std::cbrt(aspect * aspect);
  }
};

/// Lajeunesse, Monnier & Homsy (2005, Phys. Fluids 17:103302), glass beads in a channel.
RunOutLaw law_of_beads() {
  const ReferenceTable beads =
      reference("granular_column_collapse.csv").where("source", "Lajeunesse 2005 (glass beads)");
  return {beads.number("lambda1"), beads.number("lambda2"), beads.number("a0")};
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  const double diameter = 2 * kRadius;
  const RunOutLaw law = law_of_beads();
  for (const double aspect : context.quick ? std::vector{1.0} : std::vector{0.7, 1.5, 4.0}) {
    // Low columns need more grains a length: 0.80 of the law at 10 (a = 1), 0.90 at 20, 1.07 at 40.
    const bool low = aspect < 1 && !context.quick;
    const double start = (context.quick ? 10 : low ? 40 : aspect > 3 ? 12 : 20) * diameter;
    const Channel c{start, aspect * start, (low ? 4 : 6) * diameter, start * (2.5 + 1.4 * law(aspect))};
    const std::string name = fmt::format("aspect {:.1f}", aspect);
    const Outcome o = collapse(c, rows, name);
    rows.push_back(
        relative_row(fmt::format("{}, {} grains, {:.3f} as packed: run-out / length", name, o.grains, o.aspect),
                     o.run_out, law(o.aspect), context.quick ? 0.3 : 0.15));
  }
  return rows;
}

}  // namespace

Entry column_collapse() {
  return {
      "dem.column_collapse", {"Lajeunesse, Monnier & Homsy 2005, glass beads", {"granular_column_collapse.csv"}}, run};
}

}  // namespace lahar::validate
