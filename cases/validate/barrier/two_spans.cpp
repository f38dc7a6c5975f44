// Two spans between three hinged posts that retaining cables hold, left to themselves on a slope: do they come to rest
// with every ring where it hung and the books closed?
#include <algorithm>
#include <cmath>
#include <numbers>

#include "barrier/response.h"
#include "barrier/spans.h"
#include "barrier/topology.h"
#include "cases/validate/dem/ledger_watch.h"
#include "cases/validate/dem/solid_scenes.h"
#include "cases/validate/entry.h"
#include "dem/time_step.h"

namespace lahar::validate {

namespace {

/// The paper's wire, cables and dissipators (Li, Zhao & Kwan 2020, Table 4), a few rings a span, posts of 25 mm tube.
barrier::SpansSpec small_spans(int columns, int rows) {
  barrier::SpansSpec s;
  s.net.width = (columns - 1) * s.net.ring_pitch + s.net.ring_diameter + 1.6 * s.net.wire_diameter;
  s.net.height = (rows - 1) * s.net.ring_pitch + s.net.ring_diameter + 1.6 * s.net.wire_diameter;
  for (dem::BondSort* sort : {&s.net.ring, &s.net.cable, &s.net.dissipator}) sort->damping_ratio = 0.02;
  s.net.lower = barrier::NetCable{};  // tied to the feet, not to the ground
  s.spans = 2;
  s.post_height = s.net.height + 0.02;
  s.post_diameter = 0.025;
  s.section = {
      .youngs_modulus = 210e9, .area = 1.445e-4, .second_moment = 9.63e-9, .density = 7850, .damping_ratio = 0.02};
  s.foot = barrier::FootJoint::hinged;
  s.elements.of<barrier::RetainingCable>() = {{.post = -1, .anchor = {-0.15, 0, 0}, .dissipators_at = {0}},
                                              {.post = 0, .anchor = {0, -0.15, 0}, .dissipators_at = {}},
                                              {.post = 2, .anchor = {0, 0.15, 0}, .dissipators_at = {}}};
  return s;
}

std::vector<Row> run(const Context& context) {
  dem::Particles particles;
  dem::Bonds bonds;
  const barrier::Net net = build_spans(context.quick ? small_spans(3, 2) : small_spans(4, 3), particles, bonds);
  const barrier::Topology before = find_topology(net, particles, bonds);
  const double slope = 35 * std::numbers::pi / 180;
  const Vec3 gravity = kGravity * Vec3(std::sin(slope), 0, -std::cos(slope));
  constexpr double restitution = 0.1;
  const dem::Materials materials = one_material(1e9, 0.3, 0.1, restitution);
  const double step =
      std::min(0.7 * dem::bond_time_step(bonds, particles), 0.14 * dem::rayleigh_time_step(particles, materials));
  dem::Solids solids(std::move(particles), std::move(bonds), materials, {}, solids_options(step, gravity));
  LedgerWatch watch(solids);
  const double duration = context.quick ? 0.05 : 1.5;
  double largest = 0, last = 0;
  Vec3 held = Vec3::Zero();  // N s, over the last third: it still swings a little
  double held_for = 0;
  while (solids.time() < duration) {
    solids.advance(static_cast<int>(1e-3 / step));
    watch.look();
    const dem::EnergyLedger now = solids.ledger();
    last = now.kinetic + now.rotational;
    largest = std::max(largest, last);
    if (solids.time() < duration * 2 / 3) continue;
    held += 1e-3 * response(net, solids.particles(), solids.bonds(), gravity)[barrier::Component::barrier].reaction;
    held_for += 1e-3;
  }
  const barrier::BarrierResponse r = response(net, solids.particles(), solids.bonds(), gravity);
  const bool linked = same_links(before, find_topology(net, solids.particles(), solids.bonds()));
  std::vector<Row> rows{watch.row("two spans"), at_least_row("all links kept (1 = yes)", linked ? 1 : 0, 1),
                        at_most_row("broken bonds", r[barrier::Component::barrier].broken_bonds, 0)};
  if (context.quick) return rows;
  rows.push_back(at_most_row("kinetic energy at the end, of the largest", last / largest, 1e-3));
  double weight = 0;
  for (std::size_t k = 0; k < net.beads; ++k) weight += solids.particles().mass[net.first_bead + k];
  // Fixed beads' own weight is part of what acts on them.
  rows.push_back(
      relative_row("mean reaction of feet and anchors, N", (held / held_for).norm(), weight * kGravity, 1e-4));
  return rows;
}

}  // namespace

Entry two_spans() { return {"barrier.two_spans", {"energy balance; linking numbers; weight"}, run}; }

}  // namespace lahar::validate
