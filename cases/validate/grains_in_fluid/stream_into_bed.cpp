// A sheet of water that runs into a bed of spheres held in place, down a chute whose bed and sides let it slip: the
// spheres alone take momentum from it along the chute. What they got, with what the water still has, is what it had and
// what its weight gave it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/validate/entry.h"
#include "coupling/coupled_step.h"

namespace lahar::validate {

namespace {

constexpr double kDepth = 0.08, kWidth = 0.32, kSpeed = 6;  // m, m/s
constexpr double kRadius = 0.03, kBedHeight = 0.24;         // m
constexpr double kDuration = 0.16;                          // s: no drop has left through the top by then

lbm::FluidOptions chute(double cell_size, lbm::BodyWeighting weighting) {
  lbm::FluidOptions o;
  o.domain.upper = Vec3(3.2, kWidth, 0.8);
  o.domain.cell_size = cell_size;
  o.domain.faces[5] = lbm::FaceKind::open;
  o.domain.slip = WallSlip::free_slip;
  o.time_step = 0.084 * cell_size / kSpeed;
  o.gravity = 9.81 * Vec3(std::sin(35 * M_PI / 180), 0, -std::cos(35 * M_PI / 180));
  o.kinematic_viscosity = 1e-6;
  o.smagorinsky = 0.16;
  o.weighting = weighting;
  return o;
}

/// Spheres in rows that touch each other, at rest for good.
dem::Solids bed() {
  dem::Particles particles;
  constexpr double pitch = 2 * kRadius;
  for (int x = 0; x < 16; ++x)
    for (int y = 0; y < 5; ++y)
      for (int z = 0; z < static_cast<int>(kBedHeight / pitch); ++z) {
        dem::ParticleSpec sphere;
        sphere.position = Vec3(1.6, 0, 0) + pitch * Vec3(x + 0.5, y + 0.5, z + 0.5);
        sphere.radius = kRadius;
        sphere.density = 2650;
        sphere.state = dem::ParticleState::fixed;
        particles.add(sphere);
      }
  dem::Materials materials;
  materials.add({"stone", 1e8, 0.3});
  dem::SolidsOptions options;
  options.gravity = Vec3::Zero();
  options.time_step = 1;  // set by the coupled step
  return {std::move(particles), dem::Bonds{}, std::move(materials), Walls{}, options};
}

/// Momentum along the chute that was made, of that at the start.
double momentum_made(double cell_size, lbm::BodyWeighting weighting, const coupling::GrainExchangeChoice& grains) {
  coupling::CoupledStep<float> step(chute(cell_size, weighting), bed(),
                                    {.grains = grains, .thin_wires = coupling::ThinWires::uncoupled});
  lbm::LiquidRegion sheet{Vec3(0.1, 0, 0), Vec3(1.5, kWidth, kDepth)};
  sheet.velocity = kSpeed * Vec3::UnitX();
  step.fill({sheet});
  const double start = step.liquid_momentum().x(), pull = step.fluid()->options().gravity.x();
  double weight = 0, on_bed = 0, mass = 0;
  for (int n = 0; step.time() < kDuration; ++n) {
    if (n % 16 == 0) mass = step.fluid()->liquid_mass();
    step.advance();
    weight += step.time_step() * pull * mass;
    const dem::Particles& p = step.solids()->particles();
    for (dem::ParticleIndex i = 0; i < p.size(); ++i) on_bed += step.time_step() * p.external_force[i].x();
  }
  return (step.liquid_momentum().x() + on_bed - weight) / start - 1;
}

std::vector<Row> run(const Context& context) {
  constexpr double bar = 0.02;
  using enum lbm::BodyWeighting;
  const coupling::ResolvedGrains resolved{.radius_shift = coupling::kRadiusShiftFast};
  const coupling::AveragedGrains averaged{.drag = coupling::BedDrag::gidaspow};
  const auto row = [&](const char* name, int cells, lbm::BodyWeighting weighting,
                       const coupling::GrainExchangeChoice& grains) {
    return absolute_row(fmt::format("{}, sheet of {} cells: momentum made, of that at the start", name, cells),
                        momentum_made(kDepth / cells, weighting, grains), 0, bar);
  };
  if (context.quick) return {row("averaged", 2, wall_distance, averaged)};
  return {row("inertial", 4, inertial, resolved), row("inertial", 8, inertial, resolved),
          row("wall_distance", 4, wall_distance, resolved), row("averaged", 4, wall_distance, averaged)};
}

}  // namespace

Entry stream_into_bed() { return {"grains_in_fluid.stream_into_bed", {"conservation of momentum", {}}, run}; }

}  // namespace lahar::validate
