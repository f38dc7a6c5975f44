#include "coupling/grains/grain_coupling.h"

#include <gtest/gtest.h>

#include <numbers>

#include "lbm/free_surface/covered_cells.h"
#include "tests/coupling/tanks.h"

namespace lahar::coupling {
namespace {

template <class Real>
struct Immersed {
  explicit Immersed(const lbm::Fluid<Real>& fluid, double radius_shift = 0)
      : grains(ResolvedGrains{radius_shift}, fluid.options()) {}
  SolidFields<Real> fields;
  GrainCoupling<Real> grains;
};

/// One step of fluid around bodies that are moved by hand.
template <class Real>
void step(lbm::Fluid<Real>& fluid, Immersed<Real>& map, dem::Particles& particles) {
  map.fields.open(fluid.grid());
  map.grains.update(fluid, particles, map.fields);
  map.fields.close(fluid.grid());
  fluid.step();
  particles.external_force.fill(Vec3::Zero());
  particles.external_torque.fill(Vec3::Zero());
  map.grains.add_forces(fluid, particles);
}

template <class Real>
double total_fill(const lbm::Fluid<Real>& fluid) {
  double volume = 0;
  fluid.for_each_wet_cell([&](const lbm::WetCell& c) { volume += c.fill_level; });
  return volume * std::pow(fluid.units().cell_size, 3);
}

/// Archimedes: a sphere lowered into a tank raises the level by its volume, is carried by the weight of the water that
/// it displaces, and no water is lost.
TEST(GrainCoupling, LoweredSphereRaisesTheLevel) {
  const double radius = 0.08, volume = 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3);
  lbm::Fluid<double> fluid(tank(Vec3(0.48, 0.48, 0.6), 0.02, 4e-4));
  fluid.fill({{Vec3::Zero(), Vec3(0.48, 0.48, 0.3)}});
  dem::Particles particles;
  auto spec = grain(Vec3(0.241, 0.247, 0.42), radius, 2500);
  spec.state = dem::ParticleState::fixed;
  particles.add(spec);
  Immersed<double> map(fluid);
  const double start = total_fill(fluid), speed = 0.3, dt = fluid.units().time_step;
  while (particles.position.z[0] > 0.15) {
    particles.velocity.set(0, Vec3(0, 0, -speed));
    particles.position.add(0, Vec3(0, 0, -speed * dt));
    step(fluid, map, particles);
  }
  particles.velocity.set(0, Vec3::Zero());
  double lift = 0, rise = 0;
  for (int s = 0; s < 4000; ++s) {
    step(fluid, map, particles);
    if (s < 2000) continue;
    lift += particles.external_force.z[0] / 2000;
    rise += (total_fill(fluid) - start) / 2000;
  }
  EXPECT_NEAR(rise / volume, 1, 0.03);
  EXPECT_NEAR(lift / (9810 * volume), 1, 0.05);
  EXPECT_NEAR(fluid.mass_drift(), 0, 1e-12);
}

/// Highest wet cell that a body covers; 0 if there is none.
template <class Real>
double highest_covered(const lbm::Fluid<Real>& fluid) {
  const auto& grid = fluid.grid();
  double top = 0;
  for (const lbm::BlockIndex b : grid.owned())
    for (int n = 0; n < lbm::kBlockCells; ++n)
      if (lbm::is_wet(grid.block(b).type[static_cast<std::size_t>(n)]) && lbm::is_covered(grid.block(b), n))
        top = std::max(top, grid.centre(b, n).z());
  return top;
}

/// A held sphere, half in the water: the surface inside it stays where it is outside, the sphere feels the weight of
/// the water that it displaces, and no water is lost. (Before cells that a body covers were kept full the surface
/// inside had risen by two cells and the buoyancy fallen by 4 % by then.)
TEST(GrainCoupling, SurfaceInsideAHeldBodyStays) {
  const double dx = 0.02, radius = 4 * dx, level = 0.248;
  lbm::FluidOptions options = tank(Vec3(0.48, 0.48, 0.4), dx, 4e-4);
  options = by_distance(options);
  lbm::Fluid<double> fluid(options);
  fluid.fill({{Vec3::Zero(), Vec3(0.48, 0.48, level)}});
  dem::Particles particles;
  auto spec = grain(Vec3(0.244, 0.238, level), radius, 2500);
  spec.state = dem::ParticleState::fixed;
  particles.add(spec);
  Immersed<double> map(fluid);
  map.grains.embed(fluid, particles, map.fields);
  fluid.open_ledger();
  double lift = 0;
  for (int s = 0; s < 1600; ++s) {
    step(fluid, map, particles);
    if (s >= 1200) lift += particles.external_force.z[0] / 400;
  }
  EXPECT_GT(highest_covered(fluid), level - dx);
  EXPECT_LT(highest_covered(fluid), level + dx);
  EXPECT_NEAR(lift / (9810 * 2.0 / 3.0 * std::numbers::pi * std::pow(radius, 3)), 1, 0.025);
  EXPECT_NEAR(fluid.mass_drift(), 0, 1e-12);
}

/// Grains in a block of water at the start: the rest is liquid, and the ledger starts with that.
TEST(GrainCoupling, EmbeddedGrainsTakeTheirVolume) {
  lbm::Fluid<double> fluid(tank(Vec3(0.4, 0.4, 0.4), 0.02, 2e-4));
  fluid.fill({{Vec3::Zero(), Vec3(0.4, 0.4, 0.2)}});
  const double all = fluid.liquid_mass();
  dem::Particles particles;
  for (int k = 0; k < 4; ++k) particles.add(grain(Vec3(0.1 + 0.06 * k, 0.2, 0.1), 0.03, 2500));
  Immersed<double> map(fluid);
  map.grains.embed(fluid, particles, map.fields);
  fluid.open_ledger();
  EXPECT_NEAR((all - fluid.liquid_mass()) / (4000 * 4.0 / 3.0 * std::numbers::pi * std::pow(0.03, 3)), 1, 1e-6);
  EXPECT_NEAR(fluid.mass_drift(), 0, 1e-14);
}

/// Odd bodies: tiny, outside, two in one place, leaving: finite forces, mass kept.
TEST(GrainCoupling, OddBodiesDoNoHarm) {
  lbm::Fluid<float> fluid(tank(Vec3(0.32, 0.32, 0.32), 0.02, 2e-4));
  fluid.fill({{Vec3::Zero(), Vec3(0.32, 0.32, 0.16)}});
  dem::Particles particles;
  particles.add(grain(Vec3(0.101, 0.1, 0.1), 0.006, 2500));  // 0.3 cells
  particles.add(grain(Vec3(0.2, 0.2, 0.1), 0.03, 2500));
  particles.add(grain(Vec3(0.21, 0.2, 0.1), 0.03, 2500));   // in the same cells
  particles.add(grain(Vec3(5, 5, 5), 0.03, 2500));          // far away
  particles.add(grain(Vec3(0.0, 0.16, 0.16), 0.04, 2500));  // half in the wall, half out of the water
  Immersed<float> map(fluid);
  for (int s = 0; s < 300; ++s) {
    if (s == 200) particles.remove(2);
    step(fluid, map, particles);
    for (std::size_t i = 0; i < particles.size(); ++i) ASSERT_TRUE(particles.external_force[i].allFinite());
  }
  EXPECT_NE(particles.external_force[0], Vec3::Zero());
  EXPECT_EQ(particles.external_force[3], Vec3::Zero());
  EXPECT_NEAR(fluid.mass_drift(), 0, 1e-5);
}

/// The same with the weighting by distance, whose reach is wider than the body.
TEST(GrainCoupling, OddBodiesDoNoHarmByDistance) {
  auto options = tank(Vec3(0.32, 0.32, 0.32), 0.02, 2e-4);
  options = by_distance(options);
  lbm::Fluid<float> fluid(options);
  fluid.fill({{Vec3::Zero(), Vec3(0.32, 0.32, 0.16)}});
  dem::Particles particles;
  particles.add(grain(Vec3(0.101, 0.1, 0.1), 0.006, 2500));  // 0.3 cells
  particles.add(grain(Vec3(0.2, 0.2, 0.1), 0.03, 2500));
  particles.add(grain(Vec3(0.2, 0.2, 0.1), 0.03, 2500));    // in the same place
  particles.add(grain(Vec3(0.0, 0.16, 0.16), 0.04, 2500));  // half in the wall, half out of the water
  Immersed<float> map(fluid, -0.06);
  for (int s = 0; s < 300; ++s) {
    step(fluid, map, particles);
    for (std::size_t i = 0; i < particles.size(); ++i) ASSERT_TRUE(particles.external_force[i].allFinite());
  }
  EXPECT_NE(particles.external_force[0], Vec3::Zero());
  EXPECT_NEAR(fluid.mass_drift(), 0, 1e-5);
}

/// A sphere across the face of a periodic box is as good as one in its middle.
TEST(GrainCoupling, SphereAcrossAPeriodicFace) {
  const auto drag = [](const Vec3& centre) {
    auto options = stream(16, 1, 1);
    options.density = 1;
    options.kinematic_viscosity = 0.05;
    options.gravity = Vec3(1e-6, 0, 0);
    lbm::Fluid<double> fluid(options);
    fluid.fill_everything([](const Vec3&) { return Vec3(Vec3::Zero()); }, [](const Vec3&) { return 0.0; });
    dem::Particles particles;
    auto spec = grain(centre, 3, 2);
    spec.state = dem::ParticleState::fixed;
    particles.add(spec);
    Immersed<double> map(fluid);
    for (int s = 0; s < 200; ++s) step(fluid, map, particles);
    return particles.external_force[0];
  };
  const Vec3 inside = drag(Vec3(8.3, 8.2, 8.1)), across = drag(Vec3(0.3, 16.2, 8.1));
  EXPECT_GT(inside.x(), 0);
  EXPECT_NEAR((across - inside).norm() / inside.norm(), 0, 1e-9);
}

/// Grains at rest, moving, turning on the spot, stopping, starting, taken out, across the surface and in the water.
template <class Real>
class Mapping {
 public:
  explicit Mapping(lbm::BodyWeighting weighting, bool in_full)
      : fluid_(options(weighting)), map_(fluid_), in_full_(in_full) {
    fluid_.fill({{Vec3::Zero(), Vec3(0.96, 0.48, 0.3)}});
    for (int k = 0; k < 24; ++k)
      particles_.add(grain(Vec3(0.08 + 0.16 * (k % 6), 0.12 + 0.2 * (k / 6 % 2), 0.1 + 0.21 * (k / 12)), 0.031, 2500));
    map_.grains.embed(fluid_, particles_, map_.fields);
    fluid_.open_ledger();
  }
  void step() {
    const double dt = fluid_.units().time_step;
    particles_.velocity.set(1, Vec3(0, 0.2, -0.1));
    particles_.velocity.set(2, steps_ < 10 ? Vec3(0.3, 0, 0) : Vec3(Vec3::Zero()));
    particles_.velocity.set(13, steps_ % 8 < 4 ? Vec3(0, 0, -0.3) : Vec3(Vec3::Zero()));
    particles_.angular_velocity.set(3, Vec3(0, 1.0 + steps_, 0));
    for (std::size_t i = 0; i < particles_.size(); ++i) particles_.position.add(i, dt * particles_.velocity[i]);
    if (steps_++ == 20) particles_.remove(0);
    if (in_full_) map_.grains.forget();
    coupling::step(fluid_, map_, particles_);
  }
  /// Everything that the coupling writes and the fluid keeps.
  [[nodiscard]] std::vector<Real> state() const {
    std::vector<Real> all;
    const auto add = [&](const Real* field) { all.insert(all.end(), field, field + lbm::kBlockCells); };
    for (const lbm::BlockIndex b : fluid_.grid().owned()) {
      const lbm::Block<Real>& block = fluid_.grid().block(b);
      for (int i = 0; i < lbm::D3Q19::q; ++i) add(block.f(i));
      if (block.surface) add(block.surface->mass);
      if (const lbm::BodyFields<Real>* f = block.body)
        for (const Real* field :
             {f->solid_fraction, f->exchange_weight, f->drag, f->weighted_velocity_x, f->weighted_velocity_y,
              f->weighted_velocity_z, f->momentum_exchange_x, f->momentum_exchange_y, f->momentum_exchange_z})
          add(field);
    }
    for (std::size_t i = 0; i < particles_.size(); ++i)
      for (int a = 0; a < 3; ++a) {
        all.push_back(static_cast<Real>(particles_.external_force[i][a]));
        all.push_back(static_cast<Real>(particles_.external_torque[i][a]));
      }
    return all;
  }
  [[nodiscard]] std::size_t written() const { return map_.grains.written_blocks(); }

