#pragma once
// The velocity of a wall whose links exert a given stress on the fluid (wall_reflection.h, "wall model"), or none.
#include <algorithm>
#include <cmath>
#include <optional>

#include "lbm/boundary/slip_wall.h"
#include "lbm/boundary/wall_model.h"
#include "lbm/boundary/wall_reflection.h"
#include "lbm/collision/equilibrium.h"
#include "lbm/step/cell_moments.h"

namespace lahar::lbm {

/// Of the moments that are given; lu.
template <class Real>
Vec3 velocity_of(const CellMoments<Real>& m) {
  return {static_cast<double>(m.u[0]), static_cast<double>(m.u[1]), static_cast<double>(m.u[2])};
}

template <class Real>
std::array<Real, 3> rounded(const Vec3& v) {
  return {static_cast<Real>(v.x()), static_cast<Real>(v.y()), static_cast<Real>(v.z())};
}

/// c_i . Pi . c_i of a cell's outgoing populations for all velocities, shifted by rest at density 1 + drho.
template <class Real>
struct OutgoingStress {
  double pi[3][3] = {};

  OutgoingStress(FluidGrid<Real>& grid, CellPlace place, Parity parity, double drho) {
    for (int a = 1; a < D3Q19::q; a += 2) {
      const auto pair = grid.access(place, a, parity);
      const double sum = static_cast<double>(*pair.outgoing_a) + static_cast<double>(*pair.outgoing_b);
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) pi[k][l] += D3Q19::c[a][k] * D3Q19::c[a][l] * sum;
    }
    for (int k = 0; k < 3; ++k) pi[k][k] -= drho / 3;
  }
  [[nodiscard]] double along(const int (&c)[3]) const {
    double sum = 0;
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l) sum += c[k] * pi[k][l] * c[l];
    return sum;
  }
};

/// The part of a velocity that lies along a wall.
inline Vec3 along_wall(const Vec3& u, const WallCell& wall) {
  const Vec3 n(wall.normal[0], wall.normal[1], wall.normal[2]);
  return u - u.dot(n) * n;
}

/// The lattice velocity within 60 degrees of a way that is nearest to it, of those that `usable(i)` allows; 0 if none.
template <class Usable>
int direction_along(const Vec3& way, const Usable& usable) {
  int nearest = 0;
  double most = 0.5 * way.norm();
  for (int i = 1; i < D3Q19::q; ++i) {
    const Vec3 c(D3Q19::c[i][0], D3Q19::c[i][1], D3Q19::c[i][2]);
    const double along = c.dot(way) / c.norm();
    if (along > most + 1e-6 && usable(i)) most = along, nearest = i;
  }
  return nearest;
}

/// Gradient of the density around a cell, drho its own. Along each axis from the wet neighbours on it, else, in a
/// corner of steps, from those beside it: they differ by that and by the gradient along the other axis of the two.
template <class Real>
Vec3 density_gradient(FluidGrid<Real>& grid, CellPlace place, Parity parity, double drho) {
  Vec3 gradient = Vec3::Zero();
  std::array<bool, 3> known{};
  // From the velocities first to last - 1 that have a part along the axis; false if none leads to a usable cell.
  const auto take = [&](int axis, int first, int last) {
    double sum = 0;
    int wet = 0;
    for (int i = first; i < last; ++i) {
      const Vec3i c(D3Q19::c[i][0], D3Q19::c[i][1], D3Q19::c[i][2]);
      const CellPlace next = grid.neighbour(place, i);
      if (c[axis] == 0 || !is_wet(grid.type(next))) continue;
      double more = static_cast<double>(outgoing_moments(grid, next, parity).drho) - drho;
      bool usable = true;
      for (int k = 0; k < 3; ++k) {
        if (k == axis || c[k] == 0) continue;
        usable = known[static_cast<std::size_t>(k)];
        more -= c[k] * gradient[k];
      }
      if (!usable) continue;
      sum += c[axis] * more;
      ++wet;
    }
    if (wet == 0) return false;
    gradient[axis] = sum / wet;
    return true;
  };
  for (int axis = 0; axis < 3; ++axis) known[static_cast<std::size_t>(axis)] = take(axis, 1, 7);
  const std::array<bool, 3> along_axes = known;
  for (int axis = 0; axis < 3; ++axis)
    if (!along_axes[static_cast<std::size_t>(axis)]) known[static_cast<std::size_t>(axis)] = take(axis, 7, D3Q19::q);
  return gradient;
}

