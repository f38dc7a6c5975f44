#include "dem/contact/contact_detection.h"

#include <algorithm>
#include <functional>
#include <limits>

#include "core/check.h"
#include "core/parallel.h"
#include "dem/contact/wall_contacts.h"

namespace lahar::dem {

namespace {

constexpr std::size_t kChunk = 256;

// A refresh costs about as much as ten steps cost for the slots that a wider skin would add.
constexpr std::int64_t kFewSteps = 8, kManySteps = 60;
constexpr double kThinnest = 0.02;

/// What the tangential and rolling springs of slot k hold; R* = 1/(1/Ri + 1/Rj) in m.
ContactTally held_by_springs(const ContactSlots& slots, std::uint32_t k, double effective_radius) {
  const ContactHistory h = slots.history[k];
  ContactTally held;
  held.friction = 0.5 * h.tangential_stiffness * dot(h.tangential_displacement, h.tangential_displacement);
  if (!slots.rolls) return held;
  const double stiffness = effective_radius * effective_radius * h.tangential_stiffness;
  held.rolling = 0.5 * stiffness * dot(slots.rolling[k], slots.rolling[k]);
  return held;
}

/// Copies the histories of row i from `old` to `fresh`: a merge, as both rows ascend by `precedes`. Returns what
/// springs held of those that are gone; effective_radius(i, partner) as above.
template <class Precedes, class EffectiveRadius>
ContactTally carry_row(const ContactSlots& old, ContactSlots& fresh, std::size_t i, const Precedes& precedes,
                       const EffectiveRadius& effective_radius) {
  ContactTally lost;
  std::uint32_t b = fresh.offset[i];
  for (std::uint32_t a = old.offset[i]; a < old.offset[i + 1]; ++a) {
    if (!old.touching[a]) continue;
    while (b < fresh.offset[i + 1] && precedes(fresh.partner[b], old.partner[a])) ++b;
    if (b == fresh.offset[i + 1] || fresh.partner[b] != old.partner[a]) {
      lost += held_by_springs(old, a, effective_radius(i, old.partner[a]));
      continue;
    }
    fresh.history.set(b, old.history[a]);
    if (fresh.rolls) fresh.rolling[b] = old.rolling[a];
    fresh.touching[b] = 1;
  }
  return lost;
}

/// Sums up in the order of ids.
template <class Precedes, class EffectiveRadius>
ContactTally carry_histories(const ContactSlots& old, ContactSlots& fresh, const Numbering& numbering,
                             const Precedes& precedes, const EffectiveRadius& effective_radius) {
  fresh.history.clear(fresh.size());
  fresh.touching.assign(fresh.size(), 0);
  fresh.rolling.assign(fresh.rolls ? fresh.size() : 0, Triple{});
  if (old.offset.empty()) return {};
  const std::size_t rows = std::min(old.offset.size(), fresh.offset.size()) - 1;
  return ordered_sum<ContactTally>(
      rows, [&](std::size_t id) { return carry_row(old, fresh, numbering.index(id), precedes, effective_radius); },
      512);
}

void store(const ContactSlots& slots, const Numbering& numbering, bool with_wall, std::vector<StoredContact>& out) {
  for_each_slot_by_id(slots, numbering, [&](std::uint32_t k) {
    if (!slots.touching[k]) return;
    const std::uint32_t partner = with_wall ? slots.partner[k] : numbering.id(slots.partner[k]);
    out.push_back({numbering.id(slots.owner[k]), partner, with_wall, slots.history[k],
                   slots.rolls ? slots.rolling[k] : Triple{}});
  });
}

}  // namespace

void SlotHistories::reorder(const std::vector<std::uint32_t>& from) {
  RowField moved;
  moved.resize(from.size());
  for (std::size_t k = 0; k < from.size(); ++k) std::copy_n(rows_[from[k]], kRow, moved[k]);
  std::swap(rows_, moved);
}

std::vector<std::uint32_t> ContactSlots::renumber(const Renumbering& change, bool with_walls) {
  std::vector<std::uint32_t> from = change.move_rows(offset);
  for (std::vector<std::uint32_t>* v : {&owner, &partner}) reorder(*v, from);
  for (std::uint32_t& i : owner) i = change.to(i);
  if (!with_walls)
    for (std::uint32_t& j : partner) j = change.to(j);
  history.reorder(from);
  reorder(touching, from);
  reorder(rolling, from);
  return from;
}

bool ContactDetection::outdated(const Particles& particles) {
  ++asked_;
  if (refreshes_ > 0 && particles.size() == listed_at_.size() &&
      !any_moved(particles.position, listed_at_, move_limit2_))
    return false;
  if (refreshes_ > 0 && asked_ < kFewSteps) narrow_share_ = std::min(1.0, 1.5 * narrow_share_);
  if (asked_ > kManySteps) narrow_share_ = std::max(kThinnest, narrow_share_ / 1.5);
  asked_ = 0;
  return true;
}

ContactTally ContactDetection::rebuild(const Particles& particles, const Walls& walls, const PairSet& excluded,
                                       const RateShare& share) {
  neighbours_.build(particles, excluded, share);
  ContactTally lost = refresh(particles, share);
  std::swap(walls_, previous_walls_);
  list_walls(particles, walls, share);
  lost += carry_histories(
      previous_walls_, walls_, particles.numbering, std::less<>{},
      [&](std::size_t i, std::uint32_t w) { return effective_radius_on(walls.all()[w].shape, particles.radius[i]); });
  return lost;
}

ContactTally ContactDetection::refresh(const Particles& particles, const RateShare& share) {
  remember_positions(particles, share);
  std::swap(pairs_, previous_pairs_);
  list_pairs(particles);
  const std::vector<double>& r = particles.radius;
  const ContactTally lost = carry_histories(
      previous_pairs_, pairs_, particles.numbering,
      [&](ParticleIndex a, ParticleIndex b) { return particles.numbering.precedes(a, b); },
      [&](std::size_t i, std::uint32_t j) { return r[i] * r[j] / (r[i] + r[j]); });
  list_parties(particles);
  ++refreshes_;
  return lost;
}

void ContactDetection::set_move_limits(const Particles& particles, const RateShare& share) {
  move_limit2_.resize(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double narrow = share.paired(i) ? narrow_share_ : 1.0;  // others are listed with walls only, in `rebuild`
    const double limit = 0.5 * narrow * neighbours_.skin(particles, i);
    move_limit2_[i] = share.listed(i) ? limit * limit : std::numeric_limits<double>::infinity();
  }
}

void ContactDetection::remember_positions(const Particles& particles, const RateShare& share) {
  listed_at_ = particles.position;
  set_move_limits(particles, share);
  reach_.resize(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double limit = 0.5 * narrow_share_ * neighbours_.skin(particles, i);
    const bool removed = particles.state[i] == ParticleState::removed;
    reach_[i] = {particles.position.x[i], particles.position.y[i], particles.position.z[i],
                 removed ? std::numeric_limits<double>::quiet_NaN() : particles.radius[i] + limit};
  }
}

/// Neighbours of i within the narrow skin, and those whose contact has not been seen to end yet.
void ContactDetection::list_row(std::size_t i, const Numbering& numbering, std::vector<std::uint32_t>& row) const {
  const auto& neighbour = neighbours_.neighbour();
  const std::uint32_t end = neighbours_.offset()[i + 1];
  const bool known = i + 1 < previous_pairs_.offset.size();
  std::uint32_t old = known ? previous_pairs_.offset[i] : 0;
  const std::uint32_t old_end = known ? previous_pairs_.offset[i + 1] : 0;
  const Reach me = reach_[i];
  for (std::uint32_t k = neighbours_.offset()[i]; k < end; ++k) {
    const std::uint32_t j = neighbour[k];
    const double dx = reach_[j].x - me.x, dy = reach_[j].y - me.y, dz = reach_[j].z - me.z;
    const double sum = reach_[j].reach + me.reach;
    bool listed = dx * dx + dy * dy + dz * dz < sum * sum;
    while (old < old_end && numbering.precedes(previous_pairs_.partner[old], j)) ++old;
    if (old < old_end && previous_pairs_.partner[old] == j) listed = listed || previous_pairs_.touching[old] != 0;
    if (listed) row.push_back(j);
  }
}

void ContactDetection::list_pairs(const Particles& particles) {
  const std::size_t n = particles.size();
  chunk_rows_.resize((n + kChunk - 1) / kChunk);
  pairs_.offset.assign(n + 1, 0);
  parallel_for_chunks(n, kChunk, [&](std::size_t first, std::size_t last) {
    auto& rows = chunk_rows_[first / kChunk];
    rows.clear();
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t before = rows.size();
      list_row(i, particles.numbering, rows);
      pairs_.offset[i + 1] = static_cast<std::uint32_t>(rows.size() - before);
    }
  });
  for (std::size_t i = 0; i < n; ++i) pairs_.offset[i + 1] += pairs_.offset[i];
  pairs_.partner.resize(pairs_.offset[n]);
  pairs_.owner.resize(pairs_.offset[n]);
  parallel_for_chunks(n, kChunk, [&](std::size_t first, std::size_t last) {
    const auto& rows = chunk_rows_[first / kChunk];
    std::copy(rows.begin(), rows.end(), pairs_.partner.begin() + pairs_.offset[first]);
    for (std::size_t i = first; i < last; ++i)
      std::fill(pairs_.owner.begin() + pairs_.offset[i], pairs_.owner.begin() + pairs_.offset[i + 1],
                static_cast<std::uint32_t>(i));
  });
}

