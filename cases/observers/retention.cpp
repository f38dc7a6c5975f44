#include "cases/observers/retention.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "barrier/response.h"
#include "cases/observers/grains.h"

namespace lahar::cases {

Retention::Retention(const Observed& run) : Observer(run) {
  result("retained_mass_ratio", "1",
         "share by mass of the grains that are held at the end: upstream of `measure.section_x_m` (by default the "
         "net's plane or the rigid barrier's upstream face, if there is a fluid), or of the net's foremost bead along "
         "its normal (posts, what hangs on them "
         "and torn wires aside) "
         "where it has bulged beyond it",
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

namespace {

/// The measured section where that is not the net's own plane, as by default, m.
std::optional<double> own_section(const scene::Scene& scene, const barrier::Net* net) {
  const std::optional<double> section = scene.measure.section_x;
  return net != nullptr && section == scene.barrier.net.origin.x() ? std::nullopt : section;
}

}  // namespace

/// How far along the net's normal its grains are held, m: to the net's plane where that is the measured section, or to
/// the foremost bead of the net where it has bulged beyond it. Posts and what else hangs on them hold no grain, nor do
/// wires and nodes of meshes that are torn, which may fly off, and what has left the domain.
double Retention::reach_of(const barrier::Net& net) const {
  const bool is_section = !own_section(run_.scene, &net);
  double reach = is_section ? run_.scene.barrier.net.origin.dot(net.normal) : -std::numeric_limits<double>::infinity();
  const auto& p = run_.simulation.solids()->particles();
  const scene::Domain& domain = run_.scene.domain;
  const std::vector<bool> holding = barrier::holding_beads(net, run_.simulation.solids()->bonds());
  const auto reach_to = [&](dem::ParticleId first, std::size_t count) {
    for (dem::ParticleId id = first; id < first + count; ++id) {
      const Vec3 bead = p.position[p.index(id)];
      const bool inside = (bead.array() >= domain.lower.array()).all() && (bead.array() <= domain.upper.array()).all();
      if (holding[id - net.first_bead] && inside) reach = std::max(reach, bead.dot(net.normal) + p.radius[p.index(id)]);
    }
  };
  for (const auto* wires : {&net.rings, &net.cables})
    for (const barrier::Wire& wire : *wires) reach_to(wire.first_bead, wire.beads);
  for (const barrier::MeshPart& mesh : net.meshes) reach_to(mesh.first_node, mesh.nodes);
  return reach;
}

Retained Retention::now() const {
  const auto& p = run_.simulation.solids()->particles();
  const barrier::Net* net = run_.simulation.net();
  const std::optional<double> section = own_section(run_.scene, net);
  const double reach = net != nullptr ? reach_of(*net) : 0;
  const auto is_kept = [&](std::size_t i) {
    if (p.state[i] == dem::ParticleState::removed) return false;
    const Vec3 at = p.position[i];
    return (section && at.x() <= *section) || (net != nullptr && at.dot(net->normal) <= reach);
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