/// What the pressure adds to a cell's velocity in half a step. Outgoing populations hold half of the body force but not
/// this; the wall's velocity is of half a step on. In free fall it is zero, at hydrostatic rest it undoes that half.
template <class Real>
Vec3 half_a_step_of_pressure(FluidGrid<Real>& grid, CellPlace place, Parity parity, const CellMoments<Real>& m) {
  const double drho = static_cast<double>(m.drho);
  return density_gradient(grid, place, parity, drho) / (-6 * (1 + drho));  // p = rho/3
}

/// Velocity of the liquid along a wall, half a step on.
template <class Real>
Vec3 slip_half_a_step_on(FluidGrid<Real>& grid, CellPlace place, const WallCell& wall, Parity parity,
                         const CellMoments<Real>& m) {
  return along_wall(velocity_of(m) + half_a_step_of_pressure(grid, place, parity, m), wall);
}

/// The part of a velocity along a wall that leads over its steps; along an axis across which no step stands it leads
/// beside them.
inline Vec3 over_steps(Vec3 slip, const WallCell& wall) {
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(wall.normal[static_cast<std::size_t>(axis)]) < 1e-6F) slip[axis] = 0;
  return slip;
}

/// Share of the stress of its links that a slipping wall in steps takes back.
inline constexpr double kTakenBack = 0.8;

/// M of the links into a wall (wall_reflection.h), now a matrix of the plane of the wall.
class WallMobility {
 public:
  explicit WallMobility(const WallCell& wall)
      : n_(wall.normal[0], wall.normal[1], wall.normal[2]), t_(n_.unitOrthogonal()), b_(n_.cross(t_)) {
    for_links_into([&](int i, double into, double ct, double cb) {
      const double weight = 6 * D3Q19::w(i) * into;
      tt_ += weight * ct * ct, tb_ += weight * ct * cb, bb_ += weight * cb * cb;
    });
  }
  /// visit(i, its part into the wall, those along it), for the velocities into the wall.
  template <class Visit>
  void for_links_into(const Visit& visit) const {
    for (int i = 1; i < D3Q19::q; ++i) {
      const Vec3 c(D3Q19::c[i][0], D3Q19::c[i][1], D3Q19::c[i][2]);
      if (const double into = -c.dot(n_); into > 0) visit(i, into, c.dot(t_), c.dot(b_));
    }
  }
  /// Velocity along the wall at which links that carry this along it, over density, carry nothing.
  [[nodiscard]] Vec3 velocity_for(double along_t, double along_b) const {
    return ((bb_ * along_t - tb_ * along_b) * t_ + (tt_ * along_b - tb_ * along_t) * b_) / (tt_ * bb_ - tb_ * tb_);
  }
  [[nodiscard]] Vec3 velocity_for(const Vec3& stress) const { return velocity_for(stress.dot(t_), stress.dot(b_)); }

 private:
  Vec3 n_, t_, b_;
  double tt_ = 0, tb_ = 0, bb_ = 0;
};

/// What the links of a wall that moves with the liquid carry along it, as a velocity: P / (rho M). P is that of the
/// viscous stress, without rho u u: a plug slides along the wall unchanged.
template <class Real>
Vec3 velocity_of_stress(FluidGrid<Real>& grid, CellPlace place, const WallMobility& mobility, Parity parity,
                        const CellMoments<Real>& m) {
  const Vec3 u = velocity_of(m);
  const double density = 1 + static_cast<double>(m.drho);
  OutgoingStress<Real> stress(grid, place, parity, static_cast<double>(m.drho));
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) stress.pi[k][l] -= density * u[k] * u[l];
  double carried_t = 0, carried_b = 0;
  mobility.for_links_into([&](int i, double into, double ct, double cb) {
    const double along = 9 * D3Q19::w(i) * into * stress.along(D3Q19::c[i]);
    carried_t += along * ct, carried_b += along * cb;
  });
  return mobility.velocity_for(carried_t, carried_b) / density;
}

