#include "cases/observers/sections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

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

/// Mean velocity of the grains in the cells at a section.
class GrainVelocities {
 public:
  GrainVelocities(const lbm::Domain& domain, const dem::Particles* grains, const SectionFrame& frame)
      : domain_(domain) {
    for (dem::ParticleId id = 0; grains && id < grains->size(); ++id) {
      const dem::ParticleIndex i = grains->index(id);
      if (grains->kind[i] != dem::ParticleKind::grain || grains->state[i] == dem::ParticleState::removed) continue;
      const Vec3 centre = grains->position[i];
      if (std::abs((centre - frame.centre).dot(frame.normal)) < grains->radius[i] + 2 * domain.cell_size())
        add(centre, grains->radius[i], grains->velocity[i], frame);
    }
  }
  /// m/s; none where no grain is.
  [[nodiscard]] std::optional<Vec3> at(const Vec3& centre) const {
    const auto found = cells_.find(key(domain_.cell_at(centre)));
    if (found == cells_.end()) return std::nullopt;
    return Vec3(found->second.momentum / found->second.share);
  }

 private:
  struct Sum {
    double share = 0;
    Vec3 momentum = Vec3::Zero();
  };
  static std::array<int, 3> key(const Vec3i& cell) { return {cell.x(), cell.y(), cell.z()}; }

  /// A cell belongs to a grain by the distance of its centre from the surface, over a cell.
  void add(const Vec3& centre, double radius, const Vec3& velocity, const SectionFrame& frame) {
    const double h = domain_.cell_size();
    const Vec3 reach = Vec3::Constant(radius + h / 2);
    const Vec3i low = domain_.cell_at(centre - reach), high = domain_.cell_at(centre + reach);
    for (int x = low.x(); x <= high.x(); ++x)
      for (int y = low.y(); y <= high.y(); ++y)
        for (int z = low.z(); z <= high.z(); ++z) {
          const Vec3i cell(x, y, z);
          const Vec3 there = domain_.centre(cell);
          const double share = std::clamp(0.5 + (radius - (there - centre).norm()) / h, 0.0, 1.0);
          if (share <= 0 || std::abs((there - frame.centre).dot(frame.normal)) > 2 * h) continue;
          Sum& sum = cells_[key(cell)];
          sum.share += share, sum.momentum += share * velocity;
        }
  }

  const lbm::Domain& domain_;
  std::map<std::array<int, 3>, Sum> cells_;
};

/// Whether there may be cells at a place: past the end of a periodic axis there are.
bool exists_in(const scene::Domain& domain, Vec3 p) {
  for (const scene::Axis axis : {scene::Axis::x, scene::Axis::y, scene::Axis::z})
    if (const auto a = static_cast<Eigen::Index>(axis); domain.periodic(axis)) p[a] = domain.lower[a];
  return domain.contains(p);
}

/// Extents of a section along its width and height, from its centre (m), as far as the domain reaches.
struct Extent {
  double left, right, bottom, top;
};

/// The part of a rectangle that lies in a cube, by cutting it along the cube's sides in turn (Sutherland & Hodgman
/// 1974, Commun. ACM 17:32).
class Patch {
 public:
  Patch(const SectionFrame& f, const Extent& e, const Vec3& lower, double width) {
    const std::pair<double, double> corners[] = {
        {e.left, e.bottom}, {e.right, e.bottom}, {e.right, e.top}, {e.left, e.top}};
    for (const auto& [x, y] : corners) points_.push_back(f.centre + x * f.across + y * f.up);
    for (int axis = 0; axis < 3; ++axis) {
      cut([&](const Vec3& p) { return p[axis] - lower[axis]; });
      cut([&](const Vec3& p) { return lower[axis] + width - p[axis]; });
    }
    const Vec3& first = points_.empty() ? lower : points_.front();
    for (std::size_t k = 2; k < points_.size(); ++k) {
      const double part = 0.5 * (points_[k - 1] - first).cross(points_[k] - first).norm();
      area_ += part;
      centre_ += part / 3 * (first + points_[k - 1] + points_[k]);
    }
    if (area_ > 0) centre_ /= area_;
  }
  [[nodiscard]] double area() const { return area_; }  ///< m^2
  [[nodiscard]] const Vec3& centre() const { return centre_; }

