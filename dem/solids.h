#pragma once
// The ordered particle step: grains, rings and cables together.
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "core/geometry.h"
#include "core/timers.h"
#include "dem/bonds/bond_forces.h"
#include "dem/bonds/bonds.h"
#include "dem/contact/contact_detection.h"
#include "dem/contact/contact_forces.h"
#include "dem/contact/worst_overlap.h"
#include "dem/energy.h"
#include "dem/liquid_drag.h"
#include "dem/material.h"
#include "dem/particles.h"
#include "dem/rates.h"
#include "dem/watchdog.h"
#include "dem/wires/wire_forces.h"

namespace lahar::dem {

struct SolidsOptions {
  Vec3 gravity{0, 0, -9.81};  ///< m/s^2
  double time_step = 0;       ///< s, of one sub-step, > 0
  /// Sub-steps in a long step, in which grains act on each other and on walls; all that beads do takes a sub-step. 1:
  /// one rate for all. See docs/decisions/0024.
  int long_step = 1;
  ContactLawChoice contact_law = HertzMindlin{};
  WireContacts wire_contacts = WireContacts::beads;
  NeighbourOptions neighbours;
  WatchdogOptions watchdog;
};

/// What particles gave a wall over some time: N s, and its moment about the origin of the coordinates, N m s.
struct WallImpulse {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
};

/// All solids of a scene. Results do not depend on the number of threads, on where particles stand in their arrays nor,
/// but for smooth wires, whose runs are made with the lists, on when neighbour lists are rebuilt.
class Solids {
 public:
  /// Throws std::logic_error if the time step is not positive.
  Solids(Particles particles, Bonds bonds, Materials materials, Walls walls, const SolidsOptions& options);
  Solids(Solids&&) = default;
  Solids(const Solids&) = delete;  // timers point into the object
  Solids& operator=(const Solids&) = delete;
  Solids& operator=(Solids&&) = delete;

  /// One sub-step of options.time_step.
  void step() { advance(1); }
  /// `substeps` sub-steps under the same external forces: each gives a particle exactly force x time of momentum. The
  /// last long step is shorter where they do not fill it. `drags` act besides, at most one on a particle; afterwards
  /// forces and external forces contain their mean.
  /// Throws NumericalFailure when the watchdog finds something wrong.
  void advance(int substeps, std::span<LiquidDrag> drags = {});

  /// Takes a particle out of the scene; its kinetic and potential energy and what the normal springs of its contacts
  /// hold go to EnergyLedger::removed, what their tangential springs hold to friction. Not for beads with intact bonds.
  void remove(ParticleIndex i);

  /// Moves the particles to other places in their arrays; spatial_order.h has orders that keep neighbours together.
  /// To be called between steps. Every number of a particle, of a contact or of a sum stays the same to the bit;
  /// indices that others keep must be found again from ids.
  void renumber(const Renumbering& change);

  /// Takes away the walls that open by `time` (s), between steps; says whether there were some. What the springs of
  /// contacts with them hold goes the way it does in `remove`.
  bool open_walls_by(double time);

  /// Sub-steps from now on have another length, s.
  void set_time_step(double time_step);

  /// Particles and bonds may be added between steps; positions may be moved by less than half a skin at a time.
  [[nodiscard]] Particles& particles() { return particles_; }
  [[nodiscard]] const Particles& particles() const { return particles_; }
  [[nodiscard]] Bonds& bonds() { return bonds_; }
  [[nodiscard]] const Bonds& bonds() const { return bonds_; }
  [[nodiscard]] const Materials& materials() const { return materials_; }
  [[nodiscard]] const Walls& walls() const { return walls_; }
  [[nodiscard]] const SolidsOptions& options() const { return options_; }
  [[nodiscard]] double time() const { return time_; }  ///< s
  [[nodiscard]] std::int64_t step_count() const { return step_count_; }
  [[nodiscard]] EnergyLedger ledger() const;
  [[nodiscard]] BondEnergy bond_energy() const { return bond_forces_.energy(bonds_); }
  [[nodiscard]] const ContactDetection& contacts() const { return contacts_; }  ///< all, or those of a sub-step
  [[nodiscard]] const ContactDetection& slow_contacts() const { return slow_contacts_; }
  /// Contacts of smooth wires; none with WireContacts::beads.
  [[nodiscard]] const std::optional<WireForces>& wires() const { return wires_; }
  [[nodiscard]] WorstOverlap worst_overlap() const;
  /// Force of all particles on a wall at the end of the last step, N.
  [[nodiscard]] Vec3 force_on_wall(std::uint32_t wall) const;
  /// Its moment about the origin of the coordinates, N m.
  [[nodiscard]] Vec3 moment_on_wall(std::uint32_t wall) const;
  /// From now on sums up what these walls get in each sub-step: a blow may be shorter than a step of the fluid.
  void measure_walls(const std::vector<std::uint32_t>& walls);
  /// What a wall that is measured got since this was last asked for; zero of others.
  WallImpulse take_impulse_on(std::uint32_t wall);
  [[nodiscard]] const Timers& timers() const { return timers_; }

