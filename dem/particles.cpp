#include "dem/particles.h"

namespace lahar::dem {

void Particles::renumber(const Renumbering& change) {
  for (Vec3Field* f : {&position, &velocity, &angular_velocity, &force, &torque, &external_force, &external_torque})
    change.move(*f);
  for (std::vector<double>* v : {&radius, &mass, &inverse_mass, &inertia, &gravitational_mass}) change.move(*v);
  change.move(material), change.move(body), change.move(kind), change.move(state);
  numbering.apply(change);
}

}  // namespace lahar::dem
