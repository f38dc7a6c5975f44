// A post as a cantilever, and a hinged post that its retaining cable holds, against statics.
#include "barrier/post.h"

#include <cmath>
#include <numbers>

#include "barrier/dissipator.h"
#include "barrier/link.h"
#include "barrier/retaining.h"
#include "cases/validate/dem/ledger_watch.h"
#include "cases/validate/dem/solid_scenes.h"
#include "cases/validate/entry.h"
#include "dem/time_step.h"

namespace lahar::validate {

namespace {

constexpr double kTube = 0.0603, kWall = 0.005;  // m, a common steel tube
constexpr double kWire = 0.0061;                 // m, of the cable

barrier::PostSection tube() {
  const double r = kTube / 2, bore = r - kWall, pi = std::numbers::pi;
  return {.youngs_modulus = 210e9,
          .area = pi * (r * r - bore * bore),
          .second_moment = 0.25 * pi * (std::pow(r, 4) - std::pow(bore, 4)),
          .density = 7850,
          .damping_ratio = 0.02};
}

barrier::PostSpec upright(double length, barrier::FootJoint foot) {
  barrier::PostSpec post;
  post.head = {0, 0, length};
  post.diameter = kTube;
  post.section = tube();
  post.foot_joint = foot;
  return post;
}

struct Standing {
  barrier::Post post;
  barrier::Retaining cable;
  dem::Solids solids;
};

/// Anchored upslope at the distance `anchor` from the foot; no cable at 0.
Standing stand(const barrier::PostSpec& spec, double anchor) {
  dem::Particles p;
  dem::Bonds b;
  barrier::Post post = add_post(spec, p, b);
  barrier::Retaining cable;
  if (anchor > 0) {
    const dem::BondSort wire = barrier::wire_bond(8e11, kWire / 2);  // Li, Zhao & Kwan 2020, Table 4
    const double stiffness = wire.axial.stiffness[0] * std::numbers::pi * kWire * kWire / 4;
    const int sort = b.add_sort(wire), tie = b.add_sort(barrier::link_bond(stiffness, kWire / 2));
    cable = add_retaining(post, Vec3(-anchor, 0, 0), {}, {kWire, 7800, 0}, {sort, sort}, tie, 1, p, b);
  }
  const double step = 0.7 * dem::bond_time_step(b, p);
  return {
      post, cable, {std::move(p), std::move(b), one_material(1e10, 0.3, 0, 1), {}, solids_options(step, {0, 0, 0})}};
}

/// Pulls at the head along x until a drag of this rate (1/s) has brought all to rest; watches the ledger.
Row load(Standing& s, double force, double rate, double time, const std::string& what) {
  LedgerWatch watch(s.solids);
  for (int k = 0; s.solids.time() < time; ++k) {
    set_drag(s.solids.particles(), rate);
    s.solids.particles().external_force.add(s.post.head(), Vec3(force, 0, 0));
    s.solids.advance(10);
    if (k % 10 == 0) watch.look();
  }
  return watch.row(what);
}

void ask_cantilever(double length, std::vector<Row>& rows) {
  const barrier::PostSpec spec = upright(length, barrier::FootJoint::fixed);
  const double bending = tube().youngs_modulus * tube().second_moment, stiffness = 3 * bending / std::pow(length, 3);
  const double frequency = std::pow(1.87510407, 2) / (2 * std::numbers::pi * length * length) *
                           std::sqrt(bending / (tube().density * tube().area));
  Standing s = stand(spec, 0);
  const double force = 1e-3 * length * stiffness;
  const Row ledger = load(s, force, 4 * std::numbers::pi * frequency, 3 / frequency, "clamped post");
  rows.push_back(relative_row("clamped post: load / deflection, N/m",
                              force / s.solids.particles().position.x[s.post.head()], stiffness, 0.01));
  rows.push_back(relative_row("clamped post: force of the foot, N", -foot_reaction(s.post, s.solids.particles()).x(),
                              force, 0.01));
  rows.push_back(relative_row("clamped post: moment of the foot, N m", -foot_moment(s.post, s.solids.particles()).y(),
                              force * length, 0.01));
  rows.push_back(ledger);
}

/// Moments about the foot: the cable's pull along x holds the load, its pull along z presses on the foot.
void ask_held(double length, double anchor, std::vector<Row>& rows) {
  Standing s = stand(upright(length, barrier::FootJoint::hinged), anchor);
  constexpr double force = 200;  // N: stretches the cable by 0.3 %
  const Row ledger = load(s, force, 150, 0.25, "hinged post");
  const dem::Particles& p = s.solids.particles();
  const Vec3 head = p.position[s.post.head()], foot = p.position[s.post.wire.first_bead];
  const Vec3 back = (Vec3(-anchor, 0, 0) - head).normalized(), from = head - foot;
  // As the structure stands under its load.
  const double tension = force * from.z() / (back.z() * from.x() - back.x() * from.z());
  rows.push_back(relative_row("hinged post: tension of the cable, N",
                              s.solids.bonds().axial_force[s.cable.wire.first_bond], tension, 0.01));
  rows.push_back(relative_row("hinged post: tension by the geometry at rest, N",
                              s.solids.bonds().axial_force[s.cable.wire.first_bond],
                              force * std::hypot(length, anchor) / anchor, 0.01));
  rows.push_back(
      relative_row("hinged post: pressure on the foot, N", foot_reaction(s.post, p).z(), -tension * back.z(), 0.01));
  rows.push_back(absolute_row("hinged post: moment of the foot, of load times height",
                              foot_moment(s.post, p).norm() / (force * length), 0, 0.01));
  rows.push_back(ledger);
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  ask_cantilever(context.quick ? 0.9 : 1.2, rows);
  ask_held(context.quick ? 0.6 : 1.2, context.quick ? 0.6 : 1.2, rows);
  return rows;
}

}  // namespace

Entry post() { return {"barrier.post", {"beam theory, F L^3 / (3 E I); statics of a hinged post and its cable"}, run}; }

}  // namespace lahar::validate
