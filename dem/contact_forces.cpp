#include "dem/contact_forces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/check.h"
#include "core/parallel.h"
#include "dem/contact/damping.h"

namespace lahar::dem {

namespace {

constexpr std::size_t kChunk = 128;  // particles; fixed, so that sums do not depend on the number of threads
constexpr std::size_t kLanes = 32;   // contacts evaluated together

Triple triple(const Vec3Field& f, std::size_t i) { return {f.x[i], f.y[i], f.z[i]}; }
Triple triple(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

struct ContactForces::Work {
  Particles& particles;
  ContactDetection& contacts;
  const Walls& walls;
  Triple gravity;
  double dt;
};

/// Up to kLanes touching contacts, one array per quantity: the law runs over lanes as vector code. Always evaluated in
/// full width, so that a contact's result does not depend on its lane.
struct ContactForces::Batch {
  template <class T>
  using Lanes = std::array<T, kLanes>;
  struct Vec {
    Lanes<double> x{}, y{}, z{};
    [[nodiscard]] Triple get(std::size_t b) const { return {x[b], y[b], z[b]}; }
    void set(std::size_t b, const Triple& t) { x[b] = t.x, y[b] = t.y, z[b] = t.z; }
  };

  std::size_t count = 0;
  Lanes<std::uint32_t> slot{}, i{}, partner{};
  // gathered
  Vec normal, slip, slip_end;  // slip: velocity of i's centre relative to j, at mid-step and at the end
  Vec spin_i, spin_j, spin_end_i, spin_end_j;
  Lanes<double> overlap{}, radius_i{}, radius_j{}, inverse_mass{};
  Lanes<double> modulus{}, shear_modulus{}, friction{}, damping_ratio{};
  Vec displacement;
  Lanes<double> stiffness{}, normal_force{};
  // computed
  Vec force, torque_i, torque_j;
  Lanes<double> elastic_normal{}, elastic_tangential{}, damping{}, friction_work{}, overlap_ratio{};

  Batch();
  void sphere_geometry();
  template <ContactLaw L>
  void evaluate(const L& law, double dt);
};

ContactForces::Batch::Batch() {  // harmless numbers in lanes that are not in use
  for (auto* lanes : {&normal.x, &overlap, &radius_i, &radius_j, &inverse_mass, &modulus, &shear_modulus})
    lanes->fill(1.0);
}

/// From centre to centre: unit normal and overlap.
void ContactForces::Batch::sphere_geometry() {
  for (std::size_t b = 0; b < kLanes; ++b) {
    const Triple between = normal.get(b);
    const double distance = length(between);
    normal.set(b, (1.0 / std::max(distance, 1e-300)) * between);
    // Touching was judged on squares: by rounding the difference may be a hair below zero, and a root is taken of it.
    overlap[b] = std::max(0.0, radius_i[b] + radius_j[b] - distance);
  }
}

template <ContactLaw L>
void ContactForces::Batch::evaluate(const L& law, double dt) {
  for (std::size_t b = 0; b < kLanes; ++b) {
    const Triple n = normal.get(b), wi = spin_i.get(b), wj = spin_j.get(b), v = slip.get(b), v_end = slip_end.get(b);
    const double ri = radius_i[b], rj = radius_j[b];
    const double curvature_i = 1.0 / ri, curvature_j = rj > 0 ? 1.0 / rj : 0.0;  // a wall has rj = 0
    const double arm_i = ri - 0.5 * overlap[b], arm_j = rj - 0.5 * overlap[b];   // sum is the distance of the centres
    const Triple turning = cross(arm_i * wi + arm_j * wj, n);
    const Triple turning_end = cross(arm_i * spin_end_i.get(b) + arm_j * spin_end_j.get(b), n);

    ContactState s;
    s.overlap = overlap[b];
    s.closing_speed = dot(v_end, n);
    s.normal_ij = n;
    s.tangential_velocity = normal_part(v, n) + turning;
    s.tangential_velocity_end = normal_part(v_end, n) + turning_end;
    s.twist_rate = 0.5 * dot(wi + wj, n);
    s.effective_radius = 1.0 / (curvature_i + curvature_j);
    s.effective_mass = inverse_mass[b] > 0 ? 1.0 / inverse_mass[b] : 0.0;
    s.effective_modulus = modulus[b];
    s.effective_shear_modulus = shear_modulus[b];
    s.friction = friction[b];
    s.damping_ratio = damping_ratio[b];

    ContactHistory history{displacement.get(b), stiffness[b], normal_force[b]};
    const ContactForce f = law(s, history, dt);

    displacement.set(b, history.tangential_displacement);
    stiffness[b] = history.tangential_stiffness;
    normal_force[b] = history.normal_force;
    force.set(b, f.tangential - f.normal * n);
    const Triple twist = cross(n, f.tangential);
    torque_i.set(b, arm_i * twist);
    torque_j.set(b, arm_j * twist);
    elastic_normal[b] = f.elastic_normal;
    elastic_tangential[b] = f.elastic_tangential;
    damping[b] = f.damping_work;
    friction_work[b] = f.friction_work;
    overlap_ratio[b] = overlap[b] * std::max(curvature_i, curvature_j);
  }
}

ContactForces::ContactForces(const Materials& materials, ContactLawChoice law)
    : law_(law), material_count_(materials.size()) {
  for (int a = 0; a < static_cast<int>(materials.size()); ++a)
    for (int b = 0; b < static_cast<int>(materials.size()); ++b) {
      const MaterialPair& p = materials.pair(a, b);
      materials_.push_back({p.effective_modulus, p.effective_shear_modulus, p.friction, damping_ratio(p.restitution)});
    }
}

void ContactForces::compute(Particles& particles, ContactDetection& contacts, const Walls& walls, const Vec3& gravity,
                            double dt) {
  require(contacts.pairs().offset.size() == particles.size() + 1, "contact lists do not belong to these particles");
  pack(particles, dt);
  reactions_.resize(contacts.pairs().size());
  wall_forces_.resize(contacts.wall_contacts().size());
  tallies_.resize((particles.size() + kChunk - 1) / kChunk);
  const Work work{particles, contacts, walls, triple(gravity), dt};
  std::visit([&](const auto& law) { compute_with(law, work); }, law_);
  add_reactions(work);
  sum_tallies();
}

void ContactForces::pack(const Particles& p, double dt) {
  bodies_.resize(p.size());
  const auto pack_one = [&](std::size_t i) {
    ContactBody& b = bodies_[i];
    b.position = triple(p.position, i);
    if (p.state[i] == ParticleState::removed) b.position.x = std::numeric_limits<double>::quiet_NaN();  // never touches
    b.radius = p.radius[i];
    b.velocity = triple(p.velocity, i);
    b.inverse_mass = p.inverse_mass[i];
    b.spin = triple(p.angular_velocity, i);
    b.velocity_end = b.velocity + (0.5 * dt * b.inverse_mass) * triple(p.force, i);
    b.spin_end = b.spin + (0.5 * dt * 2.5 * b.inverse_mass / (b.radius * b.radius)) * triple(p.torque, i);
    b.material = p.material[i];
    b.body = p.body[i];
  };
  parallel_for_even_chunks(p.size(), 512, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) pack_one(i);
  });
}

template <ContactLaw L>
void ContactForces::compute_with(const L& law, const Work& work) {
  Particles& p = work.particles;
  parallel_for_chunks(p.size(), kChunk, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const double m = p.state[i] == ParticleState::removed ? 0.0 : p.mass[i];
      p.force.x[i] = m * work.gravity.x + p.external_force.x[i];
      p.force.y[i] = m * work.gravity.y + p.external_force.y[i];
      p.force.z[i] = m * work.gravity.z + p.external_force.z[i];
      p.torque.x[i] = p.external_torque.x[i];
      p.torque.y[i] = p.external_torque.y[i];
      p.torque.z[i] = p.external_torque.z[i];
    }
    static thread_local Batch batch;  // what idle lanes hold from before is harmless
    Tally tally;
    chunk_pairs(law, work, batch, first, last, tally);
    chunk_walls(law, work, batch, first, last, tally);
    tallies_[first / kChunk] = tally;
  });
}

