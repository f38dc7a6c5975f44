#include "cases/rockfall/rockfall.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "barrier/guide.h"
#include "barrier/net.h"
#include "barrier/threading.h"
#include "barrier/topology.h"
#include "core/check.h"
#include "core/number_text.h"
#include "core/worst.h"
#include "dem/bonds/bond_constants.h"
#include "dem/bonds/bond_energy.h"
#include "dem/solids.h"
#include "dem/time_step.h"

namespace lahar::cases {

namespace {

constexpr double kGravity = 9.81;  // m/s^2
constexpr int kWire = 0, kBall = 1;

dem::Materials materials_of(const Rockfall& r) {
  dem::Materials materials;
  materials.add({"wire", r.youngs_modulus, r.poisson_ratio});
  materials.add({"ball", r.ball_modulus, r.ball_poisson_ratio});
  materials.set_pair(kWire, kWire, r.friction, r.restitution);
  materials.set_pair(kWire, kBall, r.friction, r.restitution);
  return materials;
}

/// A horizontal net around the origin; its dissipators are the last bonds of each cable.
barrier::RingNetSpec net_spec(const Rockfall& r) {
  barrier::RingNetSpec spec;
  spec.across = Vec3::UnitX(), spec.up = Vec3::UnitY(), spec.normal = Vec3::UnitZ();
  spec.width = spec.height = r.net_width;
  spec.origin = Vec3(-0.5 * r.net_width, -0.5 * r.net_width, 0);
  spec.ring_diameter = r.ring_diameter, spec.ring_pitch = r.ring_pitch;
  spec.beads_per_ring = static_cast<int>(r.beads_per_ring);
  spec.wire_diameter = r.wire_diameter, spec.density = r.density, spec.material = kWire;
  spec.fit = barrier::NetFit::cables_on_frame;
  spec.cable_extension = r.cable_extension;
  spec.ring = barrier::wire_bond(r.ring_stiffness, 0);
  spec.cable = barrier::wire_bond(r.cable_stiffness, 0);
  spec.dissipator =
      barrier::dissipator_bond(r.dissipator_stiffness[0], r.dissipator_stiffness[1], r.activation_force, 0);
  spec.dissipator.axial.plastic_unloading = r.plastic_unloading;
  for (dem::BondSort* sort : {&spec.ring, &spec.cable, &spec.dissipator}) sort->damping_ratio = r.bond_damping_ratio;
  barrier::NetCable cable;  // ends fixed, a dissipator next to either
  if (r.dissipators_per_cable == 1) cable.support.dissipators_at = {0};
  spec.lower = spec.upper = spec.left = spec.right = cable;
  return spec;
}

barrier::Guides guides_of(const Rockfall& r, const barrier::Net& net) {
  barrier::Guides guides({.stiffness = r.guide_stiffness});
  for (std::size_t c = 0; c < net.cables.size(); ++c) {
    const auto& [start, end] = net.corners[c];
    for (const Vec3& corner : {start, end}) guides.add(net.cables[c], corner);
  }
  return guides;
}

/// Sets the forces of the guides, and sees that every cable still runs through its own.
void guide(barrier::Guides& guides, dem::Solids& solids) {
  guides.apply(solids.particles());
  if (!guides.slipped_out()) return;
  const Vec3& point = *guides.slipped_out();
  throw NumericalFailure("guide at (" + number_text(point.x()) + ", " + number_text(point.y()) + ")",
                         solids.step_count(),
                         "a cable has slipped out: its dissipator is drawn out by more than net.cable_extension_m");
}

double time_step_of(const Rockfall& r, const dem::Bonds& bonds, const dem::Particles& particles) {
  return r.time_step > 0 ? r.time_step : 0.7 * dem::bond_time_step(bonds, particles);
}

void check_dissipators(const Rockfall& r, scene::Findings& findings) {
  const std::string stiffness = "bonds.dissipator_stiffness_N_m3";
  if (r.dissipator_stiffness.size() != 2)
    return findings.mistake(stiffness, stiffness + " does not have 2 entries, expected two stages");
  // Plastic elongation would not grow under load (dem/bonds/axial_law.h).
  if (r.plastic_unloading && r.dissipator_stiffness[1] >= r.dissipator_stiffness[0])
    findings.mistake("bonds.plastic_unloading",
                     "bonds.plastic_unloading is true and the second stage of dissipator_stiffness_N_m3 as stiff as "
                     "the first, expected a softer one",
                     {stiffness});
}

void check_ball(const Rockfall& r, scene::Findings& findings) {
  if (r.ball_diameter >= r.net_width)
    findings.mistake("ball.diameter_m",
                     "ball.diameter_m is not below net.width_m, expected a ball that the net catches");
  if (r.ball_diameter <= r.ring_diameter)
    findings.mistake("ball.diameter_m",
                     "ball.diameter_m is not above net.ring_diameter_m, expected a ball that no ring lets through");
}

/// A guide lets go of a cable that it holds at its first or last bond.
void check_extension(const Rockfall& r, const barrier::Net& net, dem::Particles particles, const dem::Bonds& bonds,
                     scene::Findings& findings) {
  barrier::Guides guides = guides_of(r, net);
  guides.apply(particles);
  if (guides.slipped_out())
    findings.mistake("net.cable_extension_m",
                     fmt::format("net.cable_extension_m is {:g}, expected more than a bond of the cables, {:.4g}",
                                 r.cable_extension, bonds.rest_length[net.cables.front().first_bond]));
}

/// Of bonds, of guides and of contacts; the last two seldom bind. A row needs a step at least.
void check_step(const Rockfall& r, const dem::Particles& particles, const dem::Bonds& bonds,
                scene::Findings& findings) {
  const double limit = dem::bond_time_step(bonds, particles), time_step = time_step_of(r, bonds, particles);
  if (r.time_step > limit)
    return findings.mistake(
        "run.time_step_s",
        fmt::format("run.time_step_s is {:g}, expected at most the limit of the bonds, {:.4g}", r.time_step, limit));
  if (0.7 * limit < 1e-8)
    return findings.mistake("bonds", fmt::format("bonds as stiff as these need a time step of {:.4g} s, expected "
                                                 "stiffnesses per unit area (N/m^3) that allow 1e-8 s",
                                                 limit));
  const auto refuse = [&](const char* key, double most) {
    if (time_step > most)
      findings.mistake(key, fmt::format("{} asks for a time step of at most {:.4g} s, and it is {:.4g} s: expected "
                                        "less, or a shorter run.time_step_s",
                                        key, most, time_step));
  };
  const double bead = *std::min_element(particles.mass.begin(), particles.mass.end());
  refuse("net.guide_stiffness_N_m", 0.5 * barrier::guide_time_step({.stiffness = r.guide_stiffness}, bead));
  refuse("contact.youngs_modulus_Pa", 0.3 * dem::rayleigh_time_step(particles, materials_of(r)));
  if (r.sample_interval < time_step)
    findings.mistake("run.sample_interval_s",
                     fmt::format("run.sample_interval_s is {:g}, expected at least a time step, {:.4g}",
                                 r.sample_interval, time_step),
                     {"run.time_step_s"});
}

}  // namespace

bool as_in_paper(const Rockfall& rockfall) {
  const Rockfall paper;
  Rockfall as_paper = rockfall;
  as_paper.sample_interval = paper.sample_interval, as_paper.duration = paper.duration;
  as_paper.time_step = paper.time_step;
  return as_paper == paper;
}

double Rockfall::impact_speed() const { return std::sqrt(2 * kGravity * drop_height); }

void check(const Rockfall& r, scene::Findings& findings) {
  check_dissipators(r, findings);
  if (!findings.sound({"bonds"})) return;
  check_ball(r, findings);
  dem::Particles particles;
  dem::Bonds bonds;
  barrier::Net net;
  try {
    net = barrier::build_net(net_spec(r), particles, bonds);
  } catch (const InputError& e) {
    for (const InputMistake& m : e.mistakes()) findings.mistake("net", "net: " + m.message);
    return;
  }
  check_extension(r, net, particles, bonds, findings);
  check_step(r, particles, bonds, findings);
}

/// What settles.
struct SettledNet::Parts {
  barrier::Net net;
  barrier::Topology topology;  // as built
  dem::Particles particles;
  dem::Bonds bonds;
  barrier::Guides guides;
  double time_step = 0;
  double settled_for = 0;  // s
  std::int64_t steps = 0;  // in that time
  bool interrupted = false;

