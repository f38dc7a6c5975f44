#include "cases/observers/probes.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "cases/observers/fluid_samples.h"

namespace lahar::cases {

namespace {

constexpr const char* kAxes[] = {"x", "y", "z"};

Label of_probe(const std::string& probe, const std::string& rest) { return {probe + rest, "PROBE" + rest}; }

}  // namespace

Probes::Probes(const Observed& run) : Observer(run), looked_at_(run.simulation.time()) {
  for (const auto& p : run.scene.probes) {
    if (p.kind == scene::ProbeKind::height) declare_level(p);
    if (p.kind == scene::ProbeKind::pressure) declare_pressure(p);
    if (p.kind == scene::ProbeKind::velocity) declare_velocity(p);
    if (p.kind == scene::ProbeKind::force) declare_force(p);
    if (p.kind == scene::ProbeKind::grain) declare_grain(p);
  }
  if (!forces_.empty() && run.simulation.fluid()) run.simulation.fluid()->measure_walls();
  std::vector<std::uint32_t> walls;
  for (const ForceProbe& probe : forces_) walls.push_back(probe.wall);
  if (run.simulation.solids()) run.simulation.solids()->measure_walls(walls);
}

void Probes::declare_level(const scene::Probe& probe) {
  const std::size_t k = levels_.size();
  levels_.push_back({probe.position, 0.0});
  column(of_probe(probe.name, ""), "m",
         "height probe: fill levels of the cells over the point, along z, times the cell size; from the first cell "
         "that is "
         "no wall, until two cells are dry",
         [this, k] { return levels_[k].depth; })
      .peak(of_probe(probe.name, "_peak_m"), "m", "largest depth of the rows")
      .peak_time(of_probe(probe.name, "_peak_time_s"));
  event(of_probe(probe.name, "_arrival_s"), "s", "first row with a depth of half a cell or more",
        [this, k] { return levels_[k].depth >= run_.scene.fluid.cell_size / 2 ? run_.simulation.time() : kUnknown; });
}

void Probes::declare_pressure(const scene::Probe& probe) {
  const std::size_t k = sensors_.size();
  sensors_.push_back({probe.name, probe.position, probe.diameter, probe.time_mean, 0, 0});
  column(
      of_probe(probe.name, ""), "Pa",
      "pressure probe: above ambient, between the centres of the eight cells around the point; the mean over the disc "
      "of a sensor with a diameter; with time_mean the mean since the last row",
      [this, k] { return sensors_[k].reading; })
      .peak(of_probe(probe.name, "_peak_Pa"), "Pa", "largest pressure of the rows")
      .peak_time(of_probe(probe.name, "_peak_time_s"));
}

double Probes::pressure_on(const Sensor& sensor) const {
  return pressure_on_disc(*run_.simulation.fluid(), sensor.point, sensor.diameter);
}

void Probes::declare_velocity(const scene::Probe& probe) {
  const std::size_t k = currents_.size();
  currents_.push_back({probe.position, Vec3::Zero()});
  for (int a = 0; a < 3; ++a)
    column(
        {probe.name + "_" + kAxes[a] + "_m_s", "PROBE_AXIS_m_s"}, "m/s",
        "velocity probe: of the liquid, between the centres of the wet ones of the eight cells around the point; NaN "
        "where all are dry or inside grains",
        [this, k, a] { return currents_[k].velocity[a]; });
  hidden([this, k] { return currents_[k].velocity.norm(); })
      .unknown_at_times()
      .peak(of_probe(probe.name, "_speed_peak_m_s"), "m/s", "largest speed of the rows")
      .peak_time(of_probe(probe.name, "_speed_peak_time_s"));
}

void Probes::declare_force(const scene::Probe& probe) {
  const auto& walls = run_.scene.walls;
  const auto wall = std::find_if(walls.begin(), walls.end(), [&](const auto& w) { return w.name == probe.wall; });
  const std::size_t k = forces_.size();
  forces_.push_back({probe.name, static_cast<std::uint32_t>(wall - walls.begin()), probe.position, {}, {}, {}, {}, {}});
  if (run_.simulation.fluid()) declare_load(k, "fluid", "the liquid", &ForceProbe::fluid);
  if (run_.simulation.solids()) declare_load(k, "grains", "grains and barrier", &ForceProbe::grains);
  hidden([this, k] { return forces_[k].both.force.norm(); })
      .peak(of_probe(probe.name, "_force_peak_N"), "N", "largest force of the rows, of liquid and grains together")
      .peak_time(of_probe(probe.name, "_force_peak_time_s"));
  hidden([this, k] { return forces_[k].both.moment.norm(); })
      .peak(of_probe(probe.name, "_moment_peak_Nm"), "Nm", "largest moment of the rows, of liquid and grains together")
      .peak_time(of_probe(probe.name, "_moment_peak_time_s"));
}

void Probes::declare_grain(const scene::Probe& probe) {
  const dem::Particles& p = run_.simulation.solids()->particles();
  double nearest = std::numeric_limits<double>::infinity();
  Followed followed{probe.name, 0, Vec3::Zero(), Vec3::Zero()};
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double distance = (p.position[i] - probe.position).norm();
    if (p.kind[i] == dem::ParticleKind::grain && distance < nearest) nearest = distance, followed.grain = p.id(i);
  }
  const std::size_t k = followed_.size();
  followed_.push_back(followed);
  for (int a = 0; a < 3; ++a)
    column({probe.name + "_" + kAxes[a] + "_m", "PROBE_AXIS_m"}, "m",
           "grain probe: centre of the grain that was nearest to the point at the start; NaN once it is gone",
           [this, k, a] { return followed_[k].position[a]; });
  for (int a = 0; a < 3; ++a)
    column({probe.name + "_" + kAxes[a] + "_m_s", "PROBE_AXIS_m_s"}, "m/s", "grain probe: velocity of that grain",
           [this, k, a] { return followed_[k].velocity[a]; });
  hidden([this, k] { return followed_[k].velocity.norm(); })
      .unknown_at_times()
      .peak(of_probe(probe.name, "_speed_peak_m_s"), "m/s", "largest speed of the rows")
      .peak_time(of_probe(probe.name, "_speed_peak_time_s"));
}