  [[nodiscard]] Timers& timers() { return timers_; }

  /// State of a checkpoint, by id (solids_transfer.cpp). Loading needs solids of the same scene: materials, walls, bond
  /// sorts and options are theirs. Throws NumericalFailure instead of saving what is not finite.
  void transfer(Archive& archive);

 private:
  [[nodiscard]] bool two_rates() const { return !slow_.empty(); }
  [[nodiscard]] RateShare share(Rate rate) const {
    return {two_rates() ? rate : Rate::all, slow_.data(), wires_ ? wires_->chains().covered().data() : nullptr};
  }
  void transfer_by_id(Archive& archive);
  void find_slow();
  void long_step(int substeps, std::span<LiquidDrag> drags, bool final);
  void kick_slow(double dt);
  void add_to_mean(bool first);
  void detect_slow();
  void evaluate_slow(double dt, const MeanMotion* mean);
  void substep(bool first, bool last, std::span<LiquidDrag> drags, double drag_kick);
  void detect();
  void detect_wires(bool bonds_broke);
  void evaluate_forces(double dt, std::span<LiquidDrag> drags = {}, double drag_kick = 0);
  void prepare();
  void build_all();
  void build_bonds();
  void take_external_forces();
  void begin_drags(std::span<LiquidDrag> drags);
  void end_drags(std::span<LiquidDrag> drags, double time);
  void hold_on_rails();
  void hold_more_on_rails();
  [[nodiscard]] bool note_broken_bonds();
  void watch();
  void add_wall_impulses(const ContactForces& forces, const ContactDetection& contacts, double dt);

  Particles particles_;
  Bonds bonds_;
  Materials materials_;
  Walls walls_;
  SolidsOptions options_;
  ContactDetection contacts_;
  ContactForces contact_forces_;
  BondForces bond_forces_;
  std::optional<WireForces> wires_;
  PairSet bonded_;
  // Of two rates. particles.force then holds what acts in sub-steps, and for slow particles slow_force_ the rest.
  std::vector<std::uint8_t> slow_;  // per particle; empty with one rate
  std::vector<ParticleIndex> slow_particles_;
  ContactDetection slow_contacts_;
  ContactForces slow_forces_;
  Vec3Field slow_force_, slow_torque_;
  MeanMotion mean_;
  double slow_step_ = 0;                              // s, length of the last long step
  Vec3Field applied_force_, applied_torque_;          // external ones contained in the forces and torques
  Vec3Field bond_force_, bond_torque_;                // those of bonds contained in them
  Vec3Field former_bond_force_, former_bond_torque_;  // during evaluate_forces
  std::size_t known_particles_ = 0, known_bonds_ = 0;
  std::vector<std::uint8_t> known_intact_;  // bonds that were whole when the lists were built
  double known_breakage_ = 0;
  std::vector<std::size_t> yielding_bonds_;             // that may be drawn out far, and so bind the time step
  std::vector<double> checked_elongation_;              // m, of each when the time step was last held against them
  std::map<std::uint32_t, WallImpulse> wall_impulses_;  // of those that are measured, since they were asked for
  bool prepared_ = false, external_acts_ = false;
  double time_ = 0, external_work_ = 0, removed_energy_ = 0;
  std::int64_t step_count_ = 0;
  Timers timers_;
  Timers::Section* section_integrate_;
  Timers::Section* section_detect_;
  Timers::Section* section_contact_;
  Timers::Section* section_bonds_;
};

}  // namespace lahar::dem