  [[nodiscard]] dem::Solids solids(const Rockfall& r) const {
    dem::SolidsOptions options;
    options.gravity = Vec3(0, 0, -kGravity);
    options.time_step = time_step;
    if (r.capsules) options.wire_contacts = dem::WireContacts::capsules;
    options.watchdog.speed_limit = 20 * r.impact_speed();
    return {particles, bonds, materials_of(r), Walls{}, options};
  }
  /// What is known of a strike before it.
  [[nodiscard]] RockfallResult before_strike(const Rockfall& r) const {
    RockfallResult result;
    result.as_in_paper = as_in_paper(r);
    result.beads = static_cast<std::int64_t>(particles.size());
    result.rings = static_cast<std::int64_t>(net.rings.size());
    result.steps = steps, result.simulated = settled_for, result.time_step = time_step;
    result.interrupted = interrupted;
    return result;
  }
};

SettledNet::SettledNet(SettledNet&&) noexcept = default;
SettledNet::~SettledNet() = default;

SettledNet::SettledNet(const Rockfall& r, const std::function<bool(double)>& progress)
    : parts_(std::make_unique<Parts>()) {
  scene::Findings findings("rockfall");
  check(r, findings);
  findings.raise();
  Parts& p = *parts_;
  p.net = barrier::build_net(net_spec(r), p.particles, p.bonds);
  p.topology = barrier::find_topology(p.net, p.particles, p.bonds);
  p.guides = guides_of(r, p.net);
  p.time_step = time_step_of(r, p.bonds, p.particles);
  dem::Solids solids = p.solids(r);
  constexpr int kStretch = 25;  // steps between two brakings
  const double braked = std::exp(-r.settling_drag * kStretch * p.time_step);
  while (solids.time() < r.settling_time && !p.interrupted) {
    for (int n = 0; n < kStretch; ++n) {
      guide(p.guides, solids);
      solids.step();
    }
    p.interrupted = !progress(solids.time());
    // It first falls freely: with drag from the start it would take longer to sag than the ball takes to fall.
    if (solids.time() < 2.0 / 3.0 * r.settling_time) continue;
    for (auto* field : {&solids.particles().velocity, &solids.particles().angular_velocity})
      for (auto* v : {&field->x, &field->y, &field->z})
        for (double& x : *v) x *= braked;
  }
  p.particles = solids.particles();
  p.bonds = solids.bonds();
  p.settled_for = solids.time(), p.steps = solids.step_count();
}

namespace {

/// Watches a strike.
class Strike {
 public:
  Strike(const Rockfall& r, const barrier::Net& net, const dem::Solids& solids, dem::ParticleIndex ball)
      : r_(r), net_(net), solids_(solids), ball_(ball), threads_(barrier::threadings(net)) {
    start_places_ = places();
    energy_at_start_ = solids.ledger().total();
    bond_loss_at_start_ = solids.bond_energy().dissipated();  // as the net came to rest
  }

