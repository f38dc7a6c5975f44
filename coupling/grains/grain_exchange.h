#pragma once
// How grains and fluid exchange momentum: the interface between where the grains are (grain_map.h) and what the cells
// do.
//
// In a fluid step GrainCoupling calls, in this order:
//   shape_sphere   for every grain: how far its exchange reaches
//   prepare        once, when all grains are mapped
//   write_block    for the blocks whose grains changed: what the sweep is to know of them
//   give_impulses  once, when all fields are written: forces that are known before the step
//   (the fluid's step)
//   gather_block   for every block with grains: what its cells do to each
//   finish         for every grain: force and torque
// and look once before the first step.
// A new exchange is a class that overrides these, an entry in GrainExchangeChoice (coupling_options.h) and a line in
// make_grain_exchange. Dispatch is by block or by grain; the loops over cells lie within.
#include <memory>

#include "coupling/audit.h"
#include "coupling/coupling_options.h"
#include "coupling/grains/displaced_volume.h"
#include "coupling/grains/grain_map.h"
#include "coupling/solid_fields.h"

namespace lahar::coupling {

template <class Real>
class GrainExchange {
 public:
  GrainExchange() = default;
  GrainExchange(const GrainExchange&) = delete;
  GrainExchange& operator=(const GrainExchange&) = delete;
  virtual ~GrainExchange() = default;

  /// Sets surface and reach (at least covered_reach) of a sphere whose mapping radius is known; `radius`: the true one,
  /// cells. From many threads.
  virtual void shape_sphere(double radius, GridSphere<Real>& sphere) const = 0;

  /// After the grains are mapped: size what is kept by id, grain or pair. What lasts longer than a step must be kept by
  /// id: particles may be renumbered between steps.
  virtual void prepare(const lbm::Fluid<Real>& fluid, const dem::Particles& particles, const GrainMap<Real>& map) = 0;

  /// Whether a cell holds of its grains what it holds of a full cell's water, its fill level, so that grains at the
  /// surface end where the water ends (displaced_volume.h). Else a wet cell holds all of them.
  [[nodiscard]] virtual bool fills_with_level() const { return false; }

  /// Momentum of what the cells hold of grains that fill with the level, over the liquid's density: their wet volume
  /// times the velocity that the cells know of them, cells times m/s. Between steps.
  [[nodiscard]] virtual Vec3 flow_in_cells(const GrainMap<Real>& /*map*/, const DisplacedVolume<Real>& /*displaced*/,
                                           const dem::Particles& /*particles*/) const {
    return Vec3::Zero();
  }

  /// Writes the body fields of a block, which are empty. The solid fraction must be the sum of fraction_row of its
  /// grains (sphere_fraction.h), times water_in (rows.h) where grains fill with the level, whatever else is written:
  /// the ledger of the liquid rests on it. In parallel over blocks.
  virtual void write_block(lbm::Fluid<Real>& fluid, const GrainMap<Real>& map, std::size_t block) const = 0;

  /// Gets to know what liquid_velocity asks for, where give_impulses has not been: after grains are embedded.
  virtual void look(const lbm::Fluid<Real>& /*fluid*/, const GrainMap<Real>& /*map*/,
                    const DisplacedVolume<Real>& /*displaced*/, const dem::Particles& /*particles*/) {}

  /// Puts forces onto grains (external_force, SI) and the opposite impulses into cells (FluidGrid::require_impulse) of
  /// blocks that it reaches (SolidFields::reach).
  virtual ExchangedMomentum give_impulses(lbm::Fluid<Real>& /*fluid*/, const GrainMap<Real>& /*map*/,
                                          const DisplacedVolume<Real>& /*displaced*/, dem::Particles& /*particles*/,
                                          SolidFields<Real>& /*fields*/) {
    return {};
  }

  /// Velocity (lu) of the liquid between the grains at a place (cells from the corner of cell (0, 0, 0)), after
  /// look or give_impulses; `sampled`: of the cells there, which may be that of liquid and grains together.
  [[nodiscard]] virtual Vec3 liquid_velocity(const Vec3& /*place*/, const Vec3& sampled) const { return sampled; }

  /// m/s of a lattice unit when liquid_velocity last got to know the grains' velocities; 0 where it knows none. The
  /// fluid may have changed its step since.
  [[nodiscard]] virtual double velocity_unit() const { return 0; }
  /// Beads of wires in the liquid that feel the law of grains.
  [[nodiscard]] virtual std::size_t wet_beads() const { return 0; }

  /// Notes what the cells of a block, which may be gone, did to each of its grains. In parallel over blocks.
  virtual void gather_block(const lbm::Fluid<Real>& fluid, const GrainMap<Real>& map, std::size_t block) = 0;

  /// Adds force and torque (SI) to a grain, buoyancy included; `wet_volume`: of it in wet cells, cells. Returns the
  /// momentum that the cells' momentum_exchange gave it, lu, for the audit. In parallel over grains.
  virtual Vec3 finish(const lbm::Fluid<Real>& fluid, const GrainMap<Real>& map, std::size_t grain, double wet_volume,
                      dem::Particles& particles) = 0;

  /// State of a checkpoint.
  virtual void transfer(Archive& archive) = 0;
};

/// Null where grains and fluid do not feel each other.
template <class Real>
std::unique_ptr<GrainExchange<Real>> make_grain_exchange(const GrainExchangeChoice& choice,
                                                         const lbm::FluidOptions& fluid);

}  // namespace lahar::coupling