 private:
  /// Keeps what is inside: inside(point) >= 0.
  template <class Inside>
  void cut(const Inside& inside) {
    std::vector<Vec3> kept;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const Vec3 &p = points_[k], &q = points_[(k + 1) % points_.size()];
      const double at_p = inside(p), at_q = inside(q);
      if (at_p >= 0) kept.push_back(p);
      if ((at_p < 0) != (at_q < 0)) kept.push_back(p + at_p / (at_p - at_q) * (q - p));
    }
    points_ = std::move(kept);
  }

  std::vector<Vec3> points_;
  double area_ = 0;
  Vec3 centre_ = Vec3::Zero();
};

/// Calls visit(wet cell, m^2 of the section in it, their middle) for an oblique section.
template <class Visit>
void for_cells_across(const FluidView& fluid, const SectionFrame& frame, const Extent& extent,
                      const scene::Domain& domain, const Visit& visit) {
  const double dx = fluid.units().cell_size;
  Vec3 lower = Vec3::Constant(1e300), upper = -lower;
  for (const double x : {extent.left, extent.right})
    for (const double y : {extent.bottom, extent.top}) {
      const Vec3 corner = frame.centre + x * frame.across + y * frame.up;
      lower = lower.cwiseMin(corner), upper = upper.cwiseMax(corner);
    }
  lower = lower.cwiseMax(domain.lower), upper = upper.cwiseMin(domain.upper);
  const Vec3i low = ((lower - domain.lower) / dx).array().floor().cast<int>(),
              high = ((upper - domain.lower) / dx - Vec3::Constant(1e-9)).array().floor().cast<int>();
  const double farthest = 0.5 * dx * frame.normal.cwiseAbs().sum();  // of a cell's centre from the plane
  for (int x = low.x(); x <= high.x(); ++x)
    for (int y = low.y(); y <= high.y(); ++y)
      for (int z = low.z(); z <= high.z(); ++z) {
        const Vec3 corner = domain.lower + dx * Vec3(x, y, z), centre = corner + Vec3::Constant(dx / 2);
        if (std::abs((centre - frame.centre).dot(frame.normal)) >= farthest) continue;
        const auto cell = fluid.cell_at(centre);
        if (!cell) continue;
        const Patch patch(frame, extent, corner, dx);
        if (patch.area() > 0) visit(*cell, patch.area(), patch.centre());
      }
}

/// The same for a section along two axes: sums over points half a cell apart, a quarter of a cell off on both sides.
/// Where it lies between two layers of cells it takes half of each; on a face of the domain, all of the one inside.
template <class Visit>
void for_points_of(const FluidView& fluid, const SectionFrame& frame, const Extent& extent, const scene::Domain& domain,
                   const Visit& visit) {
  const double spacing = fluid.units().cell_size / 2;
  const auto parts = [&](double length) { return std::max(1, static_cast<int>(std::ceil(length / spacing - 1e-6))); };
  const int columns = parts(extent.right - extent.left), rows = parts(extent.top - extent.bottom);
  const double wide = (extent.right - extent.left) / columns, high = (extent.top - extent.bottom) / rows;
  const Vec3 half_way = 0.5 * spacing * frame.normal;
  for (int i = 0; i < columns; ++i)
    for (int k = 0; k < rows; ++k) {
      const Vec3 p = frame.centre + (extent.left + (i + 0.5) * wide) * frame.across +
                     (extent.bottom + (k + 0.5) * high) * frame.up;
      if (!domain.contains(p)) continue;
      const Vec3 sides[] = {p - half_way, p + half_way};
      const bool inside[] = {exists_in(domain, sides[0]), exists_in(domain, sides[1])};
      for (const int side : {0, 1})
        if (inside[side])  // where the domain ends within a cell both sides are in that
          if (const auto cell = fluid.cell_at(sides[side]))
            visit(*cell, (inside[0] && inside[1] ? 0.5 : 1.0) * wide * high, p);
    }
}

}  // namespace

Flux liquid_flux(const FluidView& fluid, const LiquidVelocity& velocity, const dem::Particles* grains,
                 const SectionFrame& frame, const scene::Domain& domain, const Vec3& up, double datum) {
  const double rho = fluid.options().density, g = fluid.options().gravity.norm();
  const auto [left, right] = reach(frame, frame.across, frame.half_width, domain);
  const auto [bottom, top] = reach(frame, frame.up, frame.half_height, domain);
  const double cell_volume = std::pow(fluid.units().cell_size, 3);
  const GrainVelocities velocities(fluid.domain(), grains, frame);
  Flux flux;
  const auto add = [&](const lbm::WetCell& cell, double area, const Vec3& p) {
    const double liquid = cell.liquid_volume / cell_volume;
    const Vec3 solid = velocities.at(cell.centre).value_or(cell.velocity);
    const double volume =
        area * (cell.fill_level * cell.velocity - (cell.fill_level - liquid) * solid).dot(frame.normal);
    flux.area += area * liquid;
    flux.volume += volume;
    flux.energy += volume * (0.5 * rho * velocity(cell).squaredNorm() + rho * g * (up.dot(p) - datum) + cell.pressure);
  };
  const bool along_the_cells = frame.normal.cwiseAbs().maxCoeff() > 1 - 1e-9;
  if (along_the_cells)
    for_points_of(fluid, frame, {left, right, bottom, top}, domain, add);
  else
    for_cells_across(fluid, frame, {left, right, bottom, top}, domain, add);
  return flux;
}

