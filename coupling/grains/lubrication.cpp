#include "coupling/grains/lubrication.h"

#include <algorithm>
#include <cstdint>

#include "dem/contact/wall_contacts.h"

namespace lahar::coupling {

namespace {

/// A grain in a grid of boxes as wide as the largest grain and its film.
struct Boxed {
  std::int64_t key;
  dem::ParticleId grain;
  bool operator<(const Boxed& o) const { return key != o.key ? key < o.key : grain < o.grain; }
};

constexpr std::int64_t kRow = 1 << 20;  // boxes along an axis

std::int64_t key_of(const Vec3i& box) { return (static_cast<std::int64_t>(box.x()) * kRow + box.y()) * kRow + box.z(); }

Vec3i box_of(const Vec3& p, double width) { return (p / width).array().floor().cast<int>(); }

bool is_grain(const dem::Particles& particles, dem::ParticleIndex i) {
  return particles.kind[i] == dem::ParticleKind::grain && particles.state[i] != dem::ParticleState::removed;
}

Vec3 across(const Vec3& v, const Vec3& normal) { return v - v.dot(normal) * normal; }

/// The sum of the rates at which a film slows what it acts on bounds the fastest of them: the share of it that at most
/// stops the motion within a step.
double bounded_share(double rate, double time_step) { return 1 / std::max(1.0, rate * time_step); }

/// Whether the liquid is around a gap, whose surfaces part as s^2 / (2 R) at the distance s from its middle.
bool is_wet_around(const Vec3& middle, const Vec3& normal, double reduced, double cell_size,
                   const std::function<bool(const Vec3&)>& is_wet) {
  int least = 0, wet = 0;
  normal.cwiseAbs().minCoeff(&least);
  const Vec3 along = normal.cross(Vec3::Unit(least)).normalized(), sideways = normal.cross(along);
  const double s = std::sqrt(2 * reduced * cell_size);
  for (const Vec3& direction : {along, sideways, Vec3(-along), Vec3(-sideways)}) wet += is_wet(middle + s * direction);
  return wet >= 2;
}

/// How fast its films together slow a grain, 1/s: what each may do in a step is judged by all of them (as dampers of
/// one body are, docs/decisions/0051). With C the sum of the resistances of a grain over its mass, and shares 1 /
/// max(1, dt (C_i + C_j)), no motion of any crowd turns round (Cauchy-Schwarz); a lone film at most stops its pair.
struct Slowing {
  double squeeze = 0, shear = 0;
};

/// A film as it is now: first all are measured, then they act.
struct Film {
  dem::ParticleIndex i = 0, j = 0;  ///< j of pairs alone
  Vec3 normal = Vec3::Zero();       ///< from i to j or to the wall
  Vec3 wall_velocity = Vec3::Zero();
  double distance = 0;  ///< of centres, m
  double squeeze = 0;   ///< N s/m
  ShearResistance shear{};
};

struct Films {
  double cut_off, shear_cut_off, viscosity, time_step;
  dem::Particles& particles;
  std::vector<Slowing> slowing;
  std::vector<Film> between{}, at_walls{};

  void measure(dem::ParticleIndex i, dem::ParticleIndex j) {
    const double a = particles.radius[i], b = particles.radius[j];
    const Vec3 apart = particles.position[j] - particles.position[i];
    Film f;
    f.i = i, f.j = j;
    f.distance = apart.norm();
    const double gap = f.distance - a - b;
    if (gap >= cut_off || f.distance <= 0 || particles.inverse_mass[i] + particles.inverse_mass[j] <= 0) return;
    f.normal = apart / f.distance;
    f.squeeze = squeeze_resistance(a, b, gap, cut_off, viscosity);
    if (gap < shear_cut_off) f.shear = shear_resistance(a, b, gap, shear_cut_off, viscosity);
    const double across = (f.shear.aa + 2 * f.shear.ab + f.shear.bb) / (f.distance * f.distance);
    for (const auto& [k, own] : {std::pair{i, f.shear.aa}, std::pair{j, f.shear.bb}}) {
      slowing[k].squeeze += f.squeeze * particles.inverse_mass[k];
      slowing[k].shear += own * particles.inverse_inertia(k) + across * particles.inverse_mass[k];
    }
    between.push_back(f);
  }

