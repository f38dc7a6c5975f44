#include "dem/solids.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.h"
#include "core/parallel.h"
#include "dem/contact/contact_energy.h"
#include "dem/integrator.h"

namespace lahar::dem {

Solids::Solids(Particles particles, Bonds bonds, Materials materials, Walls walls, const SolidsOptions& options)
    : particles_(std::move(particles)),
      bonds_(std::move(bonds)),
      materials_(std::move(materials)),
      walls_(std::move(walls)),
      options_(options),
      contacts_(options.neighbours),
      contact_forces_(materials_, options.contact_law),
      slow_contacts_(options.neighbours),
      slow_forces_(materials_, options.contact_law),
      section_integrate_(&timers_.section("integrate")),
      section_detect_(&timers_.section("detect")),
      section_contact_(&timers_.section("contact")),
      section_bonds_(&timers_.section("bonds")) {
  require(options.long_step >= 1, "a long step has at least one sub-step");
  set_time_step(options.time_step);
  if (options.wire_contacts == WireContacts::capsules)
    wires_.emplace(materials_, options.contact_law, options.neighbours);
  if (!contact_forces_.rolls()) return;
  contacts_.remember_rolling();
  slow_contacts_.remember_rolling();
}

void Solids::set_time_step(double time_step) {
  require(time_step > 0, "the time step must be positive");
  if (time_step > options_.time_step)  // what is drawn out may be too stiff for it
    std::fill(checked_elongation_.begin(), checked_elongation_.end(), 0.0);
  options_.time_step = time_step;
}

void Solids::advance(int substeps, std::span<LiquidDrag> drags) {
  if (!prepared_ || particles_.size() != known_particles_ || bonds_.size() != known_bonds_) prepare();
  take_external_forces();
  const double dt = options_.time_step;
  if (!drags.empty()) begin_drags(drags);
  if (two_rates())
    for (int n = 0; n < substeps; n += options_.long_step)
      long_step(std::min(options_.long_step, substeps - n), drags, n + options_.long_step >= substeps);
  else
    for (int n = 0; n < substeps; ++n) substep(n == 0, n + 1 == substeps, drags, n + 1 == substeps ? 0.5 * dt : dt);
  if (!drags.empty()) end_drags(drags, substeps * dt);
}

/// For the half kick that comes first.
void Solids::begin_drags(std::span<LiquidDrag> drags) {
  dem::begin_drags(drags, particles_);
  external_work_ += add_drags(drags, particles_, 0.5 * options_.time_step);
  hold_more_on_rails();
}

void Solids::end_drags(std::span<LiquidDrag> drags, double time) {
  note_mean_drags(drags, particles_, time);
  applied_force_ = particles_.external_force, applied_torque_ = particles_.external_torque;
  hold_more_on_rails();
}

/// The half kick at the end of a sub-step and the one at the start of the next are done in one. `drag_kick`: s, over
/// which the drags of its end act.
void Solids::substep(bool first, bool last, std::span<LiquidDrag> drags, double drag_kick) {
  const double dt = options_.time_step;
  {
    const ScopedTimer timer(*section_integrate_);
    kick_and_drift(particles_, first ? 0.5 * dt : dt, dt);
    if (external_acts_) external_work_ += external_work(particles_, dt);
    if (two_rates()) add_to_mean(first);
  }
  detect();
  evaluate_forces(dt, drags, drag_kick);
  add_wall_impulses(contact_forces_, contacts_, dt);
  if (last) {
    const ScopedTimer timer(*section_integrate_);
    kick(particles_, 0.5 * dt);
  }
  ++step_count_;
  time_ += dt;
  if (step_count_ % options_.watchdog.interval == 0) watch();
}

void Solids::detect() {
  const ScopedTimer timer(*section_detect_);
  const bool bonds_broke = note_broken_bonds();
  if (wires_) detect_wires(bonds_broke);
  if (!contacts_.outdated(particles_) && (!bonds_broke || wires_)) return;
  check_motion(particles_, options_.watchdog, step_count_);  // lists need finite positions
  if ((!bonds_broke || wires_) && contacts_.neighbours_hold(particles_))
    return contact_forces_.book_lost(contacts_.refresh(particles_, share(Rate::fast)));
  bonded_.assign(particles_.size(), bonds_.i, bonds_.j, bonds_.intact);
  contact_forces_.book_lost(contacts_.rebuild(particles_, walls_, bonded_, share(Rate::fast)));
}

/// Beads whose bond broke in the last step touch from now on: the lists must be built anew. Where they press on each
/// other, the contact takes over a part of what the bond held, which is not lost. (The contact begins between the last
/// step and this one, so its overlap half-way counts.)
bool Solids::note_broken_bonds() {
  if (bonds_.breakage_loss == known_breakage_) return false;
  for (std::size_t b = 0; b < bonds_.size(); ++b) {
    if (bonds_.intact[b] == known_intact_[b]) continue;
    known_intact_[b] = bonds_.intact[b];
    if (wires_) continue;  // see detect_wires
    const ParticleIndex i = bonds_.i[b], j = bonds_.j[b];
    const Vec3 arm = particles_.position[j] - particles_.position[i] -
                     0.5 * options_.time_step * (particles_.velocity[j] - particles_.velocity[i]);
    bonds_.breakage_loss -= normal_energy(i, j, particles_.radius[i] + particles_.radius[j] - arm.norm(), particles_,
                                          materials_, options_.contact_law);
  }
  known_breakage_ = bonds_.breakage_loss;
  return true;
}

/// Where a bond broke, a wire became two, or its bead a plain one: what its contacts hold changes at once. The
/// difference comes from what the bond held.
void Solids::detect_wires(bool bonds_broke) {
  if (!bonds_broke) {
    if (!wires_->outdated(particles_)) return;
    check_motion(particles_, options_.watchdog, step_count_);
    return wires_->relist(particles_);
  }
  check_motion(particles_, options_.watchdog, step_count_);
  // It happens between the last step and this one: energies are those half-way.
  const Vec3Field now = particles_.position;
  for (std::size_t i = 0; i < particles_.size(); ++i)
    particles_.position.add(i, -0.5 * options_.time_step * particles_.velocity[i]);
  const double before = wires_->normal_energy(particles_);
  const Vec3Field half_way = std::exchange(particles_.position, now);
  const std::vector<std::uint8_t> covered = wires_->chains().covered();
  wires_->rebuild(particles_, bonds_);
  bonded_.assign(particles_.size(), bonds_.i, bonds_.j, bonds_.intact);
  contact_forces_.book_lost(contacts_.rebuild(particles_, walls_, bonded_, share(Rate::fast)));
  particles_.position = half_way;
  double after = wires_->normal_energy(particles_);
  const ContactSlots& pairs = contacts_.pairs();
  for_each_slot_by_id(pairs, particles_.numbering, [&](std::uint32_t k) {
    const ParticleIndex i = pairs.owner[k], j = pairs.partner[k];
    if (covered[i] == 0 && covered[j] == 0) return;
    const double distance = (particles_.position[j] - particles_.position[i]).norm();
    after += normal_energy(i, j, particles_.radius[i] + particles_.radius[j] - distance, particles_, materials_,
                           options_.contact_law);
  });
  particles_.position = now;
  bonds_.breakage_loss += before - after;
  known_breakage_ = bonds_.breakage_loss;
}

namespace {

/// sum += f - less.
void add(Vec3Field& sum, const Vec3Field& f, const Vec3Field& less) {
  parallel_for_even_chunks(sum.size(), 4096, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      sum.x[i] += f.x[i] - less.x[i], sum.y[i] += f.y[i] - less.y[i], sum.z[i] += f.z[i] - less.z[i];
  });
}

/// sum += f.
void add(Vec3Field& sum, const Vec3Field& f) {
  parallel_for_even_chunks(sum.size(), 4096, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) sum.x[i] += f.x[i], sum.y[i] += f.y[i], sum.z[i] += f.z[i];
  });
}

}  // namespace

