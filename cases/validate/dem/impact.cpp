#include "cases/validate/dem/impact.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cases/scene/scene.h"
#include "cases/validate/dem/ledger_watch.h"
#include "core/worst.h"
#include "dem/time_step.h"

namespace lahar::validate {

namespace {

constexpr double kRigid = 1e20;  // Pa

dem::Materials materials_of(const ImpactSpec& s) {
  dem::Materials m;
  m.add({"sphere", s.youngs_modulus, s.poisson_ratio});
  m.add({"plate", kRigid, s.poisson_ratio});
  m.set_pair(0, 0, s.friction, s.restitution);
  m.set_pair(0, 1, s.friction, s.restitution);
  return m;
}

dem::Particles spheres_of(const ImpactSpec& s, double gap) {
  dem::ParticleSpec sphere;
  sphere.radius = s.radius;
  sphere.density = s.density;
  sphere.velocity = s.speed * Vec3(std::sin(s.angle), 0, -std::cos(s.angle));
  sphere.position = Vec3(0, 0, s.radius + gap);
  dem::Particles p;
  p.add(sphere);
  if (!s.pair) return p;
  sphere.velocity *= -1;
  sphere.position *= -1;
  p.add(sphere);
  return p;
}

dem::Solids scene_of(const ImpactSpec& s, double time_step, double gap) {
  Walls walls;
  if (!s.pair) walls.add({"plate", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}, WallSlip::no_slip, 1});
  dem::SolidsOptions options;
  options.gravity = Vec3::Zero();
  options.time_step = time_step;
  options.contact_law = s.law;
  return {spheres_of(s, gap), {}, materials_of(s), walls, options};
}

}  // namespace

double default_time_step(const ImpactSpec& s) {
  return scene::Solids{}.contact_safety *
         dem::rayleigh_time_step(s.radius, s.density, {"sphere", s.youngs_modulus, s.poisson_ratio});
}

void ImpactLedger::add(const ImpactSpec& spec, const Impact& impact) {
  ImpactSpec fine = spec;
  fine.step_share = spec.step_share / 3;
  keep_worst(after_, impact.ledger_error);
  keep_worst(within_, run_impact(fine).ledger_worst);
}

void ImpactLedger::rows(std::vector<Row>& rows) const {
  rows.push_back(at_most_row("ledger at any time, a third of the default step", within_, kLedgerBar));
  rows.push_back(at_most_row("ledger after impacts, default step", after_, 5 * kLedgerBar));
}

Impact run_impact(const ImpactSpec& s) {
  const double dt = s.step_share * default_time_step(s), closing = s.speed * std::cos(s.angle);
  const double gap = 0.3 * closing * dt;  // the touch falls between two steps, as it does in a scene
  dem::Solids solids = scene_of(s, dt, gap);
  LedgerWatch watch(solids);
  Impact result;
  double touched = 0;  // s
  for (int step = 0; step < 1000000; ++step) {
    solids.step();
    watch.look();
    const auto& p = solids.particles();
    const double height = p.position.z[0], overlap = s.radius - height;  // of one side: by symmetry half of a pair's
    if (overlap > 0 && touched == 0) touched = solids.time() - overlap / closing;
    result.max_overlap = std::max(result.max_overlap, (s.pair ? 2 : 1) * overlap);
    result.max_force = std::max(result.max_force, p.force.z[0]);
    if (overlap > 0 || touched == 0 || p.velocity.z[0] <= 0) continue;
    result.restitution = p.velocity.z[0] / closing;
    result.duration = solids.time() + overlap / p.velocity.z[0] - touched;
    result.tangential_ratio = p.velocity.x[0] / (s.speed * std::sin(s.angle));
    result.spin = -p.angular_velocity.y[0];
    result.rebound_angle = std::atan2(p.velocity.x[0] - s.radius * p.angular_velocity.y[0], p.velocity.z[0]);
    result.ledger_error = std::abs(watch.last_error()) / watch.exchanged();
    result.ledger_worst = watch.error() / watch.exchanged();
    return result;
  }
  throw std::runtime_error("the spheres never parted");
}

}  // namespace lahar::validate
