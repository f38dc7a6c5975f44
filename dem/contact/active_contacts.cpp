#include "dem/contact/active_contacts.h"

#include <algorithm>
#include <array>
#include <bit>

#include "core/simd_math.h"

namespace lahar::dem {

namespace {

// The law decides whether two spheres touch; what rounds otherwise here must not be left out.
constexpr double kMargin = 1 + 1e-12;

/// Bit l: whether spheres i[l] and j[l] may touch.
template <class V>
[[gnu::always_inline]] inline auto may_touch(const Particles& p, const std::uint32_t* i, const std::uint32_t* j) {
  const auto difference = [&](const std::vector<double>& x) __attribute__((always_inline)) {
    return V(gather<V>(x.data(), i) - gather<V>(x.data(), j));
  };
  const V x = difference(p.position.x), y = difference(p.position.y), z = difference(p.position.z);
  const V reach = gather<V>(p.radius.data(), i) + gather<V>(p.radius.data(), j);
  return V(x * x + y * y + z * z) < V(V(kMargin) * reach * reach);
}

}  // namespace

void ActiveContacts::note_slots(const ContactDetection& contacts) {
  const ContactParties& t = contacts.parties();
  const ContactSlots& slots = contacts.pairs();
  const std::size_t particles = slots.offset.size() - 1;
  slots_.resize(slots.size());
  places_.resize(t.particle.size());
  as_partner_.resize(slots.size());
  number_.resize(slots.size());
  chunks_.resize(t.first_place.size() - 1);
  for (std::size_t c = 0; c < chunks_.size(); ++c)
    chunks_[c] = {{slots.offset[std::min(c * kContactChunk, particles)]}, {t.first_place[c]}, {t.first_partner[c]}};
}

void ActiveContacts::find_slots(const Particles& p, const ContactDetection& contacts, std::size_t chunk) {
  const ContactSlots& slots = contacts.pairs();
  const std::size_t end = slots.offset[std::min((chunk + 1) * kContactChunk, slots.offset.size() - 1)];
  List& list = chunks_[chunk].slots;
  std::size_t next = list.first, k = list.first;
  const auto add = [&](std::size_t slot) {
    slots_[next++] = static_cast<std::uint32_t>(slot);
    number_[slot] = static_cast<std::uint32_t>(next);
  };
  for (; k + kRow <= end; k += kRow) {
    unsigned bits = may_touch<Row<double>>(p, &slots.owner[k], &slots.partner[k]).bits();
    for (unsigned l = 0; l < kRow; ++l) bits |= static_cast<unsigned>(slots.touching[k + l]) << l;
    std::fill_n(&number_[k], kRow, 0U);
    for (; bits != 0; bits &= bits - 1) add(k + static_cast<std::size_t>(std::countr_zero(bits)));
  }
  for (; k < end; ++k) {
    number_[k] = 0;
    if (may_touch<double>(p, &slots.owner[k], &slots.partner[k]) || slots.touching[k] != 0) add(k);
  }
  list.count = next - list.first;
}

void ActiveContacts::find_places(const ContactDetection& contacts, std::size_t chunk) {
  const ContactParties& t = contacts.parties();
  Chunk& own = chunks_[chunk];
  std::array<std::uint8_t, kContactChunk> found{};
  for (const std::uint32_t k : slots(chunk)) found[t.owner[k] - own.places.first] = 1;
  std::size_t next = own.as_partner.first;
  for (std::size_t n = t.first_partner[chunk]; n < t.first_partner[chunk + 1];
       ++n) {  // a branch would often be guessed wrong
    const auto [slot, place] = t.as_partner[n];
    const std::uint32_t number = number_[slot];
    const auto active = static_cast<std::uint8_t>(number != 0);
    found[place - own.places.first] |= active;
    as_partner_[next] = {number - 1, place};
    next += active;
  }
  own.as_partner.count = next - own.as_partner.first;
  std::size_t place = own.places.first;
  for (std::size_t p = own.places.first; p < t.first_place[chunk + 1]; ++p) {
    places_[place] = static_cast<std::uint32_t>(p);
    place += found[p - own.places.first];
  }
  own.places.count = place - own.places.first;
}

}  // namespace lahar::dem
