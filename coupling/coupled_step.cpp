#include "coupling/coupled_step.h"

#include <cmath>

#include "coupling/body_fields.h"
#include "coupling/lubrication.h"

namespace lahar::coupling {

template <class Real>
CoupledStep<Real>::CoupledStep(std::optional<lbm::FluidOptions> fluid, std::optional<dem::Solids> solids,
                               CouplingOptions options)
    : solids_(std::move(solids)), options_(options), bodies_(options.radius_shift) {
  require(fluid || solids_, "CoupledStep: neither fluid nor solids");
  require(options_.substeps > 0, "CoupledStep: substeps must be positive");
  if (fluid) {
    fluid_.emplace(std::move(*fluid));
    clock_ = StepClock(fluid_->units().time_step);
    if (solids_) solids_->set_time_step(clock_.time_step() / options_.substeps);
  } else {
    clock_ = StepClock(solids_->options().time_step * options_.substeps);
  }
  longest_substep_ = clock_.time_step() / options_.substeps;
  if (fluid_ && solids_ && options_.wire_drag) wires_.emplace(solids_->particles(), solids_->bonds());
  if (fluid_) fluid_->keep_velocities(wires_ && wires_->beads() > 0);
}

template <class Real>
void CoupledStep<Real>::fill(const std::vector<lbm::LiquidRegion>& regions) {
  require(fluid_.has_value(), "CoupledStep::fill: there is no fluid");
  fluid_->fill(regions);
  if (!solids_ || !options_.immersed_grains) return;
  bodies_.embed(*fluid_, solids_->particles());
  fluid_->open_ledger();
}

template <class Real>
void CoupledStep<Real>::advance() {
  if (fluid_) follow_time_step();
  if (fluid_ && solids_) {
    hold_fluid_forces();
  } else if (fluid_) {
    const ScopedTimer timer(timers_.section("fluid"));
    fluid_->step();
  }
  if (solids_) {
    const ScopedTimer timer(timers_.section("solids"));
    solids_->advance(options_.substeps);
  }
  clock_.advance();
}

/// The fluid may have chosen another step: as many sub-steps as keep each no longer than the first ones were.
template <class Real>
void CoupledStep<Real>::follow_time_step() {
  const double time_step = fluid_->plan_time_step();
  if (time_step == clock_.time_step()) return;
  clock_.set_time_step(time_step);
  options_.substeps = std::max(1, static_cast<int>(std::ceil(time_step / longest_substep_ * (1 - 1e-12))));
  if (solids_) solids_->set_time_step(time_step / options_.substeps);
}

/// Fluid step between the solids' places of now; the forces that come out are held over the sub-steps that follow.
template <class Real>
void CoupledStep<Real>::hold_fluid_forces() {
  dem::Particles& particles = solids_->particles();
  particles.external_force.fill(Vec3::Zero());
  particles.external_torque.fill(Vec3::Zero());
  Vec3 on_wires = Vec3::Zero(), from_wires = Vec3::Zero();
  clear_body_fields(fluid_->grid());
  if (options_.immersed_grains) {
    const ScopedTimer timer(timers_.section("coupling.body_map"));
    bodies_.update(*fluid_, particles);
  }
  if (wires_) {
    const ScopedTimer timer(timers_.section("coupling.wires"));
    on_wires = wires_->apply(*fluid_, particles);
    from_wires = wires_->given_to_fluid();
  }
  release_unused_body_fields(fluid_->grid());
  {
    const ScopedTimer timer(timers_.section("fluid"));
    fluid_->step();
  }
  if (options_.immersed_grains) {
    const ScopedTimer timer(timers_.section("coupling.forces"));
    const Vec3 on_grains = bodies_.add_forces(*fluid_, particles);
    audit_.book(on_grains, momentum_given_to_bodies(fluid_->grid()));
  }
  if (options_.immersed_grains && options_.lubrication) {
    const ScopedTimer timer(timers_.section("coupling.lubrication"));
    const lbm::FluidOptions& o = fluid_->options();
    add_lubrication(particles, o.domain.cell_size, o.density * o.kinematic_viscosity, clock_.time_step(),
                    [&](const Vec3& p) { return fluid_->cell_at(p).has_value(); });
  }
  audit_.book(on_wires, -from_wires);
}

template class CoupledStep<float>;
template class CoupledStep<double>;

}  // namespace lahar::coupling
