// A net left to itself for 4 s under gravity: does it come to rest, does its energy only ever fall, and does every ring
// stay where it hangs? The net is the paper's of section 4.1 (wire, stiffness, dissipators, anchors, slope of 35
// degrees), 4 x 3 rings of it: what is asked of a ring and its neighbours does not depend on how many there are.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "barrier/net.h"
#include "barrier/topology.h"
#include "cases/scene/scene.h"
#include "cases/validate/entry.h"
#include "core/worst.h"
#include "dem/solids.h"
#include "dem/time_step.h"

namespace lahar::validate {

namespace {

struct HangingNet {
  barrier::Net net;
  barrier::Topology topology;
  dem::Solids solids;
};

HangingNet hang(int columns, int rows, dem::WireContacts wires) {
  barrier::RingNetSpec spec;  // its defaults are the paper's net
  spec.fit = barrier::NetFit::cables_on_frame;
  spec.width = columns * spec.ring_pitch, spec.height = rows * spec.ring_pitch;
  for (dem::BondSort* sort : {&spec.ring, &spec.cable, &spec.dissipator}) sort->damping_ratio = 0.02;
  dem::Particles particles;
  dem::Bonds bonds;
  barrier::Net net = barrier::build_net(spec, particles, bonds);
  barrier::Topology topology = barrier::find_topology(net, particles, bonds);
  dem::Materials materials;
  materials.add({"steel", 10e9, 0.3});
  constexpr double restitution = 0.1;
  materials.set_pair(0, 0, 0.1, restitution);
  dem::SolidsOptions options;
  options.wire_contacts = wires;
  const double slope = 35 * std::numbers::pi / 180;
  options.gravity = 9.81 * Vec3(std::sin(slope), 0, -std::cos(slope));
  const scene::Solids defaults;
  options.time_step = std::min(defaults.bond_safety * dem::bond_time_step(bonds, particles),
                               defaults.contact_safety * dem::rayleigh_time_step(particles, materials));
  return {std::move(net), std::move(topology),
          dem::Solids(std::move(particles), std::move(bonds), std::move(materials), Walls{}, options)};
}

/// What a net at rest is watched for.
struct Fall {
  double largest_kinetic = 0, last_kinetic = 0;  ///< J
  double released = 0;                           ///< J: stored energy lost in all, by a net that falls
  [[nodiscard]] double share(double energy) const { return energy / std::abs(released); }
  double largest_rise = 0;  ///< J, of the stored energy between two samples
  double largest_gap = 0;   ///< J
  bool linked = true;
};

Fall watch(HangingNet& hanging, double duration, double interval, int samples_per_link_check) {
  dem::Solids& solids = hanging.solids;
  solids.advance(0);
  const dem::EnergyLedger first = solids.ledger();
  double stored = first.stored();
  Fall fall;
  const int steps = static_cast<int>(interval / solids.options().time_step);
  for (int sample = 1; solids.time() < duration; ++sample) {
    solids.advance(steps);
    const dem::EnergyLedger now = solids.ledger();
    fall.last_kinetic = now.kinetic + now.rotational;
    fall.largest_kinetic = std::max(fall.largest_kinetic, fall.last_kinetic);
    keep_worst(fall.largest_rise, now.stored() - std::exchange(stored, now.stored()));
    keep_worst(fall.largest_gap, std::abs(now.total() - first.total()));
    if (sample % samples_per_link_check == 0)
      fall.linked =
          fall.linked && same_links(hanging.topology, find_topology(hanging.net, solids.particles(), solids.bonds()));
  }
  fall.released = first.stored() - stored;
  return fall;
}

std::vector<Row> run(const Context& context) {
  HangingNet hanging = context.quick ? hang(3, 2, dem::WireContacts::beads) : hang(4, 3, dem::WireContacts::beads);
  const Fall fall = watch(hanging, context.quick ? 0.12 : 4.0, 0.01, context.quick ? 1 : 20);
  std::vector<Row> rows{
      at_most_row("largest rise of the stored energy in 10 ms, of what is lost", fall.share(fall.largest_rise), 1e-4),
      at_most_row("gap of the energy ledger, of what is lost", fall.share(fall.largest_gap), 1e-3),
      at_least_row("energy is lost (1 = yes)", fall.released > 0 ? 1 : 0, 1),
      at_least_row("all links kept (1 = yes)", fall.linked ? 1 : 0, 1)};
  HangingNet smooth = hang(3, 2, dem::WireContacts::capsules);
  const Fall smooth_fall = watch(smooth, context.quick ? 0.05 : 0.5, 0.01, 1);
  rows.push_back(at_most_row("smooth wires: largest rise of the stored energy in 10 ms, of what is lost",
                             smooth_fall.share(smooth_fall.largest_rise), 1e-4));
  rows.push_back(at_most_row("smooth wires: gap of the energy ledger, of what is lost",
                             smooth_fall.share(smooth_fall.largest_gap), 1e-3));
  rows.push_back(at_least_row("smooth wires: energy is lost (1 = yes)", smooth_fall.released > 0 ? 1 : 0, 1));
  rows.push_back(at_least_row("smooth wires: all links kept (1 = yes)", smooth_fall.linked ? 1 : 0, 1));
  if (!context.quick)
    rows.push_back(
        at_most_row("kinetic energy after 4 s, of the largest", fall.last_kinetic / fall.largest_kinetic, 1e-3));
  return rows;
}

}  // namespace

Entry net_at_rest() { return {"barrier.net_at_rest", {"energy balance; linking numbers"}, run}; }

}  // namespace lahar::validate
