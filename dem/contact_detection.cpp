#include "dem/contact_detection.h"

#include <algorithm>

#include "core/check.h"
#include "core/parallel.h"

namespace lahar::dem {

namespace {

/// Copies the histories of row i from `old` to `fresh`: a merge, as both rows ascend.
void carry_row(const ContactSlots& old, ContactSlots& fresh, std::size_t i) {
  std::uint32_t a = old.offset[i];
  for (std::uint32_t b = fresh.offset[i]; b < fresh.offset[i + 1]; ++b) {
    while (a < old.offset[i + 1] && old.partner[a] < fresh.partner[b]) ++a;
    if (a == old.offset[i + 1]) return;
    if (old.partner[a] != fresh.partner[b] || !old.touching[a]) continue;
    fresh.history[b] = old.history[a];
    fresh.touching[b] = 1;
  }
}

void carry_histories(const ContactSlots& old, ContactSlots& fresh) {
  fresh.history.assign(fresh.size(), ContactHistory{});
  fresh.touching.assign(fresh.size(), 0);
  if (old.offset.empty()) return;
  const std::size_t rows = std::min(old.offset.size(), fresh.offset.size()) - 1;
  parallel_for(0, rows, 512, [&](std::size_t i) { carry_row(old, fresh, i); });
}

void store(const ContactSlots& slots, bool with_wall, std::vector<StoredContact>& out) {
  for (std::size_t i = 0; i + 1 < slots.offset.size(); ++i)
    for (std::uint32_t k = slots.offset[i]; k < slots.offset[i + 1]; ++k)
      if (slots.touching[k])
        out.push_back({static_cast<ParticleIndex>(i), slots.partner[k], with_wall, slots.history[k]});
}

}  // namespace

void ContactDetection::rebuild(const Particles& particles, const Walls& walls, const PairSet& excluded) {
  neighbours_.build(particles, excluded);
  std::swap(pairs_, previous_pairs_);
  pairs_.offset = neighbours_.offset();
  pairs_.partner = neighbours_.neighbour();
  carry_histories(previous_pairs_, pairs_);
  list_partners(particles.size());

  std::swap(walls_, previous_walls_);
  list_walls(particles, walls);
  carry_histories(previous_walls_, walls_);
}

void ContactDetection::list_partners(std::size_t particles) {
  partner_offset_.assign(particles + 1, 0);
  for (const auto j : pairs_.partner) ++partner_offset_[j];
  std::uint32_t sum = 0;
  for (auto& o : partner_offset_) sum += o, o = sum;
  slot_of_partner_.resize(pairs_.size());
  for (std::size_t k = pairs_.size(); k-- > 0;)
    slot_of_partner_[--partner_offset_[pairs_.partner[k]]] = static_cast<std::uint32_t>(k);
}

void ContactDetection::list_walls(const Particles& particles, const Walls& walls) {
  walls_.offset.assign(1, 0);
  walls_.partner.clear();
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double reach = particles.radius[i] + neighbours_.skin(particles, i);
    const Vec3 p = particles.position[i];
    if (particles.state[i] == ParticleState::free)
      for (std::size_t w = 0; w < walls.all().size(); ++w)
        if (walls.distance(w, p) < reach) walls_.partner.push_back(static_cast<std::uint32_t>(w));
    walls_.offset.push_back(static_cast<std::uint32_t>(walls_.partner.size()));
  }
}

std::vector<StoredContact> ContactDetection::stored_contacts() const {
  std::vector<StoredContact> all;
  store(pairs_, false, all);
  store(walls_, true, all);
  return all;
}

void ContactDetection::restore(const std::vector<StoredContact>& contacts) {
  for (const auto& c : contacts) {
    ContactSlots& slots = c.with_wall ? walls_ : pairs_;
    require(c.particle + 1 < slots.offset.size(), "restored contact of a particle that does not exist");
    const auto row = slots.partner.begin() + slots.offset[c.particle];
    const auto row_end = slots.partner.begin() + slots.offset[c.particle + 1];
    const auto found = std::find(row, row_end, c.partner);
    require(found != row_end, "restored contact between particles that are not near each other");
    const auto k = static_cast<std::size_t>(found - slots.partner.begin());
    slots.history[k] = c.history;
    slots.touching[k] = 1;
  }
}

}  // namespace lahar::dem
