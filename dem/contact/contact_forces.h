#pragma once
// All contact forces of a step: between spheres and with walls, with gravity and what acts from outside.
#include <cstdint>
#include <vector>

#include "core/geometry.h"
#include "dem/contact/contact_detection.h"
#include "dem/contact/contact_energy_sums.h"
#include "dem/contact/contact_materials.h"
#include "dem/contact/pair_contacts.h"
#include "dem/contact/wall_contacts.h"
#include "dem/material.h"
#include "dem/particles.h"

namespace lahar::dem {

/// Contact forces between spheres and with walls.
class ContactForces {
 public:
  ContactForces(const Materials& materials, ContactLawChoice law) : law_(law), materials_(materials) {}

  /// Sets `force` and `torque` of all particles to gravity (m/s^2) + external + contacts. On entry `force` must still
  /// hold the sum of the last step, velocities those of mid-step. History and dissipation advance by `dt` (s).
  /// Beads of the same body touch without friction.
  ///
  /// With a `share`, the contacts are those of its rate, and particles of the other rate get neither gravity nor
  /// external forces. `mean`: see ContactBodies::pack.
  void compute(Particles& particles, ContactDetection& contacts, const Walls& walls, const Vec3& gravity, double dt,
               const RateShare& share = {}, const MeanMotion* mean = nullptr);

  /// Whether some pair of materials resists rolling.
  [[nodiscard]] bool rolls() const { return materials_.rolls(); }
  /// What contacts lost and what rolling holds. What springs hold is worked out when asked for (contact_energy.h).
  [[nodiscard]] const ContactEnergy& energy() const { return energy_; }
  /// Springs of contacts that left the lists while they touched: what they held is lost, and held no longer.
  void book_lost(const ContactTally& held) {
    energy_.friction += held.friction, energy_.rolling += held.rolling;
    energy_.elastic_rolling -= held.rolling;
  }
  /// See WallContacts.
  [[nodiscard]] Vec3 force_on_wall(const Particles& particles, const ContactDetection& contacts,
                                   std::uint32_t wall) const {
    return walls_.force_on_wall(particles, contacts, wall);
  }
  [[nodiscard]] Vec3 moment_on_wall(const Particles& particles, const ContactDetection& contacts, const Walls& walls,
                                    std::uint32_t wall) const {
    return walls_.moment_on_wall(particles, contacts, walls, wall);
  }
  /// See WallContacts.
  void keep_answers(const ContactSlots& walls_before, const ContactSlots& walls_now) {
    walls_.keep_answers(walls_before, walls_now);
  }
  /// The particles were renumbered, and wall slot k was from[k].
  void renumber(const Renumbering& change, const std::vector<std::uint32_t>& from) {
    walls_.renumber(from);
    change.move(damping_);
    noted_refresh_ = -1;
  }
  /// Per particle: sum of the normal dampers of its contacts in the last step, N s/m. Others that act on the same
  /// particles add theirs.
  [[nodiscard]] std::vector<double>& damping() { return damping_; }
  /// State of a checkpoint; the histories lie with the contacts.
  void transfer(Archive& archive);

 private:
  void tally_by_id(const Particles& particles, const ContactDetection& contacts, double dt);
  void sum_tallies();

  ContactLawChoice law_;
  ContactMaterials materials_;
  PairContacts pairs_;
  WallContacts walls_;
  std::vector<double> damping_;  // per particle: sum of the normal dampers of its contacts in the last step, N s/m
  std::int64_t noted_refresh_ = -1;
  std::vector<ContactTally> tallies_;  // per chunk of particles that follow each other by id
  ContactEnergy energy_;
};

}  // namespace lahar::dem