namespace {

/// Tangential way of i's surface against j's in a step: n from i to j, slip of the centres, arm x spin of both summed.
Triple surface_step(const Triple& n, const Triple& slip, const Triple& turning, double dt) {
  return dt * (normal_part(slip, n) + cross(turning, n));
}

/// Notes that a contact begins or ends. What an ending spring still holds, and what its last force did in the step that
/// parted it, goes to friction; `step` tells that way.
template <class Step>
void change_touch(ContactSlots& slots, std::uint32_t k, bool touches, ContactEnergy& energy, const Step& step) {
  ContactHistory& h = slots.history[k];
  if (!touches) {
    const double held = 0.5 * h.tangential_stiffness * dot(h.tangential_displacement, h.tangential_displacement);
    const double last = 0.5 * h.tangential_stiffness * dot(h.tangential_displacement, step());
    energy.friction += std::max(0.0, held + (std::isfinite(last) ? last : 0.0));  // not so where a particle was removed
    h = ContactHistory{};
  }
  slots.touching[k] = touches;
}

}  // namespace

template <ContactLaw L>
void ContactForces::chunk_pairs(const L& law, const Work& work, Batch& batch, std::size_t first, std::size_t last,
                                Tally& tally) {
  ContactSlots& slots = work.contacts.pairs();
  const auto flush = [&] {
    for (std::size_t b = 0; b < batch.count; ++b) gather_pair(batch, b, slots);
    batch.sphere_geometry();
    batch.evaluate(law, work.dt);
    scatter(batch, work, false, tally);
    batch.count = 0;
  };
  for (std::size_t i = first; i < last; ++i) {
    const Triple x = bodies_[i].position;
    const double r = bodies_[i].radius;
    for (std::uint32_t k = slots.offset[i]; k < slots.offset[i + 1]; ++k) {
      const ContactBody& other = bodies_[slots.partner[k]];
      const Triple between = other.position - x;
      const double sum = r + other.radius;
      const bool touches = dot(between, between) < sum * sum;
      if (static_cast<bool>(slots.touching[k]) != touches)
        change_touch(slots, k, touches, tally.energy, [&] {
          const ContactBody& self = bodies_[i];
          return surface_step((1.0 / length(between)) * between, self.velocity - other.velocity,
                              self.radius * self.spin + other.radius * other.spin, work.dt);
        });
      batch.slot[batch.count] = k;  // kept only if it counts: no branch
      batch.i[batch.count] = static_cast<std::uint32_t>(i);
      batch.count += touches;
      if (batch.count == kLanes) flush();
    }
  }
  if (batch.count > 0) flush();
}

