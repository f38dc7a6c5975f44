#include "cases/observers/measurements.h"

#include <algorithm>
#include <cmath>

namespace lahar::cases {

namespace {

/// Profiles along x: volume of the mixture, and momentum of the liquid, per column of cells across the flow.
struct Profiles {
  std::vector<double> volume, liquid, momentum;
};

double& at(std::vector<double>& v, std::size_t k) {
  if (k >= v.size()) v.resize(k + 1, 0.0);
  return v[k];
}

}  // namespace

template <class Real>
Measurements<Real>::Measurements(const scene::Scene& scene, coupling::CoupledStep<Real>& step, const barrier::Net* net,
                                 SeriesWriter& series)
    : scene_(scene), step_(step), net_(net), series_(series), section_(scene::section_of(scene)) {
  const Vec3 g = scene.gravity.vector();
  up_ = g.norm() > 0 ? Vec3(-g.normalized()) : Vec3(Vec3::UnitZ());
  datum_height_ = up_.dot(Vec3(section_.value_or(0.0), 0, scene.measure.energy_datum_z));
  if (step_.solids()) crossed_.assign(step_.solids()->particles().size(), 0);
  if (net_) topology_ = barrier::find_topology(*net_, step_.solids()->particles(), step_.solids()->bonds());
  declare_columns();
  probes_.emplace(scene_, step_, series_);
  sections_.emplace(scene_, step_, series_, up_, datum_height_);
}

template <class Real>
void Measurements<Real>::declare_columns() {
  if (step_.fluid()) {
    series_.declare("liquid_mass_kg", "kg", "liquid in the domain");
    series_.declare("outflow_mass_kg", "kg", "liquid that left through open faces");
    series_.declare("liquid_mass_drift_rel", "1", "in the domain + left - start, over start");
    series_.declare("fluid_kinetic_J", "J", "kinetic energy of the liquid");
    series_.declare("fluid_potential_J", "J", "potential energy of the liquid about the datum");
    series_.declare("front_x_m", "m", "fluid front: mean over the width of the foremost bed cell more than half full");
    series_.declare("wet_cells", "1", "liquid and interface cells");
    series_.declare("max_speed_lu", "1", "largest speed in lattice units at the last look");
    if (scene_.fluid.adaptive_time_step) series_.declare("fluid_time_step_s", "s", "length of the fluid's last step");
    if (section_) series_.declare("section_power_W", "W", "energy flux of the liquid through the outflow section");
  }
  if (step_.solids()) {
    series_.declare("grains_kinetic_J", "J", "translation and rotation of the grains");
    series_.declare("grains_potential_J", "J", "potential energy of the grains about the datum");
    series_.declare("grains_front_x_m", "m", "foremost point of the grains");
    series_.declare("grains_passed_kg", "kg", "mass of grains beyond the outflow section or gone");
  }
  if (net_) {
    for (const auto c : barrier::all_components) {
      if (!is_reported(c, *net_)) continue;
      const std::string name(barrier::name(c));
      series_.declare(name + "_force_sum_N", "N", "sum over bonds of the force's magnitude");
      series_.declare(name + "_max_tension_N", "N", "largest tension of a bond");
    }
    series_.declare("barrier_elongation_m", "m", "largest displacement of a bead along the flow");
    series_.declare("barrier_elastic_J", "J", "elastic energy of all bonds");
    series_.declare("dissipator_elongation_m", "m", "largest elongation of a dissipator");
    series_.declare("wet_beads", "1", "beads of rings and cables in the fluid");
  }
}

template <class Real>
double Measurements<Real>::height(const Vec3& p) const {
  return up_.dot(p) - datum_height_;
}

template <class Real>
FlowFigures Measurements<Real>::look_at_fluid() {
  FlowFigures f;
  const double dx = scene_.fluid.cell_size, rho = scene_.fluid.density, g = scene_.gravity.magnitude;
  const Vec3 lower = scene_.domain.lower;
  const double outflow_x = section_.value_or(0.0) + scene_.measure.outflow_distance;
  Profiles profile;
  std::vector<double> foremost;
  step_.fluid()->for_each_wet_cell([&](const lbm::WetCell& c) {
    const double mass = rho * c.liquid_volume, energy = 0.5 * c.velocity.squaredNorm() + g * height(c.centre);
    f.kinetic += 0.5 * mass * c.velocity.squaredNorm();
    f.potential += mass * g * height(c.centre);
    f.momentum += mass * c.velocity;
    const auto x = static_cast<std::size_t>(std::max(0.0, (c.centre.x() - lower.x()) / dx));
    at(profile.volume, x) += c.fill_level * dx * dx * dx;
    at(profile.liquid, x) += c.liquid_volume;
    at(profile.momentum, x) += c.liquid_volume * c.velocity.x();
    if (c.fill_level > 0.5 && c.centre.z() - lower.z() < dx) {
      const auto y = static_cast<std::size_t>(std::max(0.0, (c.centre.y() - lower.y()) / dx));
      at(foremost, y) = std::max(at(foremost, y), c.centre.x() + dx / 2 - lower.x());
    }
    if (section_ && std::abs(c.centre.x() - outflow_x) <= dx / 2) {
      f.outflow_rate += mass * c.velocity.x() / dx;
      f.outflow_power += mass * energy * c.velocity.x() / dx;
    }
  });
  const double width = scene_.domain.upper.y() - lower.y();
  for (const double x : foremost) f.front += x * dx / width;
  f.front += lower.x();
  for (std::size_t x = 0; x < profile.volume.size(); ++x) {
    const double depth = profile.volume[x] / (dx * width);
    if (depth <= f.deepest || profile.liquid[x] <= 0) continue;
    f.deepest = depth;
    f.deepest_speed = profile.momentum[x] / profile.liquid[x];
  }
  return f;
}

template <class Real>
void Measurements<Real>::sample() {
  std::vector<double> row;
  const double time = step_.time(), interval = time - last_time_;
  if (step_.solids()) sample_grains(row, interval);
  std::vector<double> grains;
  grains.swap(row);
  if (step_.fluid()) sample_fluid(row, interval);
  row.insert(row.end(), grains.begin(), grains.end());
  if (net_) sample_barrier(row);
  probes_->sample(row, interval, found_);
  sections_->sample(row, interval, found_);
  series_.append(time, row);
  last_time_ = time;
}

template <class Real>
void Measurements<Real>::sample_fluid(std::vector<double>& row, double interval) {
  auto& fluid = *step_.fluid();
  const FlowFigures f = look_at_fluid();
  row.insert(row.end(), {fluid.liquid_mass(), fluid.outflow_mass(), fluid.mass_drift(), f.kinetic, f.potential, f.front,
                         static_cast<double>(fluid.wet_cells()), fluid.max_speed_lu()});
  if (scene_.fluid.adaptive_time_step) row.push_back(fluid.units().time_step);
  auto& largest_drift = found_["liquid_mass_drift_rel"];
  largest_drift = std::max(largest_drift, std::abs(fluid.mass_drift()));
  auto& speed = found_["max_speed_lu"];
  speed = std::max(speed, fluid.max_speed_lu());
  if (!section_) return;
  row.push_back(f.outflow_power);
  fluid_energy_out_ += f.outflow_power * interval;
  fluid_mass_passed_ += f.outflow_rate * interval;
  note_arrivals(f);
  note_inflow(f);
}

template <class Real>
void Measurements<Real>::note_arrivals(const FlowFigures& f) {
  if (f.front >= *section_) found_.try_emplace("front_arrival_s", step_.time());
}

/// The energy of the flow is taken when the front has come within the inflow distance of the section (paper, 4.4).
template <class Real>
void Measurements<Real>::note_inflow(const FlowFigures& f) {
  if (f.front < *section_ - scene_.measure.inflow_distance || found_.contains("e_in_kJ")) return;
  found_["e_in_kJ"] = (f.kinetic + f.potential + grain_energy_) / 1000;
  const double g = -scene_.gravity.vector().z();
  if (f.deepest <= 0 || g <= 0) return;
  found_["froude_deepest_section"] = f.deepest_speed / std::sqrt(g * f.deepest);
  found_["depth_at_inflow_m"] = f.deepest;
  const double mass = step_.fluid()->liquid_mass();
  if (mass > 0) found_["froude_mean_speed"] = f.momentum.x() / mass / std::sqrt(g * f.deepest);
}

template <class Real>
void Measurements<Real>::sample_grains(std::vector<double>& row, double) {
  const auto& p = step_.solids()->particles();
  const double g = scene_.gravity.magnitude;
  double kinetic = 0, potential = 0, front = scene_.domain.lower.x(), passed = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.kind[i] != dem::ParticleKind::grain) continue;
    const double move =
        0.5 * p.mass[i] * p.velocity[i].squaredNorm() + 0.5 * p.inertia[i] * p.angular_velocity[i].squaredNorm();
    const double fall = p.mass[i] * g * height(p.position[i]);
    const bool gone = p.state[i] == dem::ParticleState::removed;
    if (!gone) {
      kinetic += move, potential += fall;
      front = std::max(front, p.position.x[i] + p.radius[i]);
    }
    if (!section_) continue;
    const bool beyond = gone || p.position.x[i] > *section_ + scene_.measure.outflow_distance;
    if (beyond && !crossed_[i]) {
      crossed_[i] = 1;
      grain_energy_out_ += move + fall;
    }
    if (crossed_[i]) passed += p.mass[i];
  }
  row.insert(row.end(), {kinetic, potential, front, passed});
  grain_energy_ = kinetic + potential;
  grain_front_ = front;
  if (section_ && front >= *section_) found_.try_emplace("particle_arrival_s", step_.time());
}

