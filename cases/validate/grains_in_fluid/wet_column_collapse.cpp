// Case H11 of the hard cases: the block of the paper's debris flow, water and 4741 boulders packed to 0.64, let go on
// 35 degrees. Nothing is softened; the scene's number format (float) holds whatever is asked for.
#include <fmt/format.h>

#include <algorithm>

#include "cases/assembly/simulation.h"
#include "cases/validate/entry.h"
#include "coupling/coupling_options.h"

namespace lahar::validate {

namespace {

scene::WallSettings plane(const char* name, const Vec3& point, const Vec3& normal, WallSlip slip) {
  scene::WallSettings wall;
  wall.name = name, wall.point = point, wall.normal = normal, wall.slip = slip, wall.material = "wall";
  return wall;
}

/// The release of cases/debris_flow, weighting and radius shift as there, on cells of 2 cm, `share` of its width.
scene::Scene wet_column(double share) {
  constexpr double length = 0.75, depth = 0.75, packed = 0.583, full_width = 1.8;
  const double width = share * full_width;
  const auto part = [&](double count) { return static_cast<std::int64_t>(std::lround(share * count)); };
  scene::Scene s;
  s.identity.name = "wet_column";
  s.gravity.slope_deg = 35;
  s.domain.upper = Vec3(3.2, width, 1.0);
  s.domain.open_faces = {scene::Face::x_upper, scene::Face::z_upper};
  using enum WallSlip;
  s.walls = {plane("bed", Vec3::Zero(), Vec3::UnitZ(), free_slip),
             plane("upstream_end", Vec3::Zero(), Vec3::UnitX(), no_slip),
             plane("right_side", Vec3::Zero(), Vec3::UnitY(), free_slip),
             plane("left_side", Vec3(0, width, 0), -Vec3::UnitY(), free_slip)};
  s.fluid.enabled = true;
  s.fluid.cell_size = 0.02;
  s.fluid.max_speed = 7;
  s.fluid.smagorinsky = 0.16;
  scene::FluidRegion water;
  water.upper = Vec3(length, width, depth);
  s.fluid.regions = {water};
  s.materials = {{"rock", 70e9, 0.3}, {"wall", 700e9, 0.3}};
  s.contacts = {{{"rock", "rock"}, 0.7, 0.7}, {{"rock", "wall"}, 0.7, 0.7}};
  scene::Packing packing;
  packing.upper = Vec3(length, width, 1.0);
  packing.target_height = packed;
  packing.sizes = {{0.04, part(3260), 2500, "rock"}, {0.08, part(1481), 2500, "rock"}};
  s.grains.packings = {packing};
  s.coupling.enabled = true;
  s.coupling.body_weighting = lbm::BodyWeighting::inertial;
  s.coupling.radius_shift_cells = coupling::kRadiusShiftFast;
  return s;
}

struct Energy {
  double kinetic = 0, total = 0;  ///< J, of water and grains; with gravity and the springs of contacts
};

Energy energy_of(cases::Simulation& simulation, const scene::Scene& s) {
  const dem::EnergyLedger grains = simulation.solids()->ledger();
  Energy all{grains.kinetic + grains.rotational, grains.stored()};
  const Vec3 g = s.gravity.vector();
  simulation.fluid()->for_each_wet_cell([&](const lbm::WetCell& cell) {
    const double mass = s.fluid.density * cell.liquid_volume, kinetic = 0.5 * mass * cell.velocity.squaredNorm();
    all.kinetic += kinetic;
    all.total += kinetic - mass * g.dot(cell.centre);
  });
  return all;
}

/// Grains whose centre is behind a wall.
double behind_walls(const dem::Solids& solids) {
  double count = 0;
  const dem::Particles& p = solids.particles();
  for (std::size_t i = 0; i < p.size(); ++i)
    if (solids.walls().nearest(p.position[i]).distance < 0) count += 1;
  return count;
}

std::vector<Row> run(const Context& context) {
  const scene::Scene s = wet_column(context.quick ? 1.0 / 6 : 1.0);
  const double duration = context.quick ? 0.1 : 0.5;
  const auto simulation = cases::build_simulation(s);
  double overlap = 0, lowest = energy_of(*simulation, s).total, rise = 0, behind = 0;
  Energy energy;
  while (simulation->time() < duration) {
    simulation->advance();
    overlap = std::max(overlap, simulation->solids()->worst_overlap().ratio / 2);
    energy = energy_of(*simulation, s);
    rise = std::max(rise, energy.total - lowest);
    lowest = std::min(lowest, energy.total);
    behind = std::max(behind, behind_walls(*simulation->solids()));
  }
  const cases::FluidView& fluid = *simulation->fluid();
  return {at_most_row("largest overlap / diameter, of all fluid steps", overlap, 0.01),
          at_most_row(fmt::format("rise of all energy / kinetic energy of {:.3g} kJ at the end", energy.kinetic / 1e3),
                      rise / energy.kinetic, 0.01),
          at_most_row("grains behind a wall", behind, 0),
          at_most_row("liquid ledger", std::abs(fluid.mass_drift(fluid.liquid_mass())), 1e-6),
          at_most_row("momentum audit", simulation->audit().relative(), 1e-6)};
}

}  // namespace

Entry wet_column_collapse() {
  return {"grains_in_fluid.wet_column_collapse",
          {"case H11 of the hard cases: conservation laws", {"hard_cases.csv"}},
          run};
}

}  // namespace lahar::validate
