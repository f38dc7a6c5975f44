#include "cases/observers/sections.h"

#include <cmath>

#include "cases/observers/peaks.h"

namespace lahar::cases {

bool SectionFrame::holds(const Vec3& p) const {
  return std::abs((p - centre).dot(across)) <= half_width && std::abs((p - centre).dot(up)) <= half_height;
}

SectionFrame frame_of(const scene::FluxSection& section, const scene::Domain& domain) {
  SectionFrame f;
  f.centre = section.point;
  f.normal = section.normal.normalized();
  const Vec3 sideways = Vec3::UnitZ().cross(f.normal);
  f.across = sideways.norm() > 1e-6 ? Vec3(sideways.normalized()) : Vec3(Vec3::UnitX());
  f.up = f.normal.cross(f.across);
  const double everything = (domain.upper - domain.lower).norm();
  f.half_width = section.width > 0 ? section.width / 2 : everything;
  f.half_height = section.height > 0 ? section.height / 2 : everything;
  return f;
}

namespace {

/// Part of [-half, half] along a direction from the centre that the domain reaches.
std::pair<double, double> reach(const SectionFrame& f, const Vec3& direction, double half, const scene::Domain& d) {
  double low = 1e300, high = -1e300;
  for (int k = 0; k < 8; ++k) {
    const Vec3 corner(k & 1 ? d.upper.x() : d.lower.x(), k & 2 ? d.upper.y() : d.lower.y(),
                      k & 4 ? d.upper.z() : d.lower.z());
    low = std::min(low, (corner - f.centre).dot(direction)), high = std::max(high, (corner - f.centre).dot(direction));
  }
  return {std::max(low, -half), std::min(high, half)};
}

}  // namespace

template <class Real>
Flux liquid_flux(const lbm::Fluid<Real>& fluid, const SectionFrame& frame, const scene::Domain& domain, const Vec3& up,
                 double datum) {
  const double spacing = fluid.units().cell_size / 2, rho = fluid.options().density, g = fluid.options().gravity.norm();
  const auto [left, right] = reach(frame, frame.across, frame.half_width, domain);
  const auto [bottom, top] = reach(frame, frame.up, frame.half_height, domain);
  const int columns = std::max(1, static_cast<int>(std::ceil((right - left) / spacing - 1e-6)));
  const int rows = std::max(1, static_cast<int>(std::ceil((top - bottom) / spacing - 1e-6)));
  const double wide = (right - left) / columns, high = (top - bottom) / rows;
  const double cell_volume = std::pow(fluid.units().cell_size, 3);
  Flux flux;
  for (int i = 0; i < columns; ++i)
    for (int k = 0; k < rows; ++k) {
      const Vec3 p = frame.centre + (left + (i + 0.5) * wide) * frame.across + (bottom + (k + 0.5) * high) * frame.up;
      if (!domain.contains(p)) continue;
      for (const double side : {-0.5, 0.5}) {  // a plane between two layers of cells takes half of each
        const auto cell = fluid.cell_at(p + side * spacing * frame.normal);
        if (!cell) continue;
        const double share = 0.5 * cell->liquid_volume / cell_volume * wide * high;
        const double volume = cell->velocity.dot(frame.normal) * share;
        flux.volume += volume;
        flux.energy +=
            volume * (0.5 * rho * cell->velocity.squaredNorm() + rho * g * (up.dot(p) - datum) + cell->pressure);
      }
    }
  return flux;
}

template <class Real>
Sections<Real>::Sections(const scene::Scene& scene, coupling::CoupledStep<Real>& step, SeriesWriter& series,
                         const Vec3& up, double datum)
    : scene_(scene), step_(step), up_(up), datum_(datum) {
  for (const auto& s : scene.sections) {
    Counter counter{s.name, frame_of(s, scene.domain), {}, {}};
    if (step.fluid()) {
      series.declare(s.name + "_discharge_m3_s", "m^3/s", "liquid through the section");
      series.declare(s.name + "_liquid_power_W", "W",
                     "kinetic and potential energy of the liquid through the section, and work of the pressure on it");
    }
    if (step.solids()) {
      series.declare(s.name + "_grains_kg_s", "kg/s", "grains through the section since the last row");
      series.declare(s.name + "_grains_power_W", "W", "kinetic and potential energy of these grains");
      const auto& p = step.solids()->particles();
      for (std::size_t i = 0; i < p.size(); ++i) counter.places.push_back(p.position[i]);
    }
    counters_.push_back(std::move(counter));
  }
}

template <class Real>
void Sections<Real>::sample(std::vector<double>& row, double interval, std::map<std::string, double>& metrics) {
  for (Counter& counter : counters_) {
    if (step_.fluid()) sample_liquid(counter, row, interval, metrics);
    if (step_.solids()) sample_grains(counter, row, interval, metrics);
  }
}

template <class Real>
void Sections<Real>::sample_liquid(Counter& counter, std::vector<double>& row, double interval,
                                   std::map<std::string, double>& metrics) {
  const Flux now = liquid_flux(*step_.fluid(), counter.frame, scene_.domain, up_, datum_);
  row.insert(row.end(), {now.volume, now.energy});
  metrics[counter.name + "_volume_m3"] += 0.5 * (now.volume + counter.before.volume) * interval;
  metrics[counter.name + "_liquid_energy_kJ"] += 0.5e-3 * (now.energy + counter.before.energy) * interval;
  note_peak(metrics, counter.name + "_discharge", "m3_s", now.volume, step_.time());
  counter.before = now;
}

/// A grain passes where the straight way of its centre between two rows crosses the rectangle.
template <class Real>
void Sections<Real>::sample_grains(Counter& counter, std::vector<double>& row, double interval,
                                   std::map<std::string, double>& metrics) {
  const auto& p = step_.solids()->particles();
  const SectionFrame& f = counter.frame;
  double mass = 0, energy = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec3 place = p.position[i], former = counter.places[i];
    counter.places[i] = place;
    const double before = (former - f.centre).dot(f.normal), after = (place - f.centre).dot(f.normal);
    if (p.kind[i] != dem::ParticleKind::grain || (before < 0) == (after < 0)) continue;
    if (!f.holds(former + before / (before - after) * (place - former))) continue;
    const double sign = after > before ? 1 : -1;
    mass += sign * p.mass[i];
    energy += sign * (0.5 * p.mass[i] * p.velocity[i].squaredNorm() +
                      0.5 * p.inertia[i] * p.angular_velocity[i].squaredNorm() +
                      p.mass[i] * scene_.gravity.magnitude * (up_.dot(place) - datum_));
  }
  const double rate = interval > 0 ? 1 / interval : 0.0;
  row.insert(row.end(), {rate * mass, rate * energy});
  metrics[counter.name + "_grains_kg"] += mass;
  metrics[counter.name + "_grains_energy_kJ"] += energy / 1000;
}

template <class Real>
void Sections<Real>::transfer(Archive& archive) {
  for (Counter& counter : counters_) {
    archive.value(counter.name + "_volume_before", counter.before.volume);
    archive.value(counter.name + "_energy_before", counter.before.energy);
    archive.list(counter.name + "_places", counter.places);
  }
}

template Flux liquid_flux<float>(const lbm::Fluid<float>&, const SectionFrame&, const scene::Domain&, const Vec3&,
                                 double);
template Flux liquid_flux<double>(const lbm::Fluid<double>&, const SectionFrame&, const scene::Domain&, const Vec3&,
                                  double);
template class Sections<float>;
template class Sections<double>;

}  // namespace lahar::cases