/// Bonds, then spheres, walls, gravity and external forces, then drags, which slow down what all others do. Velocities
/// are those of mid-step. Dampers of contacts predict the velocity at the end of the step from the forces of the step
/// before. Of bonds they get the new ones: with old ones a damper c on a bead m that a spring K holds would be stable
/// only while (K dt^2/m) (1 + c dt/m) < 4.
void Solids::evaluate_forces(double dt, std::span<LiquidDrag> drags, double drag_kick) {
  if (bonds_.size() > 0) {
    const ScopedTimer timer(*section_bonds_);
    std::swap(bond_force_, former_bond_force_), std::swap(bond_torque_, former_bond_torque_);
    for (Vec3Field* f : {&bond_force_, &bond_torque_}) f->resize(particles_.size()), f->fill(Vec3::Zero());
    std::swap(particles_.force, bond_force_), std::swap(particles_.torque, bond_torque_);
    bond_forces_.add_forces(bonds_, particles_, dt);
    std::swap(particles_.force, bond_force_), std::swap(particles_.torque, bond_torque_);
    add(particles_.force, bond_force_, former_bond_force_);
    add(particles_.torque, bond_torque_, former_bond_torque_);
    hold_on_rails();
  }
  {
    const ScopedTimer timer(*section_contact_);
    if (wires_) wires_->evaluate(particles_, contact_forces_.damping(), dt);
    contact_forces_.compute(particles_, contacts_, walls_, options_.gravity, dt, share(Rate::fast));
    if (wires_) wires_->add_forces(particles_, contact_forces_.damping());
  }
  if (bonds_.size() > 0) {
    const ScopedTimer timer(*section_bonds_);
    add(particles_.force, bond_force_), add(particles_.torque, bond_torque_);
  }
  if (!drags.empty()) external_work_ += add_drags(drags, particles_, drag_kick);
  hold_on_rails();
}