 private:
  static lbm::FluidOptions options(lbm::BodyWeighting weighting) {
    auto o = tank(Vec3(0.96, 0.48, 0.48), 0.02, 4e-4);
    o.weighting = weighting;
    if (weighting == lbm::BodyWeighting::wall_distance) o = by_distance(o);
    return o;
  }
  lbm::Fluid<Real> fluid_;
  dem::Particles particles_;
  Immersed<Real> map_;
  bool in_full_;
  int steps_ = 0;
};

/// What stayed where it was is not written again, and that changes no bit.
template <class Real>
void compare_with_full_mapping(lbm::BodyWeighting weighting) {
  Mapping<Real> part(weighting, false), full(weighting, true);
  for (int s = 0; s < 40; ++s) {
    part.step(), full.step();
    EXPECT_LT(part.written(), full.written() / 2) << s;
    EXPECT_GT(part.written(), 0U) << s;
    ASSERT_EQ(part.state(), full.state()) << s;
  }
}

TEST(GrainCoupling, WritesOnlyWhatMoved) {
  compare_with_full_mapping<float>(lbm::BodyWeighting::noble_torczynski);
  compare_with_full_mapping<double>(lbm::BodyWeighting::wall_distance);
}

/// Ten thousand grains at once, most of them in contact, half of them in air.
TEST(GrainCoupling, TenThousandGrains) {
  lbm::Fluid<float> fluid(tank(Vec3(0.5, 0.4, 0.48), 0.02, 2e-4));
  fluid.fill({{Vec3::Zero(), Vec3(0.5, 0.4, 0.24)}});
  dem::Particles particles;
  for (int k = 0; k < 10000; ++k)
    particles.add(
        grain(Vec3(0.01 + 0.02 * (k % 25), 0.01 + 0.02 * (k / 25 % 20), 0.012 + 0.024 * (k / 500)), 0.01, 2500));
  Immersed<float> map(fluid);
  map.grains.embed(fluid, particles, map.fields);
  fluid.open_ledger();
  for (int s = 0; s < 5; ++s) step(fluid, map, particles);
  for (std::size_t i = 0; i < particles.size(); ++i) ASSERT_TRUE(particles.external_force[i].allFinite());
  EXPECT_GT(particles.external_force.z[0], 0);
  EXPECT_NEAR(fluid.mass_drift(), 0, 1e-5);
}

}  // namespace
}  // namespace lahar::coupling
