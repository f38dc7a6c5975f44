#include "cases/observers/retention.h"

#include <algorithm>
#include <vector>

#include "barrier/response.h"
#include "cases/observers/grains.h"

namespace lahar::cases {

Retention::Retention(const Observed& run) : Observer(run) {
  result("retained_mass_ratio", "1",
         "share by mass of the grains that are held at the end: upstream of the measured section, or of the net's "
         "foremost bead (posts, what hangs on them and torn wires aside) where it has bulged beyond it",
         [this] { return now().mass; })
      .unknown_at_times();
  result(
      "retained_small_grains_ratio", "1",
      "share by number of the grains smaller than the middle of smallest and largest that are held; absent if all are "
      "equal",
      [this] { return now().small; })
      .unknown_at_times();
  result("retained_large_grains_ratio", "1", "share by number of the larger grains that are held", [this] {
    return now().large;
  }).unknown_at_times();
}

/// How far down a grain may be and still count as held: the net's section, or the foremost bead of the net where it has
/// bulged beyond it. Posts and what else hangs on them hold no grain, nor do wires and nodes of meshes that
/// are torn, which may fly off, and what has left the domain.
double Retention::limit() const {
  double limit = *run_.section;
  const barrier::Net* net = run_.simulation.net();
  if (net == nullptr) return limit;
  const auto& p = run_.simulation.solids()->particles();
  const dem::Bonds& bonds = run_.simulation.solids()->bonds();
  const scene::Domain& domain = run_.scene.domain;
  const std::vector<bool> holding = barrier::holding_beads(*net, bonds);
  const auto reach = [&](dem::ParticleId first, std::size_t count) {
    for (dem::ParticleId id = first; id < first + count; ++id) {
      const Vec3 bead = p.position[p.index(id)];
      const bool inside = (bead.array() >= domain.lower.array()).all() && (bead.array() <= domain.upper.array()).all();
      if (holding[id - net->first_bead] && inside) limit = std::max(limit, bead.x() + p.radius[p.index(id)]);
    }
  };
  for (const auto* wires : {&net->rings, &net->cables})
    for (const barrier::Wire& wire : *wires) reach(wire.first_bead, wire.beads);
  for (const barrier::MeshPart& mesh : net->meshes) reach(mesh.first_node, mesh.nodes);
  return limit;
}

Retained Retention::now() const {
  const auto& p = run_.simulation.solids()->particles();
  const double furthest = limit();
  const auto is_kept = [&](std::size_t i) {
    return p.state[i] != dem::ParticleState::removed && p.position.x[i] <= furthest;
  };
  double mass = 0, kept = 0, smallest = 1e300, largest = 0;
  for (dem::ParticleId id = 0; id < p.size(); ++id) {
    const dem::ParticleIndex i = p.index(id);
    if (!is_loose_grain(p, i)) continue;
    mass += p.mass[i];
    kept += is_kept(i) ? p.mass[i] : 0.0;
    smallest = std::min(smallest, p.radius[i]), largest = std::max(largest, p.radius[i]);
  }
  Retained retained;
  if (mass <= 0) return retained;
  retained.mass = kept / mass;
  if (!(largest > smallest)) return retained;
  double count[2] = {0, 0}, held[2] = {0, 0};
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!is_loose_grain(p, i)) continue;
    const std::size_t size = p.radius[i] > 0.5 * (smallest + largest) ? 1 : 0;
    count[size] += 1, held[size] += is_kept(i) ? 1 : 0;
  }
  if (count[0] > 0) retained.small = held[0] / count[0];
  if (count[1] > 0) retained.large = held[1] / count[1];
  return retained;
}

}  // namespace lahar::cases
