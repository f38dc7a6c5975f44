#pragma once
// The velocity of a wall whose links exert a given stress on the fluid (wall_reflection.h, "wall model"), or none.
#include <algorithm>
#include <cmath>

#include "lbm/boundary/wall_model.h"
#include "lbm/boundary/wall_reflection.h"
#include "lbm/cell_moments.h"

namespace lahar::lbm {

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

/// Velocity of a wall at an angle to the lattice whose links exert no stress along it: with M now a matrix, and P a
/// vector, of the plane of the wall, v = u + P / (rho M). With v = u alone the traction is -P, (1 - tau)/3 of the
/// shear. P is that of the viscous stress, without rho u u: a plug slides along the wall unchanged.
template <class Real>
std::array<Real, 3> free_slip_velocity(FluidGrid<Real>& grid, CellPlace place, const WallCell& wall, Parity parity,
                                       const CellMoments<Real>& m) {
  const Vec3 n(wall.normal[0], wall.normal[1], wall.normal[2]);
  const Vec3 u(static_cast<double>(m.u[0]), static_cast<double>(m.u[1]), static_cast<double>(m.u[2]));
  const Vec3 slip = u - u.dot(n) * n, t = n.unitOrthogonal(), b = n.cross(t);
  OutgoingStress<Real> stress(grid, place, parity, static_cast<double>(m.drho));
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) stress.pi[k][l] -= (1 + static_cast<double>(m.drho)) * u[k] * u[l];
  double tt = 0, tb = 0, bb = 0, carried_t = 0, carried_b = 0;
  for (int i = 1; i < D3Q19::q; ++i) {
    const auto& c = D3Q19::c[i];
    const Vec3 velocity(c[0], c[1], c[2]);
    const double into = -velocity.dot(n);
    if (into <= 0) continue;
    const double ct = velocity.dot(t), cb = velocity.dot(b), weight = D3Q19::w(i) * into;
    tt += 6 * weight * ct * ct, tb += 6 * weight * ct * cb, bb += 6 * weight * cb * cb;
    const double along = 9 * weight * stress.along(c);
    carried_t += along * ct, carried_b += along * cb;
  }
  const double inverse = 1 / ((1 + static_cast<double>(m.drho)) * (tt * bb - tb * tb));
  Vec3 more = inverse * ((bb * carried_t - tb * carried_b) * t + (tt * carried_b - tb * carried_t) * b);
  const double most = slip.norm();  // where the cells are too coarse for any profile
  if (more.norm() > most) more *= most / more.norm();
  const Vec3 v = slip + more;
  return {static_cast<Real>(v.x()), static_cast<Real>(v.y()), static_cast<Real>(v.z())};
}

template <class Real>
std::array<Real, 3> wall_model_velocity(FluidGrid<Real>& grid, CellPlace place, const WallCell& wall, Parity parity,
                                        const WallPhysics& physics, const CellMoments<Real>& m) {
  const Vec3 n(wall.normal[0], wall.normal[1], wall.normal[2]);
  const Vec3 moving(wall.wall_velocity[0], wall.wall_velocity[1], wall.wall_velocity[2]);
  const Vec3 half_force = 0.5 * Vec3(physics.acceleration[0], physics.acceleration[1], physics.acceleration[2]);
  const Vec3 outgoing =
      Vec3(static_cast<double>(m.u[0]), static_cast<double>(m.u[1]), static_cast<double>(m.u[2])) - moving;
  const Vec3 slip = outgoing - outgoing.dot(n) * n, between = slip - (half_force - half_force.dot(n) * n);
  std::array<Real, 3> v{static_cast<Real>(moving.x()), static_cast<Real>(moving.y()), static_cast<Real>(moving.z())};
  const double speed = between.norm();
  if (speed < 1e-12) return v;
  const Vec3 t = between / speed;
  const OutgoingStress<Real> stress(grid, place, parity, static_cast<double>(m.drho));
  double mobility = 0, carried = 0;  // M, P
  for (int i = 1; i < D3Q19::q; ++i) {
    const auto& c = D3Q19::c[i];
    const double into = -(c[0] * n.x() + c[1] * n.y() + c[2] * n.z());
    if (into <= 0) continue;
    const double ct = c[0] * t.x() + c[1] * t.y() + c[2] * t.z(), weight = D3Q19::w(i) * into * ct;
    mobility += 6 * weight * ct;
    carried += 9 * weight * stress.along(c);
  }
  const double rho = 1 + static_cast<double>(m.drho), along = slip.dot(t);
  // A cell cut by the wall stands for more than the sliver between its centre and the wall.
  const double distance = std::max(0.5, static_cast<double>(wall.distance));
  const double law = wall_stress(speed, distance, physics.viscosity, wall.roughness);
  const double wanted = along + (carried / rho - law) / mobility;
  const double bounded = std::clamp(wanted, -speed, 2 * speed);  // where the cells are too coarse for any profile
  for (int k = 0; k < 3; ++k) v[static_cast<std::size_t>(k)] += static_cast<Real>(bounded * t[k]);
  return v;
}

}  // namespace lahar::lbm