template <class Real>
void Measurements<Real>::sample_barrier(std::vector<double>& row) {
  const auto& solids = *step_.solids();
  const auto r = barrier::response(*net_, solids.particles(), solids.bonds(), scene_.gravity.vector());
  const auto peak = [&](const std::string& name, double value) {
    auto& p = found_[name];
    p = std::max(p, value);
  };
  times_.push_back(step_.time());
  for (std::size_t c = 0; c < barrier::all_components.size(); ++c) {
    if (!is_reported(barrier::all_components[c], *net_)) continue;
    const auto& part = r[barrier::all_components[c]];
    const std::string name(barrier::name(barrier::all_components[c]));
    row.insert(row.end(), {part.force_sum, part.max_tension});
    force_sums_[c].push_back(part.force_sum / 1000);
    peak("peak_" + name + "_sum_kN", part.force_sum / 1000);
    peak("peak_" + name + "_tension_kN", part.max_tension / 1000);
  }
  const double elastic = r[barrier::Component::barrier].energy.elastic();
  row.insert(row.end(),
             {r.elongation, elastic, r.largest_dissipator_elongation, static_cast<double>(step_.wet_beads())});
  peak("max_elongation_m", r.elongation);
  peak("max_dissipator_elongation_m", r.largest_dissipator_elongation);
  peak("peak_barrier_elastic_J", elastic);
}

