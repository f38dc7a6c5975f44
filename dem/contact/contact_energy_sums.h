#pragma once
// Energies of contacts: what they hold now and what they have lost.
#include "core/archive.h"

namespace lahar::dem {

/// Energies of contacts, J. Stored parts are those of now, the others sums since the start.
struct ContactEnergy {
  double elastic_normal = 0, elastic_tangential = 0, elastic_rolling = 0;
  double damping = 0;                                 ///< dissipated by dampers
  double friction = 0;                                ///< dissipated by slip
  double rolling = 0;                                 ///< dissipated by rolling on against its resistance
  double wall_work = 0;                               ///< done on particles by walls that move
  double damping_of_step = 0, wall_work_of_step = 0;  ///< shares of the last evaluation in `damping` and `wall_work`
  double damped_ahead = 0;  ///< of smooth wires in the last evaluation; of spheres see EnergyNow

  ContactEnergy& operator+=(const ContactEnergy& o) {
    elastic_normal += o.elastic_normal, elastic_tangential += o.elastic_tangential,
        elastic_rolling += o.elastic_rolling;
    damping += o.damping, friction += o.friction, rolling += o.rolling, wall_work += o.wall_work;
    damping_of_step += o.damping_of_step, wall_work_of_step += o.wall_work_of_step;
    damped_ahead += o.damped_ahead;
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
    archive.value("damped_ahead", damped_ahead);
  }
};

/// What one step changes in it, of one chunk of particles, J.
struct ContactTally {
  double elastic_rolling = 0, damping = 0, friction = 0, rolling = 0, wall_work = 0;

  ContactTally& operator+=(const ContactTally& o) {
    elastic_rolling += o.elastic_rolling, damping += o.damping, friction += o.friction;
    rolling += o.rolling, wall_work += o.wall_work;
    return *this;
  }
};

}  // namespace lahar::dem
