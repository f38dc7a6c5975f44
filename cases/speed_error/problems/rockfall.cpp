// A ball of 100 kg from 8 m on a net of 5 x 5 rings on braked cables: its depth, when it is deepest, and how far the
// dissipators are drawn out, against the shortest time step. The largest tension of a cable is no such figure: one
// peak, which chance moves by 5 % at any time step.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/rockfall/rockfall.h"
#include "cases/speed_error/problems/problems.h"
#include "cases/speed_error/reference_run.h"

namespace lahar::validate {

namespace {

cases::Rockfall small_net() {
  cases::Rockfall r;
  r.net_width = 5 * r.ring_pitch;
  r.ball_diameter = 0.45, r.ball_mass = 100;
  r.drop_height = 8;
  r.activation_force = 6e3;
  r.settling_time = 0.04;
  r.duration = 0.12;
  r.sample_interval = 2e-4;
  return r;
}

cases::RockfallResult fall(const cases::Rockfall& r) {
  return cases::run_rockfall(r, [](double) { return true; });
}

double error_of(const cases::RockfallResult& found, const cases::RockfallResult& known) {
  return std::max({std::abs(found.depth / known.depth - 1), std::abs(found.lowest_time / known.lowest_time - 1),
                   std::abs(found.brake_elongation / known.brake_elongation - 1)});
}

/// Scales of the stiffnesses, and the step that they allow, s.
struct Softness {
  double contacts, bonds, time_step;
};

cases::Rockfall softened(const Softness& s) {
  cases::Rockfall r = small_net();
  r.youngs_modulus *= s.contacts, r.ball_modulus *= s.contacts;
  r.ring_stiffness *= s.bonds, r.cable_stiffness *= s.bonds;
  for (double& k : r.dissipator_stiffness) k *= s.bonds;
  r.time_step = s.time_step;
  return r;
}

}  // namespace

Problem rockfall_problem(bool quick) {
  Problem p{"rockfall",
            "largest of the errors of depth, time of the deepest point and ways of the dissipators",
            quick ? "finest-step (1.5 us)" : "finest-step (0.75 us)",
            "60 beads a ring, 3 us, wires bead by bead, full stiffness",
            {}};
  const ReferenceRun<cases::RockfallResult> finest([quick] {
    cases::Rockfall r = small_net();
    r.time_step = quick ? 1.5e-6 : 0.75e-6;
    return fall(r);
  });
  const auto trial = [&](std::vector<Knob> turned, const cases::Rockfall& r) {
    return Trial{std::move(turned), [finest, r] {
                   const cases::RockfallResult& known = finest.result();
                   return timed([&] { return error_of(fall(r), known); });
                 }};
  };
  p.trials.push_back(trial({}, small_net()));
  for (const double step : {1.5e-6, 3.5e-6}) {
    if (quick && step < 3e-6) continue;
    cases::Rockfall r = small_net();
    r.time_step = step;
    p.trials.push_back(trial({{"time_step_us", fmt::format("{:g}", 1e6 * step)}}, r));
  }
  for (const std::int64_t beads : {45, 52}) {
    if (quick && beads > 45) continue;
    cases::Rockfall r = small_net();
    r.beads_per_ring = beads;
    p.trials.push_back(trial({{"beads_per_ring", fmt::to_string(beads)}}, r));
  }
  for (const Softness& s : {Softness{0.1, 1, 4.3e-6}, Softness{0.1, 0.5, 6e-6}, Softness{0.01, 0.1, 13e-6}}) {
    std::vector<Knob> turned{{"contact_modulus_scale", fmt::format("{:g}", s.contacts)}};
    if (s.bonds < 1) turned.push_back({"bond_stiffness_scale", fmt::format("{:g}", s.bonds)});
    turned.push_back({"time_step_us", fmt::format("{:g}", 1e6 * s.time_step)});
    p.trials.push_back(trial(turned, softened(s)));
  }
  if (quick) return p;
  cases::Rockfall r = small_net();
  r.capsules = true;
  p.trials.push_back(trial({{"wire_contacts", "capsules"}}, r));
  return p;
}

}  // namespace lahar::validate