/// A velocity `slip` along steps, with as much of P as is taken back over them. A wall pushes nothing over its steps: P
/// is noise too, which it would feed (docs/decisions/0077).
inline Vec3 slip_over_steps(const Vec3& slip, const Vec3& of_stress, const WallCell& wall) {
  Vec3 more = kTakenBack * over_steps(of_stress, wall);
  if (const double most = slip.norm(); more.norm() > most)
    more *= most / more.norm();  // cells too coarse for a profile
  const Vec3 over = over_steps(slip, wall);
  if (const double ahead = more.dot(over); ahead > 0) more -= ahead / over.squaredNorm() * over;
  return slip + more;
}

/// Sets the velocity of a wall in steps beside them, along an axis a across which no step stands. If it is
/// sum 2 c_a f_i / sum 6 rho w_i c_a^2, over the cell's own links into the wall, they exert nothing along a: what comes
/// back is what was sent, its part along c_a turned the other way about, and has the same norm, sum f_i^2 / w_i. f_i
/// counts without its part that is even in c at equilibrium, the pressure. The links have to come in pairs, of which
/// one is the other's mirror image across a; in a corner, where one is alone, v stays.
template <class Real>
void slip_beside_steps(FluidGrid<Real>& grid, CellPlace place, const WallCell& wall, Parity parity,
                       const CellMoments<Real>& m, const Vec3& pressure, Vec3& v) {
  const std::uint8_t* const links = grid.block(place.block).walls.directions.data() + wall.first_link;
  for (int a = 0; a < 3; ++a) {
    if (std::abs(wall.normal[static_cast<std::size_t>(a)]) >= 1e-6F) continue;
    double mobility = 0, brought = 0;
    Vec3 alone = Vec3::Zero();  // sum of c_a c over links without a pair
    for (int k = 0; k < wall.links; ++k) {
      const int i = links[k], c = D3Q19::c[i][a];
      if (c == 0) continue;
      mobility += 6 * D3Q19::w(i);
      alone += c * Vec3(D3Q19::c[i][0], D3Q19::c[i][1], D3Q19::c[i][2]);
      brought += 2 * c *
                 static_cast<double>(*link_populations(grid, place, i, parity).sent -
                                     Real(0.5) * equilibrium_pair_sum(i, m.drho, m.u[0], m.u[1], m.u[2]));
    }
    alone[a] = 0;
    if (mobility > 0 && alone.isZero()) v[a] = brought / (mobility * (1 + static_cast<double>(m.drho))) + pressure[a];
  }
}

/// Velocity of a wall at an angle to the lattice whose links exert no stress along it: over steps v = u + P / (rho M).
/// With v = u alone the traction is -P, (1 - tau)/3 of the shear. Only a share of P is taken back: P is that of all
/// velocities into the wall, a cell of a step has some of them, and with all of P a sheared flow in steps gains energy
/// (docs/decisions/0043).
template <class Real>
std::array<Real, 3> free_slip_velocity(FluidGrid<Real>& grid, CellPlace place, const WallCell& wall, Parity parity,
                                       const CellMoments<Real>& m) {
  const Vec3 pressure = half_a_step_of_pressure(grid, place, parity, m);
  const Vec3 of_stress = velocity_of_stress(grid, place, WallMobility(wall), parity, m);
  Vec3 v = slip_over_steps(along_wall(velocity_of(m) + pressure, wall), of_stress, wall);
  slip_beside_steps(grid, place, wall, parity, m, pressure, v);
  return rounded<Real>(v);
}