/// Without a force across its line a particle that began along it stays on it.
void Solids::hold_on_rails() {
  for (Rail& rail : particles_.rails) {
    const ParticleIndex i = particles_.index(rail.id);
    const Vec3 force = particles_.force[i], kept = force.dot(rail.along) * rail.along;
    rail.taken_up = force - kept;
    particles_.force.set(i, kept);
  }
}

/// At the start, and when particles or bonds were added: the first half kick needs forces.
void Solids::prepare() {
  build_all();
  evaluate_forces(0);
  if (two_rates()) evaluate_slow(0, nullptr);
}

void Solids::build_bonds() {
  bond_forces_.build(bonds_, particles_);
  yielding_bonds_.clear();
  for (std::size_t b = 0; b < bonds_.size(); ++b)
    if (std::isfinite(bonds_.sorts[static_cast<std::size_t>(bonds_.sort[b])].axial.force_limit[0]))
      yielding_bonds_.push_back(b);
  checked_elongation_.resize(yielding_bonds_.size(), 0.0);  // bonds are only ever added behind
}

void Solids::build_all() {
  build_bonds();
  check_motion(particles_, options_.watchdog, step_count_);
  bonded_.assign(particles_.size(), bonds_.i, bonds_.j, bonds_.intact);
  find_slow();
  if (wires_) wires_->rebuild(particles_, bonds_);
  contact_forces_.book_lost(contacts_.rebuild(particles_, walls_, bonded_, share(Rate::fast)));
  if (two_rates()) slow_forces_.book_lost(slow_contacts_.rebuild(particles_, walls_, bonded_, share(Rate::slow)));
  bond_force_.resize(particles_.size()), bond_torque_.resize(particles_.size());
  contact_forces_.damping().resize(particles_.size());
  applied_force_ = particles_.external_force;
  applied_torque_ = particles_.external_torque;
  known_particles_ = particles_.size();
  known_bonds_ = bonds_.size();
  known_intact_ = bonds_.intact;
  known_breakage_ = bonds_.breakage_loss;
  prepared_ = true;
}

namespace {

/// total += now - applied; applied = now. Returns whether anything acts.
bool exchange(std::vector<double>& total, std::vector<double>& slow_total, const std::vector<std::uint8_t>& slow,
              const std::vector<double>& now, std::vector<double>& applied) {
  double any = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    (!slow.empty() && slow[i] != 0 ? slow_total : total)[i] += now[i] - applied[i];
    applied[i] = now[i];
    any += std::abs(now[i]);
  }
  return any != 0;
}

bool exchange(Vec3Field& total, Vec3Field& slow_total, const std::vector<std::uint8_t>& slow, const Vec3Field& now,
              Vec3Field& applied) {
  const bool x = exchange(total.x, slow_total.x, slow, now.x, applied.x);
  const bool y = exchange(total.y, slow_total.y, slow, now.y, applied.y);
  return exchange(total.z, slow_total.z, slow, now.z, applied.z) || x || y;
}

}  // namespace

/// The first half kick of a fluid step must already use the new external forces, or half a sub-step of momentum would
/// be exchanged with the wrong ones.
void Solids::take_external_forces() {
  Particles& p = particles_;
  const bool forces = exchange(p.force, slow_force_, slow_, p.external_force, applied_force_);
  external_acts_ = exchange(p.torque, slow_torque_, slow_, p.external_torque, applied_torque_) || forces;
  hold_more_on_rails();
}

/// Forces that are there already were freed of what rails take up: what comes now is more.
void Solids::hold_more_on_rails() {
  std::vector<Rail>& rails = particles_.rails;
  std::vector<Vec3> taken_up;
  for (const Rail& rail : rails) taken_up.push_back(rail.taken_up);
  hold_on_rails();
  for (std::size_t k = 0; k < rails.size(); ++k) rails[k].taken_up += taken_up[k];
}