void ContactDetection::list_parties(const Particles& particles) {
  const std::size_t n = particles.size(), slots = pairs_.size(), chunks = (n + kContactChunk - 1) / kContactChunk;
  ContactParties& t = parties_;
  place_.assign(n, 0);  // whether a particle is in a slot, then its place
  t.first_partner.assign(chunks + 1, 0);
  for (std::size_t k = 0; k < slots; ++k) {
    place_[pairs_.owner[k]] = place_[pairs_.partner[k]] = 1;
    ++t.first_partner[pairs_.partner[k] / kContactChunk + 1];
  }
  t.particle.clear();
  t.first_place.clear();
  for (std::size_t i = 0; i < n; ++i) {
    if (i % kContactChunk == 0) t.first_place.push_back(static_cast<std::uint32_t>(t.particle.size()));
    if (place_[i] == 0) continue;
    place_[i] = static_cast<std::uint32_t>(t.particle.size());
    t.particle.push_back(static_cast<ParticleIndex>(i));
  }
  t.first_place.push_back(static_cast<std::uint32_t>(t.particle.size()));
  for (std::size_t c = 0; c < chunks; ++c) t.first_partner[c + 1] += t.first_partner[c];
  t.owner.resize(slots);
  t.partner.resize(slots);
  t.as_partner.resize(slots);
  std::vector<std::uint32_t>& next = chunk_next_;
  next.assign(t.first_partner.begin(), t.first_partner.end());
  for_each_slot_by_id(pairs_, particles.numbering, [&](std::uint32_t k) {
    t.owner[k] = place_[pairs_.owner[k]];
    t.partner[k] = place_[pairs_.partner[k]];
    t.as_partner[next[pairs_.partner[k] / kContactChunk]++] = {k, t.partner[k]};
  });
}