/// How far down a grain may be and still count as retained: the net's section, or the foremost bead where the net has
/// bulged beyond it.
template <class Real>
double Measurements<Real>::retention_limit() const {
  double limit = *section_;
  const auto& p = step_.solids()->particles();
  for (std::size_t i = 0; net_ && i < p.size(); ++i)
    if (p.kind[i] == dem::ParticleKind::bead) limit = std::max(limit, p.position.x[i] + p.radius[i]);
  return limit;
}

template <class Real>
std::map<std::string, double> Measurements<Real>::metrics() {
  auto all = found_;
  if (step_.fluid() && step_.solids()) all["momentum_audit_rel"] = step_.audit().relative();
  if (step_.fluid()) {
    all["liquid_mass_start_kg"] = step_.fluid()->liquid_mass() + step_.fluid()->outflow_mass() -
                                  step_.fluid()->inflow_mass() - step_.fluid()->rescaled_mass();
    if (scene_.fluid.adaptive_time_step) {
      const lbm::TimeStepRecord& record = step_.fluid()->time_step_record();
      all["fluid_time_step_min_s"] = record.shortest;
      all["fluid_time_step_max_s"] = record.longest;
      all["fluid_time_step_changes"] = static_cast<double>(record.changes);
      all["fluid_steps"] = static_cast<double>(step_.fluid()->steps());
      all["liquid_rescaled_kg"] = step_.fluid()->rescaled_mass();
    }
    if (!step_.fluid()->options().inflows.empty()) all["liquid_inflow_kg"] = step_.fluid()->inflow_mass();
    if (const double returned = step_.fluid()->account().walls.returned; returned > 0)
      all["liquid_wall_balance_kg"] = returned * step_.fluid()->units().mass();
    all["speed_limited_cells_max"] = static_cast<double>(step_.fluid()->limited_cells());
    all["liquid_left_kg"] = step_.fluid()->outflow_mass();
    all["liquid_pooled_kg"] = step_.fluid()->account().pooled_total * step_.fluid()->units().mass();
    if (section_) all["liquid_passed_kg"] = fluid_mass_passed_;
  }
  if (!section_ || !step_.solids()) return all;
  if (step_.fluid()) all["e_out_kJ"] = (fluid_energy_out_ + grain_energy_out_) / 1000;
  const auto& p = step_.solids()->particles();
  const double limit = retention_limit();
  const auto is_kept = [&](std::size_t i) {
    return p.state[i] != dem::ParticleState::removed && p.position.x[i] <= limit;
  };
  double mass = 0, kept = 0, smallest = 1e300, largest = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.kind[i] != dem::ParticleKind::grain) continue;
    mass += p.mass[i];
    kept += is_kept(i) ? p.mass[i] : 0.0;
    smallest = std::min(smallest, p.radius[i]), largest = std::max(largest, p.radius[i]);
  }
  if (mass <= 0) return all;
  all["retained_mass_ratio"] = kept / mass;
  if (!(largest > smallest)) return all;
  double count[2] = {0, 0}, held[2] = {0, 0};
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.kind[i] != dem::ParticleKind::grain) continue;
    const std::size_t size = p.radius[i] > 0.5 * (smallest + largest) ? 1 : 0;
    count[size] += 1, held[size] += is_kept(i) ? 1 : 0;
  }
  if (count[0] > 0) all["retained_small_grains_ratio"] = held[0] / count[0];
  if (count[1] > 0) all["retained_large_grains_ratio"] = held[1] / count[1];
  return all;
}

