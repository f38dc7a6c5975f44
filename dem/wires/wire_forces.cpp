#include "dem/wires/wire_forces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "dem/contact/damping.h"

namespace lahar::dem {

namespace {

constexpr std::size_t kChunk = 64;      // slots; fixed, so that sums do not depend on the number of threads
constexpr double kSearchedShare = 0.1;  // of a wire's radius: how far beyond contact a partner is looked for

/// The energy of a tangential spring.
double stored_energy(const ContactHistory& h) {
  return 0.5 * h.tangential_stiffness * dot(h.tangential_displacement, h.tangential_displacement);
}

}  // namespace

/// What one thread needs for one contact at a time.
struct WireForces::Scratch {
  SplineSegment segment;
  WirePartner partner;
  WireSphere sphere;
  WirePatch patch;
  WireContact contact;
  double gap = 0;  // m
};

WireForces::WireForces(const Materials& materials, ContactLawChoice law, NeighbourOptions options)
    : law_(law), material_count_(materials.size()), detection_(options) {
  for (int a = 0; a < static_cast<int>(materials.size()); ++a)
    for (int b = 0; b < static_cast<int>(materials.size()); ++b) {
      const MaterialPair& p = materials.pair(a, b);
      pairs_.push_back({p.effective_modulus, p.effective_shear_modulus, p.friction, damping_ratio(p.restitution)});
    }
}

void WireForces::rebuild(const Particles& particles, const Bonds& bonds) {
  chains_.build(bonds, particles);
  relist(particles);
}

void WireForces::relist(const Particles& particles) {
  energy_.friction += detection_.rebuild(particles, chains_);
  note_slots(particles);
}

void WireForces::renumber(const Renumbering& change) {
  chains_.renumber(change);
  detection_.renumber(change);
  change.move(position_before_);
  change.move(counts_);
}

/// Nothing is known yet of how far the slots are from touching.
void WireForces::note_slots(const Particles& p) {
  position_before_ = p.position;
  moved_ = 0;
  idle_to_.assign(slots().size(), 0.0);
  patches_.list(slots(), chains_);
  counts_.assign(p.size(), 0.0);
  const auto count = [&](ParticleIndex i) {
    for (const ParticleIndex k : {i, chains_.before(i), chains_.behind(i)})
      if (k != WireChains::none) counts_[k] = 1;
  };
  for (const WireSlot& slot : slots()) {
    count(slot.wire);
    count(slot.partner);
    ParticleIndex k = slot.partner;
    for (std::uint32_t n = 1; n < slot.count; ++n) count(k = chains_.behind(k));
  }
}

/// Adds to `moved_` how far the particles have come since the last time.
void WireForces::note_movement(const Vec3Field& position) {
  constexpr std::size_t kLanes = 8;
  std::array<double, kLanes> farthest2{};
  const Vec3Field &now = position, &then = position_before_;
  const auto note = [&](std::size_t i, std::size_t lane) {
    const double dx = now.x[i] - then.x[i], dy = now.y[i] - then.y[i], dz = now.z[i] - then.z[i];
    const double way2 = counts_[i] * (dx * dx + dy * dy + dz * dz);
    farthest2[lane] = way2 <= farthest2[lane] ? farthest2[lane] : way2;  // takes what is not a number, too
  };
  std::size_t i = 0;
  for (; i + kLanes <= now.size(); i += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane) note(i + lane, lane);
  for (; i < now.size(); ++i) note(i, 0);
  moved_ += std::sqrt(*std::max_element(farthest2.begin(), farthest2.end()));
  position_before_ = position;
}

/// Fills the scratch with the contact of a slot. If it does not touch, false, and `scratch.gap` says how far it is from
/// it at least.
bool WireForces::find_contact(const WireSlot& slot, const Particles& p, Scratch& x) const {
  const double r = p.radius[slot.wire], reach = r + p.radius[slot.partner];
  x.gap = std::numeric_limits<double>::infinity();
  x.sphere = {slot.count == 0, slot.partner};
  if (slot.count == 0 && p.state[slot.partner] == ParticleState::removed) return false;
  const Triple own = triple_at(p.position, slot.wire);
  const double extent = SplineSegment::extent(chains_, p.position, slot.wire);
  std::uint32_t near_segment = 0;
  double least = x.gap, widest = 0;  // squares
  for (std::uint32_t n = 0, k = slot.partner; n < std::max(1U, slot.count); ++n) {
    const Triple d = triple_at(p.position, k) - own;
    if (dot(d, d) < least) least = dot(d, d), near_segment = n;
    if (slot.count == 0) break;
    widest = std::max(widest, SplineSegment::extent2(chains_, p.position, k));
    k = chains_.behind(k);
  }
  x.gap = std::sqrt(least) - std::sqrt(widest) - reach - extent;
  if (x.gap >= 0) return false;
  x.segment = spline_segment(chains_, p.position, slot.wire);
  x.partner.segments.clear();
  x.partner.centre = triple_at(p.position, slot.partner);
  for (std::uint32_t n = 0, k = slot.partner; n < slot.count; ++n, k = chains_.behind(k))
    x.partner.segments.push_back(spline_segment(chains_, p.position, k));
  double searched = slot.touching != 0 ? 0.0 : kSearchedShare * r;
  if (slot.count == 0) searched = std::numeric_limits<double>::infinity();
  find_kinks(x.partner, reach + searched);
  const bool touches = find_patch(x.segment, x.partner, reach, extent, {x.partner.centre, near_segment, 0.5}, x.patch);
  x.gap = std::min(x.patch.gap, searched);
  if (touches) describe(x.patch, x.segment, x.partner, x.sphere, reach, r, x.contact);
  return touches;
}

ContactState WireForces::material_state(const WireSlot& slot, const Particles& p) const {
  const auto material = [&](ParticleIndex i) { return static_cast<std::size_t>(p.material[i]); };
  const Pair& pair = pairs_[material(slot.wire) * material_count_ + material(slot.partner)];
  const double r = p.radius[slot.wire], other = p.radius[slot.partner];
  ContactState s;
  s.effective_radius = slot.count > 0 ? effective_radius_of_wires(r, other) : effective_radius_on_sphere(r, other);
  s.effective_modulus = pair.modulus;
  s.effective_shear_modulus = pair.shear_modulus;
  s.damping_ratio = pair.damping_ratio;
  const bool one_body = p.body[slot.wire] == p.body[slot.partner];
  s.friction = one_body ? 0.0 : pair.friction;
  return s;
}

/// Where the wires touch now. Contacts that have parted lose what they remember.
void WireForces::find_touching(const Particles& p) {
  auto& slots = detection_.slots();
  chunks_.resize((slots.size() + kChunk - 1) / kChunk);
  parallel_for_chunks(slots.size(), kChunk, [&](std::size_t first, std::size_t last) {
    static thread_local Scratch x;
    Chunk& chunk = chunks_[first / kChunk];
    chunk.found.clear();
    chunk.energy = {}, chunk.worst = {};
    for (std::size_t k = first; k < last; ++k) {
      if (moved_ < idle_to_[k]) continue;
      WireSlot& slot = slots[k];
      if (!find_contact(slot, p, x)) {
        if (slot.touching != 0) chunk.energy.friction += stored_energy(slot.history);
        slot.history = {}, slot.touching = 0;
        idle_to_[k] = moved_ + 0.5 * x.gap;  // both sides may come nearer by as much as is moved
        continue;
      }
      idle_to_[k] = 0;
      const auto deepest =
          std::max_element(x.patch.nodes.begin(), x.patch.nodes.begin() + static_cast<long>(x.patch.count),
                           [](const auto& a, const auto& b) { return a.overlap < b.overlap; });
      const ParticleIndex there = slot.count > 0 ? x.partner.segments[deepest->nearest.segment].beads[1] : slot.partner;
      chunk.found.push_back({static_cast<std::uint32_t>(k), x.contact, x.patch.integral, x.patch.depth, there});
    }
  });
}

template <ContactLaw L>
void WireForces::evaluate_touch(const L& law, const WireTouch& touch, const Particles& p,
                                const std::vector<double>& damping, double dt, Chunk& chunk) {
  WireSlot& slot = detection_.slots()[touch.slot];
  const WireContact& c = touch.contact;
  ContactState s = material_state(slot, p);
  s.damping_ratio *= std::sqrt(touch.share * touch.yields);
  s.effective_shear_modulus *= std::pow(touch.share, 0.8);
  set_motion(c, p, dt, s);
  s.friction *= c.spread;  // Coulomb's limit is one on the resultant
  for (const WireSide* side : {&c.wire, &c.partner})
    for (std::size_t k = 0; k < side->count; ++k) {
      const WireShare& b = side->shares[k];
      const double rate = c.spread * b.weight * p.inverse_mass[b.particle] * damping[b.particle];
      s.damping_rate += p.free_share(b.particle, c.normal) * rate;
      s.tangential_damping_rate += rate;
    }
  ContactState still = s;
  still.damping_ratio = 0;
  ContactHistory none;
  const double elastic = law(still, none, 0.0).normal;
  const ContactForce f = law(s, slot.history, dt);
  const Triple at_point =
      f.tangential - (f.normal - elastic) * c.spread * c.normal;  // friction and dampers, on the wire
  slot.touching = 1, slot.last = touch.last;
  const auto answer = [&](const WireSide& side, double sign) {
    const Triple moment = cross(side.lever, sign * at_point);
    for (std::size_t k = 0; k < side.count; ++k) {
      const WireShare& b = side.shares[k];
      chunk.answers.push_back({b.particle, (sign * b.weight) * at_point - elastic * b.gradient, b.weight * moment,
                               c.spread * b.weight * f.damping});
    }
  };
  answer(c.wire, 1);
  answer(c.partner, -1);
  chunk.energy.elastic_normal += f.elastic_normal;
  chunk.energy.elastic_tangential += f.elastic_tangential;
  chunk.energy.damping += f.damping_work;
  chunk.energy.damping_of_step += f.damping_work;
  if (s.effective_mass > 0)
    chunk.energy.damped_ahead +=
        0.125 * dt * dt * slot.history.damping_force * slot.history.normal_force / s.effective_mass;
  chunk.energy.friction += f.friction_work;
  const double ratio = touch.depth / std::min(p.radius[slot.wire], p.radius[slot.partner]);
  if (ratio > chunk.worst.ratio) chunk.worst = {ratio, p.id(slot.wire), p.id(slot.last), false};
}

template <ContactLaw L>
void WireForces::evaluate_with(const L& law, const Particles& p, const std::vector<double>& damping, double dt) {
  find_touching(p);
  touching_.clear();
  for (Chunk& chunk : chunks_)
    for (WireTouch& touch : chunk.found) touching_.push_back(&touch);
  patches_.share_out(touching_, p);
  parallel_for(0, chunks_.size(), 1, [&](std::size_t n) {
    Chunk& chunk = chunks_[n];
    chunk.answers.clear();
    for (const WireTouch& touch : chunk.found) evaluate_touch(law, touch, p, damping, dt, chunk);
  });
}

void WireForces::evaluate(const Particles& p, const std::vector<double>& damping, double dt) {
  note_movement(p.position);
  std::visit([&](const auto& law) { evaluate_with(law, p, damping, dt); }, law_);
  energy_.elastic_normal = energy_.elastic_tangential = energy_.damping_of_step = energy_.damped_ahead = 0;
  worst_ = {};
  for (const Chunk& c : chunks_) {
    energy_ += c.energy;
    if (c.worst.ratio > worst_.ratio) worst_ = c.worst;
  }
}

void WireForces::add_forces(Particles& p, std::vector<double>& damping) {
  for (const Chunk& c : chunks_)
    for (const Answer& a : c.answers) {
      p.force.x[a.particle] += a.force.x, p.force.y[a.particle] += a.force.y, p.force.z[a.particle] += a.force.z;
      p.torque.x[a.particle] += a.torque.x, p.torque.y[a.particle] += a.torque.y, p.torque.z[a.particle] += a.torque.z;
      damping[a.particle] += a.damper;
    }
}

std::size_t WireForces::touching() const {
  return static_cast<std::size_t>(
      std::count_if(slots().begin(), slots().end(), [](const WireSlot& s) { return s.touching != 0; }));
}

/// A contact at rest: the law tells what its spring holds.
double WireForces::energy_at_rest(const WireSlot& slot, const Particles& p) const {
  Scratch x;
  if (!find_contact(slot, p, x)) return 0;
  ContactState s = material_state(slot, p);
  s.overlap = x.contact.overlap;
  s.effective_mass = s.tangential_mass = 1;
  ContactHistory none;
  return std::visit([&](const auto& law) { return law(s, none, 0.0).elastic_normal; }, law_);
}

double WireForces::normal_energy(const Particles& p) const {
  double sum = 0;
  for (const WireSlot& s : slots()) sum += energy_at_rest(s, p);
  return sum;
}

double WireForces::normal_energy_of(ParticleIndex sphere, const Particles& p) const {
  double sum = 0;
  for (const WireSlot& s : slots())
    if (s.count == 0 && s.partner == sphere) sum += energy_at_rest(s, p);
  return sum;
}

}  // namespace lahar::dem
