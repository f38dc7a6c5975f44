#include "dem/contact/rolling_lane.h"

#include <algorithm>

namespace lahar::dem {

Triple roll_lane(const ContactLanes& contacts, const ContactHistoryOf<Lanes>& history, std::size_t lane,
                 RollingState state, double stiffness_before, double damper, double dt, Triple& angle,
                 ContactTally& tally) {
  state.effective_radius = contacts.effective_radius[lane];
  state.last_shear_stiffness = stiffness_before;
  if (!contacts.touches[lane]) {
    tally.rolling += left_by_rolling(state, angle, dt);
    angle = Triple{};
    return Triple{};
  }
  const Lanes3 &n = contacts.normal, &spin = contacts.spin;
  state.normal_ij = {n.x[lane], n.y[lane], n.z[lane]};
  state.twist_rate = 0.5 * dot(Triple{spin.x[lane], spin.y[lane], spin.z[lane]}, state.normal_ij);
  state.normal_force = history.normal_force[lane];
  state.shear_stiffness = history.tangential_stiffness[lane];
  state.damping_ratio = contacts.damping_ratio[lane];
  if (const double alone = damper * contacts.inverse_mass[lane]; alone > 0)
    state.crowd = std::max(1.0, contacts.damping_rate[lane] / alone);
  const RollingTorque t = roll(state, angle, dt);
  tally.damping += t.damping_work;
  tally.elastic_rolling += t.elastic;
  tally.rolling += t.friction_work;
  return t.on_i;
}

}  // namespace lahar::dem