  /// Peaks between the rows: of tension in every step, of overlap in every 25th, for it looks through all contacts.
  void watch_peaks() {
    for (const barrier::Wire& cable : net_.cables)
      for (std::size_t b = cable.first_bond; b < cable.first_bond + cable.bonds; ++b)
        result.largest_tension = std::max(result.largest_tension, solids_.bonds().axial_force[b]);
    if (solids_.step_count() % 25 == 0)
      result.worst_overlap = std::max(result.worst_overlap, solids_.worst_overlap().ratio);
  }

  void sample(double time, double travelled) {
    RockfallSeries& s = result.series;
    const dem::EnergyLedger ledger = solids_.ledger();
    const dem::BondEnergy& bonds = solids_.bond_energy();
    s.time.push_back(time);
    s.ball_displacement.push_back(travelled);
    s.ball_energy.push_back(ball_energy());
    s.ball_force.push_back(solids_.particles().force.z[ball_] + r_.ball_mass * kGravity);
    s.bond_energy.push_back(bonds.elastic());
    s.friction_loss.push_back(ledger.friction);
    s.contact_loss.push_back(ledger.contact_damping);
    s.bond_loss.push_back(bonds.dissipated() - bond_loss_at_start_);
    s.ledger_gap.push_back(ledger.total() - energy_at_start_);
    sample_brakes();
    sample_rings();
  }