template <ContactLaw L>
void ContactForces::chunk_walls(const L& law, const Work& work, Batch& batch, std::size_t first, std::size_t last,
                                Tally& tally) {
  ContactSlots& slots = work.contacts.wall_contacts();
  const auto flush = [&] {
    batch.evaluate(law, work.dt);
    scatter(batch, work, true, tally);
    batch.count = 0;
  };
  for (std::size_t i = first; i < last; ++i)
    for (std::uint32_t k = slots.offset[i]; k < slots.offset[i + 1]; ++k) {
      wall_forces_[k] = Triple{};
      const bool listed = work.particles.state[i] != ParticleState::removed;
      const double distance = listed ? work.walls.distance(slots.partner[k], work.particles.position[i]) : 0.0;
      const bool touches = listed && distance < bodies_[i].radius;
      if (static_cast<bool>(slots.touching[k]) != touches)
        change_touch(slots, k, touches, tally.energy, [&] {
          const std::uint32_t w = slots.partner[k];
          return surface_step(-1.0 * triple(work.walls.gradient(w, work.particles.position[i])),
                              bodies_[i].velocity - triple(work.walls.all()[w].velocity),
                              bodies_[i].radius * bodies_[i].spin, work.dt);
        });
      if (!touches) continue;
      batch.slot[batch.count] = k;
      batch.i[batch.count] = static_cast<std::uint32_t>(i);
      gather_wall(batch, batch.count, work, distance);
      if (++batch.count == kLanes) flush();
    }
  if (batch.count > 0) flush();
}