template <class Real>
std::string Measurements<Real>::lost_links() const {
  if (!net_) return {};
  const auto& solids = *step_.solids();
  return barrier::first_difference(*topology_, barrier::find_topology(*net_, solids.particles(), solids.bonds()));
}

template <class Real>
std::vector<ChartSeries> Measurements<Real>::cable_chart() const {
  std::vector<ChartSeries> lines;
  if (!net_) return lines;
  for (std::size_t c = 0; c < 4; ++c) {
    ChartSeries line;
    line.name = std::string(barrier::name(barrier::all_components[c]));
    std::replace(line.name.begin(), line.name.end(), '_', ' ');
    line.x = times_;
    line.y = force_sums_[c];
    if (c == 3) line.dash = Dash::dashed;  // the left cable, often pulled the same way, shows in between
    lines.push_back(std::move(line));
  }
  return lines;
}

template <class Real>
void Measurements<Real>::transfer(Archive& archive) {
  archive.value("last_time", last_time_);
  archive.list_of("crossed", crossed_, crossed_.size());
  archive.value("grain_energy_out", grain_energy_out_);
  archive.value("fluid_energy_out", fluid_energy_out_);
  archive.value("fluid_mass_passed", fluid_mass_passed_);
  archive.value("grain_front", grain_front_);
  archive.value("grain_energy", grain_energy_);
  archive.numbers("found", found_);
  archive.list("times", times_);
  for (std::size_t c = 0; c < force_sums_.size(); ++c) archive.list("force_sums_" + std::to_string(c), force_sums_[c]);
  archive.part("probes", *probes_);
  archive.part("sections", *sections_);
}

template class Measurements<float>;
template class Measurements<double>;

}  // namespace lahar::cases