/// How the velocity of the liquid along a wall grows on its way along it.
struct Stretch {
  Vec3 way = Vec3::Zero();  ///< unit vector of the velocity
  double rate = 0;          ///< d|u|/ds, 1/step

  /// What it adds to c_i . u half-way along a link.
  [[nodiscard]] double half_way(int i) const {
    const double s = Vec3(D3Q19::c[i][0], D3Q19::c[i][1], D3Q19::c[i][2]).dot(way);
    return 0.5 * rate * s * s;
  }
};

/// Largest |d|u|/ds| that counts, of |u| per cell; more is noise, which would grow.
inline constexpr double kLargestStretch = 0.05;

/// From the wet cells that lie nearest to the way of `slip` ahead and back, with the cell's own velocity where there is
/// none.
template <class Real>
Stretch stretch_along(FluidGrid<Real>& grid, CellPlace place, Parity parity, const CellMoments<Real>& m,
                      const Vec3& slip) {
  const double speed = slip.norm();
  if (speed < 1e-12) return {};
  const Vec3 way = slip / speed;
  double from = 0, to = 0, slower = velocity_of(m).dot(way), faster = slower;
  for (const int side : {-1, 1}) {
    const int i = direction_along(Vec3(side * way), [&](int k) { return is_wet(grid.type(grid.neighbour(place, k))); });
    if (i == 0) continue;
    const double s = Vec3(D3Q19::c[i][0], D3Q19::c[i][1], D3Q19::c[i][2]).dot(way);
    const double there = velocity_of(outgoing_moments(grid, grid.neighbour(place, i), parity)).dot(way);
    if (side < 0)
      from = s, slower = there;
    else
      to = s, faster = there;
  }
  if (to <= from) return {};
  return {way, std::clamp((faster - slower) / (to - from), -kLargestStretch * speed, kLargestStretch * speed)};
}

/// Velocity along a wall and its distance from it, lu.
struct WallSample {
  Vec3 velocity;
  double distance;
};

/// Cells from a wall cell to the one whose velocity the law takes: the eddies of the first two are not resolved (Kawai
/// & Larsson 2012, Phys. Fluids 24, 015105).
inline constexpr int kSampledCell = 2;

inline constexpr double kLargestStressShare = 1.0 / 3;  ///< of u: what bounce-back takes
/// From here on (tau of 1) the collision forgets everywhere and bounce-back is right.
inline constexpr double kBounceBackViscosity = 1.0 / 6;

/// The law's stress over that of a laminar layer above which a layer is turbulent: y+ of 24.
inline constexpr double kTurbulent = 2;

/// The lattice velocity nearest to a normal.
inline int direction_away(const Vec3& n) {
  return direction_along(n, [](int) { return true; });
}

/// The velocity along the wall, relative to it, half of the force taken off, in the third cell from a wall, or the last
/// wet one before it.
template <class Real>
WallSample sample_above(FluidGrid<Real>& grid, CellPlace place, const WallCell& wall, Parity parity, const Vec3& frame,
                        WallSample sample) {
  const Vec3 n(wall.normal[0], wall.normal[1], wall.normal[2]);
  const int away = direction_away(n);
  const double step = Vec3(D3Q19::c[away][0], D3Q19::c[away][1], D3Q19::c[away][2]).dot(n);
  for (int k = 0; k < kSampledCell; ++k) {
    const CellPlace next = grid.neighbour(place, away);
    if (!is_wet(grid.type(next))) break;
    place = next;
    const auto m = outgoing_moments(grid, place, parity);
    const Vec3 u = velocity_of(m) - frame;
    sample = {u - u.dot(n) * n, sample.distance + step};
  }
  return sample;
}