void ContactForces::set_material(Batch& batch, std::size_t lane, int a, int b) const {
  const PairMaterial& m = materials_[static_cast<std::size_t>(a) * material_count_ + static_cast<std::size_t>(b)];
  batch.modulus[lane] = m.modulus;
  batch.shear_modulus[lane] = m.shear_modulus;
  batch.friction[lane] = m.friction;
  batch.damping_ratio[lane] = m.damping_ratio;
}

void ContactForces::gather_pair(Batch& batch, std::size_t lane, const ContactSlots& slots) const {
  const std::uint32_t k = batch.slot[lane], j_index = slots.partner[k];
  const ContactBody &i = bodies_[batch.i[lane]], &j = bodies_[j_index];
  batch.partner[lane] = j_index;
  batch.normal.set(lane, j.position - i.position);
  batch.slip.set(lane, i.velocity - j.velocity);
  batch.slip_end.set(lane, i.velocity_end - j.velocity_end);
  batch.spin_i.set(lane, i.spin);
  batch.spin_j.set(lane, j.spin);
  batch.spin_end_i.set(lane, i.spin_end);
  batch.spin_end_j.set(lane, j.spin_end);
  batch.radius_i[lane] = i.radius;
  batch.radius_j[lane] = j.radius;
  batch.inverse_mass[lane] = i.inverse_mass + j.inverse_mass;
  set_material(batch, lane, i.material, j.material);
  if (i.body == j.body && i.body >= 0) batch.friction[lane] = 0;
  batch.displacement.set(lane, slots.history[k].tangential_displacement);
  batch.stiffness[lane] = slots.history[k].tangential_stiffness;
  batch.normal_force[lane] = slots.history[k].normal_force;
}

void ContactForces::gather_wall(Batch& batch, std::size_t lane, const Work& work, double distance) const {
  const ContactSlots& slots = work.contacts.wall_contacts();
  const std::uint32_t k = batch.slot[lane], w = slots.partner[k];
  const ContactBody& i = bodies_[batch.i[lane]];
  const Wall& wall = work.walls.all()[w];
  const Triple wall_velocity = triple(wall.velocity);
  batch.partner[lane] = w;
  batch.normal.set(lane, -1.0 * triple(work.walls.gradient(w, work.particles.position[batch.i[lane]])));
  batch.overlap[lane] = i.radius - distance;
  batch.slip.set(lane, i.velocity - wall_velocity);
  batch.slip_end.set(lane, i.velocity_end - wall_velocity);
  batch.spin_i.set(lane, i.spin);
  batch.spin_j.set(lane, Triple{});
  batch.spin_end_i.set(lane, i.spin_end);
  batch.spin_end_j.set(lane, Triple{});
  batch.radius_i[lane] = i.radius;
  batch.radius_j[lane] = 0;
  batch.inverse_mass[lane] = i.inverse_mass;
  set_material(batch, lane, i.material, wall.material);
  batch.displacement.set(lane, slots.history[k].tangential_displacement);
  batch.stiffness[lane] = slots.history[k].tangential_stiffness;
  batch.normal_force[lane] = slots.history[k].normal_force;
}

