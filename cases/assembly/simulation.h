#pragma once
// The solvers of a scene put together, whatever the number format of the fluid.
#include <map>
#include <memory>
#include <string>

#include "barrier/net.h"
#include "cases/assembly/fluid_view.h"
#include "cases/scene/scene.h"
#include "coupling/audit.h"
#include "dem/solids.h"

namespace lahar::cases {

class Simulation {
 public:
  Simulation() = default;
  virtual ~Simulation() = default;
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// One step of the fluid with all particle steps in it.
  virtual void advance() = 0;
  [[nodiscard]] virtual double time() const = 0;       ///< s
  [[nodiscard]] virtual double time_step() const = 0;  ///< s, of the last step

  /// Parts that the scene lacks are null.
  [[nodiscard]] virtual FluidView* fluid() = 0;
  [[nodiscard]] virtual dem::Solids* solids() = 0;
  [[nodiscard]] virtual const barrier::Net* net() const = 0;
  [[nodiscard]] virtual const coupling::MomentumAudit& audit() const = 0;
  /// Of the liquid, kg m/s (coupling/coupled_step.h). The scene must have a fluid. A sum over all cells.
  [[nodiscard]] virtual Vec3 liquid_momentum() const = 0;
  /// Of the liquid between the grains at a wet cell, m/s.
  [[nodiscard]] virtual Vec3 liquid_velocity(const lbm::WetCell& cell) const = 0;
  /// Beads of rings and cables in the fluid.
  [[nodiscard]] virtual std::size_t wet_beads() const = 0;

  /// Wall time by section, s; sections of the solids are called "solids.NAME".
  [[nodiscard]] virtual std::map<std::string, double> seconds() = 0;
  /// State of a checkpoint; times of the sections are apart, they are not the same twice.
  virtual void transfer(Archive& archive) = 0;
  virtual void transfer_timers(Archive& archive) = 0;
};

/// Where the solvers begin: as the scene says, or empty, for a checkpoint that brings grains and liquid along.
enum class Beginning { scene, checkpoint };

/// Builds all that a scene describes. Throws InputError where grains do not fit or the net cannot be built.
std::unique_ptr<Simulation> build_simulation(const scene::Scene& scene, Beginning beginning = Beginning::scene);

}  // namespace lahar::cases