/// What links can do to a cell along the unit vector t of a wall: traction = rho M v . t - Q (wall_reflection.h), where
/// Q is what they bring if the wall stands still: at a wall along the lattice twice what the cell sends, else rho M u .
/// t + P, as a cell of a step has some of the links alone.
template <class Real>
class LinkTraction {
 public:
  LinkTraction(FluidGrid<Real>& grid, CellPlace place, const WallCell& wall, Parity parity, const CellMoments<Real>& m,
               const Vec3& t)
      : density_(1 + static_cast<double>(m.drho)) {
    const Vec3 n(wall.normal[0], wall.normal[1], wall.normal[2]);
    std::optional<OutgoingStress<Real>> stress;
    if (is_in_steps(wall)) stress.emplace(grid, place, parity, static_cast<double>(m.drho));
    for (int i = 1; i < D3Q19::q; ++i) {
      const auto& c = D3Q19::c[i];
      const Vec3 velocity(c[0], c[1], c[2]);
      const double into = -velocity.dot(n), ct = velocity.dot(t);
      if (into < 1e-6) continue;
      const double weight = D3Q19::w(i) * into * ct;
      mobility_ += 6 * weight * ct;
      if (stress) {
        brought_ += 9 * weight * stress->along(c);
        continue;
      }
      const int a = i % 2 == 1 ? i : i - 1;
      const auto pair = grid.access(place, a, parity);
      brought_ += 2 * ct * static_cast<double>(i == a ? *pair.outgoing_a : *pair.outgoing_b);
    }
    if (stress) brought_ += density_ * mobility_ * velocity_of(m).dot(t);
  }
  /// Velocity along t of the wall that brakes the cell by `stress`, over density.
  [[nodiscard]] double velocity_for(double stress) const { return (brought_ / density_ - stress) / mobility_; }

 private:
  double density_, mobility_ = 0, brought_ = 0;  // rho, M, Q
};

/// The cell's velocity along a wall, relative to it; lu.
template <class Real>
Vec3 slip_of(const WallCell& wall, const CellMoments<Real>& m) {
  return along_wall(velocity_of(m) - Vec3(wall.wall_velocity[0], wall.wall_velocity[1], wall.wall_velocity[2]), wall);
}

/// Velocity of a wall whose links brake a cell by `stress`, over density, along the unit vector t, at the speed `speed`
/// that the stress is of, and exert none across t; lu. (A wall that stood still across t would turn round what crosses
/// the way of the stream in every step, which grows where viscosity is small.)
template <class Real>
std::array<Real, 3> braking_velocity(FluidGrid<Real>& grid, CellPlace place, const WallCell& wall, Parity parity,
                                     const CellMoments<Real>& m, const Vec3& t, double speed, double stress) {
  const Vec3 n(wall.normal[0], wall.normal[1], wall.normal[2]), b = n.cross(t);
  const Vec3 moving(wall.wall_velocity[0], wall.wall_velocity[1], wall.wall_velocity[2]);
  const Vec3 pressure = half_a_step_of_pressure(grid, place, parity, m), own = slip_of(wall, m) + pressure;
  const auto wanted = [&](const Vec3& way, double braking) {
    return LinkTraction<Real>(grid, place, wall, parity, m, way).velocity_for(braking) + (pressure - moving).dot(way);
  };
  // Where the cells are too coarse for any profile. Walls in steps never push: P is noise too, which they would feed.
  const double limit = 2 * speed;
  const bool steps = is_in_steps(wall);
  const double most = steps ? std::clamp(own.dot(t), -limit, limit) : limit;
  const double most_across = steps ? std::min(std::abs(own.dot(b)), limit) : limit;
  const Vec3 v = moving + std::clamp(wanted(t, stress), -limit, most) * t +
                 std::clamp(wanted(b, 0), -most_across, most_across) * b;
  return rounded<Real>(v);
}

/// A wall that does not brake.
template <class Real>
std::array<Real, 3> own_velocity(const WallCell& wall) {
  std::array<Real, 3> v;
  for (std::size_t k = 0; k < 3; ++k) v[k] = static_cast<Real>(wall.wall_velocity[k]);
  return v;
}

/// What the wall model asks of a cell: a stress, over density, against the unit vector `way`; lu.
struct WallLaw {
  Vec3 way = Vec3::Zero();
  double speed = 0;  ///< that the stress is of
  double stress = 0;
  bool of_cell = true;  ///< the cell's own speed, which braking changes
};

