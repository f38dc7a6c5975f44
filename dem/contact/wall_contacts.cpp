#include "dem/contact/wall_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/check.h"
#include "dem/contact/rolling_lane.h"

namespace lahar::dem {

namespace {

Triple triple(const Vec3Field& f, std::size_t i) { return {f.x[i], f.y[i], f.z[i]}; }
Triple triple(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 vec(const Triple& t) { return {t.x, t.y, t.z}; }
Triple lane_of(const Lanes3& t, std::size_t lane) { return {t.x[lane], t.y[lane], t.z[lane]}; }
void set(Lanes3& to, std::size_t lane, const Triple& t) {
  to.x.set(lane, t.x), to.y.set(lane, t.y), to.z.set(lane, t.z);
}

/// The range of wall slots of a chunk of particles.
std::pair<std::uint32_t, std::uint32_t> slots_of_chunk(const ContactSlots& slots, std::size_t chunk) {
  const std::size_t particles = slots.offset.size() - 1, first = chunk * kContactChunk;
  return {slots.offset[first], slots.offset[std::min(first + kContactChunk, particles)]};
}

/// Distance and gradient without a call for plane walls, which are the most.
double distance_to(const Walls& walls, std::uint32_t w, const Vec3& p) {
  const auto* plane = std::get_if<HalfSpace>(&walls.all()[w].shape);
  return plane != nullptr ? plane->distance(p) : walls.distance(w, p);
}
Vec3 gradient_of(const Walls& walls, std::uint32_t w, const Vec3& p) {
  const auto* plane = std::get_if<HalfSpace>(&walls.all()[w].shape);
  return plane != nullptr ? plane->normal : walls.gradient(w, p);
}

/// The direction in which the distance to a wall grows, and by how much of the way: 1 but for sampled shapes.
std::pair<Triple, double> growth_of(const Walls& walls, std::uint32_t w, const Vec3& p) {
  const auto* sampled = std::get_if<SampledDistance>(&walls.all()[w].shape);
  if (sampled == nullptr) return {triple(gradient_of(walls, w, p)), 1.0};
  const Vec3 slope = sampled->grid->slope(p);
  const double steep = slope.norm();
  return {steep > 0 ? (1 / steep) * triple(slope) : Triple{0, 0, 1}, steep};
}

/// Not inlined: a compiler may or may not fuse product and sum, but here it does the same wherever this is called from.
[[gnu::noinline]] void add_work(double dt, double power, ContactTally& tally) { tally.wall_work += dt * power; }

}  // namespace

double effective_radius_on(const Shape& wall, double r) {
  if (const auto* ball = std::get_if<SolidSphere>(&wall)) return r * ball->radius / (r + ball->radius);
  const auto* cylinder = std::get_if<SolidCylinder>(&wall);
  if (cylinder == nullptr) return r;
  constexpr double closest = 0.1;  // of the sphere's curvature
  const double curvature =
      std::max(closest, 1 + (cylinder->hollow ? -1 : 1) * r / cylinder->radius);  // across, times r
  return r / std::sqrt(curvature);
}

struct WallContacts::Work {
  const Particles& particles;
  const std::vector<double>& damping;
  ContactSlots& slots;
  const Walls& walls;
  const ContactMaterials& materials;
  double dt;
  const MeanMotion* mean;
};

/// Contacts side by side. Idle lanes hold what was there before, which is harmless: they do not touch.
///
/// A sampled distance grows by less than the way along its normal where it has a crease (DistanceGrid::slope): by
/// `steepness` of it. The overlap then closes at that share of the speed, and the force that it makes acts with that
/// share: so the force is the slope of the energy that the ledger books, and a concave edge makes none.
struct WallContacts::Batch {
  ContactLanes contacts;
  ContactHistoryOf<Lanes> history;
  Lanes steepness = Lanes(1);
  std::size_t count = 0;
  std::array<std::uint32_t, kContactLanes> slot{};
  std::array<std::uint16_t, kContactLanes> material{};

