#pragma once
// THE step: fluid, grains and barrier advance together by one fluid time step.
#include <functional>
#include <limits>
#include <optional>

#include "core/step_clock.h"
#include "coupling/audit.h"
#include "coupling/grains/body_map.h"
#include "coupling/wires/wire_drag.h"
#include "coupling/wires/wire_map.h"
#include "dem/solids.h"
#include "lbm/step/fluid.h"

namespace lahar::coupling {

struct CouplingOptions {
  bool immersed_grains = true;  ///< grains displace and stop the fluid
  double radius_shift = 0;      ///< cells, see BodyMap
  bool lubrication = false;     ///< films between close grains (lubrication.h)
  bool wire_drag = true;        ///< beads of rings and cables feel drag and give it back
  /// Cells a diameter from which on wires are mapped as bodies instead (wire_map.h).
  double resolve_wires_from = std::numeric_limits<double>::infinity();
  int substeps = 1;  ///< DEM steps in a fluid step; where that adapts they stay no longer than those of the first
};

/// Owns the fluid and the solids; either may be absent.
template <class Real>
class CoupledStep {
 public:
  CoupledStep(std::optional<lbm::FluidOptions> fluid, std::optional<dem::Solids> solids, CouplingOptions options);

  /// Fills boxes with water and grains together: where grains stand, the rest is liquid. Before the first step.
  void fill(const std::vector<lbm::LiquidRegion>& regions);

  /// Called in every step when the bodies are in the fluid's fields, before the fluid's step: for what acts on the
  /// fluid there and is no particle. Blocks that it writes it marks as used and edited. The audit does not know of it.
  using FieldWriter = std::function<void(lbm::Fluid<Real>&)>;
  void set_field_writer(FieldWriter writer) { field_writer_ = std::move(writer); }

  /// Advances by one fluid step (or `substeps` DEM steps without fluid).
  void advance();

  /// s, of the last step: by so much the solids advanced.
  [[nodiscard]] double time_step() const { return clock_.time_step(); }
  /// s. Where the fluid's step changes its own time may differ from that of the solids by less than a step.
  [[nodiscard]] double time() const { return solids_ ? clock_.time() : fluid_->time(); }
  [[nodiscard]] std::int64_t steps() const { return clock_.steps(); }
  [[nodiscard]] lbm::Fluid<Real>* fluid() { return fluid_ ? &*fluid_ : nullptr; }
  [[nodiscard]] dem::Solids* solids() { return solids_ ? &*solids_ : nullptr; }
  [[nodiscard]] const MomentumAudit& audit() const { return audit_; }
  /// Of rings and cables, by either way.
  [[nodiscard]] std::size_t wet_beads() const;
  [[nodiscard]] Timers& timers() { return timers_; }

  /// State of a checkpoint, of everything that the step owns; loading needs a step of the same scene that was not
  /// filled (coupled_step_transfer.cpp). Times of the parts are apart: they are not the same twice.
  void transfer(Archive& archive);
  void transfer_timers(Archive& archive);

 private:
  void follow_time_step();
  void hold_fluid_forces();
  void choose_wires();
  void map_bodies();

  std::optional<lbm::Fluid<Real>> fluid_;
  std::optional<dem::Solids> solids_;
  CouplingOptions options_;
  BodyMap<Real> bodies_;
  std::optional<WireDrag<Real>> wires_;
  std::optional<WireMap<Real>> resolved_wires_;
  FieldWriter field_writer_;
  MomentumAudit audit_;
  StepClock clock_;
  double longest_substep_ = 0;  // s
  Timers timers_;
};

extern template class CoupledStep<float>;
extern template class CoupledStep<double>;

}  // namespace lahar::coupling