void ContactForces::scatter(const Batch& batch, const Work& work, bool with_wall, Tally& tally) {
  ContactSlots& slots = with_wall ? work.contacts.wall_contacts() : work.contacts.pairs();
  Particles& p = work.particles;
  for (std::size_t b = 0; b < batch.count; ++b) {
    const std::uint32_t k = batch.slot[b], i = batch.i[b];
    slots.history[k] = {batch.displacement.get(b), batch.stiffness[b], batch.normal_force[b]};
    const Triple f = batch.force.get(b), t = batch.torque_i.get(b);
    p.force.x[i] += f.x, p.force.y[i] += f.y, p.force.z[i] += f.z;
    p.torque.x[i] += t.x, p.torque.y[i] += t.y, p.torque.z[i] += t.z;
    if (with_wall) {
      wall_forces_[k] = f;
      tally.energy.wall_work += work.dt * dot(f, triple(work.walls.all()[batch.partner[b]].velocity));
    } else {
      reactions_[k] = {-1.0 * f, batch.torque_j.get(b)};
    }
    tally.energy.elastic_normal += batch.elastic_normal[b];
    tally.energy.elastic_tangential += batch.elastic_tangential[b];
    tally.energy.damping += batch.damping[b];
    tally.energy.friction += batch.friction_work[b];
    if (batch.overlap_ratio[b] > tally.worst.ratio)
      tally.worst = {batch.overlap_ratio[b], i, batch.partner[b], with_wall};
  }
}

/// Adds what the partners of pairs feel, per particle in the order of the slots.
void ContactForces::add_reactions(const Work& work) {
  Particles& p = work.particles;
  const auto& offset = work.contacts.partner_offset();
  const auto& slot = work.contacts.slot_of_partner();
  const auto& touching = work.contacts.pairs().touching;
  parallel_for(0, p.size(), 512, [&](std::size_t j) {
    Triple f{}, t{};
    for (std::uint32_t n = offset[j]; n < offset[j + 1]; ++n)
      if (touching[slot[n]]) f = f + reactions_[slot[n]].force, t = t + reactions_[slot[n]].torque;
    p.force.x[j] += f.x, p.force.y[j] += f.y, p.force.z[j] += f.z;
    p.torque.x[j] += t.x, p.torque.y[j] += t.y, p.torque.z[j] += t.z;
  });
}

void ContactForces::sum_tallies() {
  energy_.elastic_normal = energy_.elastic_tangential = energy_.damping_of_step = energy_.wall_work_of_step = 0;
  worst_ = {};
  for (const auto& t : tallies_) {
    energy_.elastic_normal += t.energy.elastic_normal;
    energy_.elastic_tangential += t.energy.elastic_tangential;
    energy_.damping += t.energy.damping;
    energy_.friction += t.energy.friction;
    energy_.wall_work += t.energy.wall_work;
    energy_.damping_of_step += t.energy.damping;
    energy_.wall_work_of_step += t.energy.wall_work;
    if (t.worst.ratio > worst_.ratio) worst_ = t.worst;
  }
}

Vec3 ContactForces::force_on_wall(const ContactDetection& contacts, std::uint32_t wall) const {
  const ContactSlots& slots = contacts.wall_contacts();
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < slots.size(); ++k)
    if (slots.partner[k] == wall) sum -= Vec3(wall_forces_[k].x, wall_forces_[k].y, wall_forces_[k].z);
  return sum;
}

Vec3 ContactForces::moment_on_wall(const ContactDetection& contacts, const Walls& walls, std::uint32_t wall) const {
  const ContactSlots& slots = contacts.wall_contacts();
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i + 1 < slots.offset.size(); ++i)
    for (std::size_t k = slots.offset[i]; k < slots.offset[i + 1]; ++k) {
      if (slots.partner[k] != wall) continue;
      const Vec3 p(bodies_[i].position.x, bodies_[i].position.y, bodies_[i].position.z);
      const Vec3 at = p - walls.distance(wall, p) * walls.gradient(wall, p);
      sum -= at.cross(Vec3(wall_forces_[k].x, wall_forces_[k].y, wall_forces_[k].z));
    }
  return sum;
}

}  // namespace lahar::dem
