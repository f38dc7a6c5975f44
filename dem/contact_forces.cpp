#include "dem/contact_forces.h"

#include <algorithm>
#include <array>

#include "core/check.h"
#include "core/parallel.h"
#include "dem/contact/damping.h"
#include "dem/fast_math.h"

namespace lahar::dem {

namespace {

constexpr std::size_t kChunk = 128;  // particles; fixed, so that sums do not depend on the number of threads
constexpr std::size_t kLanes = 32;   // contacts evaluated together

Triple triple(const Vec3Field& f, std::size_t i) { return {f.x[i], f.y[i], f.z[i]}; }
Triple triple(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 vec(const Triple& t) { return {t.x, t.y, t.z}; }

}  // namespace

struct ContactForces::Work {
  Particles& particles;
  ContactDetection& contacts;
  const Walls& walls;
  Triple gravity;
  double dt;
  const RateShare& share;
  const MeanMotion* mean;
};

/// Up to kLanes possible contacts, one array per quantity: the law runs over lanes as vector code. Lanes that do not
/// touch answer zero. Always evaluated in whole lines, so that a contact's result does not depend on its lane.
struct ContactForces::Batch {
  template <class T>
  using Lanes = std::array<T, kLanes>;
  struct Vec {
    alignas(64) Lanes<double> x{}, y{}, z{};
    [[nodiscard]] Triple get(std::size_t b) const { return {x[b], y[b], z[b]}; }
    void set(std::size_t b, const Triple& t) { x[b] = t.x, y[b] = t.y, z[b] = t.z; }
  };

  std::size_t count = 0;
  std::size_t first = 0;             // slot of lane 0, for pairs
  Lanes<std::uint32_t> slot{}, i{};  // for walls
  // gathered
  Vec between;                                                     // m, from j to i
  Vec slip, slip_end;                                              // m/s, of i's centre relative to j
  Vec spin, spin_end;                                              // rad/s, sum of both spheres
  Vec rim, rim_end;                                                // m/s, sum of radius x spin
  alignas(64) Lanes<double> radii{}, inverse_mass{}, curvature{};  // sums of both
  alignas(64) Lanes<double> modulus{}, shear_modulus{}, friction{}, damping_ratio{};
  Vec displacement;
  alignas(64) Lanes<double> stiffness{}, normal_force{};
  // computed
  Vec normal;  // from i to j
  alignas(64) Lanes<double> overlap{};
  Vec force, twist;
  Vec rolling;  // torque on i
  alignas(64) Lanes<double> elastic_normal{}, elastic_tangential{}, damping{}, friction_work{}, touches{};

