#include "cases/validate/averaged_grains/averaged_bed.h"

#include <cmath>
#include <numbers>
#include <random>

#include "dem/time_step.h"

namespace lahar::validate {

std::unique_ptr<coupling::CoupledStep<float>> make_bed(const AveragedBed& bed, const std::vector<Vec3>& centres) {
  lbm::FluidOptions fluid;
  fluid.domain.upper = bed.size;
  fluid.domain.cell_size = bed.cell_size;
  fluid.domain.faces.fill(bed.periodic ? lbm::FaceKind::periodic : lbm::FaceKind::closed);
  if (bed.upright) fluid.domain.faces[4] = fluid.domain.faces[5] = lbm::FaceKind::closed;
  fluid.domain.slip = WallSlip::free_slip;
  fluid.time_step = bed.time_step;
  fluid.density = kLiquidDensity;
  fluid.kinematic_viscosity = bed.viscosity;
  fluid.gravity = bed.fluid_gravity;
  fluid.smagorinsky = 0.16;
  fluid.weighting = bed.weighting;
  fluid.inflows = bed.inflows;
  if (bed.water_level > 0) fluid.domain.faces[5] = lbm::FaceKind::open;
  dem::Particles particles;
  for (const Vec3& c : centres)
    particles.add({.position = c, .radius = bed.diameter / 2, .density = bed.density, .state = bed.state});
  dem::Materials materials;  // smooth: walls bear no part of a bed's weight
  materials.add({"glass", bed.youngs_modulus, 0.3});
  materials.set_pair(0, 0, 0.0, 0.5);
  Walls walls;
  if (!bed.periodic)
    for (int a = 0; a < 3; ++a) {
      walls.add({"lower", HalfSpace{Vec3(0, 0, bed.grate), Vec3::Unit(a)}});
      walls.add({"upper", HalfSpace{bed.size, -Vec3::Unit(a)}});
    }
  dem::SolidsOptions solids;
  solids.gravity = bed.grain_gravity;
  solids.time_step = 1;  // set by the coupled step
  const double rayleigh =
      std::numbers::pi * bed.diameter / 2 * std::sqrt(bed.density * 2.6 / bed.youngs_modulus) / 0.84;
  const int substeps = std::max(1, static_cast<int>(std::ceil(bed.time_step / (0.2 * rayleigh))));
  auto step = std::make_unique<coupling::CoupledStep<float>>(
      fluid, dem::Solids(std::move(particles), {}, std::move(materials), std::move(walls), solids),
      coupling::CouplingOptions{
          .grains = bed.exchange, .thin_wires = coupling::ThinWires::uncoupled, .substeps = substeps});
  if (bed.water_level > 0)
    step->fill({{Vec3::Zero(), Vec3(bed.size.x(), bed.size.y(), bed.water_level)}});
  else
    step->fluid()->fill_everything([](const Vec3&) { return Vec3(Vec3::Zero()); }, [](const Vec3&) { return 0.0; });
  return step;
}

std::vector<Vec3> loose_lattice(const Vec3& size, double diameter, double fraction, unsigned seed) {
  const double apart = diameter * std::cbrt(std::numbers::pi / (6 * fraction));
  const Vec3i count = (size / apart).array().floor().cast<int>().max(1);
  const Vec3 spacing = size.cwiseQuotient(count.cast<double>());
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(-0.4, 0.4);
  std::vector<Vec3> centres;
  for (int x = 0; x < count.x(); ++x)
    for (int y = 0; y < count.y(); ++y)
      for (int z = 0; z < count.z(); ++z) {
        const Vec3 moved(part(random), part(random), part(random));
        const Vec3 room = (spacing.array() - diameter).max(0.0);
        centres.push_back((Vec3(x + 0.5, y + 0.5, z + 0.5)).cwiseProduct(spacing) + moved.cwiseProduct(room));
      }
  return centres;
}

Vec3 mean_velocity(coupling::CoupledStep<float>& step) {
  Vec3 sum = Vec3::Zero();
  double cells = 0;
  step.fluid()->for_each_wet_cell([&](const lbm::WetCell& c) { sum += c.velocity, ++cells; });
  const lbm::Fluid<float>& fluid = *step.fluid();
  return sum / cells + 0.5 * fluid.units().time_step * fluid.options().gravity;
}

}  // namespace lahar::validate
