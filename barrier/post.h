#pragma once
// Posts: straight beams of bonded beads that touch each other, from a foot to a head. The beads are what the flow
// meets; the bonds have the section of the steel profile.
#include <vector>

#include "barrier/wire.h"

namespace lahar::barrier {

/// The profile of a post. A chain of spheres knows no turn about its own axis, so the second moment is the same in all
/// directions: that of the direction in which the flow bends the post. The shear modulus is that of steel, E / 2.6.
struct PostSection {
  double youngs_modulus = 0;  ///< Pa
  double area = 0;            ///< m^2
  double second_moment = 0;   ///< m^4
  double density = 0;         ///< kg/m^3, of the profile
  double damping_ratio = 0;   ///< of the bonds
};

enum class FootJoint {
  fixed,   ///< clamped
  hinged,  ///< a ball joint: turns freely about all axes
};

struct PostSpec {
  Vec3 foot = Vec3::Zero(), head = Vec3::Zero();  ///< m, centres of the first and the last bead
  Vec3 across = Vec3::UnitY();                    ///< unit, at right angles to the post
  double diameter = 0;                            ///< m, of the beads
  PostSection section;
  FootJoint foot_joint = FootJoint::fixed;
  int material = 0;
  std::int32_t body = 0;
};

/// A post that was built. Its wire counts the beads from the foot to the head.
struct Post {
  Wire wire;
  double radius = 0;                          ///< m
  std::vector<dem::ParticleId> foot_beads{};  ///< fixed beads that hold the foot: the first, or those of the joint
  std::vector<std::size_t> joint{};           ///< bonds of a hinged foot

  [[nodiscard]] dem::ParticleId head() const { return wire.first_bead + wire.beads - 1; }
};

/// Bonds of beads `spacing` metres apart that have the section's E A, E I, G A and G 2 I. A parallel bond has a round
/// section; the radius 2 sqrt(I / A) gives it the ratio of the two, the stiffness per area E A / (spacing area) the
/// rest (Potyondy & Cundall 2004, Eqs. 14, 15).
[[nodiscard]] dem::BondSort post_bond(const PostSection& section, double spacing);

/// Distance of the bead centres: the length over the whole number of beads that fit without overlap, m.
[[nodiscard]] double post_spacing(double length, double diameter);

/// Mass of a bead: that of the profile over one spacing, kg.
[[nodiscard]] double post_bead_mass(const PostSection& section, double spacing);

/// Adds a post at rest. Its first bead stands in the ground and touches no wall. A clamped foot is a fixed bead. A
/// hinged one hangs in three links at right angles, half a radius long, to fixed beads inside it: they keep its place
/// and let it turn.
/// Throws InputError for a section without stiffness or mass,
/// and for a post shorter than five of its beads.
Post add_post(const PostSpec& spec, dem::Particles& particles, dem::Bonds& bonds);

/// What the ground does to the foot, N: the opposite of what acts on the fixed beads.
[[nodiscard]] Vec3 foot_reaction(const Post& post, const dem::Particles& particles);
/// The moment about the foot, Nm, that goes with it; of a hinged one about 0.
[[nodiscard]] Vec3 foot_moment(const Post& post, const dem::Particles& particles);

}  // namespace lahar::barrier
