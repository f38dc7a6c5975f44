#include "dem/contact/pair_contacts.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "core/check.h"
#include "core/parallel.h"
#include "dem/contact/rolling_lane.h"

namespace lahar::dem {

namespace {

/// Rows of eight numbers of several contacts, turned: one pack per number. row(l, first): from number `first` on, those
/// of lane l.
template <class RowOf>
[[gnu::always_inline]] inline std::array<Lanes, kRow> turned(const RowOf& row) {
  std::array<Lanes, kRow> numbers;
  for (std::size_t first = 0; first < kRow; first += kContactLanes) {
    std::array<Lanes, kContactLanes> part;
    for (std::size_t l = 0; l < kContactLanes; ++l) part[l] = row(l, first);
    transpose(part);
    std::copy(part.begin(), part.end(), numbers.begin() + first);
  }
  return numbers;
}

/// And back: put(l, first, numbers from `first` on of the row of lane l).
template <class Put>
[[gnu::always_inline]] inline void turn_back(const std::array<Lanes, kRow>& numbers, const Put& put) {
  for (std::size_t first = 0; first < kRow; first += kContactLanes) {
    std::array<Lanes, kContactLanes> part;
    std::copy_n(numbers.begin() + first, kContactLanes, part.begin());
    transpose(part);
    for (std::size_t l = 0; l < kContactLanes; ++l) put(l, first, part[l]);
  }
}

}  // namespace

/// The active slots in the lanes, and the numbers of all.
struct PairContacts::Batch {
  const std::uint32_t* slot;
  const std::uint32_t *owner, *partner;  // where their rows begin
  const std::uint16_t* material;
  double* history;  // rows
  std::uint8_t* touching;
  Triple* rolling;           // nullptr unless remembered
  double* on_partner;        // rows of these slots
  ContactTally* of_rolling;  // nullptr where indices are ids, or nothing rolls
};

/// From the centres to where the forces act, m: the radii less half the overlap.
struct PairContacts::Arms {
  Lanes i, j;
};

/// The last active slots of a chunk, fewer than there are lanes, in a place of their own, filled up with what never
/// touches.
struct PairContacts::Tail {
  template <class T>
  using Numbers = std::array<T, kContactLanes>;
  static constexpr Numbers<std::uint32_t> kSlot = [] {
    Numbers<std::uint32_t> slot;
    std::iota(slot.begin(), slot.end(), 0U);
    return slot;
  }();
  Numbers<std::uint32_t> owner, partner;
  Numbers<std::uint16_t> material;
  Numbers<std::uint8_t> touching{};
  Numbers<Triple> rolling{};
  Numbers<ContactTally> of_rolling{};
  alignas(64) std::array<double, kContactLanes * kRow> history{}, on_partner;

