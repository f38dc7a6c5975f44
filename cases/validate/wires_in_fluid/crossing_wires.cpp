// Case H10 of reference/hard_cases.csv: two wires (0.6 cells) that cross in one cell, a ring that touches a wall, two
// bodies in the same cells by every weighting.
#include <algorithm>
#include <cmath>
#include <string>

#include "cases/validate/entry.h"
#include "cases/validate/fluid/flows.h"
#include "cases/validate/free_surface/surface_flows.h"
#include "cases/validate/wires_in_fluid/wire_flows.h"
#include "core/worst.h"
#include "coupling/coupled_step.h"

namespace lahar::validate {
namespace {

/// How bodies act on the fluid.
struct Weighting {
  const char* name;
  lbm::BodyWeighting weighting;
  lbm::SolidOperator solid_operator = lbm::SolidOperator::equilibrium_difference;
};

constexpr Weighting kWeightings[] = {
    {"solid_fraction", lbm::BodyWeighting::solid_fraction, lbm::SolidOperator::damped_nonequilibrium},
    {"noble_torczynski", lbm::BodyWeighting::noble_torczynski},
    {"wall_distance", lbm::BodyWeighting::wall_distance},
    {"inertial", lbm::BodyWeighting::inertial}};

/// Two spheres of 3 cells radius, half in each other, in a stream.
template <class Real>
void overlapping_bodies(std::vector<Row>& rows, const Weighting& how, int steps) {
  dem::Particles particles;
  for (const double x : {12.1, 14.6}) {
    dem::ParticleSpec sphere;
    sphere.position = Vec3(x, 12.2, 11.9);
    sphere.radius = 3;
    sphere.density = 8;
    sphere.state = dem::ParticleState::fixed;
    particles.add(sphere);
  }
  dem::Materials materials;
  materials.add({"stone", 1e-6, 0.3});
  dem::SolidsOptions options;
  options.gravity = Vec3::Zero();
  options.time_step = 1;
  options.watchdog.overlap_limit = 10;
  lbm::FluidOptions fluid = lattice_box({32, 24, 24}, 1e-3);
  fluid.weighting = how.weighting;
  fluid.solid_operator = how.solid_operator;
  fluid.gravity = Vec3(1e-5, 0, 0);
  coupling::CoupledStep<Real> step(
      fluid, dem::Solids(std::move(particles), dem::Bonds{}, std::move(materials), Walls{}, options), {});
  step.fluid()->fill_everything([](const Vec3&) { return Vec3(0.05, 0.01, 0); }, no_pressure);
  double most_solid = 0, most_weight = 0;
  std::vector<double> inside, after;
  const auto look = [&](std::vector<double>& densities) {
    step.fluid()->for_each_wet_cell([&](const lbm::WetCell& c) {
      if (c.solid_fraction >= 1) densities.push_back(1 + 3 * c.pressure);
    });
    const auto& grid = step.fluid()->grid();
    for (const lbm::BlockIndex b : grid.owned()) {
      const auto* body = grid.block(b).body;
      for (int n = 0; body && n < lbm::kBlockCells; ++n) {
        keep_worst(most_solid, static_cast<double>(body->solid_fraction[n]));
        keep_worst(most_weight, static_cast<double>(body->coverage_weight[n]));
      }
    }
  };
  for (int s = 0; s < steps; ++s) step.advance();
  look(inside);
  for (int s = 0; s < steps; ++s) step.advance();
  look(after);
  double drift = 0;
  for (std::size_t k = 0; k < inside.size(); ++k) drift += (after[k] - inside[k]) / static_cast<double>(inside.size());
  // 1, by the distance from the wall 1.006 at this viscosity (lbm/collision/coverage_weight.h).
  const auto largest = static_cast<Real>(step.fluid()->coverage_weight_law().largest);
  const std::string what = std::string(how.name) + ": ";
  rows.push_back(at_least_row(what + "largest sum of solid fractions of two bodies in each other", most_solid, 1.5));
  rows.push_back(at_most_row(what + "largest coverage weight B there, of the largest of a lone body",
                             most_weight / static_cast<double>(largest), 1));
  rows.push_back(at_least_row(what + "fully covered cells looked at", static_cast<double>(inside.size()), 50));
  if (steps >= 500)  // before, the pressure of the starting stream still settles
    rows.push_back(at_most_row(what + "drift of the mean density in them over the second half", std::abs(drift), 1e-3));
  rows.push_back(
      at_most_row(what + "momentum audit, bodies", step.audit().relative(), sizeof(Real) == 8 ? 1e-10 : 1e-4));
}

/// A ring that touches the floor of a channel: what the stream loses goes to the ring and the walls.
template <class Real>
Row ring_at_wall(int steps) {
  lbm::FluidOptions o = lattice_box({32, 16, 24}, 1e-3);
  o.domain.faces[4] = o.domain.faces[5] = lbm::FaceKind::closed;
  dem::Particles particles;
  dem::Bonds bonds;
  dem::BondSort sort;
  sort.axial.stiffness = {1e-6, 1e-6, 1e-6};
  sort.bond_radius = 0.3;
  bonds.add_sort(sort);
  constexpr dem::ParticleIndex beads = 36;
  for (dem::ParticleIndex k = 0; k < beads; ++k) {
    const double angle = 2 * std::numbers::pi * k / beads;
    dem::ParticleSpec bead;
    bead.position = Vec3(8.2, 8.1 + 5 * std::cos(angle), 5.3 + 5 * std::sin(angle));
    bead.radius = 0.3;
    bead.density = 8;
    bead.kind = dem::ParticleKind::bead;
    bead.state = dem::ParticleState::fixed;
    particles.add(bead);
    if (k > 0) bonds.add({k - 1, k, 0}, particles);
  }
  bonds.add({beads - 1, 0, 0}, particles);
  dem::Materials materials;
  materials.add({"wire", 1e-6, 0.3});
  dem::SolidsOptions options;
  options.gravity = Vec3::Zero();
  options.time_step = 1;
  options.watchdog.overlap_limit = 10;
  coupling::CoupledStep<Real> step(
      o, dem::Solids(std::move(particles), std::move(bonds), std::move(materials), Walls{}, options), {});
  auto& fluid = *step.fluid();
  fluid.fill_everything([](const Vec3&) { return Vec3(0.05, 0, 0); }, no_pressure);
  fluid.measure_walls();
  const auto momentum = [&] {
    Vec3 sum = Vec3::Zero();
    fluid.for_each_wet_cell([&](const lbm::WetCell& c) { sum += (1 + 3 * c.pressure) * c.velocity; });
    return Vec3(sum - step.owed_to_wires());
  };
  const auto walls = [&] {
    double sum = 0;
    for (const auto& load : fluid.wall_loads()) sum += load.impulse.x();
    return sum;
  };
  // The momentum of the cells is that before the walls' turn: what the walls got in the first step is part of the
  // balance, what they got in the last one is not.
  step.advance();
  const double start = momentum().x();
  double given = 0, reflected = 0;
  for (int s = 1; s < steps; ++s) {
    reflected = walls();
    step.advance();
    for (std::size_t i = 0; i < beads; ++i) given += step.solids()->particles().external_force.x[i];
  }
  return at_most_row("ring at a wall: momentum that is missing along the stream",
                     std::abs(momentum().x() - start + given + reflected) / start, sizeof(Real) == 8 ? 1e-10 : 1e-4);
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  WireStream s;
  s.diameter = 0.6;
  s.reynolds = 1000;
  s.cells = Vec3i(48, 24, 24);
  s.travel = context.quick ? 12 : 33;
  s.wires = {{Vec3(12.3, 12.4, 0), Vec3(12.3, 12.4, 24)}, {Vec3(12.5, 0, 12.6), Vec3(12.5, 24, 12.6)}};
  s.expected_drag = 0.5 * 0.6 * 48 * s.speed * s.speed * cylinder_law(1000);
  const WireLoad load = run_stream(s, context);
  rows.push_back(
      relative_row("drag of two wires that cross in one cell, of two lone ones", load.drag, s.expected_drag, 0.25));
  rows.push_back(
      at_most_row("momentum audit, wires", load.audit, context.precision == Precision::float64 ? 1e-10 : 1e-4));
  in_precision(context, [&]<class Real>() {
    rows.push_back(ring_at_wall<Real>(context.quick ? 50 : 300));
    for (const Weighting& how : kWeightings) overlapping_bodies<Real>(rows, how, context.quick ? 100 : 500);
    return 0;
  });
  return rows;
}

}  // namespace

Entry crossing_wires() {
  return {"wires_in_fluid.crossing_wires", {"case H10 of the hard cases", {"hard_cases.csv"}}, run};
}

}  // namespace lahar::validate
