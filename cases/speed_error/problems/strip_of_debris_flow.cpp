#include "cases/speed_error/problems/strip_of_debris_flow.h"

#include <array>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <string_view>

#include "barrier/response.h"
#include "cases/assembly/load.h"
#include "cases/assembly/simulation.h"
#include "cases/files/case_file.h"
#include "cases/speed_error/reference_run.h"
#include "core/parallel.h"

namespace lahar::validate {

namespace {

constexpr std::string_view kThreads = "threads=";

struct Centres {
  double water = 0, grains = 0, water_energy = 0, grain_energy = 0;
};

Centres centres_of(cases::Simulation& simulation, double density) {
  Centres c;
  double volume = 0, mass = 0;
  simulation.fluid()->for_each_wet_cell([&](const lbm::WetCell& cell) {
    volume += cell.liquid_volume, c.water += cell.liquid_volume * cell.centre.x();
    c.water_energy += 0.5 * density * cell.liquid_volume * cell.velocity.squaredNorm();
  });
  const dem::Particles& p = simulation.solids()->particles();
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.kind[i] != dem::ParticleKind::grain) continue;
    mass += p.mass[i], c.grains += p.mass[i] * p.position.x[i];
    c.grain_energy += 0.5 * p.mass[i] * p.velocity[i].squaredNorm();
  }
  c.water /= volume, c.grains /= mass;
  return c;
}

}  // namespace

StripFigures run_strip(const std::vector<std::string>& overrides, double until) {
  constexpr int every = 5;  // fluid steps between two looks at the net
  Overrides all;
  std::optional<ThreadLimit> limit;
  for (const std::string& o : overrides)
    if (o.starts_with(kThreads))
      limit.emplace(std::stoi(o.substr(kThreads.size())));
    else
      all.push_back(o);
  const scene::Scene scene = scene::load(cases::case_file("debris_flow/strip.toml"), all);
  const auto simulation = cases::build_simulation(scene);
  const Centres start = centres_of(*simulation, scene.fluid.density);
  StripFigures found;
  double weight = 0;
  const auto began = std::chrono::steady_clock::now();
  for (int step = 1; simulation->time() < until; ++step) {
    simulation->advance();
    if (simulation->net() == nullptr || step % every != 0) continue;
    const auto now = barrier::response(*simulation->net(), simulation->solids()->particles(),
                                       simulation->solids()->bonds(), scene.gravity.vector());
    found.net_force += simulation->time_step() * now[barrier::Component::barrier].force_sum;
    weight += simulation->time_step();
    found.elongation = std::max(found.elongation, now.elongation);
  }
  found.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  if (weight > 0) found.net_force /= weight;
  const Centres end = centres_of(*simulation, scene.fluid.density);
  found.water = end.water - start.water, found.grains = end.grains - start.grains;
  found.water_energy = end.water_energy, found.grain_energy = end.grain_energy;
  return found;
}

double error_of(const StripFigures& found, const StripFigures& known) {
  double squares = 0;
  int count = 0;
  for (double StripFigures::*figure :
       std::array{&StripFigures::water, &StripFigures::grains, &StripFigures::water_energy, &StripFigures::grain_energy,
                  &StripFigures::net_force, &StripFigures::elongation})
    if (known.*figure != 0) squares += std::pow(found.*figure / known.*figure - 1, 2), ++count;
  return std::sqrt(squares / count);
}

std::vector<Trial> strip_trials(const Overrides& always, double until, const Overrides& finest,
                                const std::vector<Overrides>& turned) {
  const auto joined = [always](const Overrides& more) {
    Overrides all = always;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const ReferenceRun<StripFigures> known([=] { return run_strip(joined(finest), until); });
  std::vector<Trial> trials;
  const auto add = [&](const Overrides& knob) {
    Trial t;
    for (const std::string& o : knob) {
      const std::size_t equals = o.find('='), dot = o.rfind('.', equals);
      t.turned.push_back(
          {o.substr(dot == std::string::npos ? 0 : dot + 1, equals - (dot == std::string::npos ? 0 : dot + 1)),
           o.substr(equals + 1)});
    }
    t.run = [=] {
      const StripFigures& reference = known.result();
      const StripFigures found = run_strip(joined(knob), until);
      return Measurement{error_of(found, reference), found.seconds};
    };
    trials.push_back(std::move(t));
  };
  add({});
  for (const Overrides& knob : turned) add(knob);
  return trials;
}

}  // namespace lahar::validate
