#pragma once
// The loop over contacts: every touching pair once, then gathered per particle in a fixed order.
#include <cstdint>
#include <limits>
#include <variant>
#include <vector>

#include "core/geometry.h"
#include "dem/contact/contact_state.h"
#include "dem/contact/hertz_mindlin.h"
#include "dem/contact/linear.h"
#include "dem/contact_detection.h"
#include "dem/material.h"
#include "dem/particles.h"

namespace lahar::dem {

/// The contact laws that a scene can choose from.
using ContactLawChoice = std::variant<HertzMindlin, LinearSpringDashpot>;

/// Energies of all contacts, J. Stored parts are those of the last evaluation, the others sums since the start.
struct ContactEnergy {
  double elastic_normal = 0, elastic_tangential = 0;
  double damping = 0;                                 ///< dissipated by dampers
  double friction = 0;                                ///< dissipated by slip
  double wall_work = 0;                               ///< done on particles by walls that move
  double damping_of_step = 0, wall_work_of_step = 0;  ///< shares of the last evaluation in `damping` and `wall_work`

  void transfer(Archive& archive) {
    archive.value("elastic_normal", elastic_normal);
    archive.value("elastic_tangential", elastic_tangential);
    archive.value("damping", damping);
    archive.value("friction", friction);
    archive.value("wall_work", wall_work);
    archive.value("damping_of_step", damping_of_step);
    archive.value("wall_work_of_step", wall_work_of_step);
  }
};

/// The deepest contact of the last evaluation.
struct WorstOverlap {
  double ratio = 0;  ///< overlap over the smaller radius
  ParticleIndex particle = 0;
  std::uint32_t partner = 0;
  bool with_wall = false;
};

/// What contact evaluation reads of a particle, side by side.
struct ContactBody {
  Triple position{};
  double radius = 0;
  Triple velocity{};  ///< at mid-step
  double inverse_mass = 0;
  Triple spin{};                      ///< at mid-step
  Triple velocity_end{}, spin_end{};  ///< at the end of the step, predicted with the last known force
  std::int32_t material = 0, body = -1;
};

/// Force and torque on the partner of a pair.
struct Reaction {
  Triple force{}, torque{};
};

/// Contact forces between spheres and with walls.
class ContactForces {
 public:
  ContactForces(const Materials& materials, ContactLawChoice law);

  /// Sets `force` and `torque` of all particles to gravity (m/s^2) + external + contacts. On entry `force` must still
  /// hold the sum of the last step, velocities those of mid-step. History and dissipation advance by `dt` (s).
  /// Beads of the same body touch without friction.
  void compute(Particles& particles, ContactDetection& contacts, const Walls& walls, const Vec3& gravity, double dt);

  [[nodiscard]] const ContactEnergy& energy() const { return energy_; }
  [[nodiscard]] const WorstOverlap& worst_overlap() const { return worst_; }
  /// Force of all particles on one wall in the last evaluation, N.
  [[nodiscard]] Vec3 force_on_wall(const ContactDetection& contacts, std::uint32_t wall) const;
  /// Its moment about the origin of the coordinates, N m; each force acts where its sphere is nearest to the wall.
  [[nodiscard]] Vec3 moment_on_wall(const ContactDetection& contacts, const Walls& walls, std::uint32_t wall) const;
  /// A particle leaves with this energy of its normal springs, J.
  void take_out(double normal_energy) { energy_.elastic_normal -= normal_energy; }
  /// State of a checkpoint; the histories lie with the contacts.
  void transfer(Archive& archive) { energy_.transfer(archive); }

 private:
  struct PairMaterial {
    double modulus, shear_modulus, friction, damping_ratio;
  };
  struct Tally {  // of one chunk of particles
    ContactEnergy energy;
    WorstOverlap worst;
  };
  struct Batch;
  struct Work;

  void pack(const Particles& particles, double dt);
  template <ContactLaw L>
  void compute_with(const L& law, const Work& work);
  template <ContactLaw L>
  void chunk_pairs(const L& law, const Work& work, Batch& batch, std::size_t first, std::size_t last, Tally& tally);
  template <ContactLaw L>
  void chunk_walls(const L& law, const Work& work, Batch& batch, std::size_t first, std::size_t last, Tally& tally);
  void gather_pair(Batch& batch, std::size_t lane, const ContactSlots& slots) const;
  void gather_wall(Batch& batch, std::size_t lane, const Work& work, double distance) const;
  void set_material(Batch& batch, std::size_t lane, int a, int b) const;
  void scatter(const Batch& batch, const Work& work, bool with_wall, Tally& tally);
  void add_reactions(const Work& work);
  void sum_tallies();

  ContactLawChoice law_;
  std::size_t material_count_;
  std::vector<PairMaterial> materials_;
  std::vector<ContactBody> bodies_;
  std::vector<Reaction> reactions_;  // per pair slot
  std::vector<Triple> wall_forces_;  // per wall slot, on the particle
  std::vector<Tally> tallies_;
  ContactEnergy energy_;
  WorstOverlap worst_;
};

}  // namespace lahar::dem