void Solids::remove(ParticleIndex i) {
  if (particles_.state[i] == ParticleState::removed) return;
  const double springs = normal_energy_of(i, particles_, materials_, walls_, contacts_, options_.contact_law) +
                         normal_energy_of(i, particles_, materials_, walls_, slow_contacts_, options_.contact_law);
  const double wire_springs = wires_ && prepared_ ? wires_->normal_energy_of(i, particles_) : 0.0;
  if (wires_) wires_->release(wire_springs);
  removed_energy_ += motion_energy(particles_, i, options_.gravity) + springs + wire_springs;
  particles_.remove(i);
}

bool Solids::open_walls_by(double time) {
  const auto& all = walls_.all();
  if (std::none_of(all.begin(), all.end(), [&](const Wall& w) { return !w.open && w.opens_at <= time; })) return false;
  const double held = prepared_ ? ledger().elastic_normal : 0.0;
  walls_.open_by(time);
  if (!prepared_) return true;
  const auto list_again = [&](ContactDetection& contacts, ContactForces& forces, Rate rate) {
    const ContactSlots before = contacts.wall_contacts();
    forces.book_lost(contacts.rebuild(particles_, walls_, bonded_, share(rate)));
    forces.keep_answers(before, contacts.wall_contacts());
  };
  list_again(contacts_, contact_forces_, Rate::fast);
  if (two_rates()) list_again(slow_contacts_, slow_forces_, Rate::slow);
  removed_energy_ += held - ledger().elastic_normal;
  return true;
}

void Solids::renumber(const Renumbering& change) {
  require(change.size() == particles_.size(), "an order of other particles");
  particles_.renumber(change);
  bonds_.find_ends(particles_);
  if (!prepared_) return;
  bond_forces_.find_ends(bonds_);
  bonded_.assign(particles_.size(), bonds_.i, bonds_.j, bonds_.intact);  // what broke is between beads: no slow pair
  if (wires_) wires_->renumber(change);
  contact_forces_.renumber(change, contacts_.renumber(particles_, change));
  slow_forces_.renumber(change, slow_contacts_.renumber(particles_, change));
  change.move(slow_);
  for (ParticleIndex& i : slow_particles_) i = change.to(i);
  std::sort(slow_particles_.begin(), slow_particles_.end());
  for (Vec3Field* f : {&slow_force_, &slow_torque_, &mean_.velocity, &mean_.spin, &applied_force_, &applied_torque_,
                       &bond_force_, &bond_torque_})
    change.move(*f);
}

void Solids::watch() {
  check_motion(particles_, options_.watchdog, step_count_);
  check_overlap(particles_, worst_overlap(), options_.watchdog, step_count_);
  bool drawn_out = false;
  for (std::size_t k = 0; k < yielding_bonds_.size(); ++k)
    drawn_out = drawn_out || (bonds_.intact[yielding_bonds_[k]] != 0 &&
                              bonds_.elongation[yielding_bonds_[k]] > 1.05 * checked_elongation_[k]);
  if (!drawn_out) return;
  for (std::size_t k = 0; k < yielding_bonds_.size(); ++k)
    checked_elongation_[k] = std::max(checked_elongation_[k], bonds_.elongation[yielding_bonds_[k]]);
  check_bonds(bonds_, particles_, options_.time_step, step_count_);
}

EnergyLedger Solids::ledger() const {
  EnergyLedger ledger = motion_energy(particles_, options_.gravity);
  ContactEnergy c = contact_forces_.energy();
  c += slow_forces_.energy();
  if (wires_) c += wires_->energy();
  const auto add_now = [&](const ContactDetection& contacts, double dt) {
    const EnergyNow now = energy_now(particles_, materials_, walls_, contacts, options_.contact_law, dt);
    c.elastic_normal += now.normal, c.elastic_tangential += now.tangential;
    ledger.contact_damping += now.damped_ahead;
  };
  add_now(contacts_, options_.time_step);
  add_now(slow_contacts_, slow_step_);
  ledger.elastic_normal = c.elastic_normal;
  ledger.elastic_tangential = c.elastic_tangential;
  ledger.elastic_rolling = c.elastic_rolling;
  // What acts in a kick is booked for all of it, and half of the last one is still to come.
  ledger.contact_damping += c.damping - 0.5 * c.damping_of_step + c.damped_ahead;
  ledger.friction = c.friction;
  ledger.rolling = c.rolling;
  ledger.bonds = bond_energy();
  ledger.removed = removed_energy_;
  ledger.external_work = external_work_ + c.wall_work - 0.5 * c.wall_work_of_step;
  return ledger;
}

}  // namespace lahar::dem
