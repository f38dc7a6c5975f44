#pragma once
// The loop over contacts of wires as smooth curves: of wires with grains and of wires with each other.
#include <cstdint>
#include <vector>

#include "dem/contact/contact_forces.h"
#include "dem/contact/worst_overlap.h"
#include "dem/wires/shared_patches.h"
#include "dem/wires/wire_chains.h"
#include "dem/wires/wire_contact.h"
#include "dem/wires/wire_detection.h"
#include "dem/wires/wire_model.h"

namespace lahar::dem {

/// Contacts of all wires. Their beads' contacts with walls are not among them, nor is anything between plain particles.
/// Wires do not resist rolling.
class WireForces {
 public:
  WireForces(const Materials& materials, ContactLawChoice law, NeighbourOptions options);

  /// Finds the wires anew, after bonds were added or broke, and lists their contacts.
  void rebuild(const Particles& particles, const Bonds& bonds);
  /// True if particles have moved so far that the contacts must be listed anew.
  [[nodiscard]] bool outdated(const Particles& particles) const { return detection_.outdated(particles); }
  /// Lists the contacts anew. Positions must be finite.
  void relist(const Particles& particles);

  /// The same contacts of renumbered particles.
  void renumber(const Renumbering& change);

  /// Forces of all contacts after a step of dt (s) that brought the particles to where they are. Velocities must be
  /// those of mid-step, `particles.force` still the sum of the step before, `damping` the sums of the particles' normal
  /// dampers then (N s/m; those of their other contacts count, too). Wires of one body touch without friction.
  void evaluate(const Particles& particles, const std::vector<double>& damping, double dt);
  /// Adds what was evaluated to forces and dampers, in the order of the contacts.
  void add_forces(Particles& particles, std::vector<double>& damping);

  [[nodiscard]] const WireChains& chains() const { return chains_; }
  [[nodiscard]] const std::vector<WireSlot>& slots() const { return detection_.slots(); }
  [[nodiscard]] const ContactEnergy& energy() const { return energy_; }
  [[nodiscard]] const WorstOverlap& worst_overlap() const { return worst_; }
  /// Contacts that touched in the last evaluation.
  [[nodiscard]] std::size_t touching() const;

  /// Energy that the normal springs hold where everything is now, J: of all contacts, or of those of one sphere.
  [[nodiscard]] double normal_energy(const Particles& particles) const;
  [[nodiscard]] double normal_energy_of(ParticleIndex sphere, const Particles& particles) const;
  /// A sphere leaves with this energy of its normal springs, J.
  void release(double normal_energy) { energy_.elastic_normal -= normal_energy; }

  /// State of a checkpoint (wire_transfer.cpp); the wires follow from the bonds.
  void transfer(Archive& archive, const Particles& particles, const Bonds& bonds);

 private:
  struct Pair {  // of materials
    double modulus, shear_modulus, friction, damping_ratio;
  };
  struct Answer {
    ParticleIndex particle;
    Triple force, torque;
    double damper;  // N s/m
  };
  struct Chunk {
    std::vector<WireTouch> found;
    std::vector<Answer> answers;
    ContactEnergy energy;
    WorstOverlap worst;
  };
  struct Scratch;

  bool find_contact(const WireSlot& slot, const Particles& particles, Scratch& scratch) const;
  [[nodiscard]] ContactState material_state(const WireSlot& slot, const Particles& particles) const;
  template <ContactLaw L>
  void evaluate_with(const L& law, const Particles& particles, const std::vector<double>& damping, double dt);
  void find_touching(const Particles& particles);
  template <ContactLaw L>
  void evaluate_touch(const L& law, const WireTouch& touch, const Particles& particles,
                      const std::vector<double>& damping, double dt, Chunk& chunk);
  void note_slots(const Particles& particles);
  void note_movement(const Vec3Field& position);
  [[nodiscard]] double energy_at_rest(const WireSlot& slot, const Particles& particles) const;

  ContactLawChoice law_;
  std::size_t material_count_;
  std::vector<Pair> pairs_;
  WireChains chains_;
  WireDetection detection_;
  // Most slots do not touch, and cannot until what they join has moved by as much as lies between them.
  Vec3Field position_before_;    // of the last evaluation
  std::vector<double> counts_;   // per particle: 1 where a slot depends on it
  double moved_ = 0;             // m, the farthest way of such a particle in each step, added up
  std::vector<double> idle_to_;  // per slot: it does not touch while moved_ is less
  std::vector<Chunk> chunks_;    // of kChunk slots each
  SharedPatches patches_;
  std::vector<WireTouch*> touching_;
  ContactEnergy energy_;
  WorstOverlap worst_;
};

}  // namespace lahar::dem
