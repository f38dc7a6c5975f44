#include "dem/contact/worst_overlap.h"

#include <algorithm>

namespace lahar::dem {

WorstOverlap worst_overlap(const Particles& p, const ContactDetection& contacts, const Walls& walls) {
  WorstOverlap worst;
  const auto note = [&](double ratio, ParticleIndex i, std::uint32_t partner, bool with_wall) {
    if (ratio > worst.ratio) worst = {ratio, p.id(i), partner, with_wall};
  };
  const ContactSlots &pairs = contacts.pairs(), &wall = contacts.wall_contacts();
  for_each_slot_by_id(pairs, p.numbering, [&](std::uint32_t k) {
    const ParticleIndex i = pairs.owner[k], j = pairs.partner[k];
    if (pairs.touching[k] == 0 || p.state[i] == ParticleState::removed || p.state[j] == ParticleState::removed) return;
    const double dx = p.position.x[i] - p.position.x[j], dy = p.position.y[i] - p.position.y[j],
                 dz = p.position.z[i] - p.position.z[j], distance = std::sqrt(dx * dx + dy * dy + dz * dz);
    note((p.radius[i] + p.radius[j] - distance) / std::min(p.radius[i], p.radius[j]), i, p.id(j), false);
  });
  for_each_slot_by_id(wall, p.numbering, [&](std::uint32_t k) {
    const std::uint32_t i = wall.owner[k], w = wall.partner[k];
    if (wall.touching[k] == 0 || p.state[i] == ParticleState::removed) return;
    note((p.radius[i] - walls.distance(w, p.position[i])) / p.radius[i], i, w, true);
  });
  return worst;
}

}  // namespace lahar::dem
