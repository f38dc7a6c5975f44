#pragma once
// Particles as structure of arrays. Removal only deactivates, so ids and their number never change; where a particle
// stands in the arrays may (numbering.h).
#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/archive.h"
#include "core/check.h"
#include "core/sphere.h"
#include "core/triple.h"
#include "core/vector.h"
#include "dem/numbering.h"

namespace lahar::dem {

/// What a particle stands for: debris, or a piece of a ring or cable.
enum class ParticleKind : std::uint8_t { grain, bead };

enum class ParticleState : std::uint8_t {
  free,     ///< moves by its forces
  fixed,    ///< anchored: position and velocity are prescribed (zero velocity), reactions are recorded in `force`
  removed,  ///< left the scene: no forces, no contacts
};

/// A particle that moves along a line only, and turns freely: what presses it across is taken up.
struct Rail {
  ParticleId id;
  Vec3 along;                    ///< unit
  Vec3 taken_up = Vec3::Zero();  ///< N, force across the line in the last step
};

struct ParticleSpec {
  Vec3 position = Vec3::Zero();          ///< m
  Vec3 velocity = Vec3::Zero();          ///< m/s
  Vec3 angular_velocity = Vec3::Zero();  ///< rad/s
  double radius = 0;                     ///< m
  double density = 0;                    ///< kg/m^3
  double mass_scale = 1;                 ///< inertial over gravitational mass
  double inertia_scale = 1;              ///< moment of inertia over that of a sphere of that inertial mass, 2/5 m r^2
  int material = 0;
  ParticleKind kind = ParticleKind::grain;
  ParticleState state = ParticleState::free;
  std::int32_t body = -1;  ///< ring or cable that a bead belongs to, -1 for a grain (see barrier/net.h)
  std::optional<Vec3> rail = std::nullopt;  ///< unit: moves along this direction only
};

struct Particles {
  Vec3Field position, velocity, angular_velocity;  // m, m/s, rad/s
  Vec3Field force, torque;                         // N, N m: sum of contact, bond, gravity and external
  Vec3Field external_force, external_torque;       // N, N m: from the fluid, held over the sub-steps of a fluid step
  std::vector<double> radius, mass, inverse_mass, inertia;  // inertial mass; its inverse is 0 when fixed or removed
  std::vector<double> gravitational_mass;                   // kg, that weighs
  std::vector<std::int32_t> material, body;
  std::vector<ParticleKind> kind;
  std::vector<ParticleState> state;
  // By id, ascending; they follow from the scene and are in no checkpoint.
  std::vector<Rail> rails;
  std::vector<ParticleId> buried;  // in the ground: they touch no wall
  Numbering numbering;

  [[nodiscard]] std::size_t size() const { return radius.size(); }
  [[nodiscard]] ParticleId id(std::size_t index) const { return numbering.id(index); }
  [[nodiscard]] ParticleIndex index(std::size_t id) const { return numbering.index(id); }
  /// The rail of a particle, if it has one.
  [[nodiscard]] const Rail* rail_of(std::size_t i) const {
    if (rails.empty()) return nullptr;
    const auto at =
        std::lower_bound(rails.begin(), rails.end(), id(i), [](const Rail& r, ParticleId k) { return r.id < k; });
    return at != rails.end() && at->id == id(i) ? &*at : nullptr;
  }
  [[nodiscard]] bool is_buried(std::size_t i) const {
    return !buried.empty() && std::binary_search(buried.begin(), buried.end(), id(i));
  }
  /// Share of a force along `direction` (unit) that moves the particle along it, 0 to 1: less than 1 on a rail.
  [[nodiscard]] double free_share(std::size_t i, const Triple& direction) const {
    const Rail* rail = rail_of(i);
    if (rail == nullptr) return 1;
    const double along = direction.x * rail->along.x() + direction.y * rail->along.y() + direction.z * rail->along.z();
    return along * along;
  }
  /// 1/(kg m^2), 0 where the inverse mass is 0.
  [[nodiscard]] double inverse_inertia(std::size_t i) const { return inverse_mass[i] > 0 ? 1 / inertia[i] : 0.0; }

  /// State of a checkpoint, by id (solids_transfer.cpp); on loading there are as many particles as were stored.
  void transfer(Archive& archive);
  /// Moves the particles to other places. Lists of contacts and bonds refer to indices: see Solids::renumber.
  void renumber(const Renumbering& change);

  /// Returns the id, which is also the index at which the particle now stands.
  ParticleId add(const ParticleSpec& s) {
    const double weighs = sphere_volume(s.radius) * s.density;
    const double m = s.mass_scale * weighs;
    position.push_back(s.position);
    velocity.push_back(s.velocity);
    angular_velocity.push_back(s.angular_velocity);
    for (Vec3Field* f : {&force, &torque, &external_force, &external_torque}) f->push_back(Vec3::Zero());
    radius.push_back(s.radius);
    mass.push_back(m);
    gravitational_mass.push_back(weighs);
    inverse_mass.push_back(s.state == ParticleState::free ? 1.0 / m : 0.0);
    inertia.push_back(s.inertia_scale * 0.4 * m * s.radius * s.radius);
    material.push_back(s.material);
    body.push_back(s.body);
    kind.push_back(s.kind);
    state.push_back(s.state);
    numbering.add();
    const auto id = static_cast<ParticleId>(radius.size() - 1);
    if (s.rail) rails.push_back({id, *s.rail});
    return id;
  }

  /// It stands in the ground and touches no wall.
  void bury(ParticleId id) {
    require(buried.empty() || buried.back() < id, "particles are buried in the order of their ids");
    buried.push_back(id);
  }

  void remove(ParticleIndex i) {
    state[i] = ParticleState::removed;
    inverse_mass[i] = 0;
    for (Vec3Field* f : {&velocity, &angular_velocity, &force, &torque, &external_force, &external_torque})
      f->set(i, Vec3::Zero());
  }
};

}  // namespace lahar::dem
