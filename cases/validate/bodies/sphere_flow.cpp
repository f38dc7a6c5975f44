#include "cases/validate/bodies/sphere_flow.h"

#include "cases/validate/fluid/flows.h"
#include "coupling/grains/body_fields.h"

namespace lahar::validate {

namespace {

lbm::FluidOptions options_of(const Vec3i& cells, double viscosity, const Vec3& gravity, const Immersion& immersion) {
  lbm::FluidOptions o = lattice_box(cells, viscosity);
  o.gravity = gravity;
  o.collision = immersion.collision;
  o.weighting = immersion.weighting;
  o.solid_operator = immersion.solid_operator;
  return o;
}

}  // namespace

Row audit_row(const std::string& label, const coupling::MomentumAudit& audit) {
  return at_most_row(label + ": momentum audit", audit.relative(), 1e-10);
}

template <class Real>
SphereFlow<Real>::SphereFlow(const Vec3i& cells, double viscosity, const Vec3& gravity, const Immersion& immersion,
                             const std::vector<Vec3>& centres, double radius, const Vec3& flow)
    : fluid_(options_of(cells, viscosity, gravity, immersion)), map_(immersion.radius_shift) {
  for (const Vec3& c : centres) {
    dem::ParticleSpec s;
    s.position = c;
    s.radius = radius;
    s.density = 2;
    s.state = dem::ParticleState::fixed;
    particles_.add(s);
  }
  const Vec3 box = cells.cast<double>();
  const auto outside = [&](const Vec3& p) {
    for (const Vec3& c : centres) {
      Vec3 d = p - c;
      for (int a = 0; a < 3; ++a) d[a] -= box[a] * std::round(d[a] / box[a]);
      if (d.norm() < radius) return Vec3(Vec3::Zero());
    }
    return flow;
  };
  fluid_.fill_everything(outside, no_pressure);
}

template <class Real>
void SphereFlow<Real>::write_fringe() {
  auto& grid = fluid_.grid();
  for (const lbm::BlockIndex b : grid.active()) {
    const int x = grid.lowest_cell(b).x();
    if (x + lbm::kBlockWidth <= fringe_.first || x >= fringe_.last) continue;
    auto& f = grid.require_body(b);
    f.used = f.edited = true;
    for (int n = 0; n < lbm::kBlockCells; ++n) {
      const int at = x + lbm::cell_position(n)[0];
      if (at < fringe_.first || at >= fringe_.last) continue;
      f.coverage[n] = 1;
      f.resistance[n] = static_cast<Real>(fringe_.resistance);
      f.momentum_x[n] = static_cast<Real>(fringe_.speed);
    }
  }
}

template <class Real>
Vec3 SphereFlow<Real>::step() {
  coupling::clear_body_fields(fluid_.grid());
  map_.update(fluid_, particles_);
  if (fringe_.last > fringe_.first) write_fringe();
  coupling::release_unused_body_fields(fluid_.grid());
  fluid_.step();
  particles_.external_force.fill(Vec3::Zero());
  particles_.external_torque.fill(Vec3::Zero());
  const Vec3 force = map_.add_forces(fluid_, particles_);
  if (fringe_.last == fringe_.first) audit_.book(force, coupling::momentum_given_to_bodies(fluid_.grid()));
  return force;
}

template <class Real>
Vec3 SphereFlow<Real>::mean_velocity() const {
  Vec3 sum = Vec3::Zero();
  double cells = 0;
  fluid_.for_each_wet_cell([&](const lbm::WetCell& c) { sum += c.velocity, cells += 1; });
  return sum / cells + 0.5 * fluid_.options().gravity;
}

template class SphereFlow<float>;
template class SphereFlow<double>;

}  // namespace lahar::validate
