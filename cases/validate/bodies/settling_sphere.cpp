// A sphere that settles from rest in a closed box of oil (ten Cate et al. 2002). The fluid feels no gravity and the
// sphere its weight less the buoyancy: the same flow without the pressure of the depth, which would compress a lattice
// fluid by several percent at these time steps.
#include <fmt/format.h>

#include <array>
#include <numbers>

#include "cases/pictures/chart.h"
#include "cases/validate/bodies/entries.h"
#include "cases/validate/bodies/sphere_flow.h"
#include "cases/validate/fluid/flows.h"
#include "coupling/coupled_step.h"

namespace lahar::validate {

namespace {

// tencate2002.csv: d = 15 mm, 1120 kg/m^3, box 100 x 100 x 160 mm, gap below the sphere 120 mm at the start.
struct Oil {
  const char* name;
  double density, viscosity;  ///< kg/m^3, Pa s
  double unbounded, fastest;  ///< m/s: in an unbounded fluid; the highest speed that was measured
  double lattice_speed;       ///< of the fastest, for tau - 1/2 below 0.5
};
constexpr Oil kOils[] = {{"E1", 970, 0.373, 0.038, 0.035986, 0.020},
                         {"E2", 965, 0.212, 0.060, 0.05718, 0.030},
                         {"E3", 962, 0.113, 0.091, 0.087269, 0.050},
                         {"E4", 960, 0.058, 0.128, 0.12224, 0.050}};
constexpr double kDiameter = 0.015, kDensity = 1120, kGravity = 9.81, kGap = 0.120;
constexpr double kSlowedDown = 0.95;  // of the highest speed so far: it has begun to feel the floor

struct Fall {
  double fastest = 0, shifted_viscosity = 0;
  coupling::MomentumAudit audit;
  std::vector<double> time, speed;  ///< s, m/s
};

template <class Real>
Fall fall_in(const Oil& oil, int cells_per_diameter, bool to_floor) {
  const double dx = kDiameter / cells_per_diameter, dt = oil.lattice_speed * dx / oil.fastest;
  const Immersion immersion;
  lbm::FluidOptions fluid;
  fluid.domain.upper = Vec3(0.1, 0.1, 0.16);
  fluid.domain.cell_size = dx;
  fluid.time_step = dt;
  fluid.density = oil.density;
  fluid.kinematic_viscosity = oil.viscosity / oil.density;
  fluid.collision = immersion.collision;
  fluid.weighting = immersion.weighting;
  fluid.solid_operator = immersion.solid_operator;
  dem::Particles particles;
  dem::ParticleSpec sphere;
  sphere.position = Vec3(0.05, 0.05, kGap + kDiameter / 2);
  sphere.radius = kDiameter / 2;
  sphere.density = kDensity;
  particles.add(sphere);
  dem::Materials materials;
  materials.add({"nylon", 1e6, 0.3});
  materials.set_pair(0, 0, 0.3, 0.5);
  dem::SolidsOptions options;
  options.gravity = Vec3(0, 0, -kGravity * (1 - oil.density / kDensity));
  options.time_step = dt;
  coupling::CoupledStep<Real> step(
      fluid, dem::Solids(std::move(particles), dem::Bonds{}, std::move(materials), Walls{}, options),
      {.radius_shift = immersion.radius_shift, .wire_drag = false, .substeps = 1});
  step.fluid()->fill_everything(at_rest, no_pressure);
  Fall fall;
  fall.shifted_viscosity = step.fluid()->tau() - 0.5;
  const dem::Particles& p = step.solids()->particles();
  while (p.position.z[0] > kDiameter / 2 + 2 * dx) {
    step.advance();
    const double speed = -p.velocity.z[0];
    fall.time.push_back(step.time()), fall.speed.push_back(speed);
    fall.fastest = std::max(fall.fastest, speed);
    if (!to_floor && speed < kSlowedDown * fall.fastest) break;
  }
  fall.audit = step.audit();
  return fall;
}

void draw(const Context& context, const std::vector<Fall>& falls) {
  if (context.plots.empty() || falls.size() != std::size(kOils)) return;
  cases::Chart chart{
      .title = "Sphere settling in a box of oil, 12 cells a diameter", .x = {"time", "s"}, .y = {"speed", "m/s"}};
  for (std::size_t k = 0; k < falls.size(); ++k) {
    const auto colour = static_cast<cases::ChartColour>(k);
    chart.series.push_back({.name = kOils[k].name, .x = falls[k].time, .y = falls[k].speed, .colour = colour});
    chart.series.push_back({.name = k == 0 ? "highest speed measured, ten Cate et al. 2002" : "",
                            .x = {0, falls[k].time.back()},
                            .y = {kOils[k].fastest, kOils[k].fastest},
                            .dash = cases::Dash::dashed,
                            .colour = colour});
  }
  chart.write_all(context.plots / "settling_sphere.png");
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  std::vector<Fall> falls;
  for (const Oil& oil : kOils) {
    if (context.quick && oil.name != kOils[3].name) continue;
    const int cells = context.quick ? 6 : 12;
    falls.push_back(fall_in<double>(oil, cells, !context.plots.empty()));
    rows.push_back(relative_row(fmt::format("{}: highest speed, m/s, {} cells, tau - 1/2 = {:.2g}", oil.name, cells,
                                            falls.back().shifted_viscosity),
                                falls.back().fastest, oil.fastest, context.quick ? 0.10 : 0.03));
    rows.push_back(audit_row(oil.name, falls.back().audit));
  }
  draw(context, falls);
  return rows;
}

}  // namespace

Entry settling_sphere() {
  return {"bodies.settling_sphere", "ten Cate et al. 2002, Phys. Fluids 14:4012 (tencate2002.csv)", run};
}

}  // namespace lahar::validate
