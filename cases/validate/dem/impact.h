#pragma once
// One impact, head-on or oblique, of a sphere on its like or on a rigid plate, with the time step that a scene would
// take by default.
#include "cases/validate/entry.h"
#include "dem/solids.h"

namespace lahar::validate {

struct ImpactSpec {
  double radius = 0;          ///< m
  double density = 0;         ///< kg/m^3
  double youngs_modulus = 0;  ///< Pa
  double poisson_ratio = 0;
  double speed = 0;   ///< m/s, of each sphere
  bool pair = false;  ///< two equal spheres against each other instead of one against a rigid plate
  double angle = 0;   ///< rad, from the normal
  double friction = 0, restitution = 1;
  double step_share = 1;  ///< of the default time step
  dem::ContactLawChoice law = dem::HertzMindlin{};
};

/// The sphere of tests 3 and 4 of Chung & Ooi 2011, without friction.
inline ImpactSpec aluminium_oxide() {
  return {.radius = 0.0025, .density = 4000, .youngs_modulus = 380e9, .poisson_ratio = 0.23, .speed = 3.9};
}

/// What came of it. Overlap and force are those at the ends of time steps.
struct Impact {
  double max_overlap = 0;       ///< m
  double max_force = 0;         ///< N, normal
  double duration = 0;          ///< s
  double restitution = 0;       ///< normal
  double tangential_ratio = 0;  ///< tangential speed of the centre, after over before
  double spin = 0;              ///< rad/s, after; negative for a sphere that begins to roll
  double rebound_angle = 0;     ///< rad, of the velocity of the point of contact, from the normal
  double ledger_error = 0;      ///< share of the exchanged energy, after the impact
  double ledger_worst = 0;      ///< the same, at any time
};

/// Runs until they have parted. Throws std::runtime_error if they do not.
Impact run_impact(const ImpactSpec& spec);

/// Rows for the ledger of some impacts, as shares of the exchanged energy. Velocity Verlet swings about the true energy
/// within an impact, by the square of the time step, and a damped impact keeps what it lost where it began between two
/// steps. The ladder's bar is asked with a third of a scene's default step; at the default step five times as much.
class ImpactLedger {
 public:
  void add(const ImpactSpec& spec, const Impact& impact);
  void rows(std::vector<Row>& rows) const;

 private:
  double after_ = 0, within_ = 0;
};

/// The share of the Rayleigh time that a scene takes by default, less what damping costs; s.
double default_time_step(const ImpactSpec& spec);

}  // namespace lahar::validate
