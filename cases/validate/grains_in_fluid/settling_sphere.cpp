// A sphere that settles from rest in a closed box of oil (ten Cate et al. 2002). The fluid feels no gravity and the
// sphere its weight less the buoyancy: the same flow without the pressure of the depth, which would compress a lattice
// fluid by several percent at these time steps.
#include <fmt/format.h>

#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "cases/pictures/chart.h"
#include "cases/validate/entry.h"
#include "cases/validate/fluid/flows.h"
#include "cases/validate/grains_in_fluid/sphere_flow.h"
#include "cases/validate/reference_table.h"
#include "coupling/coupled_step.h"

namespace lahar::validate {

namespace {

/// Of tencate2002.csv; sphere, box and start are those of its first lines.
struct Oil {
  std::string name;
  double density, viscosity;  ///< kg/m^3, Pa s
  double fastest;             ///< m/s: the highest speed that was measured
  double lattice_speed;       ///< of the fastest, for tau - 1/2 below 0.5
};
constexpr double kDiameter = 0.015, kDensity = 1120, kGravity = 9.81, kGap = 0.120;
constexpr double kSlowedDown = 0.95;  // of the highest speed so far: it has begun to feel the floor

std::vector<Oil> oils() {
  const ReferenceTable table = reference("tencate2002.csv");
  std::vector<Oil> all;
  for (const auto& [name, lattice_speed] : {std::pair{"E1", 0.020}, {"E2", 0.030}, {"E3", 0.050}, {"E4", 0.050}}) {
    const ReferenceTable row = table.where("case", name);
    all.push_back({name, row.number("rho_f"), row.number("mu_Pas"), row.number("u_max_box"), lattice_speed});
  }
  return all;
}

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
      {.grains = coupling::ResolvedGrains{immersion.radius_shift}});
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

void draw(const Context& context, const std::vector<Oil>& all, const std::vector<Fall>& falls) {
  if (context.plots.empty() || falls.size() != all.size()) return;
  cases::Chart chart{
      .title = "Sphere settling in a box of oil, 12 cells a diameter", .x = {"time", "s"}, .y = {"speed", "m/s"}};
  for (std::size_t k = 0; k < falls.size(); ++k) {
    const auto colour = static_cast<cases::ChartColour>(k);
    chart.series.push_back({.name = all[k].name, .x = falls[k].time, .y = falls[k].speed, .colour = colour});
    chart.series.push_back({.name = k == 0 ? "highest speed measured, ten Cate et al. 2002" : "",
                            .x = {0, falls[k].time.back()},
                            .y = {all[k].fastest, all[k].fastest},
                            .dash = cases::Dash::dashed,
                            .colour = colour});
  }
  chart.write_all(context.plots / "settling_sphere.png");
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  std::vector<Fall> falls;
  const std::vector<Oil> all = oils();
  for (const Oil& oil : all) {
    if (context.quick && oil.name != "E4") continue;
    const int cells = context.quick ? 6 : 12;
    falls.push_back(fall_in<double>(oil, cells, !context.plots.empty()));
    rows.push_back(relative_row(fmt::format("{}: highest speed, m/s, {} cells, tau - 1/2 = {:.2g}", oil.name, cells,
                                            falls.back().shifted_viscosity),
                                falls.back().fastest, oil.fastest, context.quick ? 0.10 : 0.03));
    rows.push_back(audit_row(oil.name, falls.back().audit));
  }
  draw(context, all, falls);
  return rows;
}

}  // namespace

Entry settling_sphere() {
  return {"grains_in_fluid.settling_sphere", {"ten Cate et al. 2002, Phys. Fluids 14:4012", {"tencate2002.csv"}}, run};
}

}  // namespace lahar::validate