namespace {

/// Of a disc around the origin, the part with x <= a and y <= b: along x the chord up to b is whole where the disc's
/// edge lies below |b| and b is above, none where b is below, else b + sqrt(r^2 - x^2).
double disc_in_corner(double r, double a, double b) {
  a = std::clamp(a, -r, r), b = std::clamp(b, -r, r);
  const auto chord = [r](double x) { return std::sqrt((r - x) * (r + x)); };  // 0 to the bit at the edge
  const auto half = [&](double x) { return 0.5 * (x * chord(x) + r * r * std::asin(x / r)); };
  const double q = chord(b);
  const auto from_to = [&](double from, double to) { return to > from ? half(to) - half(from) : 0.0; };
  const double inner = std::clamp(a, -q, q);
  double sum = b * (inner + q) + from_to(-q, inner);
  if (b > 0) sum += 2 * (from_to(-r, std::min(a, -q)) + from_to(q, a));
  return sum;
}

}  // namespace

double disc_in_rectangle(double r, const std::array<double, 2>& x, const std::array<double, 2>& y) {
  return disc_in_corner(r, x[1], y[1]) - disc_in_corner(r, x[0], y[1]) - disc_in_corner(r, x[1], y[0]) +
         disc_in_corner(r, x[0], y[0]);
}

double grain_area(const dem::Particles& particles, const SectionFrame& frame) {
  double sum = 0;
  for (dem::ParticleId id = 0; id < particles.size(); ++id) {
    const dem::ParticleIndex i = particles.index(id);
    if (particles.kind[i] != dem::ParticleKind::grain || particles.state[i] == dem::ParticleState::removed) continue;
    const Vec3 from = particles.position[i] - frame.centre;
    const double off = from.dot(frame.normal), r = particles.radius[i];
    if (std::abs(off) >= r) continue;
    const double across = from.dot(frame.across), up = from.dot(frame.up);
    sum += disc_in_rectangle(std::sqrt(r * r - off * off), {-frame.half_width - across, frame.half_width - across},
                             {-frame.half_height - up, frame.half_height - up});
  }
  return sum;
}

namespace {

Label of_section(const std::string& section, const std::string& rest) { return {section + rest, "SECTION" + rest}; }

}  // namespace

Sections::Sections(const Observed& run) : Observer(run) {
  for (const auto& s : run.scene.sections) {
    Counter counter;
    counter.name = s.name;
    counter.frame = frame_of(s, run.scene.domain);
    if (const dem::Solids* solids = run.simulation.solids()) {
      const dem::Particles& p = solids->particles();
      for (dem::ParticleId id = 0; id < p.size(); ++id) counter.places.push_back(p.position[p.index(id)]);
    }
    counters_.push_back(std::move(counter));
    if (run.simulation.fluid()) declare_liquid(counters_.size() - 1);
    if (run.simulation.solids()) declare_grains(counters_.size() - 1);
  }
}

void Sections::declare_liquid(std::size_t k) {
  const std::string name = counters_[k].name;
  column(
      of_section(name, "_discharge_m3_s"), "m^3/s",
      "liquid through the section, positive along its normal; up to a fifth too much within 1.5 cells of an open face",
      [this, k] { return counters_[k].now.volume; })
      .peak(of_section(name, "_discharge_peak_m3_s"), "m^3/s", "largest discharge of the rows")
      .peak_time(of_section(name, "_discharge_peak_time_s"));
  column(of_section(name, "_liquid_area_m2"), "m^2", "area of the section that liquid takes",
         [this, k] { return counters_[k].now.area; });
  column(of_section(name, "_liquid_power_W"), "W",
         "energy flux of the liquid: (rho u^2/2 + rho g h + p) times the discharge at each point",
         [this, k] { return counters_[k].now.energy; });
  result(of_section(name, "_volume_m3"), "m^3",
         "liquid that passed, less what came back (trapezoidal rule over the rows)",
         [this, k] { return counters_[k].volume; });
  result(of_section(name, "_liquid_energy_kJ"), "kJ", "energy of the liquid that passed",
         [this, k] { return counters_[k].liquid_energy; });
}