  RockfallResult result;

 private:
  [[nodiscard]] double ball_energy() const {
    return dem::motion_energy(solids_.particles(), ball_, Vec3(0, 0, -kGravity));
  }
  [[nodiscard]] std::vector<double> places() const {
    return barrier::places_on_cables(net_, threads_, solids_.particles(), solids_.bonds());
  }
  void sample_brakes();
  void sample_rings();

  const Rockfall& r_;
  const barrier::Net& net_;
  const dem::Solids& solids_;
  dem::ParticleIndex ball_;
  std::vector<barrier::Threading> threads_;
  std::vector<double> start_places_;
  double energy_at_start_ = 0, bond_loss_at_start_ = 0;
};

void Strike::sample_brakes() {
  const dem::Bonds& bonds = solids_.bonds();
  double sum = 0, energy = 0;
  std::int64_t active = 0;
  for (const std::size_t b : net_.dissipators) {
    const double elongation = bonds.elongation[b];
    const dem::BondConstants law = dem::constants_of(bonds.sorts[static_cast<std::size_t>(bonds.sort[b])]);
    const dem::BondEnergy of_bond = dem::energy_of(bonds, law, b, b + 1);
    sum += elongation;
    energy += of_bond.axial + of_bond.plastic;
    active += elongation > law.axial.e1;
    if (elongation > result.largest_brake_elongation)
      result.largest_brake_elongation = elongation, result.brake_force = bonds.axial_force[b];
  }
  const double mean = sum / static_cast<double>(net_.dissipators.size());
  result.series.brake_elongation.push_back(mean);
  result.series.brake_energy.push_back(energy);
  if (mean > result.brake_elongation) result.brake_elongation = mean, result.brake_energy = energy;
  result.active_brakes = std::max(result.active_brakes, active);
}

void Strike::sample_rings() {
  const barrier::Travel travel = barrier::travel_between(start_places_, places());
  result.series.ring_travel.push_back(travel.mean);
  result.mean_travel = std::max(result.mean_travel, travel.mean);
  result.largest_travel = std::max(result.largest_travel, travel.furthest);
}

/// Linear interpolation of a series.
double at(const std::vector<double>& time, const std::vector<double>& values, double t) {
  const auto above = std::lower_bound(time.begin(), time.end(), t);
  if (above == time.begin()) return values.front();
  if (above == time.end()) return values.back();
  const auto k = static_cast<std::size_t>(above - time.begin());
  return values[k - 1] + (t - time[k - 1]) / (time[k] - time[k - 1]) * (values[k] - values[k - 1]);
}

/// What only the whole series tells.
void conclude(const Rockfall& r, RockfallResult& result) {
  const RockfallSeries& s = result.series;
  const auto lowest = std::ranges::min_element(s.ball_displacement);
  const auto least = std::ranges::min_element(s.ball_energy);
  result.lowest_time = s.time[static_cast<std::size_t>(lowest - s.ball_displacement.begin())];
  result.depth = -*lowest;
  result.least_energy_time = s.time[static_cast<std::size_t>(least - s.ball_energy.begin())];
  result.rebound_energy = s.ball_energy.back() - *least;
  const double kinetic = 0.5 * r.ball_mass * r.impact_speed() * r.impact_speed();
  const double later = 0.5 * r.ball_diameter / r.impact_speed();
  result.lost_until_50_ms = (s.ball_energy.front() - at(s.time, s.ball_energy, 0.05)) / kinetic;
  result.lost_until_50_ms_of_centre = (s.ball_energy.front() - at(s.time, s.ball_energy, 0.05 + later)) / kinetic;
  for (const double gap : s.ledger_gap) keep_worst(result.largest_gap, std::abs(gap) / kinetic);
}

}  // namespace

RockfallResult SettledNet::strike(const Rockfall& r, const std::function<bool(double)>& progress) const {
  const Parts& p = *parts_;
  if (p.interrupted) return p.before_strike(r);
  dem::Solids solids = p.solids(r);
  barrier::Guides guides = p.guides;
  if (r.tied) {
    dem::BondSort tie = barrier::wire_bond(r.ring_stiffness, 0.5 * r.wire_diameter);
    tie.damping_ratio = r.bond_damping_ratio;
    barrier::tie_to_cables(p.net, solids.particles(), solids.bonds().add_sort(tie), solids.bonds());
  }
  const double radius = 0.5 * r.ball_diameter;
  const double density = r.ball_mass / (4.0 / 3.0 * std::numbers::pi * radius * radius * radius);
  double lowest = 0, squares = 0, height = radius;  // of the ball's centre: higher where a flat net is in its way
  for (std::size_t i = 0; i < p.particles.size(); ++i) {
    const Vec3 x = p.particles.position[i];
    lowest = std::min(lowest, x.z());
    squares += p.particles.velocity[i].squaredNorm();
    const double reach = radius + p.particles.radius[i], across = std::hypot(x.x(), x.y());
    if (across < reach) height = std::max(height, x.z() + std::sqrt(reach * reach - across * across));
  }
  const dem::ParticleIndex ball = solids.particles().add({.position = Vec3(0, 0, height),
                                                          .velocity = Vec3(0, 0, -r.impact_speed()),
                                                          .radius = radius,
                                                          .density = density,
                                                          .material = kBall});
  guides.apply(solids.particles());
  solids.advance(0);
  // Springs of the guides are no part of the solids' ledger: their work is external.
  Strike strike(r, p.net, solids, ball);
  strike.result = p.before_strike(r);
  strike.result.settled_sag = -lowest;
  strike.result.settled_speed = std::sqrt(squares / static_cast<double>(p.particles.size()));
  strike.sample(0, height - radius);
  strike.watch_peaks();
  for (std::int64_t k = 1; solids.time() < r.duration && !strike.result.interrupted; ++k) {
    const double until = std::min(static_cast<double>(k) * r.sample_interval, r.duration);
    while (solids.time() < until) {
      guide(guides, solids);
      solids.step();
      strike.watch_peaks();
    }
    strike.sample(solids.time(), solids.particles().position.z[ball] - radius);
    strike.result.interrupted = !progress(solids.time());
  }
  RockfallResult& result = strike.result;
  result.steps += solids.step_count(), result.simulated += solids.time();
  result.lost_links =
      barrier::first_difference(p.topology, barrier::find_topology(p.net, solids.particles(), solids.bonds()));
  conclude(r, result);
  return std::move(strike.result);
}

RockfallResult run_rockfall(const Rockfall& rockfall, const std::function<bool(double)>& progress) {
  return SettledNet(rockfall, progress).strike(rockfall, [&](double t) {
    return progress(rockfall.settling_time + t);
  });
}

}  // namespace lahar::cases
