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
#include "dem/contact/rolling.h"
#include "dem/contact_bodies.h"
#include "dem/contact_detection.h"
#include "dem/material.h"
#include "dem/particles.h"

namespace lahar::dem {

/// The contact laws that a scene can choose from.
using ContactLawChoice = std::variant<HertzMindlin, LinearSpringDashpot>;

/// Energies of all contacts, J. Stored parts are those of the last evaluation, the others sums since the start.
struct ContactEnergy {
  double elastic_normal = 0, elastic_tangential = 0, elastic_rolling = 0;
  double damping = 0;                                 ///< dissipated by dampers
  double friction = 0;                                ///< dissipated by slip
  double rolling = 0;                                 ///< dissipated by rolling on against its resistance
  double wall_work = 0;                               ///< done on particles by walls that move
  double damping_of_step = 0, wall_work_of_step = 0;  ///< shares of the last evaluation in `damping` and `wall_work`

  ContactEnergy& operator+=(const ContactEnergy& o) {
    elastic_normal += o.elastic_normal, elastic_tangential += o.elastic_tangential,
        elastic_rolling += o.elastic_rolling;
    damping += o.damping, friction += o.friction, rolling += o.rolling, wall_work += o.wall_work;
    damping_of_step += o.damping_of_step, wall_work_of_step += o.wall_work_of_step;
    return *this;
  }
  void transfer(Archive& archive) {
    archive.value("elastic_normal", elastic_normal);
    archive.value("elastic_tangential", elastic_tangential);
    archive.value("elastic_rolling", elastic_rolling);
    archive.value("damping", damping);
    archive.value("friction", friction);
    archive.value("rolling", rolling);
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

/// Contact forces between spheres and with walls.
class ContactForces {
 public:
  ContactForces(const Materials& materials, ContactLawChoice law);

  /// Sets `force` and `torque` of all particles to gravity (m/s^2) + external + contacts. On entry `force` must still
  /// hold the sum of the last step, velocities those of mid-step. History and dissipation advance by `dt` (s).
  /// Beads of the same body touch without friction.
  ///
  /// With a `share`, the contacts are those of its rate, and particles of the other rate get neither gravity nor
  /// external forces. `mean`: see ContactBodies::pack.
  void compute(Particles& particles, ContactDetection& contacts, const Walls& walls, const Vec3& gravity, double dt,
               const RateShare& share = {}, const MeanMotion* mean = nullptr);

  /// Whether some pair of materials resists rolling.
  [[nodiscard]] bool rolls() const { return rolls_; }
  [[nodiscard]] const ContactEnergy& energy() const { return energy_; }
  [[nodiscard]] const WorstOverlap& worst_overlap() const { return worst_; }
  /// Force of all particles on one wall in the last evaluation, N.
  [[nodiscard]] Vec3 force_on_wall(const ContactDetection& contacts, std::uint32_t wall) const;
  /// Its moment about the origin of the coordinates, N m; each force acts where its sphere is nearest to the wall.
  [[nodiscard]] Vec3 moment_on_wall(const Particles& particles, const ContactDetection& contacts, const Walls& walls,
                                    std::uint32_t wall) const;
  /// A particle leaves with this energy of its normal springs, J.
  void take_out(double normal_energy) { energy_.elastic_normal -= normal_energy; }
  /// State of a checkpoint; the histories lie with the contacts.
  void transfer(Archive& archive);

 private:
  struct PairMaterials {
    std::vector<double> modulus, shear_modulus, friction, damping_ratio, rolling_friction;
    struct Tables {  // bare pointers to them
      const double *modulus, *shear_modulus, *friction, *damping_ratio;
      explicit Tables(const PairMaterials& m)
          : modulus(m.modulus.data()),
            shear_modulus(m.shear_modulus.data()),
            friction(m.friction.data()),
            damping_ratio(m.damping_ratio.data()) {}
    };
  };
  struct Tally {      // of one chunk of particles
    Line energies{};  // J: elastic normal, elastic tangential, damping, friction, elastic rolling, rolling
    double wall_work = 0;
    WorstOverlap worst;
  };
  struct Batch;
  struct Work;

  void note_slots(const Particles& particles, const ContactDetection& contacts);
  template <ContactLaw L>
  void compute_with(const L& law, const Work& work);
  template <ContactLaw L>
  void chunk_pairs(const L& law, const Work& work, Batch& batch, std::size_t first, std::size_t last, Tally& tally);
  template <ContactLaw L>
  void chunk_walls(const L& law, const Work& work, Batch& batch, std::size_t first, std::size_t last, Tally& tally);
  void gather_pairs(Batch& batch, const ContactSlots& slots, const ContactParties& parties) const;
  void gather_wall(Batch& batch, std::size_t lane, const Work& work, double distance) const;
  void set_material(Batch& batch, std::size_t lane, std::size_t material) const;
  void roll_pairs(Batch& batch, const Work& work, Tally& tally);
  void roll_walls(Batch& batch, const Work& work, Tally& tally);
  void roll_lane(Batch& batch, std::size_t lane, RollingState state, const ContactHistory& before, Triple& angle,
                 double dt, Tally& tally) const;
  void answer_pairs(const Batch& batch, const Work& work, Tally& tally);
  void answer_walls(const Batch& batch, const Work& work, Tally& tally);
  void set_body_forces(const Work& work, std::size_t first, std::size_t last) const;
  void add_pair_forces(const Work& work) const;
  void add_rolling_torques(const Work& work) const;
  void sum_tallies();

  ContactLawChoice law_;
  std::size_t material_count_;
  PairMaterials materials_;  // of all pairs of materials, then the same without friction
  ContactBodies bodies_;
  std::vector<std::uint16_t> slot_material_;  // per pair slot, index into materials_
  std::vector<float> slot_curvature_;         // 1/m, of the smaller sphere
  std::int64_t noted_refresh_ = -1;
  LineField pair_answers_;  // per pair slot: force on the owner, twist, half overlap
  bool rolls_ = false;
  std::vector<Triple> rolling_answers_;  // per pair slot: torque on the owner; empty unless rolls_
  struct WallAnswer {
    Triple force{}, torque{};  // on the particle
  };
  std::vector<WallAnswer> wall_answers_;  // per wall slot
  std::vector<Tally, AlignedAllocator<Tally>> tallies_;
  ContactEnergy energy_;
  WorstOverlap worst_;
};

}  // namespace lahar::dem
