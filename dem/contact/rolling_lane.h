#pragma once
// Rolling resistance of one of the contacts side by side, after the law, whose normal force and stiffness it needs.
#include "dem/contact/contact_energy_sums.h"
#include "dem/contact/contact_lanes.h"
#include "dem/contact/rolling.h"

namespace lahar::dem {

/// 1 / (I + m R^2) of a sphere, I = 2/5 m R^2, 1/(kg m^2). Of beads with more inertia it is too much: their dashpot is
/// the weaker.
inline double inverse_rolling_inertia(double inverse_mass, double radius) {
  return inverse_mass / (1.4 * radius * radius);
}

/// The torque on i, N m. `history`: after the law; `stiffness_before` is that of the tangential spring in the step
/// before, `damper` the normal damper (N s/m). `state` brings the spins, the inertia and the coefficient. Advances
/// `angle` (rad) and books what rolling holds and loses.
[[nodiscard]] Triple roll_lane(const ContactLanes& contacts, const ContactHistoryOf<Lanes>& history, std::size_t lane,
                               RollingState state, double stiffness_before, double damper, double dt, Triple& angle,
                               ContactTally& tally);

}  // namespace lahar::dem