void Sections::declare_grains(std::size_t k) {
  const std::string name = counters_[k].name;
  column(of_section(name, "_grains_kg_s"), "kg/s", "grains whose centre crossed the rectangle since the last row",
         [this, k] { return counters_[k].grain_rate; });
  column(of_section(name, "_grains_power_W"), "W",
         "kinetic and potential energy of grains that crossed since the last row",
         [this, k] { return counters_[k].grain_power; });
  column(of_section(name, "_grains_area_m2"), "m^2", "area that grains cut out of the section",
         [this, k] { return counters_[k].grain_area; });
  result(of_section(name, "_grains_kg"), "kg", "grains that passed, less those that came back",
         [this, k] { return counters_[k].grain_mass; });
  result(of_section(name, "_grains_energy_kJ"), "kJ", "energy of the grains that passed",
         [this, k] { return counters_[k].grain_energy; });
}

void Sections::sample(double interval) {
  for (Counter& counter : counters_) {
    if (run_.simulation.fluid()) sample_liquid(counter, interval);
    if (run_.simulation.solids()) sample_grains(counter, interval);
  }
}

void Sections::sample_liquid(Counter& counter, double interval) {
  const dem::Solids* solids = run_.simulation.solids();
  const auto velocity = [&](const lbm::WetCell& cell) { return run_.simulation.liquid_velocity(cell); };
  const Flux now = liquid_flux(*run_.simulation.fluid(), velocity, solids ? &solids->particles() : nullptr,
                               counter.frame, run_.scene.domain, run_.up, run_.datum);
  counter.volume += 0.5 * (now.volume + counter.now.volume) * interval;
  counter.liquid_energy += 0.5e-3 * (now.energy + counter.now.energy) * interval;
  counter.now = now;
}

void Sections::after_step() {
  if (!run_.simulation.solids()) return;
  for (Counter& counter : counters_) follow_grains(counter);
}

/// A grain passes where the straight way of its centre crosses the rectangle.
void Sections::follow_grains(Counter& counter) {
  const auto& p = run_.simulation.solids()->particles();
  const SectionFrame& f = counter.frame;
  for (dem::ParticleId id = 0; id < p.size(); ++id) {
    const dem::ParticleIndex i = p.index(id);
    if (p.kind[i] != dem::ParticleKind::grain) continue;
    const Vec3 place = p.position[i], former = counter.places[id];
    counter.places[id] = place;
    const double before = (former - f.centre).dot(f.normal), after = (place - f.centre).dot(f.normal);
    if ((before < 0) == (after < 0)) continue;
    if (!f.holds(former + before / (before - after) * (place - former))) continue;
    const double sign = after > before ? 1 : -1;
    counter.mass_since += sign * p.mass[i];
    counter.energy_since += sign * (0.5 * p.mass[i] * p.velocity[i].squaredNorm() +
                                    0.5 * p.inertia[i] * p.angular_velocity[i].squaredNorm() +
                                    p.mass[i] * run_.scene.gravity.magnitude * run_.height(place));
  }
}

void Sections::sample_grains(Counter& counter, double interval) {
  follow_grains(counter);
  counter.grain_area = grain_area(run_.simulation.solids()->particles(), counter.frame);
  const double rate = interval > 0 ? 1 / interval : 0.0;
  counter.grain_rate = rate * counter.mass_since, counter.grain_power = rate * counter.energy_since;
  counter.grain_mass += counter.mass_since, counter.grain_energy += counter.energy_since / 1000;
  counter.mass_since = counter.energy_since = 0;
}

void Sections::transfer(Archive& archive) {
  for (Counter& counter : counters_) {
    const auto value = [&](const char* what, double& x) { archive.value(counter.name + what, x); };
    value("_volume_before", counter.now.volume), value("_energy_before", counter.now.energy);
    value("_volume", counter.volume), value("_liquid_energy", counter.liquid_energy);
    value("_grain_mass", counter.grain_mass), value("_grain_energy", counter.grain_energy);
    value("_mass_since", counter.mass_since), value("_energy_since", counter.energy_since);
    archive.list(counter.name + "_places", counter.places);
  }
}

}  // namespace lahar::cases
