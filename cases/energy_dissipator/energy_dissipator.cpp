#include "cases/energy_dissipator/energy_dissipator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include "barrier/wire.h"
#include "core/check.h"
#include "core/number_text.h"
#include "dem/bonds/axial_law.h"
#include "dem/solids.h"
#include "dem/time_step.h"

namespace lahar::cases {

namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

double area(const EnergyDissipator& b) { return std::numbers::pi * b.bond_radius * b.bond_radius; }

/// A straight chain along x: cable, dissipator, cable. The first bead is held, the last pulled.
struct Chain {
  dem::Solids solids;
  dem::ParticleIndex pulled;
  std::size_t dissipator;  // bond
};

/// Limit of the bonds at the largest force, with a tenth more than the dissipator is drawn out by then, s: a longer
/// bond turns its ends with a longer lever (docs/decisions/0029).
double time_step_limit(const EnergyDissipator& brake, const dem::Bonds& bonds, dem::Particles particles) {
  const Vec3 drawn_out(1.1 * brake.elongation_at(brake.last_force), 0, 0);
  for (auto k = static_cast<dem::ParticleIndex>(brake.cable_beads + 1); k < particles.size(); ++k)
    particles.position.add(k, drawn_out);
  return dem::bond_time_step(bonds, particles);
}

Chain build(const EnergyDissipator& brake) {
  dem::Bonds bonds;
  dem::Particles particles;
  dem::BondSort cable;
  cable.axial.stiffness = {brake.stiffness[0], brake.stiffness[0], brake.stiffness[0]};
  cable.shear_stiffness = brake.stiffness[0];
  cable.bond_radius = brake.bond_radius;
  cable.damping_ratio = brake.damping_ratio;
  dem::BondSort dissipator = cable;
  dissipator.axial = brake.law();

  const auto beads = static_cast<std::size_t>(2 * brake.cable_beads + 2);
  barrier::WireSpec spec;
  spec.properties = {brake.bead_diameter, brake.density, 0};
  spec.sort = bonds.add_sort(cable);
  spec.dissipator_sort = bonds.add_sort(dissipator);
  spec.dissipator_bonds = {static_cast<std::size_t>(brake.cable_beads)};
  spec.fixed_beads = {0, beads - 1};
  for (std::size_t k = 0; k < beads; ++k)
    spec.line.points.push_back(Vec3(static_cast<double>(k) * brake.bead_diameter, 0, 0));
  barrier::add_wire(spec, particles, bonds);

  dem::Materials materials;
  materials.add({"steel", 100e9, 0.3});  // nothing touches under tension
  dem::SolidsOptions options;
  options.gravity = Vec3::Zero();
  options.time_step = brake.safety * time_step_limit(brake, bonds, particles);
  return {dem::Solids(std::move(particles), std::move(bonds), std::move(materials), Walls{}, options),
          static_cast<dem::ParticleIndex>(beads - 1), static_cast<std::size_t>(brake.cable_beads)};
}

/// The end that is moved, and what it did.
class Pull {
 public:
  explicit Pull(Chain& chain) : chain_(chain) {}

  /// One step at this speed, m/s. Adds to the sums of the stretch under way.
  void step(double speed) {
    dem::Solids& s = chain_.solids;
    const double dt = s.options().time_step, before = end_force();
    s.particles().velocity.set(chain_.pulled, Vec3(speed, 0, 0));
    s.step();
    const double travel = speed * dt, mean = 0.5 * (before + end_force());
    moved_ += travel;
    sum_.time += s.time();
    sum_.displacement += moved_;
    sum_.elongation += s.bonds().elongation[chain_.dissipator];
    sum_.force += s.bonds().axial_force[chain_.dissipator];
    sum_.end_force += end_force();
    ++steps_;
    work_ += mean * travel;
  }
  /// Mean over the steps since the last call.
  BrakePoint point() {
    const double n = static_cast<double>(std::exchange(steps_, 0));
    const BrakePoint s = std::exchange(sum_, {});
    return {s.time / n, s.displacement / n, s.elongation / n, s.force / n, s.end_force / n};
  }
  [[nodiscard]] double work() const { return work_; }
  [[nodiscard]] double moved() const { return moved_; }
  [[nodiscard]] double force() const { return chain_.solids.bonds().axial_force[chain_.dissipator]; }

 private:
  [[nodiscard]] double end_force() const { return -chain_.solids.particles().force.x[chain_.pulled]; }

  Chain& chain_;
  BrakePoint sum_;
  std::int64_t steps_ = 0;
  double moved_ = 0, work_ = 0;
};

}  // namespace

