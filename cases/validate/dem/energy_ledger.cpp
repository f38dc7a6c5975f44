// The energy ledger of the solids: stored, lost and gained add up in scenes that use all of its terms.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "barrier/net.h"
#include "cases/validate/dem/ledger_watch.h"
#include "cases/validate/dem/solid_scenes.h"
#include "cases/validate/entry.h"
#include "dem/packing/packing.h"
#include "dem/time_step.h"

namespace lahar::validate {

namespace {

dem::ParticleSpec grain(const Vec3& position, double radius, const Vec3& velocity) {
  dem::ParticleSpec s;
  s.position = position;
  s.velocity = velocity;
  s.radius = radius;
  s.density = 2650;
  return s;
}

/// Two sizes of grains fall apart in a box with a floor that moves like a belt: friction, damping, work of a wall; one
/// of them is taken out half-way.
void ask_grains(std::vector<Row>& rows, int count, double time) {
  dem::PackingSpec spec;
  spec.upper = Vec3(0.2, 0.2, 2);
  spec.classes = {{0.02, count / 4, 2650, 0}, {0.01, count, 2650, 0}};
  dem::Particles p;
  for (dem::ParticleSpec s : dem::pack(spec)) {
    s.position.z() += 0.05;
    p.add(s);
  }
  Walls walls;
  walls.add({"belt", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}, WallSlip::no_slip, 0, Vec3(1, 0, 0)});
  for (const Vec3& n : {Vec3(1, 0, 0), Vec3(0, 1, 0)}) {
    walls.add({"near", HalfSpace{Vec3::Zero(), n}});
    walls.add({"far", HalfSpace{0.4 * n, -n}});
  }
  const dem::Materials m = one_material(1e8, 0.25, 0.5, 0.3);
  const double step = 0.1 * dem::rayleigh_time_step(0.01, 2650, m[0]);  // 0.14 is the default
  dem::Solids solids(p, {}, m, walls, solids_options(step, Vec3(0, 0, -kGravity)));
  LedgerWatch watch(solids);
  const int steps = static_cast<int>(time / step);
  advance_watched(solids, watch, steps / 2, 20);
  solids.remove(0);  // a large one, in the middle of the others
  watch.look();
  advance_watched(solids, watch, steps / 2, 20);
  const dem::EnergyLedger l = solids.ledger();
  rows.push_back(watch.row("grains on a belt"));
  for (const auto& [name, value] : {std::pair{"friction", l.friction},
                                    {"contact damping", l.contact_damping},
                                    {"work of the belt", l.external_work}})
    rows.push_back(
        at_least_row(fmt::format("grains on a belt: {} / exchanged", name), value / watch.exchanged(), 0.02));
}

/// A boulder falls into a small net with plastic brakes, damped bonds and, if so asked, bonds that break.
void ask_net(std::vector<Row>& rows, bool breaks, double time) {
  barrier::RingNetSpec spec;
  spec.width = 0.24;
  spec.height = 0.24;
  spec.up = Vec3::UnitX(), spec.normal = -Vec3::UnitZ();  // lies flat, loaded from above
  spec.fit = barrier::NetFit::cables_on_frame;
  spec.lower = spec.upper = {true, {.fixed_at = {0, 1}, .fixed_all = false, .dissipators_at = {0, 1}}};
  spec.left = spec.right = spec.lower;
  spec.dissipator = barrier::dissipator_bond(8e11, 8e10, 500, 0);
  spec.dissipator.axial.plastic_unloading = true;
  for (dem::BondSort* sort : {&spec.ring, &spec.cable, &spec.dissipator}) sort->damping_ratio = 0.02;
  if (breaks) spec.ring.tensile_strength = spec.ring.shear_strength = 2e7;
  dem::Particles p;
  dem::Bonds b;
  barrier::build_net(spec, p, b);
  const double radius = 0.06;
  p.add(grain(Vec3(0.12, 0.12, radius + 0.02), radius, Vec3(0.3, 0.2, breaks ? -12 : -6)));
  const dem::Materials m = one_material(10e9, 0.3, 0.1, 0.3);
  const double step = std::min((breaks ? 0.25 : 0.5) * dem::bond_time_step(b, p), 0.2 * dem::rayleigh_time_step(p, m));
  dem::Solids solids(p, b, m, {}, solids_options(step, Vec3(0, 0, -kGravity)));
  LedgerWatch watch(solids);
  advance_watched(solids, watch, static_cast<int>(time / step), 20);
  const std::string name = breaks ? "net that tears" : "net with brakes";
  rows.push_back(watch.row(name));
  const dem::BondEnergy& e = solids.bond_energy();
  rows.push_back(at_least_row(name + ": bond damping / exchanged", e.damping / watch.exchanged(), 1e-3));
  if (breaks) rows.push_back(at_least_row(name + ": breakage / exchanged", e.breakage / watch.exchanged(), 1e-3));
  if (!breaks) rows.push_back(at_least_row(name + ": plastic work / exchanged", e.plastic / watch.exchanged(), 1e-2));
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  ask_grains(rows, context.quick ? 100 : 600, context.quick ? 0.2 : 0.6);
  ask_net(rows, false, context.quick ? 0.02 : 0.1);
  ask_net(rows, true, context.quick ? 0.02 : 0.1);
  return rows;
}

}  // namespace

Entry energy_ledger() { return {"dem.energy_ledger", {"conservation of energy"}, run}; }

}  // namespace lahar::validate