void Probes::declare_load(std::size_t probe, const std::string& source, const std::string& who,
                          Load ForceProbe::*load) {
  const std::string& name = forces_[probe].name;
  const auto declare = [&](const std::string& what, const std::string& unit, const std::string& text,
                           Vec3 Load::*vector) {
    for (int a = 0; a < 3; ++a) {
      const std::string rest = "_" + source + "_" + what + "_";
      column({name + rest + kAxes[a] + "_" + unit, "PROBE" + rest + "AXIS_" + unit}, unit, text,
             [this, probe, load, vector, a] { return (forces_[probe].*load.*vector)[a]; });
    }
  };
  declare("force", "N", "force of " + who + " on the wall, mean since the last row", &Load::force);
  declare("moment", "Nm", "moment of that force about the probe's point, mean since the last row", &Load::moment);
}

void Probes::after_step() {
  const double now = run_.simulation.time();
  for (Sensor& sensor : sensors_)  // by the time of the fluid: its step may just have changed
    if (sensor.time_mean) sensor.since += (now - looked_at_) * pressure_on(sensor);
  looked_at_ = now;
  // A reflection books what walls get in the coming step, which has another length where the step has just changed.
  if (const FluidView* fluid = run_.simulation.fluid()) fluid_span_ += fluid->units().time_step;
  if (!run_.simulation.solids()) return;
  for (auto first = forces_.begin(); first != forces_.end(); ++first) {
    const auto is_beside = [&](const ForceProbe& probe) { return probe.wall == first->wall; };
    if (std::any_of(forces_.begin(), first, is_beside)) continue;  // several may look at one wall
    const dem::WallImpulse got = run_.simulation.solids()->take_impulse_on(first->wall);
    for (auto probe = first; probe != forces_.end(); ++probe)
      if (is_beside(*probe)) probe->grains_since.force += got.linear, probe->grains_since.moment += got.angular;
  }
}

Probes::Load Probes::mean_load(const Load& sum, double span, const Vec3& point) {
  const double rate = span > 0 ? 1 / span : 0.0;
  const Vec3 force = rate * sum.force, moment = rate * sum.moment - point.cross(force);
  return {force, moment};
}

void Probes::sample(double interval) {
  for (Level& level : levels_)
    level.depth = depth_over(*run_.simulation.fluid(), level.point, run_.scene.domain.upper.z());
  const auto liquid_velocity = [&](const lbm::WetCell& cell) { return run_.simulation.liquid_velocity(cell); };
  for (Current& current : currents_)
    current.velocity = velocity_at(*run_.simulation.fluid(), liquid_velocity, current.point);
  for (Sensor& sensor : sensors_) {
    sensor.reading = sensor.time_mean && interval > 0 ? sensor.since / interval : pressure_on(sensor);
    sensor.since = 0;
  }
  for (Followed& f : followed_) {
    const dem::Particles& p = run_.simulation.solids()->particles();
    const dem::ParticleIndex i = p.index(f.grain);
    f.position = f.velocity = Vec3::Constant(kUnknown);
    if (p.state[i] != dem::ParticleState::removed) f.position = p.position[i], f.velocity = p.velocity[i];
  }
  for (ForceProbe& probe : forces_) {
    probe.both = {};
    const auto add = [&](Load& mean, const Load& sum, double span) {
      mean = mean_load(sum, span, probe.point);
      probe.both.force += mean.force, probe.both.moment += mean.moment;
    };
    if (const FluidView* fluid = run_.simulation.fluid()) {
      const lbm::WallLoad& now = fluid->wall_loads()[probe.wall];
      add(probe.fluid, {now.impulse - probe.fluid_before.force, now.angular_impulse - probe.fluid_before.moment},
          fluid_span_);
      probe.fluid_before = {now.impulse, now.angular_impulse};
    }
    if (run_.simulation.solids()) add(probe.grains, probe.grains_since, interval);
    probe.grains_since = {};
  }
  fluid_span_ = 0;
}

void Probes::transfer(Archive& archive) {
  // By number: names are the user's, and may be those of each other's parts.
  for (std::size_t k = 0; k < forces_.size(); ++k) {
    archive.part(fmt::format("force_{}_fluid_before", k), forces_[k].fluid_before);
    archive.part(fmt::format("force_{}_grains_since", k), forces_[k].grains_since);
  }
  for (std::size_t k = 0; k < sensors_.size(); ++k) archive.value(fmt::format("sensor_{}_since", k), sensors_[k].since);
  archive.value("fluid_span", fluid_span_);
  if (archive.loading()) looked_at_ = run_.simulation.time();
  for (std::size_t k = 0; k < followed_.size(); ++k) archive.value(fmt::format("grain_{}", k), followed_[k].grain);
}

}  // namespace lahar::cases