dem::AxialLaw EnergyDissipator::law() const {
  dem::AxialLaw law;
  for (std::size_t k = 0; k < 3; ++k) law.stiffness[k] = stiffness[std::min(k, stiffness.size() - 1)];
  for (std::size_t k = 0; k < 2; ++k) law.force_limit[k] = k < force_limit.size() ? force_limit[k] : kNone;
  law.plastic_unloading = unloading == BrakeUnloading::plastic;
  return law;
}

double EnergyDissipator::stage_stiffness(std::size_t k) const { return stiffness[k] * area(*this); }

double EnergyDissipator::elongation_at(double force) const {
  double elongation = 0, from = 0;
  for (std::size_t k = 0; k < stiffness.size(); ++k) {
    const double until = k < force_limit.size() ? std::min(force, force_limit[k]) : force;
    if (until > from) elongation += (until - from) / stage_stiffness(k);
    from = std::max(from, until);
  }
  return elongation;
}

double EnergyDissipator::displacement_at(double force) const {
  return elongation_at(force) + 2 * static_cast<double>(cable_beads) * force / stage_stiffness(0);
}

double EnergyDissipator::cable_stiffness(std::size_t k) const {
  return 1 / (1 / stage_stiffness(k) + 2 * static_cast<double>(cable_beads) / stage_stiffness(0));
}

double EnergyDissipator::energy_to(double force) const {
  return dem::curve_energy(dem::axial_curve(law(), area(*this)), elongation_at(force));
}

namespace {

/// Slopes are fitted to the points of a stage: they lie equally far apart.
void check_samples(const EnergyDissipator& b, scene::Findings& findings) {
  constexpr double least = 6;
  double before = 0;
  for (std::size_t k = 0; k < b.stiffness.size(); ++k) {
    const double after = b.displacement_at(k < b.force_limit.size() ? b.force_limit[k] : b.last_force);
    const double share = (after - std::exchange(before, after)) / b.displacement_at(b.last_force);
    if (share * static_cast<double>(b.samples) < least)
      return findings.mistake("loading.samples",
                              "loading.samples is " + std::to_string(b.samples) + ", of which stage " +
                                  std::to_string(k + 1) + " gets " +
                                  number_text(share * static_cast<double>(b.samples)) + ", expected at least " +
                                  std::to_string(static_cast<std::int64_t>(std::ceil(least / share))));
  }
}

/// A point is a mean over steps.
void check_speed(const EnergyDissipator& b, scene::Findings& findings) {
  const double in_a_step = b.speed * build(b).solids.options().time_step;
  if (const double apart = b.displacement_at(b.last_force) / static_cast<double>(b.samples); in_a_step > apart)
    findings.mistake("loading.speed_m_s",
                     fmt::format("loading.speed_m_s is {:g}, {:.2g} m in a time step, and loading.samples asks for one "
                                 "every {:.2g} m, expected a lower speed or fewer samples",
                                 b.speed, in_a_step, apart),
                     {"loading.samples"});
}

}  // namespace

void check(const EnergyDissipator& b, scene::Findings& findings) {
  const std::string stiffness = "dissipator.stiffness_N_m3", limits = "dissipator.force_limit_N";
  if (b.stiffness.size() < 2 || b.stiffness.size() > 3)
    return findings.mistake(stiffness, stiffness + " does not have two or three entries, expected one for each stage");
  if (b.force_limit.size() + 1 != b.stiffness.size())
    findings.mistake(stiffness,
                     stiffness + " and force_limit_N do not fit together, expected one limit less than stages");
  const bool rise =
      std::adjacent_find(b.force_limit.begin(), b.force_limit.end(), std::greater_equal<>{}) == b.force_limit.end();
  if (!rise || (!b.force_limit.empty() && b.last_force <= b.force_limit.back()))
    findings.mistake(limits, limits + " and last_force_N do not rise, expected each above the one before");
  if (b.unloading == BrakeUnloading::plastic &&
      std::any_of(b.stiffness.begin() + 1, b.stiffness.end(), [&](double k) { return k >= b.stiffness.front(); }))
    findings.mistake(stiffness, "dissipator.unloading is \"plastic\", expected later stages softer than the first");
  if (!findings.mistakes().empty()) return;
  check_samples(b, findings);
  check_speed(b, findings);
}

