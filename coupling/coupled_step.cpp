#include "coupling/coupled_step.h"

#include <cmath>

#include "coupling/liquid_around_bodies.h"

namespace lahar::coupling {

namespace {

template <class Real>
std::unique_ptr<GrainExchange<Real>> chosen_exchange(const std::optional<lbm::FluidOptions>& fluid,
                                                     const CouplingOptions& options) {
  return fluid ? make_grain_exchange<Real>(options.grains, *fluid) : nullptr;
}

}  // namespace

template <class Real>
CoupledStep<Real>::CoupledStep(std::optional<lbm::FluidOptions> fluid, std::optional<dem::Solids> solids,
                               CouplingOptions options)
    : CoupledStep(fluid, std::move(solids), options, chosen_exchange<Real>(fluid, options)) {}

template <class Real>
CoupledStep<Real>::CoupledStep(std::optional<lbm::FluidOptions> fluid, std::optional<dem::Solids> solids,
                               CouplingOptions options, std::unique_ptr<GrainExchange<Real>> exchange)
    : solids_(std::move(solids)), options_(options) {
  require(fluid || solids_, "CoupledStep: neither fluid nor solids");
  require(options_.substeps > 0, "CoupledStep: substeps must be positive");
  require(!options_.mapped_wires || !std::holds_alternative<AveragedGrains>(options_.grains),
          "CoupledStep: mapped wires beside averaged grains");
  require(!options_.mapped_wires || !fluid || fluid->weighting != lbm::BodyWeighting::inertial,
          "CoupledStep: mapped wires with the inertial weighting");
  const auto* averaged = std::get_if<AveragedGrains>(&options_.grains);
  require(!averaged || !averaged->beads_as_grains || options_.thin_wires == ThinWires::uncoupled,
          "CoupledStep: beads by the grains' law and by the wires', too");
  if (fluid) {
    fluid_.emplace(std::move(*fluid));
    clock_ = StepClock(fluid_->units().time_step);
    if (solids_) solids_->set_time_step(clock_.time_step() / options_.substeps);
  } else {
    clock_ = StepClock(solids_->options().time_step * options_.substeps);
  }
  longest_substep_ = clock_.time_step() / options_.substeps;
  const bool coupled = fluid_ && solids_;
  if (coupled && exchange) grains_.emplace(std::move(exchange));
  if (coupled && options_.mapped_wires)
    mapped_wires_.emplace(solids_->particles(), solids_->bonds(), *options_.mapped_wires, fluid_->units().cell_size);
  if (coupled && options_.thin_wires == ThinWires::drag_law)
    thin_wires_.emplace(solids_->particles(), solids_->bonds());
  if (grains_ && options_.films == GrainFilms::lubrication) {
    const lbm::FluidOptions& o = fluid_->options();
    films_.emplace(o.domain.cell_size, o.density * o.kinematic_viscosity);
  }
  if (fluid_) choose_wires();
}

/// Each piece of wire is either mapped or left to the drag law.
template <class Real>
void CoupledStep<Real>::choose_wires() {
  if (thin_wires_ && mapped_wires_) thin_wires_->leave_out(solids_->bonds(), mapped_wires_->wires().is_mapped());
  // Mapped wires that break are left to the drag law from one step to the next.
  fluid_->keep_velocities(thin_wires_ && (thin_wires_->beads() > 0 || mapped_wires_));
}

template <class Real>
std::size_t CoupledStep<Real>::wet_beads() const {
  std::size_t sum = (thin_wires_ ? thin_wires_->wet_beads() : 0) + (grains_ ? grains_->wet_beads() : 0);
  if (!mapped_wires_) return sum;
  for (const dem::ParticleId id : mapped_wires_->wires().beads())
    sum += mapped_wires_->wet_volume_of(id) > 0 && !(thin_wires_ && thin_wires_->acts_on(id));
  return sum;
}

template <class Real>
Vec3 CoupledStep<Real>::liquid_momentum() const {
  require(fluid_.has_value(), "CoupledStep::liquid_momentum: there is no fluid");
  const double rho = fluid_->options().density, cell = std::pow(fluid_->units().cell_size, 3);
  const bool with_level = grains_ && grains_->fills_with_level();
  std::vector<Vec3> blocks(fluid_->wet_block_count(), Vec3::Zero());
  fluid_->for_each_wet_block([&](std::size_t k, std::span<const lbm::WetCell> cells) {
    for (const lbm::WetCell& c : cells)
      blocks[k] += rho * (with_level ? c.fill_level * cell : c.liquid_volume) * c.velocity;
  });
  Vec3 sum = Vec3::Zero();
  for (const Vec3& block : blocks) sum += block;
  sum -= owed_to_wires() + lent_to_wires();
  if (with_level) sum -= rho * cell * grains_->flow_in_cells(solids_->particles());
  return sum;
}

template <class Real>
Vec3 CoupledStep<Real>::liquid_velocity(const lbm::WetCell& cell) const {
  if (!grains_) return cell.velocity;
  const Vec3 place = (cell.centre - fluid_->grid().domain().origin()) / fluid_->units().cell_size;
  return grains_->liquid_velocity_si(place, cell.velocity);
}

template <class Real>
void CoupledStep<Real>::fill(const std::vector<lbm::LiquidRegion>& regions) {
  require(fluid_.has_value(), "CoupledStep::fill: there is no fluid");
  fluid_->fill(regions);
  if (grains_) grains_->embed(*fluid_, solids_->particles(), fields_);
  if (mapped_wires_) mapped_wires_->embed(*fluid_, solids_->particles(), solids_->bonds(), fields_);
  if ((grains_ && !grains_->fills_with_level()) || mapped_wires_)
    add_bodies_out_of_liquid(fluid_->grid(), solids_->particles(), regions);
  if (grains_ || mapped_wires_) fluid_->open_ledger();
}

template <class Real>
void CoupledStep<Real>::renumber(const dem::Renumbering& change) {
  require(solids_.has_value(), "CoupledStep::renumber: there are no solids");
  solids_->renumber(change);
}

template <class Real>
void CoupledStep<Real>::advance() {
  const bool coupled = fluid_ && solids_;
  if (fluid_) follow_time_step();
  if (coupled) map_bodies();     // solids at their places of now, in the fluid's cells
  if (coupled) give_impulses();  // forces that are known before the step
  if (fluid_) step_fluid();
  if (coupled) gather_forces();   // of the fluid, held over the sub-steps that follow
  if (solids_) advance_solids();  // by as many sub-steps as the fluid's step takes
  clock_.advance();
  open_walls();
}

template <class Real>
void CoupledStep<Real>::open_walls() {
  const double now = time();
  if (fluid_ && fluid_->open_walls_by(now) && grains_)
    grains_->forget();  // what they are spread over stays out of walls
  if (solids_) solids_->open_walls_by(now);
}

/// m/s, of the fastest body that the fluid feels in its cells, or will: a grain, or a bead of a mapped wire.
template <class Real>
double CoupledStep<Real>::speed_of_bodies() const {
  double fastest = 0;  // square
  if (!solids_) return fastest;
  const dem::Particles& p = solids_->particles();
  for (dem::ParticleIndex i = 0; grains_ && i < p.size(); ++i)
    if (p.kind[i] == dem::ParticleKind::grain && p.state[i] != dem::ParticleState::removed)
      fastest = std::max(fastest, Vec3(p.velocity[i]).squaredNorm());
  if (mapped_wires_)
    for (const dem::ParticleId id : mapped_wires_->wires().beads())
      fastest = std::max(fastest, Vec3(p.velocity[p.index(id)]).squaredNorm());
  return std::sqrt(fastest);
}

/// The fluid may have chosen another step: as many sub-steps as keep each no longer than the first ones were.
template <class Real>
void CoupledStep<Real>::follow_time_step() {
  const double time_step = fluid_->plan_time_step(fluid_->options().adaptive_time_step ? speed_of_bodies() : 0.0);
  if (time_step == clock_.time_step()) return;
  clock_.set_time_step(time_step);
  options_.substeps = std::max(1, static_cast<int>(std::ceil(time_step / longest_substep_ * (1 - 1e-12))));
  if (solids_) solids_->set_time_step(time_step / options_.substeps);
}

template <class Real>
void CoupledStep<Real>::map_bodies() {
  const dem::Particles& particles = solids_->particles();
  fluid_->make_room();
  fields_.open(fluid_->grid());
  if (grains_) {
    const ScopedTimer timer(timers_.section("coupling.body_map"));
    grains_->update(*fluid_, particles, fields_);
  }
  if (mapped_wires_) {
    const ScopedTimer timer(timers_.section("coupling.wire_map"));
    if (mapped_wires_->follow_breakage(particles, solids_->bonds())) choose_wires();
    mapped_wires_->update(*fluid_, particles, solids_->bonds(), fields_);
  }
}

template <class Real>
void CoupledStep<Real>::give_impulses() {
  dem::Particles& particles = solids_->particles();
  particles.external_force.fill(Vec3::Zero());
  particles.external_torque.fill(Vec3::Zero());
  impulses_ = {};
  drags_.clear();
  if (grains_) {
    const ScopedTimer timer(timers_.section("coupling.grain_drag"));
    impulses_ += grains_->give_impulses(*fluid_, particles, fields_);
  }
  if (thin_wires_) {
    const ScopedTimer timer(timers_.section("coupling.wires"));
    thin_wires_->follow_breakage(solids_->bonds());
    impulses_ += thin_wires_->apply(*fluid_, particles, fields_, drags_, grains_ ? &*grains_ : nullptr);
  }
  thin_drags_ = drags_.size();
  if (field_writer_) field_writer_(*fluid_, fields_);
  fields_.close(fluid_->grid());
}

template <class Real>
void CoupledStep<Real>::step_fluid() {
  const ScopedTimer timer(timers_.section("fluid"));
  fluid_->step();
}

template <class Real>
void CoupledStep<Real>::gather_forces() {
  dem::Particles& particles = solids_->particles();
  if (grains_ || mapped_wires_) {
    const ScopedTimer timer(timers_.section("coupling.forces"));
    Vec3 on_bodies = Vec3::Zero();
    if (grains_) on_bodies += grains_->add_forces(*fluid_, particles);
    if (mapped_wires_) {
      on_bodies += mapped_wires_->add_forces(*fluid_, particles);
      mapped_wires_->add_drags(
          clock_.time_step(), particles, [&](dem::ParticleId id) { return thin_wires_ && thin_wires_->acts_on(id); },
          drags_);
    }
    audit_.book({on_bodies, momentum_given_to_bodies(fluid_->grid())});
  }
  if (films_) find_films();
  audit_.book(impulses_);
}

template <class Real>
void CoupledStep<Real>::find_films() {
  const ScopedTimer timer(timers_.section("coupling.lubrication"));
  films_->find(solids_->particles(), solids_->walls(), clock_.time_step(),
               [&](const Vec3& p) { return fluid_->cell_at(p).has_value(); });
}

template <class Real>
void CoupledStep<Real>::advance_solids() {
  const ScopedTimer timer(timers_.section("solids"));
  if (films_ && !films_->empty())
    advance_in_films();
  else
    solids_->advance(options_.substeps, drags_);
  if (thin_wires_) thin_wires_->collect(std::span(drags_).first(thin_drags_));
  if (mapped_wires_) mapped_wires_->collect(std::span(drags_).subspan(thin_drags_));
}

/// The fluid's forces are held over all sub-steps, those of the films change with the gaps, drags with the velocities.
template <class Real>
void CoupledStep<Real>::advance_in_films() {
  dem::Particles& particles = solids_->particles();
  const Vec3Field force = particles.external_force, torque = particles.external_torque;
  const int together = std::max(1, solids_->options().long_step);
  for (int n = 0; n < options_.substeps; n += together) {
    const int steps = std::min(together, options_.substeps - n);
    particles.external_force = force, particles.external_torque = torque;
    films_->add(particles, solids_->walls(), steps * solids_->options().time_step);
    solids_->advance(steps, drags_);
  }
  particles.external_force = force, particles.external_torque = torque;
  for (const dem::LiquidDrag& drag : drags_) {
    particles.external_force.add(drag.particle, drag.impulse / clock_.time_step());
    particles.external_torque.add(drag.particle, drag.angular_impulse / clock_.time_step());
  }
  solids_->advance(0);  // so that the particles' forces, too, contain the means of the whole step
}

template class CoupledStep<float>;
template class CoupledStep<double>;

}  // namespace lahar::coupling
