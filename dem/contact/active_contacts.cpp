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
  active_.resize(slots.size());
  chunks_.resize(t.first_place.size() - 1);
  for (std::size_t c = 0; c < chunks_.size(); ++c)
    chunks_[c] = {{slots.offset[std::min(c * kContactChunk, particles)]}, {t.first_place[c]}, {t.first_partner[c]}};
}

void ActiveContacts::find_slots(const Particles& p, const ContactDetection& contacts, std::size_t chunk) {
  const ContactSlots& slots = contacts.pairs();
  const std::size_t end = slots.offset[std::min((chunk + 1) * kContactChunk, slots.offset.size() - 1)];
  List& list = chunks_[chunk].slots;
  std::uint32_t* next = slots_.data() + list.first;
  std::size_t k = list.first;
  for (; k + kRow <= end; k += kRow) {
    unsigned bits = may_touch<Row<double>>(p, &slots.owner[k], &slots.partner[k]).bits();
    for (unsigned l = 0; l < kRow; ++l) bits |= static_cast<unsigned>(slots.touching[k + l]) << l;
    for (unsigned l = 0; l < kRow; ++l) active_[k + l] = static_cast<std::uint8_t>(bits >> l & 1U);
    for (; bits != 0; bits &= bits - 1) *next++ = static_cast<std::uint32_t>(k) + std::countr_zero(bits);
  }
  for (; k < end; ++k) {
    active_[k] = may_touch<double>(p, &slots.owner[k], &slots.partner[k]) || slots.touching[k] != 0 ? 1 : 0;
    if (active_[k] != 0) *next++ = static_cast<std::uint32_t>(k);
  }
  list.count = static_cast<std::size_t>(next - slots_.data()) - list.first;
}

void ActiveContacts::find_places(const ContactDetection& contacts, std::size_t chunk) {
  const ContactParties& t = contacts.parties();
  Chunk& own = chunks_[chunk];
  std::array<std::uint8_t, kContactChunk> found{};
  for (const std::uint32_t k : slots(chunk)) found[t.owner[k] - own.places.first] = 1;
  std::size_t next = own.as_partner.first;
  for (std::size_t n = t.first_partner[chunk]; n < t.first_partner[chunk + 1]; ++n) {
    if (active_[t.as_partner[n].slot] == 0) continue;
    found[t.as_partner[n].place - own.places.first] = 1;
    as_partner_[next++] = t.as_partner[n];
  }
  own.as_partner.count = next - own.as_partner.first;
  std::size_t place = own.places.first;
  for (std::size_t p = own.places.first; p < t.first_place[chunk + 1]; ++p)
    if (found[p - own.places.first] != 0) places_[place++] = static_cast<std::uint32_t>(p);
  own.places.count = place - own.places.first;
}

}  // namespace lahar::dem