BrakeCurve stretch(const EnergyDissipator& brake, const std::function<bool()>& go_on) {
  scene::Findings findings("energy_dissipator");
  check(brake, findings);
  findings.raise();
  Chain chain = build(brake);
  Pull pull(chain);
  const double dt = chain.solids.options().time_step, end = brake.displacement_at(brake.last_force);
  const double start_up = 0.01 * end / brake.speed;
  BrakeCurve curve;
  curve.time_step = dt;

  double time = 0;
  for (std::int64_t k = 1; pull.force() < brake.last_force && !curve.interrupted; ++k) {
    const double until = end * static_cast<double>(k) / static_cast<double>(brake.samples);
    while (pull.moved() < until && pull.force() < brake.last_force)
      pull.step(brake.speed * std::min(1.0, (time += dt) / start_up));
    curve.loading.push_back(pull.point());
    curve.interrupted = !go_on();
  }
  curve.simulated = chain.solids.time();
  if (curve.interrupted) return curve;
  // Stopped at once: what moves then is damped before the way back begins.
  for (int k = 0; k < 2000; ++k) pull.step(0);
  (void)pull.point();
  curve.work_in = pull.work();
  const dem::Bonds& bonds = chain.solids.bonds();
  curve.largest_elongation = bonds.elongation[chain.dissipator];
  const dem::AxialCurve law = dem::axial_curve(brake.law(), area(brake));
  const double force = curve.largest_force = pull.force();
  const bool plastic = brake.unloading == BrakeUnloading::plastic;
  curve.stored = plastic ? 0.5 * force * force / law.k1 : dem::curve_energy(law, bonds.elongation[chain.dissipator]);
  curve.cable_energy = chain.solids.bond_energy().axial - curve.stored;

  const double way_back = plastic ? brake.displacement_at(force) - brake.elongation_at(force) + force / law.k1 : end;
  const double slow = brake.speed * std::min(1.0, 10 * way_back / end);
  while (pull.force() > 0 && !curve.interrupted) {
    const auto steps =
        static_cast<std::int64_t>(std::ceil(way_back / static_cast<double>(brake.samples) / (slow * dt)));
    for (std::int64_t s = 0; s < steps && pull.force() > 0; ++s) pull.step(-slow);
    curve.unloading.push_back(pull.point());
    curve.interrupted = !go_on();
  }
  for (int k = 0; k < 2000; ++k) pull.step(0);
  curve.work_out = curve.work_in - pull.work();
  curve.plastic = chain.solids.bond_energy().plastic;
  curve.damped = chain.solids.bond_energy().damping;
  curve.simulated = chain.solids.time();
  curve.ledger_gap = chain.solids.ledger().total() - pull.work();
  return curve;
}

namespace {

/// End force = a + b x elongation by least squares over the points between two forces. Taken at the pulled end, the
/// force has gone through all beads and bonds.
struct Line {
  double a = 0, b = 0;
};

Line fit(const std::vector<BrakePoint>& points, double BrakePoint::*along, double from, double to) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const BrakePoint& p : points) {
    if (p.end_force < from || p.end_force > to) continue;
    n += 1, x += p.*along, y += p.end_force, xx += p.*along * p.*along, xy += p.*along * p.end_force;
  }
  require(n >= 3, "too few points between these forces to fit a line");
  const double b = (n * xy - x * y) / (n * xx - x * x);
  return {(y - b * x) / n, b};
}

/// The inner part of a stage's range of forces: the samples next to a knee are means over both stages.
Line stage_line(const EnergyDissipator& brake, const std::vector<BrakePoint>& points, std::size_t stage,
                double BrakePoint::*along = &BrakePoint::elongation) {
  const double from = stage == 0 ? 0 : brake.force_limit[stage - 1];
  const double to = stage < brake.force_limit.size() ? brake.force_limit[stage] : brake.last_force;
  return fit(points, along, from + 0.05 * (to - from), to - 0.05 * (to - from));
}

}  // namespace

double stage_slope(const EnergyDissipator& brake, const std::vector<BrakePoint>& points, std::size_t stage) {
  return stage_line(brake, points, stage).b;
}

double cable_slope(const EnergyDissipator& brake, const std::vector<BrakePoint>& points, std::size_t stage) {
  return stage_line(brake, points, stage, &BrakePoint::displacement).b;
}

double knee(const EnergyDissipator& brake, const std::vector<BrakePoint>& points, std::size_t stage) {
  const Line one = stage_line(brake, points, stage), two = stage_line(brake, points, stage + 1);
  const double elongation = (two.a - one.a) / (one.b - two.b);
  return one.a + one.b * elongation;
}

double area_under(const std::vector<BrakePoint>& points) {
  double sum = 0;
  for (std::size_t k = 1; k < points.size(); ++k)
    sum += 0.5 * (points[k - 1].end_force + points[k].end_force) * (points[k].elongation - points[k - 1].elongation);
  return sum;
}

}  // namespace lahar::cases