  Tail(const Batch& at, std::size_t count, std::uint32_t nobody) {
    owner.fill(at.owner[at.slot[0]]), partner.fill(nobody), material.fill(at.material[at.slot[0]]);
    copy(at, count, true);
    for (std::size_t l = 0; l < count; ++l) {
      const std::uint32_t k = at.slot[l];
      owner[l] = at.owner[k], partner[l] = at.partner[k], material[l] = at.material[k];
    }
  }
  [[nodiscard]] Batch batch(const Batch& at) {
    return {kSlot.data(),
            owner.data(),
            partner.data(),
            material.data(),
            history.data(),
            touching.data(),
            at.rolling != nullptr ? rolling.data() : nullptr,
            on_partner.data(),
            at.of_rolling != nullptr ? of_rolling.data() : nullptr};
  }
  void copy(const Batch& at, std::size_t count, bool in) {
    for (std::size_t l = 0; l < count; ++l) {
      const std::uint32_t k = at.slot[l];
      const auto move = [&](auto& theirs, auto& ours) { in ? ours = theirs : theirs = ours; };
      for (std::size_t n = 0; n < kRow; ++n) move(at.history[kRow * k + n], history[kRow * l + n]);
      move(at.touching[k], touching[l]);
      if (at.rolling != nullptr) move(at.rolling[k], rolling[l]);
      if (in) continue;
      if (at.of_rolling != nullptr) at.of_rolling[k] = of_rolling[l];
      std::copy_n(on_partner.data() + kRow * l, kRow, at.on_partner + kRow * l);
    }
  }
};

void PairContacts::note_slots(const Particles& p, const ContactDetection& contacts, const ContactMaterials& materials) {
  const ContactSlots& slots = contacts.pairs();
  material_.resize(slots.size());
  on_partner_.resize(slots.size());
  owner_at_.resize(slots.size());
  partner_at_.resize(slots.size());
  const ContactParties& parties = contacts.parties();
  require(ContactBodies::kStride * (parties.particle.size() + 1) <= std::numeric_limits<std::uint32_t>::max(),
          "too many particles in contact");
  parallel_for(0, slots.size(), 4096, [&](std::size_t k) {
    const std::uint32_t i = slots.owner[k], j = slots.partner[k];
    const bool of_one_body = p.body[i] == p.body[j] && p.body[i] >= 0;
    material_[k] = materials.index(p.material[i], p.material[j], of_one_body);
    owner_at_[k] = static_cast<std::uint32_t>(ContactBodies::kStride * parties.owner[k]);
    partner_at_[k] = static_cast<std::uint32_t>(ContactBodies::kStride * parties.partner[k]);
  });
  active_.note_slots(contacts);
  bodies_.make_room(p, parties);
  one_material_ = std::all_of(material_.begin(), material_.end(), [&](auto m) { return m == material_[0]; });
  const bool by_id = p.numbering.by_id();
  id_of_place_.clear();
  if (!by_id)
    for (const ParticleIndex i : parties.particle) id_of_place_.push_back(p.id(i));
  energies_.assign(by_id ? 0 : p.size(), {});
  of_rolling_.assign(by_id || !slots.rolls ? 0 : slots.size(), {});
}

void PairContacts::pack(const Particles& p, const ContactDetection& contacts, const std::vector<double>& damping,
                        double dt, const MeanMotion* mean) {
  const std::size_t chunks = contacts.parties().first_place.size() - 1;
  parallel_for(0, chunks, 4, [&](std::size_t chunk) { active_.find_slots(p, contacts, chunk); });
  parallel_for(0, chunks, 4, [&](std::size_t chunk) {
    active_.find_places(contacts, chunk);
    bodies_.pack(p, contacts.parties(), active_.places(chunk), damping, dt, mean);
  });
}

/// Fetches what contacts need of their spheres.
[[gnu::always_inline]] inline void PairContacts::gather(ContactLanes& c, Arms& arms, const Batch& at,
                                                        const ContactMaterials& materials) const {
  // Differences or sums, by the signs, of the rows of two spheres.
  using Signs = std::array<double, kRow>;
  const auto together = [&](std::size_t row, const Signs& sign) __attribute__((always_inline)) {
    return turned([&](std::size_t l, std::size_t first) __attribute__((always_inline)) {
      const double* rows = bodies_.data() + row * kRow + first;
      const std::uint32_t k = at.slot[l];
      return Lanes(load_aligned<Lanes>(rows + at.owner[k]) +
                   load<Lanes>(&sign[first]) * load_aligned<Lanes>(rows + at.partner[k]));
    });
  };
  const auto a = together(0, {-1, -1, -1, -1, -1, -1, -1, -1});
  const auto b = together(1, {-1, 1, 1, 1, 1, 1, 1, 1});
  const auto d = together(2, {1, 1, 1, 1, 1, 1, 1, -1});
  c.slip = {a[3], a[4], a[5]};
  c.slip_end = {a[6], a[7], b[0]};
  c.spin = {b[1], b[2], b[3]};
  c.damping_rate = c.tangential_damping_rate = b[4];
  c.rim = {d[0], d[1], d[2]};
  c.rim_end = {d[3], d[4], d[5]};
  c.inverse_mass = c.tangential_inverse_mass = d[6];
  const Lanes radius_i = 0.5 * (b[7] + d[7]), radius_j = 0.5 * (b[7] - d[7]);
  c.effective_radius = radius_i * radius_j / b[7];
  c.set_spheres({a[0], a[1], a[2]}, b[7]);
  arms = {radius_i - 0.5 * c.overlap, radius_j - 0.5 * c.overlap};
  if ((b[5] > 0).bits() != 0) give_way_along_rails(c, at);

  if (one_material_) {
    const double* m = materials[at.material[at.slot[0]]];
    c.modulus = Lanes(m[0]), c.shear_modulus = Lanes(m[1]);
    c.friction = Lanes(m[2]), c.damping_ratio = Lanes(m[3]);
    return;
  }
  const auto m = turned([&](std::size_t l, std::size_t first) __attribute__((always_inline)) {
    return load_aligned<Lanes>(materials[at.material[at.slot[l]]] + first);
  });
  c.modulus = m[0], c.shear_modulus = m[1], c.friction = m[2], c.damping_ratio = m[3];
}

/// Where one of the two is on a rail.
void PairContacts::give_way_along_rails(ContactLanes& c, const Batch& at) const {
  for (std::size_t l = 0; l < kContactLanes; ++l) {
    const std::uint32_t k = at.slot[l];
    const ContactBodies::OnRails along =
        bodies_.on_rails(at.owner[k], at.partner[k], {c.normal.x[l], c.normal.y[l], c.normal.z[l]});
    c.inverse_mass.set(l, along.inverse_mass);
    c.damping_rate.set(l, along.damping_rate);
  }
}

/// Rolling resistance, after the law: the torque on the owners.
Lanes3 PairContacts::roll(const ContactLanes& c, const ContactHistoryOf<Lanes>& history, const Lanes& stiffness_before,
                          const Lanes& damper, const Batch& at, const ContactMaterials& materials, double dt,
                          ContactTally& tally) const {
  Lanes3 torques{};
  for (std::size_t l = 0; l < kContactLanes; ++l) {
    const std::uint32_t k = at.slot[l];
    RollingState state;
    state.rolling_friction = materials[at.material[k]][ContactMaterials::kRollingFriction];
    if (state.rolling_friction == 0 || (!c.touches[l] && at.touching[k] == 0)) continue;
    const double *i = bodies_.data() + at.owner[k], *j = bodies_.data() + at.partner[k];  // see contact_bodies.h
    const auto difference = [&](std::size_t first) {  // of the spins that make the rims' velocities there
      const double *a = i + 2 * kRow + first, *b = j + 2 * kRow + first, ri = i[2 * kRow + 7], rj = j[2 * kRow + 7];
      return Triple{a[0] / ri - b[0] / rj, a[1] / ri - b[1] / rj, a[2] / ri - b[2] / rj};
    };
    state.spin = difference(0), state.spin_end = difference(3);
    const double inverse_inertia = inverse_rolling_inertia(i[2 * kRow + 6], i[2 * kRow + 7]) +
                                   inverse_rolling_inertia(j[2 * kRow + 6], j[2 * kRow + 7]);
    state.effective_inertia = inverse_inertia > 0 ? 1 / inverse_inertia : 0.0;
    ContactTally booked;
    const Triple torque = roll_lane(c, history, l, state, stiffness_before[l], damper[l], dt, at.rolling[k], booked);
    tally += booked;
    if (at.of_rolling != nullptr) at.of_rolling[k] = booked;
    torques.x.set(l, torque.x), torques.y.set(l, torque.y), torques.z.set(l, torque.z);
  }
  return torques;
}

// Flattened: the numbers of the lanes stay in registers, or next to them on the stack.
template <ContactLaw L>
[[gnu::flatten, gnu::noinline]] void PairContacts::evaluate_batch(const L& law, const Batch& at,
                                                                  const ContactMaterials& materials, double dt,
                                                                  ContactTally& tally) {
  ContactLanes c;
  Arms arms;
  gather(c, arms, at, materials);
  const auto remembered = turned([&](std::size_t l, std::size_t first) __attribute__((always_inline)) {
    return load_aligned<Lanes>(at.history + kRow * at.slot[l] + first);
  });
  const Lanes stiffness_before = remembered[3];
  ContactHistoryOf<Lanes> h{
      {remembered[0], remembered[1], remembered[2]}, stiffness_before, remembered[4], remembered[5]};
  const AnswerLanes f = dem::evaluate(c, h, law, dt);
  const Lanes3& u = h.tangential_displacement;
  turn_back(
      {u.x, u.y, u.z, h.tangential_stiffness, h.normal_force, h.damping_force, Lanes{}, Lanes{}},
      [&](std::size_t l, std::size_t first, const Lanes& numbers)
          __attribute__((always_inline)) { store_aligned(at.history + kRow * at.slot[l] + first, numbers); });

  Lanes3 torque_i = arms.i * f.twist, torque_j = arms.j * f.twist;
  if (at.rolling != nullptr) {
    const Lanes3 rolled = roll(c, h, stiffness_before, f.damper, at, materials, dt, tally);
    torque_i = torque_i + rolled, torque_j = torque_j - rolled;
  }
  double* sums = bodies_.sums();
  turn_back(
      {f.force.x, f.force.y, f.force.z, torque_i.x, torque_i.y, torque_i.z, f.damping_work, f.damper},
      [&](std::size_t l, std::size_t first, const Lanes& numbers) __attribute__((always_inline)) {
        double* sum = sums + at.owner[at.slot[l]] + first;
        store_aligned(sum, load_aligned<Lanes>(sum) + numbers);
      });
  turn_back(
      {-f.force.x, -f.force.y, -f.force.z, torque_j.x, torque_j.y, torque_j.z, f.friction_work, f.damper},
      [&](std::size_t l, std::size_t first, const Lanes& numbers)
          __attribute__((always_inline)) { store_aligned(at.on_partner + kRow * l + first, numbers); });
  const unsigned touches = c.touches.bits();
  for (std::size_t l = 0; l < kContactLanes; ++l)
    at.touching[at.slot[l]] = static_cast<std::uint8_t>(touches >> l & 1U);
}

/// Prefetches what lies apart of slots, their histories and the rows of their spheres, while
/// others are evaluated.
[[gnu::always_inline]] inline void PairContacts::prefetch(const std::uint32_t* slot, const double* history) const {
  for (std::size_t l = 0; l < kContactLanes; ++l) {
    __builtin_prefetch(history + kRow * slot[l], 1);
    for (const std::uint32_t at : {owner_at_[slot[l]], partner_at_[slot[l]]})
      for (std::size_t row = 0; row < 3; ++row) __builtin_prefetch(bodies_.data() + at + row * kRow);
  }
}

template <ContactLaw L>
void PairContacts::evaluate_with(const L& law, ContactDetection& contacts, const ContactMaterials& materials, double dt,
                                 std::size_t chunk, ContactTally& tally) {
  ContactSlots& slots = contacts.pairs();
  for (const std::uint32_t p : active_.places(chunk)) store_aligned(bodies_.sum(p), Row<double>{});
  if (!of_rolling_.empty()) {
    const std::size_t first = chunk * kContactChunk, last = std::min(first + kContactChunk, slots.offset.size() - 1);
    std::fill(&of_rolling_[slots.offset[first]], of_rolling_.data() + slots.offset[last], ContactTally{});
  }
  Batch at{nullptr,
           owner_at_.data(),
           partner_at_.data(),
           material_.data(),
           slots.history.row(0),
           slots.touching.data(),
           slots.rolls ? slots.rolling.data() : nullptr,
           on_partner_[active_.first_number(chunk)],
           of_rolling_.empty() ? nullptr : of_rolling_.data()};
  const std::span<const std::uint32_t> active = active_.slots(chunk);
  constexpr std::size_t kAhead = 16;  // slots
  for (std::size_t n = 0; n < active.size(); n += kContactLanes, at.on_partner += kContactLanes * kRow) {
    at.slot = &active[n];
    if (n + kAhead + kContactLanes <= active.size()) prefetch(&active[n + kAhead], at.history);
    if (n + kContactLanes <= active.size()) {
      evaluate_batch(law, at, materials, dt, tally);
      continue;
    }
    Tail tail(at, active.size() - n,
              static_cast<std::uint32_t>(ContactBodies::kStride * contacts.parties().particle.size()));
    evaluate_batch(law, tail.batch(at), materials, dt, tally);
    tail.copy(at, active.size() - n, false);
  }
  double damping = 0;  // partners bring the work of friction in the same place
  const std::vector<std::uint32_t>& first_place = contacts.parties().first_place;
  for (std::size_t p = first_place[chunk]; !id_of_place_.empty() && p < first_place[chunk + 1]; ++p)
    energies_[id_of_place_[p]] = {};
  for (const std::uint32_t p : active_.places(chunk)) {
    double* sum = bodies_.sum(p);
    damping += sum[6];
    if (!id_of_place_.empty()) energies_[id_of_place_[p]].damping = sum[6];
    sum[6] = 0;
  }
  tally.damping += damping;
}

void PairContacts::evaluate(const ContactLawChoice& law, ContactDetection& contacts, const ContactMaterials& materials,
                            double dt, std::size_t chunk, ContactTally& tally) {
  std::visit([&](const auto& l) { evaluate_with(l, contacts, materials, dt, chunk, tally); }, law);
}

void PairContacts::add_partners(Particles& particles, std::vector<double>& damping, const ContactDetection& contacts,
                                std::size_t chunk, ContactTally& tally) {
  for (const std::uint32_t p : active_.places(chunk)) __builtin_prefetch(bodies_.sum(p), 1);
  const std::span<const ActiveContacts::Partner> as_partner = active_.as_partner(chunk);
  for (std::size_t n = 0; n < as_partner.size(); ++n) {
    if (n + kRow < as_partner.size()) __builtin_prefetch(on_partner_[as_partner[n + kRow].number]);
    double* sum = bodies_.sum(as_partner[n].place);
    store_aligned(sum, load_aligned<Row<double>>(sum) + load_aligned<Row<double>>(on_partner_[as_partner[n].number]));
  }
  double friction = 0;
  const auto each = [&](const auto& add) {
    add(0, particles.force.x), add(1, particles.force.y), add(2, particles.force.z);
    add(3, particles.torque.x), add(4, particles.torque.y), add(5, particles.torque.z);
    add(7, damping);
  };
  const std::span<const std::uint32_t> places = active_.places(chunk);
  for (std::size_t n = 0; n < places.size(); n += kRow) {
    const std::size_t count = std::min(kRow, places.size() - n);
    std::array<ParticleIndex, kRow> index{};
    std::array<Row<double>, kRow> sum{};
    for (std::size_t l = 0; l < count; ++l) {
      const std::uint32_t p = places[n + l];
      index[l] = contacts.parties().particle[p];
      sum[l] = load_aligned<Row<double>>(bodies_.sum(p));
      friction += sum[l][6];
      if (!id_of_place_.empty()) energies_[id_of_place_[p]].friction = sum[l][6];
    }
    if (count == kRow && index[kRow - 1] - index[0] == kRow - 1) {
      transpose(sum);
      each([&](std::size_t number, std::vector<double>& to) {
        store(&to[index[0]], load<Row<double>>(&to[index[0]]) + sum[number]);
      });
    } else {
      each([&](std::size_t number, std::vector<double>& to) {
        for (std::size_t l = 0; l < count; ++l) to[index[l]] += sum[l][number];
      });
    }
  }
  tally.friction += friction;
}

void PairContacts::tally_damping(const Numbering& numbering, const ContactDetection& contacts, std::size_t chunk,
                                 ContactTally& tally) const {
  const ContactSlots& slots = contacts.pairs();
  const std::size_t first = chunk * kContactChunk, end = std::min(first + kContactChunk, energies_.size());
  double damping = 0;
  for (std::size_t id = first; id < end; ++id) {
    const ParticleIndex i = numbering.index(id);
    for (std::size_t k = slots.offset[i]; !of_rolling_.empty() && k < slots.offset[i + 1]; ++k) tally += of_rolling_[k];
    damping += energies_[id].damping;
  }
  tally.damping += damping;
}

void PairContacts::tally_friction(std::size_t chunk, ContactTally& tally) const {
  const std::size_t first = chunk * kContactChunk, end = std::min(first + kContactChunk, energies_.size());
  double friction = 0;
  for (std::size_t id = first; id < end; ++id) friction += energies_[id].friction;
  tally.friction += friction;
}

}  // namespace lahar::dem
