#pragma once
// What one parallel bond does in one step: a pure function (Potyondy & Cundall 2004, Eqs. 13-17). Which bonds, and
// where their numbers lie, is the business of bond_forces.cpp.
//
// The axial force follows from the present length. Shear force and moments are integrated, and carried along with the
// bond as it turns. A total form with particle orientations was considered and not taken: with the low shear stiffness
// that ring nets use (k_s / k_n below 1e-3) neighbouring beads twist and shear through angles near pi, where every
// finite rotation measure folds over; the integrated form has no such limit, needs no orientations, and its energy
// balance is exact up to the time step because carrying a vector along does not change its length. The scheme is second
// order in time, and a rigid rotation of any axis and size leaves forces as they were.
#include <algorithm>

#include "core/triple.h"

namespace lahar::dem {

/// How a bond's ends moved against each other during a step.
struct BondMotion {
  Triple direction;     // unit, new
  Triple shear, bend;   // m and rad, seen from i
  double twist;         // rad, of j against i
  Triple turn;          // old direction x new direction
  double cosine, spin;  // of the angle of the turn; rad about the bond, mean of both ends
};

/// v turned by the rotation vector t (Rodrigues), to sixth order in the angle of a step.
inline Triple rotated(const Triple& v, const Triple& t) {
  const double q = dot(t, t);
  const Triple first = cross(t, v);
  return v + (1.0 - q * (1.0 / 6 - q / 120)) * first + (0.5 - q * (1.0 / 24 - q / 720)) * cross(t, first);
}

/// arm is x_j - x_i, length its length; mean_turn and relative_turn (of j against i) are of the ends' rotations during
/// the step, angular velocity x time step.
inline BondMotion bond_motion(const Triple& arm, double length, const Triple& mean_turn, const Triple& relative_turn,
                              const Triple& old_direction, double old_length) {
  BondMotion m;
  m.direction = (1.0 / length) * arm;
  m.turn = cross(old_direction, m.direction);
  m.cosine = dot(old_direction, m.direction);
  const Triple middle = 0.5 * (old_direction + m.direction);
  m.spin = dot(mean_turn, middle);
  // Sideways motion beyond what the ends' own rotation would give the bond: none at all in a rigid rotation.
  m.shear = 0.5 * (old_length + length) * normal_part(m.direction - rotated(old_direction, mean_turn), m.direction);
  m.twist = dot(relative_turn, middle);
  m.bend = relative_turn - m.twist * middle;
  return m;
}

/// Carries a vector that was normal to the old direction along with the bond: the smallest rotation from the old to the
/// new direction, then the bond's spin about itself. Keeps the length. (The floor keeps broken bonds, whose ends may
/// swing round each other at once, from producing infinities.)
inline Triple carried(const Triple& v, const BondMotion& m) {
  const Triple turned = m.cosine * v + cross(m.turn, v) + (dot(m.turn, v) / std::max(1.0 + m.cosine, 1e-6)) * m.turn;
  const double half = 0.5 * m.spin;
  const double scale = 1.0 / (1.0 + half * half);
  return ((1.0 - half * half) * scale) * turned + (2.0 * half * scale) * cross(m.direction, turned);
}

/// New shear force: the shear of the step is seen from the end of the step.
inline Triple grown_shear(const Triple& force, double stiffness, const BondMotion& m) {
  return normal_part(carried(force, m) + stiffness * m.shear, m.direction);
}

/// New bending moment: the bend is seen from the middle of the step, so half of it is carried along.
inline Triple grown_bending(const Triple& moment, double stiffness, const BondMotion& m) {
  const Triple half = (0.5 * stiffness) * m.bend;
  return normal_part(carried(moment + half, m) + half, m.direction);
}

}  // namespace lahar::dem