  void measure(dem::ParticleIndex i, const Walls& walls, std::size_t wall) {
    const double a = particles.radius[i], inverse_mass = particles.inverse_mass[i];
    const Vec3 centre = particles.position[i];
    const double gap = walls.distance(wall, centre) - a;
    if (gap >= cut_off || inverse_mass <= 0) return;
    Film f;
    f.i = i;
    f.normal = -walls.gradient(wall, centre);
    f.wall_velocity = walls.all()[wall].surface_velocity(centre + a * f.normal);
    f.squeeze = squeeze_resistance_at_wall(a, squeezed_at_wall(walls.all()[wall].shape, a), gap, cut_off, viscosity);
    if (gap < shear_cut_off)
      f.shear.ab = 4.0 / 5.0 * std::numbers::pi * viscosity * a * film_logarithm(a, gap, shear_cut_off);
    slowing[i].squeeze += f.squeeze * inverse_mass;
    slowing[i].shear += 4 * f.shear.ab * (inverse_mass + a * a * particles.inverse_inertia(i));
    at_walls.push_back(f);
  }

  /// Whether it does anything.
  bool act_between(const Film& f) const {
    const Vec3 past = particles.velocity[f.j] - particles.velocity[f.i];
    const double approach = -past.dot(f.normal);
    const Vec3 turn = f.normal.cross(past) / f.distance;  // of the line of centres
    const Vec3 spin_i = across(particles.angular_velocity[f.i], f.normal) - turn,
               spin_j = across(particles.angular_velocity[f.j], f.normal) - turn;
    const bool shears = f.shear.aa > 0 && !(spin_i.isZero(0) && spin_j.isZero(0));
    if (approach == 0 && !shears) return false;
    if (shears) act_across(f, spin_i, spin_j);
    const double share = bounded_share(slowing[f.i].squeeze + slowing[f.j].squeeze, time_step);
    const Vec3 force = share * f.squeeze * approach * f.normal;
    particles.external_force.add(f.i, -force);
    particles.external_force.add(f.j, force);
    return true;
  }

  void act_across(const Film& f, const Vec3& spin_i, const Vec3& spin_j) const {
    const double share = bounded_share(slowing[f.i].shear + slowing[f.j].shear, time_step);
    const Vec3 torque_i = -share * (f.shear.aa * spin_i + f.shear.ab * spin_j),
               torque_j = -share * (f.shear.ab * spin_i + f.shear.bb * spin_j);
    const Vec3 force = f.normal.cross(torque_i + torque_j) / f.distance;
    particles.external_force.add(f.i, -force), particles.external_force.add(f.j, force);
    particles.external_torque.add(f.i, torque_i), particles.external_torque.add(f.j, torque_j);
  }