  Batch();
  /// The lanes to run over: whole lines.
  [[nodiscard]] std::size_t lanes() const { return (count + kLine - 1) / kLine * kLine; }
  // Flattened: a call left in the loop would keep it from being vectorized.
  [[gnu::flatten]] void sphere_geometry();
  template <ContactLaw L>
  [[gnu::flatten]] void evaluate(const L& law, double dt);
};

ContactForces::Batch::Batch() {  // harmless numbers in lanes that are not in use
  for (auto* lanes :
       {&between.x, &normal.x, &radii, &inverse_mass, &curvature, &modulus, &shear_modulus, &overlap, &touches})
    lanes->fill(1.0);
}

/// From centre to centre: unit normal and overlap.
void ContactForces::Batch::sphere_geometry() {
  for (std::size_t b = 0; b < lanes(); ++b) {
    const Triple d = between.get(b);
    const double square = dot(d, d), sum = radii[b];
    const double inverse = inverse_root(square), distance = square * inverse;
    normal.set(b, -inverse * d);
    touches[b] = square < sum * sum ? 1.0 : 0.0;  // 0 also for removed particles, whose position is not a number
    // Touching was judged on squares: by rounding the difference may be a hair below zero, and a root is taken of it.
    overlap[b] = std::max(0.0, sum - distance);
  }
}

/// What goes to friction when a contact ends, J: what its spring still holds, and what its last force did in the step
/// that parted the two. Nothing of the latter where a particle was removed, whose motion is not a number.
inline double left_by_spring(const ContactState& s, const ContactHistory& h, double dt) {
  const double held = 0.5 * h.tangential_stiffness * dot(h.tangential_displacement, h.tangential_displacement);
  const double last = 0.5 * h.tangential_stiffness * dt * dot(h.tangential_displacement, s.tangential_velocity);
  return std::max(0.0, held + (last == last ? last : 0.0));
}

template <ContactLaw L>
void ContactForces::Batch::evaluate(const L& law, double dt) {
  for (std::size_t b = 0; b < lanes(); ++b) {
    const Triple n = normal.get(b), w = spin.get(b), v = slip.get(b), v_end = slip_end.get(b);
    const double half = 0.5 * overlap[b];  // the arms are the radii less half the overlap
    const Triple turning = cross(rim.get(b) - half * w, n);
    const Triple turning_end = cross(rim_end.get(b) - half * spin_end.get(b), n);

    ContactState s;
    s.overlap = overlap[b];
    s.closing_speed = dot(v_end, n);
    s.normal_ij = n;
    s.tangential_velocity = normal_part(v, n) + turning;
    s.tangential_velocity_end = normal_part(v_end, n) + turning_end;
    s.twist_rate = 0.5 * dot(w, n);
    s.effective_radius = 1.0 / curvature[b];
    s.effective_mass = inverse_mass[b] > 0 ? 1.0 / inverse_mass[b] : 0.0;
    s.effective_modulus = modulus[b];
    s.effective_shear_modulus = shear_modulus[b];
    s.friction = friction[b];
    s.damping_ratio = damping_ratio[b];

    ContactHistory history{displacement.get(b), stiffness[b], normal_force[b]};
    const double left = left_by_spring(s, history, dt);
    const ContactForce f = law(s, history, dt);

    const bool on = touches[b] > 0;
    const auto only = [&](double value) { return on ? value : 0.0; };
    const auto only3 = [&](const Triple& t) { return Triple{only(t.x), only(t.y), only(t.z)}; };
    displacement.set(b, only3(history.tangential_displacement));
    stiffness[b] = only(history.tangential_stiffness);
    normal_force[b] = only(history.normal_force);
    force.set(b, only3(f.tangential - f.normal * n));
    twist.set(b, only3(cross(n, f.tangential)));
    elastic_normal[b] = only(f.elastic_normal);
    elastic_tangential[b] = only(f.elastic_tangential);
    damping[b] = only(f.damping_work);
    friction_work[b] = on ? f.friction_work : left;
  }
}

ContactForces::ContactForces(const Materials& materials, ContactLawChoice law)
    : law_(law), material_count_(materials.size()) {
  for (const double rubbing : {1.0, 0.0})
    for (int a = 0; a < static_cast<int>(materials.size()); ++a)
      for (int b = 0; b < static_cast<int>(materials.size()); ++b) {
        const MaterialPair& p = materials.pair(a, b);
        materials_.modulus.push_back(p.effective_modulus);
        materials_.shear_modulus.push_back(p.effective_shear_modulus);
        materials_.friction.push_back(rubbing * p.friction);
        materials_.damping_ratio.push_back(damping_ratio(p.restitution));
        materials_.rolling_friction.push_back(rubbing * p.rolling_friction);
        rolls_ = rolls_ || p.rolling_friction > 0;
      }
  require(materials_.modulus.size() <= std::numeric_limits<std::uint16_t>::max(), "too many materials");
}

void ContactForces::compute(Particles& particles, ContactDetection& contacts, const Walls& walls, const Vec3& gravity,
                            double dt, const RateShare& share, const MeanMotion* mean) {
  require(contacts.pairs().offset.size() == particles.size() + 1, "contact lists do not belong to these particles");
  if (noted_refresh_ != contacts.refreshes()) note_slots(particles, contacts);
  bodies_.pack(particles, contacts.parties(), dt, mean);
  tallies_.resize((particles.size() + kChunk - 1) / kChunk);
  const Work work{particles, contacts, walls, triple(gravity), dt, share, mean};
  std::visit([&](const auto& law) { compute_with(law, work); }, law_);
  add_pair_forces(work);
  if (rolls_) add_rolling_torques(work);
  sum_tallies();
}

/// What stays the same while the slots stay: materials and the smaller radius of each pair.
void ContactForces::note_slots(const Particles& p, const ContactDetection& contacts) {
  const ContactSlots& slots = contacts.pairs();
  slot_material_.resize(slots.size());
  slot_curvature_.resize(slots.size());
  pair_answers_.resize(slots.size());
  if (rolls_) rolling_answers_.resize(slots.size());
  wall_answers_.resize(contacts.wall_contacts().size());
  parallel_for(0, slots.size(), 4096, [&](std::size_t k) {
    const std::uint32_t i = slots.owner[k], j = slots.partner[k];
    const bool frictionless = p.body[i] == p.body[j] && p.body[i] >= 0;  // beads of one body
    const std::size_t pair =
        static_cast<std::size_t>(p.material[i]) * material_count_ + static_cast<std::size_t>(p.material[j]);
    slot_material_[k] = static_cast<std::uint16_t>(pair + (frictionless ? material_count_ * material_count_ : 0));
    slot_curvature_[k] = static_cast<float>(1 / std::min(p.radius[i], p.radius[j]));
  });
  noted_refresh_ = contacts.refreshes();
}

template <ContactLaw L>
void ContactForces::compute_with(const L& law, const Work& work) {
  parallel_for_chunks(work.particles.size(), kChunk, [&](std::size_t first, std::size_t last) {
    static thread_local Batch batch;  // what idle lanes hold from before is harmless
    Tally tally;
    chunk_pairs(law, work, batch, first, last, tally);
    chunk_walls(law, work, batch, first, last, tally);  // before set_body_forces: needs the last step's forces
    set_body_forces(work, first, last);
    tallies_[first / kChunk] = tally;
  });
}

/// Gravity, external and wall forces of the particles of this rate.
void ContactForces::set_body_forces(const Work& work, std::size_t first, std::size_t last) const {
  Particles& p = work.particles;
  const auto set = [&](std::vector<double>& force, const std::vector<double>& external, double gravity) {
    double* f = force.data();
    const double *e = external.data(), *mass = p.mass.data();
    const ParticleState* state = p.state.data();
    for (std::size_t i = first; i < last; ++i)
      f[i] = (state[i] == ParticleState::removed ? 0.0 : mass[i]) * gravity + e[i];
  };
  set(p.force.x, p.external_force.x, work.gravity.x);
  set(p.force.y, p.external_force.y, work.gravity.y);
  set(p.force.z, p.external_force.z, work.gravity.z);
  const auto copy = [&](const std::vector<double>& from, std::vector<double>& to) {
    std::copy(from.data() + first, from.data() + last, to.data() + first);
  };
  copy(p.external_torque.x, p.torque.x);
  copy(p.external_torque.y, p.torque.y);
  copy(p.external_torque.z, p.torque.z);
  for (std::size_t i = first; work.share.rate != Rate::all && i < last; ++i) {
    if (work.share.single(i)) continue;
    p.force.x[i] = p.force.y[i] = p.force.z[i] = 0;
    p.torque.x[i] = p.torque.y[i] = p.torque.z[i] = 0;
  }
  const ContactSlots& slots = work.contacts.wall_contacts();
  for (std::uint32_t k = slots.offset[first]; k < slots.offset[last]; ++k) {
    const std::size_t i = slots.owner[k];
    const Triple f = wall_answers_[k].force, t = wall_answers_[k].torque;
    p.force.x[i] += f.x, p.force.y[i] += f.y, p.force.z[i] += f.z;
    p.torque.x[i] += t.x, p.torque.y[i] += t.y, p.torque.z[i] += t.z;
  }
}

template <ContactLaw L>
void ContactForces::chunk_pairs(const L& law, const Work& work, Batch& batch, std::size_t first, std::size_t last,
                                Tally& tally) {
  ContactSlots& slots = work.contacts.pairs();
  const std::size_t end = slots.offset[last];
  for (std::size_t k = slots.offset[first]; k < end; k += kLanes) {
    batch.first = k;
    batch.count = std::min(kLanes, end - k);
    gather_pairs(batch, slots, work.contacts.parties());
    batch.sphere_geometry();
    batch.evaluate(law, work.dt);
    if (rolls_) roll_pairs(batch, work, tally);
    answer_pairs(batch, work, tally);
  }
}

/// Fetches the bodies of a batch, eight contacts at a time.
void ContactForces::gather_pairs(Batch& batch, const ContactSlots& slots, const ContactParties& parties) const {
  const Line flip_first{-1, 1, 1, 1, 1, 1, 1, 1};
  for (std::size_t lane = 0; lane < batch.count; lane += kLine) {
    std::array<Line, kLine> a, b, c;
    for (std::size_t l = 0; l < kLine; ++l) {
      const std::size_t k = batch.first + std::min(lane + l, batch.count - 1);
      const double *i = bodies_[parties.owner[k]], *j = bodies_[parties.partner[k]];
      a[l] = load_line(i) - load_line(j);
      b[l] = load_line(i + kLine) + flip_first * load_line(j + kLine);
      c[l] = load_line(i + 2 * kLine) + load_line(j + 2 * kLine);
    }
    transpose(a);
    transpose(b);
    transpose(c);
    const auto put = [&](Batch::Vec& v, const Line& x, const Line& y, const Line& z) {
      store_line(&v.x[lane], x), store_line(&v.y[lane], y), store_line(&v.z[lane], z);
    };
    put(batch.between, a[0], a[1], a[2]);
    put(batch.slip, a[3], a[4], a[5]);
    put(batch.slip_end, a[6], a[7], b[0]);
    put(batch.spin, b[1], b[2], b[3]);
    put(batch.spin_end, b[4], b[5], b[6]);
    store_line(&batch.radii[lane], b[7]);
    put(batch.rim, c[0], c[1], c[2]);
    put(batch.rim_end, c[3], c[4], c[5]);
    store_line(&batch.inverse_mass[lane], c[6]);
    store_line(&batch.curvature[lane], c[7]);
  }
  const std::uint16_t* material = &slot_material_[batch.first];
  const ContactHistory* history = &slots.history[batch.first];
  const PairMaterials::Tables tables(materials_);
  for (std::size_t lane = 0; lane < batch.count; ++lane) {
    batch.modulus[lane] = tables.modulus[material[lane]];
    batch.shear_modulus[lane] = tables.shear_modulus[material[lane]];
    batch.friction[lane] = tables.friction[material[lane]];
    batch.damping_ratio[lane] = tables.damping_ratio[material[lane]];
  }
  for (std::size_t lane = 0; lane < batch.count; ++lane) {
    batch.displacement.set(lane, history[lane].tangential_displacement);
    batch.stiffness[lane] = history[lane].tangential_stiffness;
    batch.normal_force[lane] = history[lane].normal_force;
  }
}

template <ContactLaw L>
void ContactForces::chunk_walls(const L& law, const Work& work, Batch& batch, std::size_t first, std::size_t last,
                                Tally& tally) {
  ContactSlots& slots = work.contacts.wall_contacts();
  const auto flush = [&] {
    batch.evaluate(law, work.dt);
    if (rolls_) roll_walls(batch, work, tally);
    answer_walls(batch, work, tally);
    batch.count = 0;
  };
  batch.count = 0;
  for (std::uint32_t k = slots.offset[first]; k < slots.offset[last]; ++k) {
    const std::size_t i = slots.owner[k];
    wall_answers_[k] = WallAnswer{};
    const bool listed = work.particles.state[i] != ParticleState::removed;
    const double radius = work.particles.radius[i];
    const double distance = listed ? work.walls.distance(slots.partner[k], work.particles.position[i]) : radius;
    const bool touches = distance < radius;
    if (!touches && slots.touching[k] == 0) continue;
    batch.slot[batch.count] = k;
    batch.i[batch.count] = static_cast<std::uint32_t>(i);
    batch.touches[batch.count] = touches ? 1.0 : 0.0;
    gather_wall(batch, batch.count, work, distance);
    if (++batch.count == kLanes) flush();
  }
  if (batch.count > 0) flush();
}

void ContactForces::set_material(Batch& batch, std::size_t lane, std::size_t material) const {
  batch.modulus[lane] = materials_.modulus[material];
  batch.shear_modulus[lane] = materials_.shear_modulus[material];
  batch.friction[lane] = materials_.friction[material];
  batch.damping_ratio[lane] = materials_.damping_ratio[material];
}

void ContactForces::gather_wall(Batch& batch, std::size_t lane, const Work& work, double distance) const {
  const ContactSlots& slots = work.contacts.wall_contacts();
  const Particles& p = work.particles;
  const std::uint32_t k = batch.slot[lane], w = slots.partner[k], i = batch.i[lane];
  const Wall& wall = work.walls.all()[w];
  const double r = p.radius[i], inverse_mass = p.inverse_mass[i];
  const Triple v = triple(work.mean != nullptr ? work.mean->velocity : p.velocity, i);
  const Triple spin = triple(work.mean != nullptr ? work.mean->spin : p.angular_velocity, i);
  const Triple v_end = triple(p.velocity, i) + (0.5 * work.dt * inverse_mass) * triple(p.force, i);
  const Triple spin_end =
      triple(p.angular_velocity, i) + (0.5 * work.dt * 2.5 * inverse_mass / (r * r)) * triple(p.torque, i);
  const Triple wall_velocity = triple(wall.velocity);
  batch.normal.set(lane, -1.0 * triple(work.walls.gradient(w, p.position[i])));
  batch.overlap[lane] = std::max(0.0, r - distance);
  batch.slip.set(lane, v - wall_velocity);
  batch.slip_end.set(lane, v_end - wall_velocity);
  batch.spin.set(lane, spin);
  batch.spin_end.set(lane, spin_end);
  batch.rim.set(lane, r * spin);  // a wall adds nothing: its spin is zero
  batch.rim_end.set(lane, r * spin_end);
  batch.inverse_mass[lane] = inverse_mass;
  batch.curvature[lane] = 1 / r;
  set_material(batch, lane,
               static_cast<std::size_t>(p.material[i]) * material_count_ + static_cast<std::size_t>(wall.material));
  batch.displacement.set(lane, slots.history[k].tangential_displacement);
  batch.stiffness[lane] = slots.history[k].tangential_stiffness;
  batch.normal_force[lane] = slots.history[k].normal_force;
}

namespace {

/// 1 / (I + m R^2) of a sphere, 1/(kg m^2).
double inverse_rolling_inertia(double inverse_mass, double curvature) {
  return inverse_mass * curvature * curvature / 1.4;
}

}  // namespace

/// Rolling resistance of one contact, after the law, whose normal force and stiffness it needs, and before the slot
/// forgets the step before. `state` brings the spins, the inertia and the coefficient.
void ContactForces::roll_lane(Batch& batch, std::size_t lane, RollingState state, const ContactHistory& before,
                              Triple& angle, double dt, Tally& tally) const {
  state.effective_radius = 1 / batch.curvature[lane];
  state.last_shear_stiffness = before.tangential_stiffness;
  if (batch.touches[lane] == 0) {
    tally.energies[5] += left_by_rolling(state, angle, dt);
    angle = Triple{};
    batch.rolling.set(lane, Triple{});
    return;
  }
  state.normal_ij = batch.normal.get(lane);
  state.twist_rate = 0.5 * dot(batch.spin.get(lane), state.normal_ij);
  state.normal_force = batch.normal_force[lane];
  state.shear_stiffness = batch.stiffness[lane];
  state.damping_ratio = batch.damping_ratio[lane];
  const RollingTorque t = roll(state, angle, dt);
  batch.rolling.set(lane, t.on_i);
  tally.energies[2] += t.damping_work;
  tally.energies[4] += t.elastic;
  tally.energies[5] += t.friction_work;
}

void ContactForces::roll_pairs(Batch& batch, const Work& work, Tally& tally) {
  ContactSlots& slots = work.contacts.pairs();
  const ContactParties& parties = work.contacts.parties();
  for (std::size_t b = 0; b < batch.count; ++b) {
    const std::size_t k = batch.first + b;
    rolling_answers_[k] = Triple{};
    const double rolling_friction = materials_.rolling_friction[slot_material_[k]];
    if (rolling_friction == 0 || (batch.touches[b] == 0 && slots.touching[k] == 0)) continue;
    const double *i = bodies_[parties.owner[k]], *j = bodies_[parties.partner[k]];  // see contact_bodies.h
    const double *wi = i + kLine + 1, *wj = j + kLine + 1;
    RollingState state;
    state.spin = {wi[0] - wj[0], wi[1] - wj[1], wi[2] - wj[2]};
    state.spin_end = {wi[3] - wj[3], wi[4] - wj[4], wi[5] - wj[5]};
    const double inverse_inertia = inverse_rolling_inertia(i[2 * kLine + 6], i[2 * kLine + 7]) +
                                   inverse_rolling_inertia(j[2 * kLine + 6], j[2 * kLine + 7]);
    state.effective_inertia = inverse_inertia > 0 ? 1 / inverse_inertia : 0.0;
    state.rolling_friction = rolling_friction;
    roll_lane(batch, b, state, slots.history[k], slots.rolling[k], work.dt, tally);
    rolling_answers_[k] = batch.rolling.get(b);
  }
}

void ContactForces::roll_walls(Batch& batch, const Work& work, Tally& tally) {
  ContactSlots& slots = work.contacts.wall_contacts();
  for (std::size_t b = 0; b < batch.count; ++b) {
    const std::uint32_t k = batch.slot[b];
    batch.rolling.set(b, Triple{});
    const std::size_t material = static_cast<std::size_t>(work.particles.material[batch.i[b]]) * material_count_ +
                                 static_cast<std::size_t>(work.walls.all()[slots.partner[k]].material);
    if (materials_.rolling_friction[material] == 0) continue;
    RollingState state;
    state.spin = batch.spin.get(b);  // a wall has none
    state.spin_end = batch.spin_end.get(b);
    const double inverse_inertia = inverse_rolling_inertia(batch.inverse_mass[b], batch.curvature[b]);
    state.effective_inertia = inverse_inertia > 0 ? 1 / inverse_inertia : 0.0;
    state.rolling_friction = materials_.rolling_friction[material];
    roll_lane(batch, b, state, slots.history[k], slots.rolling[k], work.dt, tally);
  }
}

/// Adds the rolling torques of pairs to both sides, in the order of the slots.
void ContactForces::add_rolling_torques(const Work& work) const {
  Particles& p = work.particles;
  const ContactParties& parties = work.contacts.parties();
  parallel_for_even_chunks(parties.particle.size(), 256, [&](std::size_t first, std::size_t last) {
    for (std::size_t place = first; place < last; ++place) {
      Triple sum{};
      for (std::uint32_t n = parties.offset[place]; n < parties.offset[place + 1]; ++n) {
        const std::uint32_t feels = parties.feels[n];
        sum = sum + (feels % 2 == 0 ? 1.0 : -1.0) * rolling_answers_[feels / 2];
      }
      const std::size_t i = parties.particle[place];
      p.torque.x[i] += sum.x, p.torque.y[i] += sum.y, p.torque.z[i] += sum.z;
    }
  });
}

/// Writes what the slots of a batch remember and answer. Energies are summed slot by slot: slots that do not touch add
/// exact zeros, so that the sum does not depend on which of them are listed.
void ContactForces::answer_pairs(const Batch& batch, const Work& work, Tally& tally) {
  ContactSlots& slots = work.contacts.pairs();
  int deeper = 0;
  for (std::size_t lane = 0; lane < batch.count; lane += kLine) {
    std::array<Line, kLine> a{load_line(&batch.force.x[lane]),       load_line(&batch.force.y[lane]),
                              load_line(&batch.force.z[lane]),       load_line(&batch.twist.x[lane]),
                              load_line(&batch.twist.y[lane]),       load_line(&batch.twist.z[lane]),
                              0.5 * load_line(&batch.overlap[lane]), Line{}};
    std::array<Line, kLine> e{load_line(&batch.elastic_normal[lane]), load_line(&batch.elastic_tangential[lane]),
                              load_line(&batch.damping[lane]), load_line(&batch.friction_work[lane])};
    transpose(a);
    transpose(e);
    const std::size_t lines = std::min(kLine, batch.count - lane);
    for (std::size_t l = 0; l < lines; ++l) {
      store_line(pair_answers_[batch.first + lane + l], a[l]);
      tally.energies += e[l];
    }
  }
  ContactHistory* history = &slots.history[batch.first];
  std::uint8_t* touching = &slots.touching[batch.first];
  const float* curvature = &slot_curvature_[batch.first];
  for (std::size_t b = 0; b < batch.count; ++b)
    history[b] = {batch.displacement.get(b), batch.stiffness[b], batch.normal_force[b]};
  for (std::size_t b = 0; b < batch.count; ++b) touching[b] = batch.touches[b] > 0;
  const double worst = tally.worst.ratio;
  for (std::size_t b = 0; b < batch.count; ++b)
    deeper |= batch.touches[b] * batch.overlap[b] * static_cast<double>(curvature[b]) > worst ? 1 : 0;
  if (deeper == 0) return;
  for (std::size_t b = 0; b < batch.count; ++b) {
    const std::uint32_t i = slots.owner[batch.first + b], j = slots.partner[batch.first + b];
    const double ratio =
        batch.touches[b] * batch.overlap[b] / std::min(work.particles.radius[i], work.particles.radius[j]);
    if (ratio > tally.worst.ratio) tally.worst = {ratio, i, j, false};
  }
}

void ContactForces::answer_walls(const Batch& batch, const Work& work, Tally& tally) {
  ContactSlots& slots = work.contacts.wall_contacts();
  for (std::size_t b = 0; b < batch.count; ++b) {
    const std::uint32_t k = batch.slot[b], i = batch.i[b];
    slots.history[k] = {batch.displacement.get(b), batch.stiffness[b], batch.normal_force[b]};
    slots.touching[k] = batch.touches[b] > 0;
    tally.energies +=
        Line{batch.elastic_normal[b], batch.elastic_tangential[b], batch.damping[b], batch.friction_work[b]};
    if (!slots.touching[k]) continue;
    const double r = work.particles.radius[i];
    const Triple f = batch.force.get(b);
    wall_answers_[k] = {f, (r - 0.5 * batch.overlap[b]) * batch.twist.get(b)};
    if (rolls_) wall_answers_[k].torque = wall_answers_[k].torque + batch.rolling.get(b);
    tally.wall_work += work.dt * dot(f, triple(work.walls.all()[slots.partner[k]].velocity));
    const double ratio = batch.overlap[b] / r;
    if (ratio > tally.worst.ratio) tally.worst = {ratio, i, slots.partner[k], true};
  }
}

/// Adds what each party feels in its pairs: as owner and as partner, each in the order of the slots.
void ContactForces::add_pair_forces(const Work& work) const {
  Particles& p = work.particles;
  const ContactParties& parties = work.contacts.parties();
  const Line sign[2] = {{1, 1, 1, 0, 0, 0, 0, 0}, {-1, -1, -1, 0, 0, 0, 0, 0}};
  const Line arm{0, 0, 0, 1, 1, 1, 0, 0};
  parallel_for_even_chunks(parties.particle.size(), 256, [&](std::size_t first, std::size_t last) {
    for (std::size_t place = first; place < last; ++place) {
      const std::size_t i = parties.particle[place];
      const double r = p.radius[i];
      Line sum{};
      for (std::uint32_t n = parties.offset[place]; n < parties.offset[place + 1]; ++n) {
        const std::uint32_t feels = parties.feels[n];
        const double* answer = pair_answers_[feels / 2];
        sum += load_line(answer) * (sign[feels % 2] + (r - answer[6]) * arm);
      }
      p.force.x[i] += sum[0], p.force.y[i] += sum[1], p.force.z[i] += sum[2];
      p.torque.x[i] += sum[3], p.torque.y[i] += sum[4], p.torque.z[i] += sum[5];
    }
  });
}

void ContactForces::sum_tallies() {
  energy_.elastic_normal = energy_.elastic_tangential = energy_.elastic_rolling = energy_.damping_of_step =
      energy_.wall_work_of_step = 0;
  worst_ = {};
  for (const auto& t : tallies_) {
    energy_.elastic_normal += t.energies[0];
    energy_.elastic_tangential += t.energies[1];
    energy_.damping += t.energies[2];
    energy_.friction += t.energies[3];
    energy_.elastic_rolling += t.energies[4];
    energy_.rolling += t.energies[5];
    energy_.wall_work += t.wall_work;
    energy_.damping_of_step += t.energies[2];
    energy_.wall_work_of_step += t.wall_work;
    if (t.worst.ratio > worst_.ratio) worst_ = t.worst;
  }
}

void ContactForces::transfer(Archive& archive) {
  energy_.transfer(archive);
  if (!archive.loading()) return;
  noted_refresh_ = -1;
  wall_answers_.clear();
}

Vec3 ContactForces::force_on_wall(const ContactDetection& contacts, std::uint32_t wall) const {
  const ContactSlots& slots = contacts.wall_contacts();
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < wall_answers_.size(); ++k)
    if (slots.partner[k] == wall) sum -= vec(wall_answers_[k].force);
  return sum;
}

Vec3 ContactForces::moment_on_wall(const Particles& particles, const ContactDetection& contacts, const Walls& walls,
                                   std::uint32_t wall) const {
  const ContactSlots& slots = contacts.wall_contacts();
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < wall_answers_.size(); ++k) {
    if (slots.partner[k] != wall) continue;
    const Vec3 p = particles.position[slots.owner[k]];
    const Vec3 at = p - walls.distance(wall, p) * walls.gradient(wall, p);
    sum -= at.cross(vec(wall_answers_[k].force));
  }
  return sum;
}

}  // namespace lahar::dem