/// Times a law's stress on the film that an interface cell holds where gas is on its far side: the populations are
/// those of a full cell, whose momentum changes F times less than the film's, F its fill level.
template <class Real>
double share_of_film(const FluidGrid<Real>& grid, CellPlace place, const Vec3& n) {
  const Block<Real>& block = grid.block(place.block);
  const CellType beyond = grid.type(grid.neighbour(place, direction_away(n)));
  if (!block.surface || grid.type(place) != CellType::interface || is_wet(beyond) || beyond == CellType::wall) return 1;
  return 1 / std::max(static_cast<double>(block.surface->fill_level[place.cell]), 1e-3);
}

/// Of the wall model at a cell whose velocity along the wall, relative to it and half of the force taken off, is `own`.
template <class Real>
WallLaw wall_law(FluidGrid<Real>& grid, CellPlace place, const WallCell& wall, Parity parity,
                 const WallPhysics& physics, const Vec3& own) {
  const Vec3 n(wall.normal[0], wall.normal[1], wall.normal[2]);
  // A cell cut by the wall stands for more than the sliver between its centre and the wall.
  WallSample sample{own, std::max(0.5, static_cast<double>(wall.distance))};
  double speed = own.norm();
  if (speed < 1e-12) return {};
  bool of_cell = true;
  double stress = wall_stress(speed, sample.distance, physics.viscosity, wall.roughness);
  // Steps keep the law of the cell itself: each brakes its own cells, which the law must see.
  if (wall.even && stress > kTurbulent * physics.viscosity * speed / sample.distance) {
    const Vec3 moving(wall.wall_velocity[0], wall.wall_velocity[1], wall.wall_velocity[2]),
        half_force = 0.5 * Vec3(physics.acceleration[0], physics.acceleration[1], physics.acceleration[2]);
    const double distance = sample.distance;
    sample = sample_above(grid, place, wall, parity, moving + half_force, sample);
    of_cell = sample.distance == distance;
    speed = sample.velocity.norm();
    if (speed < 1e-12) return {};
    stress = wall_stress(speed, sample.distance, physics.viscosity, wall.roughness);
  }
  return {sample.velocity / speed, speed, stress * share_of_film(grid, place, n), of_cell};
}

/// Velocity of a wall in steps whose links exert the stress of the wall model, no more than bounce-back's: that of a
/// wall that slips freely, less what the law takes. (With a tenth more of P taken back the layer at the wall stops.)
/// Where viscosity takes as much as bounce-back, or more, the wall's own: a law would ask for more than a step can
/// take.
template <class Real>
std::array<Real, 3> wall_model_velocity(FluidGrid<Real>& grid, CellPlace place, const WallCell& wall, Parity parity,
                                        const WallPhysics& physics, const CellMoments<Real>& m) {
  if (physics.viscosity >= kBounceBackViscosity) return own_velocity<Real>(wall);
  const Vec3 half_force = 0.5 * Vec3(physics.acceleration[0], physics.acceleration[1], physics.acceleration[2]);
  const Vec3 own = slip_of(wall, m) - along_wall(half_force, wall);
  const WallLaw law = wall_law(grid, place, wall, parity, physics, own);
  if (law.speed == 0) return own_velocity<Real>(wall);
  const WallMobility mobility(wall);
  const Vec3 moving(wall.wall_velocity[0], wall.wall_velocity[1], wall.wall_velocity[2]);
  const Vec3 pressure = half_a_step_of_pressure(grid, place, parity, m);
  const Vec3 of_stress = velocity_of_stress(grid, place, mobility, parity, m);
  Vec3 v = moving + slip_over_steps(slip_of(wall, m) + along_wall(pressure, wall), of_stress, wall);
  slip_beside_steps(grid, place, wall, parity, m, pressure, v);
  return rounded<Real>(v - mobility.velocity_for(std::min(law.stress, kLargestStressShare * own.norm()) * law.way));
}

}  // namespace lahar::lbm
