// Case H9 of reference/hard_cases.csv: bonds that snap. The energy that a bond held is booked when it breaks, momentum
// is kept, and what is left of a ring with 0, 1 or 2 bonds flies on.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "cases/validate/dem/ledger_watch.h"
#include "cases/validate/dem/solid_scenes.h"
#include "cases/validate/entry.h"

namespace lahar::validate {

namespace {

constexpr double kRadius = 0.00305, kDensity = 7800;  // m, kg/m^3: bead of the paper's net
constexpr double kStrength = 3e7, kWeak = 1e6;  // Pa: of the pair, and of the ring, whose hoop stress reaches 2 MPa
constexpr int kBeads = 36;

dem::BondSort wire(double strength) {
  dem::BondSort s;
  s.axial.stiffness = {3e11, 3e11, 3e11};
  s.shear_stiffness = 3e11;
  s.bond_radius = kRadius;
  s.tensile_strength = s.shear_strength = strength;
  return s;
}

dem::ParticleSpec bead(const Vec3& position, const Vec3& velocity) {
  dem::ParticleSpec s;
  s.position = position;
  s.velocity = velocity;
  s.radius = kRadius;
  s.density = kDensity;
  s.kind = dem::ParticleKind::bead;
  s.body = 0;
  return s;
}

/// A ring that spins and flies, all bonds weak but `left` of them; it stretches until the weak ones snap.
dem::Solids spinning_ring(int left) {
  dem::Particles p;
  dem::Bonds b;
  b.add_sort(wire(kWeak));
  b.add_sort(wire(std::numeric_limits<double>::infinity()));
  const double radius = kRadius / std::sin(std::numbers::pi / kBeads), spin = 400;  // m, rad/s
  for (int k = 0; k < kBeads; ++k) {
    const double a = 2 * std::numbers::pi * k / kBeads;
    const Vec3 out(std::cos(a), std::sin(a), 0), along(-std::sin(a), std::cos(a), 0);
    dem::ParticleSpec s = bead(radius * out, spin * radius * along + Vec3(1, 2, 3));
    s.angular_velocity = Vec3(0, 0, spin);
    p.add(s);
  }
  for (dem::ParticleIndex k = 0; k < kBeads; ++k) b.add({k, (k + 1) % kBeads, static_cast<int>(k) < left ? 1 : 0}, p);
  return {p, b, one_material(1e10, 0.3, 0.1, 0.5), {}, solids_options(2e-6, Vec3::Zero())};
}

void ask_ring(std::vector<Row>& rows, int left) {
  dem::Solids solids = spinning_ring(left);
  LedgerWatch watch(solids);
  const Vec3 momentum = dem::momentum(solids.particles());
  const Vec3 spin = dem::angular_momentum(solids.particles());
  advance_watched(solids, watch, 50000, 10);
  const dem::Particles& p = solids.particles();
  int intact = 0;
  for (const auto i : solids.bonds().intact) intact += i;
  double fastest = 0;
  for (std::size_t i = 0; i < p.size(); ++i) fastest = std::max(fastest, p.velocity[i].norm());
  const std::string name = fmt::format("ring left with {} bonds", left);
  rows.push_back(absolute_row(name + ": bonds", intact, left, 0));
  rows.push_back(at_most_row(name + ": fastest fragment, m/s", fastest, 36));  // twice what is found
  rows.push_back(
      at_most_row(name + ": change of momentum", (dem::momentum(p) - momentum).norm() / momentum.norm(), 1e-10));
  rows.push_back(at_most_row(name + ": change of angular momentum",
                             (dem::angular_momentum(p) - spin).norm() / spin.norm(), 1e-10));
  rows.push_back(watch.row(name));
}

/// Two beads fly apart until their bond snaps: the energy booked is what a bond holds at its strength, and what the
/// beads keep is the rest.
void ask_pair(std::vector<Row>& rows) {
  const double area = std::numbers::pi * kRadius * kRadius, mass = sphere_mass(kRadius, kDensity);
  const double held = 0.5 * std::pow(kStrength * area, 2) / (3e11 * area);
  const double speed = 1.5 * std::sqrt(held / mass);  // kinetic energy of both: 2.25 times what the bond holds
  dem::Particles p;
  p.add(bead({-kRadius, 0, 0}, {-speed, 0, 0}));
  p.add(bead({kRadius, 0, 0}, {speed, 0, 0}));
  dem::Bonds b;
  b.add_sort(wire(kStrength));
  b.add({0, 1, 0}, p);
  dem::Solids solids(p, b, one_material(1e10, 0.3, 0.1, 0.5), {}, solids_options(5e-9, Vec3::Zero()));
  LedgerWatch watch(solids);
  double before = 0;  // J, held by the bond in the step before it broke
  for (int k = 0; k < 20000 && solids.bonds().intact[0] != 0; ++k) {
    before = solids.bond_energy().elastic();
    solids.step();
    watch.look();
  }
  const double after = solids.ledger().kinetic;
  advance_watched(solids, watch, 1000, 1);
  rows.push_back(relative_row("pair: energy booked at breakage, J", solids.bond_energy().breakage, held, 2e-3));
  rows.push_back(relative_row("pair: the same against what the bond held a step before", solids.bond_energy().breakage,
                              before, 2e-3));
  rows.push_back(relative_row("pair: kinetic energy afterwards, J", after, mass * speed * speed - held, 2e-3));
  rows.push_back(at_most_row("pair: momentum / that of one bead",
                             dem::momentum(solids.particles()).norm() / (mass * speed), 1e-10));
  rows.push_back(watch.row("pair"));
}

std::vector<Row> run(const Context&) {
  std::vector<Row> rows;
  ask_pair(rows);
  for (const int left : {0, 1, 2}) ask_ring(rows, left);
  return rows;
}

}  // namespace

Entry bond_breakage() {
  return {"dem.bond_breakage", {"case H9 of the hard cases: bonds that snap", {"hard_cases.csv"}}, run};
}

}  // namespace lahar::validate
