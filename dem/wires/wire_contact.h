#pragma once
// One contact of a wire: from its patch to what the contact law sees, and from the law's answer to forces on beads.
//
// The equivalent overlap e is a function of the positions of all beads whose segments take part, and the elastic force
// F of the law acts on each of them as -F de/dx: the contact is as conservative as the law. At every place of the patch
// these forces lie on the line between both centre-lines and are shared out by the weights of the splines, so that
// neither momentum nor angular momentum changes.
//
// Friction and dampers act at one point, between the mean points of both centre-lines; each side's beads share their
// force by the mean weights W, and its moment about the centre-line goes to their spins by the same weights. The law
// sees the velocity of that point, from sum W v and sum W w, so that what it books is what the beads feel. The damper
// does not see de/dt: a patch that slides along a wire passes from segment to segment, each of which it enters and
// leaves, and nothing approaches.
#include <array>
#include <cstddef>

#include "dem/contact/contact_state.h"
#include "dem/particles.h"
#include "dem/wires/wire_patch.h"

namespace lahar::dem {

/// A particle's part in a contact.
struct WireShare {
  ParticleIndex particle = 0;
  double weight = 0;  ///< W, of its side they add up to 1
  Triple gradient{};  ///< de/dx
};

struct WireSide {
  std::size_t count = 0;
  std::array<WireShare, 48> shares;
  Triple lever{};  ///< m, from the mean point of its centre-line (or centre) to the contact point
};

struct WireContact {
  double overlap = 0;  ///< e, m
  double spread = 0;   ///< resultant normal force / F
  Triple normal{};     ///< unit, mean, from the wire to its partner, across the wire
  WireSide wire, partner;
};

/// The sphere on the other side, or none (index not used) where it is a run.
struct WireSphere {
  bool there = false;
  ParticleIndex particle = 0;
};

/// @param reach,radius  sum of the radii, radius of the segment, m
void describe(const WirePatch& patch, const SplineSegment& segment, const WirePartner& partner,
              const WireSphere& sphere, double reach, double radius, WireContact& contact);

/// R* for Hertz' law, m: sqrt(R' R'') with the principal radii of the gap: of two wires that cross at a right
/// angle, R' and R'' are their radii; of a sphere on a wire 1/R' = 1/a and 1/R'' = 1/a + 1/r.
double effective_radius_of_wires(double r, double other);
double effective_radius_on_sphere(double r, double sphere);

/// Velocities, masses and the spins' levers as the law wants them (all of ContactState but what materials bring).
/// Velocities are those of mid-step, forces those of the step before.
void set_motion(const WireContact& contact, const Particles& particles, double dt, ContactState& state);

}  // namespace lahar::dem
