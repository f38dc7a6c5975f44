#include "coupling/grains/lubrication.h"

#include <algorithm>
#include <cstdint>

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

struct Films {
  dem::Particles& particles;
  double cut_off, shear_cut_off, viscosity, time_step;
  const std::function<bool(const Vec3&)>& is_wet;
  std::size_t count = 0;

  void add(dem::ParticleIndex i, dem::ParticleIndex j) {
    const double a = particles.radius[i], b = particles.radius[j];
    const Vec3 apart = particles.position[j] - particles.position[i];
    const double distance = apart.norm(), gap = distance - a - b;
    const double inverse_mass = particles.inverse_mass[i] + particles.inverse_mass[j];
    if (gap >= cut_off || distance <= 0 || inverse_mass <= 0) return;
    const Vec3 normal = apart / distance;
    const Vec3 past = particles.velocity[j] - particles.velocity[i];
    const double approach = -past.dot(normal);
    const Vec3 turn = normal.cross(past) / distance;  // of the line of centres
    const auto spin = [&](dem::ParticleIndex k) {
      const Vec3 w = particles.angular_velocity[k];
      return Vec3(w - w.dot(normal) * normal - turn);
    };
    const Vec3 spin_i = spin(i), spin_j = spin(j);
    const bool shears = gap < shear_cut_off && !(spin_i.isZero(0) && spin_j.isZero(0));
    if ((approach == 0 && !shears) || !is_wet(particles.position[i] + (a + 0.5 * gap) * normal)) return;
    ++count;
    if (shears) add_shear(i, j, gap, distance, normal, spin_i, spin_j);
    const double resistance =
        std::min(squeeze_resistance(a, b, gap, cut_off, viscosity), 1 / (inverse_mass * time_step));
    const Vec3 force = resistance * approach * normal;
    particles.external_force.add(i, -force);
    particles.external_force.add(j, force);
  }

  /// The sum of the rates at which the film slows what it acts on bounds the fastest of them.
  void add_shear(dem::ParticleIndex i, dem::ParticleIndex j, double gap, double distance, const Vec3& normal,
                 const Vec3& spin_i, const Vec3& spin_j) {
    const ShearResistance c = shear_resistance(particles.radius[i], particles.radius[j], gap, shear_cut_off, viscosity);
    const auto inverse_inertia = [&](dem::ParticleIndex k) {
      return particles.inverse_mass[k] > 0 ? 1 / particles.inertia[k] : 0.0;
    };
    const double rate =
        c.aa * inverse_inertia(i) + c.bb * inverse_inertia(j) +
        (c.aa + 2 * c.ab + c.bb) / (distance * distance) * (particles.inverse_mass[i] + particles.inverse_mass[j]);
    const double share = 1 / std::max(1.0, rate * time_step);
    const Vec3 torque_i = -share * (c.aa * spin_i + c.ab * spin_j), torque_j = -share * (c.ab * spin_i + c.bb * spin_j);
    const Vec3 force = normal.cross(torque_i + torque_j) / distance;
    particles.external_force.add(i, -force), particles.external_force.add(j, force);
    particles.external_torque.add(i, torque_i), particles.external_torque.add(j, torque_j);
  }
};

}  // namespace

std::size_t add_lubrication(dem::Particles& particles, double cell_size, double viscosity, double time_step,
                            const std::function<bool(const Vec3&)>& is_wet) {
  Films films{particles, kFilmCutOff * cell_size, kShearCutOff * cell_size, viscosity, time_step, is_wet};
  std::vector<Boxed> boxed;
  double largest = 0;
  for (dem::ParticleId id = 0; id < particles.size(); ++id) {
    const dem::ParticleIndex i = particles.index(id);
    if (particles.kind[i] == dem::ParticleKind::grain && particles.state[i] != dem::ParticleState::removed)
      largest = std::max(largest, particles.radius[i]), boxed.push_back({0, id});
  }
  const double width = 2 * largest + films.cut_off;
  for (Boxed& b : boxed) b.key = key_of(box_of(particles.position[particles.index(b.grain)], width));
  std::sort(boxed.begin(), boxed.end());
  // Pairs in the order of the boxes, then of ids: the sums do not depend on where particles stand in their arrays.
  for (const Boxed& one : boxed) {
    const dem::ParticleIndex i = particles.index(one.grain);
    const Vec3i box = box_of(particles.position[i], width);
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y) {
        const std::int64_t low = key_of(box + Vec3i(x, y, -1)), high = key_of(box + Vec3i(x, y, 1));
        for (auto other = std::lower_bound(boxed.begin(), boxed.end(), Boxed{low, 0});
             other != boxed.end() && other->key <= high; ++other)
          if (one.grain < other->grain) films.add(i, particles.index(other->grain));
      }
  }
  return films.count;
}

}  // namespace lahar::coupling
