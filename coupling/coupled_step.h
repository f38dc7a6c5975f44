#pragma once
// THE step: fluid, grains and barrier advance together by one fluid time step.
#include <functional>
#include <optional>

#include "core/step_clock.h"
#include "coupling/audit.h"
#include "coupling/coupling_options.h"
#include "coupling/grains/grain_coupling.h"
#include "coupling/grains/lubrication.h"
#include "coupling/wires/wire_drag.h"
#include "coupling/wires/wire_map.h"
#include "dem/solids.h"
#include "lbm/step/fluid.h"

namespace lahar::coupling {

/// Owns the fluid and the solids; either may be absent.
template <class Real>
class CoupledStep {
 public:
  CoupledStep(std::optional<lbm::FluidOptions> fluid, std::optional<dem::Solids> solids, CouplingOptions options);
  /// With an exchange of momentum in place of that of options.grains; null: grains and fluid do not feel each other.
  CoupledStep(std::optional<lbm::FluidOptions> fluid, std::optional<dem::Solids> solids, CouplingOptions options,
              std::unique_ptr<GrainExchange<Real>> exchange);

  /// Fills boxes with water and grains together: where grains stand, the rest is liquid. Before the first step.
  void fill(const std::vector<lbm::LiquidRegion>& regions);

  /// Called in every step when the bodies are in the fluid's fields, before the fluid's step: for what acts on the
  /// fluid there and is no particle. It asks for the blocks that it writes by SolidFields::write_over. The audit does
  /// not know of it.
  using FieldWriter = std::function<void(lbm::Fluid<Real>&, SolidFields<Real>&)>;
  void set_field_writer(FieldWriter writer) { field_writer_ = std::move(writer); }

  /// Moves the particles to other places in their arrays, see dem::Solids::renumber; between steps. What the coupling
  /// remembers of grains and wires it keeps by id, and it sums in the order of ids: no number changes.
  void renumber(const dem::Renumbering& change);

  /// Advances by one fluid step (or `substeps` DEM steps without fluid), then takes away the walls that open by then.
  void advance();

  /// s, of the last step: by so much the solids advanced.
  [[nodiscard]] double time_step() const { return clock_.time_step(); }
  /// s. Where the fluid's step changes its own time may differ from that of the solids by less than a step.
  [[nodiscard]] double time() const { return solids_ ? clock_.time() : fluid_->time(); }
  [[nodiscard]] std::int64_t steps() const { return clock_.steps(); }
  [[nodiscard]] lbm::Fluid<Real>* fluid() { return fluid_ ? &*fluid_ : nullptr; }
  [[nodiscard]] dem::Solids* solids() { return solids_ ? &*solids_ : nullptr; }
  [[nodiscard]] const MomentumAudit& audit() const { return audit_; }
  /// Momentum that wires got by drag and the cells give in the next step, N s.
  [[nodiscard]] Vec3 owed_to_wires() const { return thin_wires_ ? thin_wires_->owed() : Vec3(Vec3::Zero()); }
  /// Momentum that mapped wires got and have still to return, N s: no cell gave it.
  [[nodiscard]] Vec3 lent_to_wires() const { return mapped_wires_ ? mapped_wires_->lent() : Vec3(Vec3::Zero()); }
  /// Momentum of the liquid, kg m/s: of what the cells hold less the part of averaged grains, which move in them, and
  /// less what is owed or lent to wires.
  [[nodiscard]] Vec3 liquid_momentum() const;
  /// Velocity of the liquid between the grains at a wet cell, m/s: with averaged grains cells hold that of both
  /// together.
  [[nodiscard]] Vec3 liquid_velocity(const lbm::WetCell& cell) const;
  /// Of rings and cables, by either way.
  [[nodiscard]] std::size_t wet_beads() const;
  [[nodiscard]] Timers& timers() { return timers_; }

  /// State of a checkpoint, of everything that the step owns; loading needs a step of the same scene that was not
  /// filled (coupled_step_transfer.cpp). Times of the parts are apart: they are not the same twice.
  void transfer(Archive& archive);
  void transfer_timers(Archive& archive);

 private:
  void choose_wires();
  [[nodiscard]] double speed_of_bodies() const;
  void follow_time_step();
  void map_bodies();
  void give_impulses();
  void step_fluid();
  void gather_forces();
  void find_films();
  void advance_solids();
  void advance_in_films();
  void open_walls();

  std::optional<lbm::Fluid<Real>> fluid_;
  std::optional<dem::Solids> solids_;
  CouplingOptions options_;
  SolidFields<Real> fields_;
  std::optional<GrainCoupling<Real>> grains_;
  std::optional<WireMap<Real>> mapped_wires_;
  std::optional<WireDrag<Real>> thin_wires_;
  std::optional<LubricationFilms> films_;  // of the step under way
  FieldWriter field_writer_;
  std::vector<dem::LiquidDrag> drags_;  // of the step under way: those of thin wires, then of mapped ones
  std::size_t thin_drags_ = 0;          // how many are of thin ones
  ExchangedMomentum impulses_;          // of the step under way
  MomentumAudit audit_;
  StepClock clock_;
  double longest_substep_ = 0;  // s
  Timers timers_;
};

extern template class CoupledStep<float>;
extern template class CoupledStep<double>;

}  // namespace lahar::coupling