  bool act_at_wall(const Film& f) const {
    const double a = particles.radius[f.i];
    const Vec3 past = f.wall_velocity - Vec3(particles.velocity[f.i]);
    const double approach = -past.dot(f.normal);
    particles.external_force.add(f.i,
                                 -bounded_share(slowing[f.i].squeeze, time_step) * f.squeeze * approach * f.normal);
    const Vec3 slip = across(past, f.normal), spin = across(particles.angular_velocity[f.i], f.normal);
    if (f.shear.ab == 0 || (slip.isZero(0) && spin.isZero(0))) return approach != 0;
    const double share = bounded_share(slowing[f.i].shear, time_step) * f.shear.ab;
    particles.external_force.add(f.i, share * (4 * slip + a * f.normal.cross(spin)));
    particles.external_torque.add(f.i, share * a * (f.normal.cross(slip) - 4 * a * spin));
    return true;
  }
};

}  // namespace

double squeezed_at_wall(const Shape& wall, double a) {
  const double mean = dem::effective_radius_on(wall, a);  // 1 / sqrt(k k')
  if (!std::holds_alternative<SolidCylinder>(wall)) return mean * mean;
  return 2 * mean / (1 / a + a / (mean * mean));  // k = 1 / a along the cylinder
}

LubricationFilms::LubricationFilms(double cell_size, double viscosity)
    : cell_size_(cell_size),
      cut_off_(kFilmCutOff * cell_size),
      shear_cut_off_(kShearCutOff * cell_size),
      viscosity_(viscosity) {}

void LubricationFilms::find(const dem::Particles& particles, const Walls& walls, double time_step,
                            const std::function<bool(const Vec3&)>& is_wet) {
  pairs_.clear(), at_walls_.clear();
  std::vector<Boxed> boxed;
  double largest = 0, fastest = 0;
  for (dem::ParticleId id = 0; id < particles.size(); ++id) {
    const dem::ParticleIndex i = particles.index(id);
    if (!is_grain(particles, i)) continue;
    largest = std::max(largest, particles.radius[i]);
    fastest = std::max(fastest, Vec3(particles.velocity[i]).norm());
    boxed.push_back({0, id});
  }
  const auto reach = [&](double speed) { return cut_off_ + time_step * speed; };
  const double width = 2 * largest + reach(2 * fastest);
  for (Boxed& b : boxed) b.key = key_of(box_of(particles.position[particles.index(b.grain)], width));
  std::sort(boxed.begin(), boxed.end());
  const auto find_pair = [&](dem::ParticleIndex i, dem::ParticleIndex j) {
    const double a = particles.radius[i];
    const Vec3 apart = particles.position[j] - particles.position[i];
    const double distance = apart.norm(), gap = distance - a - particles.radius[j];
    if (distance <= 0 || gap >= reach((particles.velocity[j] - particles.velocity[i]).norm())) return;
    const Vec3 normal = apart / distance, middle = particles.position[i] + (a + 0.5 * gap) * normal;
    const double reduced = a * particles.radius[j] / (a + particles.radius[j]);
    if (is_wet_around(middle, normal, reduced, cell_size_, is_wet)) pairs_.push_back({i, j});
  };
  // Pairs in the order of the boxes, then of ids: the sums do not depend on where particles stand in their arrays.
  for (const Boxed& one : boxed) {
    const dem::ParticleIndex i = particles.index(one.grain);
    const Vec3i box = box_of(particles.position[i], width);
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y) {
        const std::int64_t low = key_of(box + Vec3i(x, y, -1)), high = key_of(box + Vec3i(x, y, 1));
        for (auto other = std::lower_bound(boxed.begin(), boxed.end(), Boxed{low, 0});
             other != boxed.end() && other->key <= high; ++other)
          if (one.grain < other->grain) find_pair(i, particles.index(other->grain));
      }
    const double a = particles.radius[i];
    for (std::size_t w = 0; w < walls.all().size(); ++w) {
      const Vec3 centre = particles.position[i];
      const double gap = walls.distance(w, centre) - a;
      const double speed = (walls.all()[w].surface_velocity(centre) - Vec3(particles.velocity[i])).norm();
      if (gap >= reach(speed)) continue;
      // Half a cell off the wall: what lies on it is in no cell.
      const Vec3 normal = walls.gradient(w, centre), middle = centre - (a + gap - 0.5 * cell_size_) * normal;
      if (is_wet_around(middle, normal, a, cell_size_, is_wet)) at_walls_.push_back({i, w});
    }
  }
}

std::size_t LubricationFilms::add(dem::Particles& particles, const Walls& walls, double time_step) const {
  Films films{cut_off_, shear_cut_off_, viscosity_, time_step, particles, std::vector<Slowing>(particles.size())};
  for (const Pair& p : pairs_) films.measure(p.i, p.j);
  for (const AtWall& w : at_walls_) films.measure(w.grain, walls, w.wall);
  std::size_t count = 0;
  for (const Film& f : films.between) count += films.act_between(f);
  for (const Film& f : films.at_walls) count += films.act_at_wall(f);
  return count;
}

}  // namespace lahar::coupling
