// Momentum between fluid and bodies, by its own books and from outside: free grains of 0.6 to 8 cells, two of them in
// each other, one across a face of the box, and a moving ring, in a stirred periodic box without gravity or walls. With
// lubrication two more grains close upon each other, and the bodies must have won what the fluid gave them: films act
// between them alone. Lattice units.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "cases/validate/entry.h"
#include "cases/validate/fluid/flows.h"
#include "cases/validate/free_surface/surface_flows.h"
#include "cases/validate/grains_in_fluid/stirred_box.h"
#include "coupling/coupled_step.h"

namespace lahar::validate {
namespace {

constexpr int kWidth = 32;  // cells

/// How the bodies act.
struct Variant {
  const char* name;
  lbm::CollisionOperator collision = lbm::CentralMoments{};
  lbm::BodyWeighting weighting = lbm::BodyWeighting::wall_distance;
  lbm::SolidOperator solid_operator = lbm::SolidOperator::equilibrium_difference;
  bool mapped_wires = false, lubrication = false;
  bool held = false;  ///< grains stand still
};

/// Grains of diameters from 0.6 to 8 cells on a grid of places, moving and spinning; the second overlaps the first.
void add_grains(dem::Particles& particles, bool held) {
  const double diameters[] = {8, 5, 0.6, 1, 2, 3, 4, 6};
  for (int k = 0; k < 8; ++k) {
    dem::ParticleSpec grain;
    grain.position = Vec3(6.3 + 11 * (k % 2), 5.1 + 9 * (k / 2 % 2), 7.7 + 14 * (k / 4));
    if (k == 1) grain.position = Vec3(11.4, 5.6, 8.2);
    if (k == 7) grain.position = Vec3(kWidth - 0.7, 27.3, 24.9);
    grain.radius = diameters[k] / 2;
    grain.density = 0.5 + 0.7 * k;
    grain.velocity = 0.02 * Vec3(std::sin(1.0 + k), std::cos(2.0 * k), std::sin(3.0 * k));
    grain.angular_velocity = 0.01 * Vec3(std::cos(1.0 * k), std::sin(2.0 + k), std::cos(3.0 + k));
    if (held) {
      grain.velocity = grain.angular_velocity = Vec3::Zero();
      grain.state = dem::ParticleState::fixed;
    }
    particles.add(grain);
  }
}

/// Two grains 0.1 cells apart that go with the stream and approach each other, away from all others.
void add_film(dem::Particles& particles) {
  dem::ParticleSpec grain;
  grain.density = 3;
  grain.position = Vec3(25, 6, 10), grain.radius = 2, grain.velocity = Vec3(0.063, 0.018, -0.02);
  particles.add(grain);
  grain.position = Vec3(28.6, 6, 10), grain.radius = 1.5, grain.velocity = Vec3(0.057, 0.018, -0.02);
  particles.add(grain);
}

/// A ring of 40 beads of radius 1, 7 cells in radius, that flies across the stream.
dem::Bonds add_ring(dem::Particles& particles) {
  constexpr dem::ParticleIndex beads = 40;
  const auto first = static_cast<dem::ParticleIndex>(particles.size());
  for (dem::ParticleIndex k = 0; k < beads; ++k) {
    const double angle = 2 * std::numbers::pi * k / beads;
    dem::ParticleSpec bead;
    bead.position = Vec3(20.2, 18.1 + 7 * std::cos(angle), 14.3 + 7 * std::sin(angle));
    bead.radius = 1;
    bead.density = 7.8;
    bead.velocity = Vec3(-0.03, 0.01, 0.02);
    bead.kind = dem::ParticleKind::bead;
    particles.add(bead);
  }
  dem::BondSort sort;
  sort.axial.stiffness = {1e-3, 1e-3, 1e-3};
  sort.bond_radius = 1;
  dem::Bonds bonds;
  bonds.add_sort(sort);
  for (dem::ParticleIndex k = 0; k < beads; ++k) bonds.add({first + k, first + (k + 1) % beads, 0}, particles);
  return bonds;
}

struct Balance {
  double audit = 0;    ///< by the code's own books
  double outside = 0;  ///< what the cells lost and was not given to bodies or beads, of what was exchanged; with films
                       ///< what the bodies won and the fluid did not give, too
};

Vec3 momentum_of(const dem::Particles& p) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < p.size(); ++i) sum += p.mass[i] * p.velocity[i];
  return sum;
}