std::vector<std::uint32_t> ContactDetection::renumber(const Particles& particles, const Renumbering& change) {
  neighbours_.renumber(change);
  change.move(listed_at_);
  change.move(move_limit2_);
  pairs_.renumber(change, false);
  if (!pairs_.offset.empty()) list_parties(particles);
  return walls_.renumber(change, true);
}

void ContactDetection::list_walls(const Particles& particles, const Walls& walls, const RateShare& share) {
  walls_.offset.assign(1, 0);
  walls_.owner.clear();
  walls_.partner.clear();
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double reach = particles.radius[i] + neighbours_.skin(particles, i);
    const Vec3 p = particles.position[i];
    if (particles.state[i] == ParticleState::free && share.single(i) && !particles.is_buried(i))
      for (std::size_t w = 0; w < walls.all().size(); ++w)
        if (walls.distance(w, p) < reach) {
          walls_.owner.push_back(static_cast<std::uint32_t>(i));
          walls_.partner.push_back(static_cast<std::uint32_t>(w));
        }
    walls_.offset.push_back(static_cast<std::uint32_t>(walls_.partner.size()));
  }
}

std::vector<StoredContact> ContactDetection::stored_contacts(const Particles& particles) const {
  std::vector<StoredContact> all;
  store(pairs_, particles.numbering, false, all);
  store(walls_, particles.numbering, true, all);
  return all;
}

void ContactDetection::restore(const Particles& particles, const std::vector<StoredContact>& contacts) {
  for (const auto& c : contacts) {
    ContactSlots& slots = c.with_wall ? walls_ : pairs_;
    require(c.particle + 1 < slots.offset.size(), "restored contact of a particle that does not exist");
    const ParticleIndex i = particles.index(c.particle);
    const auto row = slots.partner.begin() + slots.offset[i], row_end = slots.partner.begin() + slots.offset[i + 1];
    const auto found = std::find(row, row_end, c.with_wall ? c.partner : particles.index(c.partner));
    require(found != row_end, "restored contact between particles that are not near each other");
    const auto k = static_cast<std::size_t>(found - slots.partner.begin());
    slots.history.set(k, c.history);
    if (slots.rolls) slots.rolling[k] = c.rolling;
    slots.touching[k] = 1;
  }
}

}  // namespace lahar::dem
