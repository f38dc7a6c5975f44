#include "coupling/coupled_step.h"

#include <cmath>

#include "coupling/grains/body_fields.h"
#include "coupling/grains/lubrication.h"

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
  if (fluid_ && solids_ && std::isfinite(options_.resolve_wires_from)) {
    const double smallest = options_.resolve_wires_from * fluid_->units().cell_size * (1 - 1e-9);
    resolved_wires_.emplace(solids_->particles(), solids_->bonds(), smallest, options_.radius_shift);
  }
  choose_wires();
}

/// Each piece of wire is either mapped or left to the drag law.
template <class Real>
void CoupledStep<Real>::choose_wires() {
  if (wires_ && resolved_wires_) wires_->leave_out(solids_->bonds(), resolved_wires_->wires().is_mapped());
  if (fluid_) fluid_->keep_velocities(wires_ && wires_->beads() > 0);
}

template <class Real>
std::size_t CoupledStep<Real>::wet_beads() const {
  std::size_t sum = wires_ ? wires_->wet_beads() : 0;
  if (!resolved_wires_) return sum;
  for (const dem::ParticleIndex i : resolved_wires_->wires().beads())
    sum += resolved_wires_->wet_volume_of(i) > 0 && !(wires_ && wires_->acts_on(i));
  return sum;
}

template <class Real>
void CoupledStep<Real>::fill(const std::vector<lbm::LiquidRegion>& regions) {
  require(fluid_.has_value(), "CoupledStep::fill: there is no fluid");
  fluid_->fill(regions);
  if (!solids_ || !(options_.immersed_grains || resolved_wires_)) return;
  if (options_.immersed_grains) bodies_.embed(*fluid_, solids_->particles());
  if (resolved_wires_) resolved_wires_->embed(*fluid_, solids_->particles(), solids_->bonds());
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

template <class Real>
void CoupledStep<Real>::map_bodies() {
  const dem::Particles& particles = solids_->particles();
  clear_body_fields(fluid_->grid());
  if (options_.immersed_grains) {
    const ScopedTimer timer(timers_.section("coupling.body_map"));
    bodies_.update(*fluid_, particles);
  }
  if (!resolved_wires_) return;
  const ScopedTimer timer(timers_.section("coupling.wire_map"));
  if (resolved_wires_->follow_breakage(particles, solids_->bonds())) choose_wires();
  resolved_wires_->update(*fluid_, particles, solids_->bonds());
}

/// Fluid step between the solids' places of now; the forces that come out are held over the sub-steps that follow.
template <class Real>
void CoupledStep<Real>::hold_fluid_forces() {
  dem::Particles& particles = solids_->particles();
  particles.external_force.fill(Vec3::Zero());
  particles.external_torque.fill(Vec3::Zero());
  Vec3 on_wires = Vec3::Zero(), from_wires = Vec3::Zero();
  map_bodies();
  if (wires_) {
    const ScopedTimer timer(timers_.section("coupling.wires"));
    on_wires = wires_->apply(*fluid_, particles);
    from_wires = wires_->given_to_fluid();
  }
  if (field_writer_) field_writer_(*fluid_);
  release_unused_body_fields(fluid_->grid());
  {
    const ScopedTimer timer(timers_.section("fluid"));
    fluid_->step();
  }
  if (options_.immersed_grains || resolved_wires_) {
    const ScopedTimer timer(timers_.section("coupling.forces"));
    Vec3 on_bodies = Vec3::Zero();
    if (options_.immersed_grains) on_bodies += bodies_.add_forces(*fluid_, particles);
    if (resolved_wires_) on_bodies += resolved_wires_->add_forces(*fluid_, particles);
    audit_.book(on_bodies, momentum_given_to_bodies(fluid_->grid()));
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