template <class Real>
Balance balance_of(const Variant& v, int steps) {
  lbm::FluidOptions fluid = lattice_box({kWidth, kWidth, kWidth}, 1e-3);
  fluid.collision = v.collision;
  fluid.weighting = v.weighting;
  fluid.solid_operator = v.solid_operator;
  fluid.smagorinsky = stable_without_eddies(v.collision) ? 0 : 0.16;  // they need it at this tau
  dem::Particles particles;
  add_grains(particles, v.held);
  if (v.lubrication) add_film(particles);
  dem::Bonds bonds = add_ring(particles);
  dem::Materials materials;
  materials.add({"stone", 1e-3, 0.3});
  dem::SolidsOptions options;
  options.gravity = Vec3::Zero();
  options.time_step = 0.1;
  options.watchdog.overlap_limit = 10;
  coupling::CouplingOptions coupling;
  coupling.substeps = 10;
  coupling.grains = coupling::ResolvedGrains{.radius_shift = 0};
  if (v.mapped_wires) coupling.mapped_wires = {.from_diameter = 2, .radius_shift = 0};
  if (v.lubrication) coupling.films = coupling::GrainFilms::lubrication;
  coupling::CoupledStep<Real> step(
      fluid, dem::Solids(std::move(particles), std::move(bonds), std::move(materials), Walls{}, options), coupling);
  stir(step, kWidth);
  step.advance();
  const dem::Particles& p = step.solids()->particles();
  Vec3 before = momentum_of_cells(step), of_bodies = momentum_of(p);
  Vec3 missing = Vec3::Zero(), exchanged = Vec3::Zero();
  for (int s = 1; s < steps; ++s) {
    step.advance();
    Vec3 given = coupling::momentum_given_to_bodies(step.fluid()->grid());
    for (std::size_t i = 0; !v.mapped_wires && i < p.size(); ++i)
      if (p.kind[i] == dem::ParticleKind::bead) given += p.external_force[i];
    const Vec3 now = momentum_of_cells(step);
    missing += now - before + given;
    exchanged += given.cwiseAbs();
    before = now;
    if (!v.lubrication) continue;
    missing += momentum_of(p) - of_bodies;
    for (std::size_t i = 0; i < p.size(); ++i) missing -= step.time_step() * p.external_force[i];  // but for the films
    of_bodies = momentum_of(p);
  }
  return {step.audit().relative(), missing.norm() / exchanged.norm()};
}

std::vector<Row> run(const Context& context) {
  using lbm::BodyWeighting, lbm::SolidOperator;
  constexpr auto central = lbm::CentralMoments{};
  const Variant variants[] = {
      {"default"},
      {"trt", lbm::Trt{}},
      {"bgk", lbm::Bgk{}},
      {"weighting by the solid fraction", central, BodyWeighting::solid_fraction},
      {"Noble & Torczynski", central, BodyWeighting::noble_torczynski},
      {"inertial", central, BodyWeighting::inertial},
      {"faded", central, BodyWeighting::wall_distance, SolidOperator::damped_nonequilibrium},
      {"bounce-back", central, BodyWeighting::wall_distance, SolidOperator::nonequilibrium_bounce_back},
      // The liquid inside turns round in every step, undamped: a grain that is free runs away with it.
      {"Holdych, grains held", central, BodyWeighting::noble_torczynski, SolidOperator::wall_velocity_bounce_back,
       false, false, true},
      {"wires mapped as bodies", central, BodyWeighting::wall_distance, SolidOperator::equilibrium_difference, true},
      {"lubrication", central, BodyWeighting::wall_distance, SolidOperator::equilibrium_difference, false, true},
  };
  return in_precision(context, [&]<class Real>() {
    const double bar = sizeof(Real) == 8 ? 1e-10 : 1e-4;
    std::vector<Row> rows;
    for (const Variant& v : variants) {
      const Balance b = balance_of<Real>(v, context.quick ? 20 : 400);
      rows.push_back(at_most_row(fmt::format("{}: momentum audit", v.name), b.audit, bar));
      rows.push_back(at_most_row(fmt::format("{}: seen from outside", v.name), b.outside, bar));
    }
    return rows;
  });
}

}  // namespace

Entry momentum_audit() { return {"grains_in_fluid.momentum_audit", {"conservation of momentum"}, run}; }

}  // namespace lahar::validate