  Batch() {  // harmless numbers in lanes that were never used
    contacts.normal.x = contacts.inverse_mass = contacts.tangential_inverse_mass = Lanes(1);
    contacts.effective_radius = Lanes(1);
    contacts.modulus = contacts.shear_modulus = Lanes(1);
  }
  void add(const Work& work, std::uint32_t k, double distance);
};

void WallContacts::Batch::add(const Work& work, std::uint32_t k, double distance) {
  const Particles& p = work.particles;
  const std::uint32_t w = work.slots.partner[k], i = work.slots.owner[k];
  const Wall& wall = work.walls.all()[w];
  const std::size_t lane = count++;
  slot[lane] = k;
  material[lane] = work.materials.index(p.material[i], wall.material);
  const double r = p.radius[i], inverse_mass = p.inverse_mass[i];
  const Triple v = triple(work.mean != nullptr ? work.mean->velocity : p.velocity, i);
  const Triple spin = triple(work.mean != nullptr ? work.mean->spin : p.angular_velocity, i);
  const Triple v_end = triple(p.velocity, i) + (0.5 * work.dt * inverse_mass) * triple(p.force, i);
  const Triple spin_end = triple(p.angular_velocity, i) + (0.5 * work.dt * p.inverse_inertia(i)) * triple(p.torque, i);
  const Triple wall_velocity = triple(wall.velocity);
  ContactLanes& c = contacts;
  c.touches.set(lane, distance < r);
  c.overlap.set(lane, std::max(0.0, r - distance));
  const auto [out, steep] = growth_of(work.walls, w, p.position[i]);
  const Triple normal = -1.0 * out;
  const double moved_mass = steep * steep * p.free_share(i, normal) * inverse_mass;  // inverse, along the normal
  steepness.set(lane, steep);
  set(c.normal, lane, normal);
  set(c.slip, lane, v - wall_velocity);
  const Triple slip_end = v_end - wall_velocity;
  set(c.slip_end, lane, slip_end + ((steep - 1) * dot(slip_end, normal)) * normal);
  set(c.spin, lane, spin);
  set(c.rim, lane, r * spin);  // a wall adds nothing: its spin is zero
  set(c.rim_end, lane, r * spin_end);
  c.inverse_mass.set(lane, moved_mass);
  c.tangential_inverse_mass.set(lane, inverse_mass);
  c.damping_rate.set(lane, moved_mass * work.damping[i]);
  c.tangential_damping_rate.set(lane, inverse_mass * work.damping[i]);
  c.effective_radius.set(lane, effective_radius_on(wall.shape, r));
  const double* m = work.materials[material[lane]];
  c.modulus.set(lane, m[0]), c.shear_modulus.set(lane, m[1]);
  c.friction.set(lane, m[2]), c.damping_ratio.set(lane, m[3]);
  const ContactHistory h = work.slots.history[k];
  set(history.tangential_displacement, lane, h.tangential_displacement);
  history.tangential_stiffness.set(lane, h.tangential_stiffness);
  history.normal_force.set(lane, h.normal_force);
  history.damping_force.set(lane, h.damping_force);
}

template <ContactLaw L>
[[gnu::flatten]] void WallContacts::evaluate_batch(const L& law, const Work& work, Batch& batch, ContactTally& tally) {
  const Lanes stiffness_before = batch.history.tangential_stiffness;
  for (std::size_t l = batch.count; l < kContactLanes; ++l) batch.contacts.touches.set(l, false);
  const AnswerLanes f = dem::evaluate(batch.contacts, batch.history, law, work.dt);
  for (std::size_t l = 0; l < batch.count; ++l) {
    const std::uint32_t k = batch.slot[l], i = work.slots.owner[k];
    tally.damping += f.damping_work[l];
    tally.friction += f.friction_work[l];
    ContactTally rolled;
    const ContactHistoryOf<Lanes>& h = batch.history;
    work.slots.history.set(
        k, {lane_of(h.tangential_displacement, l), h.tangential_stiffness[l], h.normal_force[l], h.damping_force[l]});
    Answer& answer = answers_[k];
    answer.force =
        lane_of(f.force, l) + ((1 - batch.steepness[l]) * h.normal_force[l]) * lane_of(batch.contacts.normal, l);
    answer.damper = f.damper[l];
    answer.torque = (work.particles.radius[i] - 0.5 * batch.contacts.overlap[l]) * lane_of(f.twist, l);
    const double rolling_friction = work.materials[batch.material[l]][ContactMaterials::kRollingFriction];
    if (rolling_friction > 0) {
      RollingState state;
      state.rolling_friction = rolling_friction;
      state.spin = lane_of(batch.contacts.spin, l);  // a wall has none
      state.spin_end = (1 / work.particles.radius[i]) * lane_of(batch.contacts.rim_end, l);
      const double inverse_inertia = inverse_rolling_inertia(work.particles.inverse_mass[i], work.particles.radius[i]);
      state.effective_inertia = inverse_inertia > 0 ? 1 / inverse_inertia : 0.0;
      answer.torque = answer.torque + roll_lane(batch.contacts, h, l, state, stiffness_before[l], f.damper[l], work.dt,
                                                work.slots.rolling[k], rolled);
      tally += rolled;
    }
    if (!booked_.empty()) {
      Booked& booked = booked_[k];
      booked.law.damping = f.damping_work[l], booked.law.friction = f.friction_work[l];
      booked.rolling = rolled;
    }
    const bool touches = batch.contacts.touches[l];
    work.slots.touching[k] = touches ? 1 : 0;
    if (touches) answer.power = dot(answer.force, triple(work.walls.all()[work.slots.partner[k]].velocity));
  }
  batch.count = 0;
}

template <ContactLaw L>
void WallContacts::evaluate_with(const L& law, const Work& work, std::size_t chunk, ContactTally& tally) {
  const auto [first, last] = slots_of_chunk(work.slots, chunk);
  if (first == last) return;
  Batch batch;
  for (std::uint32_t k = first; k < last; ++k) {
    const std::size_t i = work.slots.owner[k];
    answers_[k] = Answer{};
    if (!booked_.empty()) booked_[k] = Booked{};
    const bool listed = work.particles.state[i] != ParticleState::removed;
    const double radius = work.particles.radius[i];
    const double distance =
        listed ? distance_to(work.walls, work.slots.partner[k], work.particles.position[i]) : radius;
    if (distance >= radius && work.slots.touching[k] == 0) continue;
    batch.add(work, k, distance);
    if (batch.count == kContactLanes) evaluate_batch(law, work, batch, tally);
  }
  if (batch.count > 0) evaluate_batch(law, work, batch, tally);
  for (std::uint32_t k = first; k < last; ++k)
    if (answers_[k].power != 0) add_work(work.dt, answers_[k].power, tally);
}

void WallContacts::evaluate(const ContactLawChoice& law, const Particles& particles, const std::vector<double>& damping,
                            ContactDetection& contacts, const Walls& walls, const ContactMaterials& materials,
                            double dt, const MeanMotion* mean, std::size_t chunk, ContactTally& tally) {
  const Work work{particles, damping, contacts.wall_contacts(), walls, materials, dt, mean};
  std::visit([&](const auto& l) { evaluate_with(l, work, chunk, tally); }, law);
}

void WallContacts::add_to(Particles& p, std::vector<double>& damping, const ContactDetection& contacts,
                          std::size_t chunk) const {
  const ContactSlots& slots = contacts.wall_contacts();
  const auto [first, last] = slots_of_chunk(slots, chunk);
  for (std::uint32_t k = first; k < last; ++k) {
    const std::size_t i = slots.owner[k];
    const Triple f = answers_[k].force, t = answers_[k].torque;
    p.force.x[i] += f.x, p.force.y[i] += f.y, p.force.z[i] += f.z;
    p.torque.x[i] += t.x, p.torque.y[i] += t.y, p.torque.z[i] += t.z;
    damping[i] += answers_[k].damper;
  }
}

void WallContacts::tally_by_id(const Numbering& numbering, const ContactDetection& contacts, double dt,
                               std::size_t chunk, ContactTally& tally) const {
  const ContactSlots& slots = contacts.wall_contacts();
  const std::size_t first = chunk * kContactChunk, end = std::min(first + kContactChunk, slots.offset.size() - 1);
  for (std::size_t id = first; id < end; ++id) {
    const ParticleIndex i = numbering.index(id);
    for (std::uint32_t k = slots.offset[i]; k < slots.offset[i + 1]; ++k) {
      tally += booked_[k].law;
      tally += booked_[k].rolling;
      if (answers_[k].power != 0) add_work(dt, answers_[k].power, tally);
    }
  }
}

void WallContacts::keep_answers(const ContactSlots& before, const ContactSlots& now) {
  if (answers_.empty()) return;
  require(answers_.size() == before.size(), "WallContacts::keep_answers: answers of other contacts");
  std::vector<Answer> kept(now.size());
  for (std::size_t i = 0; i + 1 < std::min(before.offset.size(), now.offset.size()); ++i)
    for (std::uint32_t k = now.offset[i]; k < now.offset[i + 1]; ++k)
      for (std::uint32_t b = before.offset[i]; b < before.offset[i + 1]; ++b)
        if (before.partner[b] == now.partner[k]) kept[k] = answers_[b];
  answers_ = std::move(kept);
}

Vec3 WallContacts::force_on_wall(const Particles& particles, const ContactDetection& contacts,
                                 std::uint32_t wall) const {
  const ContactSlots& slots = contacts.wall_contacts();
  Vec3 sum = Vec3::Zero();
  if (answers_.empty()) return sum;
  for_each_slot_by_id(slots, particles.numbering, [&](std::uint32_t k) {
    if (slots.partner[k] == wall) sum -= vec(answers_[k].force);
  });
  return sum;
}

Vec3 WallContacts::moment_on_wall(const Particles& particles, const ContactDetection& contacts, const Walls& walls,
                                  std::uint32_t wall) const {
  const ContactSlots& slots = contacts.wall_contacts();
  Vec3 sum = Vec3::Zero();
  if (answers_.empty()) return sum;
  for_each_slot_by_id(slots, particles.numbering, [&](std::uint32_t k) {
    if (slots.partner[k] != wall) return;
    const Vec3 p = particles.position[slots.owner[k]];
    const Vec3 at = p - walls.distance(wall, p) * walls.gradient(wall, p);
    sum -= at.cross(vec(answers_[k].force));
  });
  return sum;
}

}  // namespace lahar::dem
