// Case H16 of reference/hard_cases.csv: a ring net in free fall stays as it is; a net that tumbles keeps its angular
// momentum; a net that hangs loses energy until it is still.
#include <fmt/format.h>

#include <cmath>

#include "barrier/net.h"
#include "cases/validate/dem/ledger_watch.h"
#include "cases/validate/dem/solid_scenes.h"
#include "cases/validate/entry.h"
#include "core/worst.h"
#include "dem/time_step.h"

namespace lahar::validate {

namespace {

/// The paper's rings and wire (Li, Zhao & Kwan 2020, Table 4), fewer of them.
barrier::RingNetSpec net_spec(int columns, int rows) {
  barrier::RingNetSpec s;
  s.width = 0.06 * columns;
  s.height = 0.06 * rows;
  s.fit = barrier::NetFit::cables_on_frame;
  return s;
}

struct Scene {
  dem::Particles particles;
  dem::Bonds bonds;
  barrier::Net net;
};

Scene build(const barrier::RingNetSpec& spec) {
  Scene s;
  s.net = barrier::build_net(spec, s.particles, s.bonds);
  return s;
}

dem::Solids solids_of(const Scene& s, double share, const dem::Materials& materials, const Vec3& gravity) {
  return {
      s.particles, s.bonds, materials, {}, solids_options(share * dem::bond_time_step(s.bonds, s.particles), gravity)};
}

/// Largest change of a bead's place against the first bead, m.
double deformation(const Vec3Field& start, const Vec3Field& now) {
  double worst = 0;
  for (std::size_t i = 1; i < start.size(); ++i) keep_worst(worst, (now[i] - now[0] - start[i] + start[0]).norm());
  return worst;
}

void ask_fall(std::vector<Row>& rows, const Scene& scene, double time) {
  dem::Solids solids = solids_of(scene, 0.6, one_material(10e9, 0.3, 0.1, 0.1), Vec3(0, 0, -kGravity));
  LedgerWatch watch(solids);
  const int steps = static_cast<int>(std::lround(time / solids.options().time_step));
  advance_watched(solids, watch, steps, 1000);
  const double t = solids.time(), fallen = scene.particles.position.z[0] - solids.particles().position.z[0];
  rows.push_back(relative_row("free fall: way of the first bead, m", fallen, 0.5 * kGravity * t * t, 1e-9));
  rows.push_back(at_most_row("free fall: deformation, m",
                             deformation(scene.particles.position, solids.particles().position), 1e-9));
  rows.push_back(watch.row("free fall"));
}

void ask_tumble(std::vector<Row>& rows, Scene scene, double time) {
  const Vec3 spin(50, -30, 80);  // rad/s
  for (std::size_t i = 0; i < scene.particles.size(); ++i)
    scene.particles.velocity.set(i,
                                 spin.cross(scene.particles.position[i] - scene.particles.position[0]) + Vec3(1, 2, 3));
  dem::Solids solids = solids_of(scene, 0.25, one_material(10e9, 0.3, 0.1, 0.5), Vec3::Zero());
  LedgerWatch watch(solids);
  const Vec3 momentum = dem::momentum(solids.particles()), angular = dem::angular_momentum(solids.particles());
  advance_watched(solids, watch, static_cast<int>(time / solids.options().time_step), 20);
  const dem::EnergyLedger l = solids.ledger();
  rows.push_back(at_most_row("tumbling: change of angular momentum",
                             (dem::angular_momentum(solids.particles()) - angular).norm() / angular.norm(), 1e-10));
  rows.push_back(at_most_row("tumbling: change of momentum",
                             (dem::momentum(solids.particles()) - momentum).norm() / momentum.norm(), 1e-10));
  rows.push_back(
      at_least_row("tumbling: energy that contacts took, J (they do act)", l.friction + l.contact_damping, 1e-6));
  rows.push_back(watch.row("tumbling"));
}

/// Hangs from its upper cable; bonds damped as in a scene by default.
void ask_hanging(std::vector<Row>& rows, barrier::RingNetSpec spec, double time) {
  spec.lower.present = spec.left.present = spec.right.present = false;
  for (dem::BondSort* sort : {&spec.ring, &spec.cable, &spec.dissipator}) sort->damping_ratio = 0.02;
  const Scene scene = build(spec);
  dem::Solids solids = solids_of(scene, 0.35, one_material(10e9, 0.3, 0.1, 0.1), Vec3(0, 0, -kGravity));
  LedgerWatch watch(solids);
  const auto mechanical = [&] { return solids.ledger().stored(); };
  const auto height = [&] {
    double sum = 0;
    for (std::size_t i = 0; i < solids.particles().size(); ++i) sum += solids.particles().position.z[i];
    return sum / static_cast<double>(solids.particles().size());
  };
  const double start = mechanical();
  double before = start, rise = 0, height_before_last = 0;
  const int pieces = 500, steps = static_cast<int>(time / solids.options().time_step) / pieces;
  for (int k = 0; k < pieces; ++k) {
    solids.advance(steps);
    watch.look();
    rise = std::max(rise, mechanical() - before);
    before = std::min(before, mechanical());
    if (k == pieces * 4 / 5) height_before_last = height();
  }
  const dem::EnergyLedger l = solids.ledger();
  rows.push_back(at_most_row("hanging: largest rise of the energy / what was lost", rise / (start - before), 1e-3));
  rows.push_back(
      at_most_row("hanging: kinetic energy left / what was lost", (l.kinetic + l.rotational) / (start - before), 1e-5));
  rows.push_back(at_most_row("hanging: drift of the mean height in the last fifth, m",
                             std::abs(height() - height_before_last), 1e-6));
  rows.push_back(watch.row("hanging"));
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  barrier::RingNetSpec spec = net_spec(context.quick ? 2 : 3, context.quick ? 2 : 3);
  spec.free_net = true;
  const Scene loose = build(spec);
  ask_fall(rows, loose, context.quick ? 0.05 : 1.0);
  ask_tumble(rows, loose, context.quick ? 0.02 : 0.2);
  if (!context.quick) ask_hanging(rows, net_spec(2, 2), 5.0);
  return rows;
}

}  // namespace

Entry net_in_free_fall() {
  return {"barrier.net_in_free_fall",
          {"case H16 of the hard cases: a net in free fall, tumbling, hanging", {"hard_cases.csv"}},
          run};
}

}  // namespace lahar::validate
