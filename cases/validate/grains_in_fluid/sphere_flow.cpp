#include "cases/validate/grains_in_fluid/sphere_flow.h"

#include "cases/validate/fluid/flows.h"

namespace lahar::validate {

namespace {

lbm::FluidOptions options_of(const Vec3i& cells, double viscosity, const Vec3& gravity, const Immersion& immersion) {
  lbm::FluidOptions o = lattice_box(cells, viscosity);
  o.gravity = gravity;
  o.collision = immersion.collision;
  o.weighting = immersion.weighting;
  o.solid_operator = immersion.solid_operator;
  o.smagorinsky = immersion.smagorinsky;
  o.rheology = immersion.rheology;
  return o;
}

/// Of four times the density of the fluid and more: such a body feels the fluid's force itself, not a mean over steps
/// (coupling/under_relaxed_force.h).
constexpr double kHeavy = 8;

dem::Solids held_spheres(const std::vector<Vec3>& centres, double radius) {
  dem::Particles particles;
  for (const Vec3& c : centres) {
    dem::ParticleSpec s;
    s.position = c;
    s.radius = radius;
    s.density = kHeavy;
    s.state = dem::ParticleState::fixed;
    particles.add(s);
  }
  dem::Materials materials;
  materials.add({"stone", 1, 0.3});
  dem::SolidsOptions options;
  options.gravity = Vec3::Zero();
  options.time_step = 1;
  return {std::move(particles), dem::Bonds{}, std::move(materials), Walls{}, options};
}

template <class Real>
void write_fringe(const Fringe& fringe, lbm::FluidGrid<Real>& grid, coupling::SolidFields<Real>& fields) {
  for (const lbm::BlockIndex b : grid.owned()) {
    const int x = grid.lowest_cell(b).x();
    if (x + lbm::kBlockWidth <= fringe.first || x >= fringe.last) continue;
    auto& f = fields.write_over(grid, b);
    for (int n = 0; n < lbm::kBlockCells; ++n) {
      const int at = x + lbm::cell_position(n)[0];
      if (at < fringe.first || at >= fringe.last) continue;
      f.exchange_weight[n] = 1;
      f.drag[n] = static_cast<Real>(fringe.drag);
      f.weighted_velocity_x[n] = static_cast<Real>(fringe.speed);
    }
  }
}

}  // namespace

Row audit_row(const std::string& label, const coupling::MomentumAudit& audit) {
  return at_most_row(label + ": momentum audit", audit.relative(), 1e-10);
}

template <class Real>
SphereFlow<Real>::SphereFlow(const Vec3i& cells, double viscosity, const Vec3& gravity, const Immersion& immersion,
                             const std::vector<Vec3>& centres, double radius, const Vec3& flow)
    : step_(options_of(cells, viscosity, gravity, immersion), held_spheres(centres, radius),
            {.grains = coupling::ResolvedGrains{immersion.radius_shift}}) {
  const Vec3 box = cells.cast<double>();
  const auto outside = [&](const Vec3& p) {
    for (const Vec3& c : centres) {
      Vec3 d = p - c;
      for (int a = 0; a < 3; ++a) d[a] -= box[a] * std::round(d[a] / box[a]);
      if (d.norm() < radius) return Vec3(Vec3::Zero());
    }
    return flow;
  };
  step_.fluid()->fill_everything(outside, no_pressure);
}

template <class Real>
void SphereFlow<Real>::set_fringe(const Fringe& fringe) {
  step_.set_field_writer([fringe](lbm::Fluid<Real>& fluid, coupling::SolidFields<Real>& fields) {
    write_fringe(fringe, fluid.grid(), fields);
  });
}

template <class Real>
void SphereFlow<Real>::move_spheres(const Vec3& velocity) {
  dem::Particles& particles = step_.solids()->particles();
  for (std::size_t i = 0; i < particles.size(); ++i) particles.velocity.set(i, velocity);
}

template <class Real>
void SphereFlow<Real>::step() {
  step_.advance();
  const Vec3 box = step_.fluid()->options().domain.upper - step_.fluid()->options().domain.lower;
  dem::Particles& particles = step_.solids()->particles();
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Vec3 x = particles.position[i], home = x - box.cwiseProduct((x.cwiseQuotient(box)).array().floor().matrix());
    if (home != x) particles.position.set(i, home);
  }
}

template <class Real>
Vec3 SphereFlow<Real>::force() {
  const dem::Particles& particles = step_.solids()->particles();
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < particles.size(); ++i) sum += particles.external_force[i];
  return sum;
}

template <class Real>
Vec3 SphereFlow<Real>::mean_velocity() {
  Vec3 sum = Vec3::Zero();
  double cells = 0;
  const lbm::Fluid<Real>& fluid = *step_.fluid();
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) { sum += c.velocity, cells += 1; });
  return sum / cells;
}

template class SphereFlow<float>;
template class SphereFlow<double>;

}  // namespace lahar::validate
