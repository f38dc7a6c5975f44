#pragma once
// A tile of bonds on its way through the loop: what their ends do is gathered into rows, forces and moments are
// scattered from rows to the ends.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/triple.h"
#include "dem/bonds/bond_layout.h"
#include "dem/bonds/bonds.h"
#include "dem/particles.h"

// The rounds of the loop that follows do not depend on each other, whatever the compiler can prove.
#if defined(__GNUC__) && !defined(__clang__)
#define LAHAR_INDEPENDENT _Pragma("GCC ivdep")
#else
#define LAHAR_INDEPENDENT
#endif

namespace lahar::dem {

/// m^2, keeps broken bonds finite when their ends meet.
inline constexpr double kTinySquare = 1e-300;

/// Bare pointers to the three components of a field.
template <class Number>
struct Columns {
  Number *x, *y, *z;
  template <class Field>
  explicit Columns(Field& f) : x(f.x.data()), y(f.y.data()), z(f.z.data()) {}
  void advance(std::size_t n) { x += n, y += n, z += n; }
  Triple operator[](std::size_t k) const { return {x[k], y[k], z[k]}; }
  void set(std::size_t k, const Triple& v) const { x[k] = v.x, y[k] = v.y, z[k] = v.z; }
};

/// Intermediate results of a tile of bonds.
struct BondTile {
  using Row = std::array<double, BondLayout::kTile>;
  struct Rows {
    alignas(64) Row x, y, z;
    Triple operator[](std::size_t k) const { return {x[k], y[k], z[k]}; }
    void set(std::size_t k, const Triple& v) { x[k] = v.x, y[k] = v.y, z[k] = v.z; }
  };
  Rows arm, mean_turn, relative_turn;  // in: of the ends, see bond_motion
  Rows force, reaction;                // out: force on i, the opposite on j
  Rows moment_i, moment_j;             // out: torques, with that of the shear
  alignas(64) Row length, on, loss;    // m; 1 or 0 for broken; J, damping in this step
  alignas(64) std::array<std::uint8_t, BondLayout::kTile> broke;
};

/// Positions (m) and spins (rad/s) of the ends of a link's bonds.
struct BondEnds {
  Columns<const double> x_i, x_j, spin_i, spin_j;
};

inline BondEnds ends_in_line(const BondLayout::Link& link, const Particles& p) {
  BondEnds e{Columns<const double>(p.position), Columns<const double>(p.position),
             Columns<const double>(p.angular_velocity), Columns<const double>(p.angular_velocity)};
  e.x_i.advance(link.i), e.x_j.advance(link.j), e.spin_i.advance(link.i), e.spin_j.advance(link.j);
  return e;
}

/// Copies from where the ends stand into the rows of forces and moments, which are not needed yet.
inline BondEnds fetched_ends(const BondLayout::Link& link, const Bonds& bonds, const Particles& p, BondTile& tile) {
  for (std::size_t k = 0; k < link.last - link.first; ++k) {
    const ParticleIndex i = bonds.i[link.first + k], j = bonds.j[link.first + k];
    tile.force.set(k, {p.position.x[i], p.position.y[i], p.position.z[i]});
    tile.reaction.set(k, {p.position.x[j], p.position.y[j], p.position.z[j]});
    tile.moment_i.set(k, {p.angular_velocity.x[i], p.angular_velocity.y[i], p.angular_velocity.z[i]});
    tile.moment_j.set(k, {p.angular_velocity.x[j], p.angular_velocity.y[j], p.angular_velocity.z[j]});
  }
  return {Columns<const double>(tile.force), Columns<const double>(tile.reaction), Columns<const double>(tile.moment_i),
          Columns<const double>(tile.moment_j)};
}

/// Fetches what the ends of a tile's bonds do.
inline void gather(const BondLayout::Link* link, const BondLayout::Link* end, const Bonds& bonds,
                   const Particles& particles, double dt, BondTile& tile) {
  const std::size_t base = link->first;
  std::size_t size = 0;
  for (; link != end; ++link) {
    const std::size_t count = link->last - link->first, w = link->first - base;
    const BondEnds ends = link->in_line ? ends_in_line(*link, particles) : fetched_ends(*link, bonds, particles, tile);
    LAHAR_INDEPENDENT
    for (std::size_t k = 0; k < count; ++k) {
      const Triple arm = ends.x_j[k] - ends.x_i[k];
      const Triple turn_i = ends.spin_i[k], turn_j = ends.spin_j[k];
      tile.arm.set(w + k, arm);
      tile.length[w + k] = dot(arm, arm);
      tile.mean_turn.set(w + k, (0.5 * dt) * (turn_i + turn_j));
      tile.relative_turn.set(w + k, dt * (turn_j - turn_i));
    }
    size = w + count;
  }
  for (std::size_t k = 0; k < size; ++k) tile.on[k] = bonds.intact[base + k] != 0 ? 1.0 : 0.0;
  // A loop of its own: a square root that may set errno keeps a loop from being vectorized.
  for (std::size_t k = 0; k < size; ++k) tile.length[k] = std::sqrt(std::max(tile.length[k], kTinySquare));
}

/// Adds what a link's bonds give to ends that stand anywhere, with the same sums as `add_rows`.
inline void add_scattered(std::vector<double>& to, const BondLayout::Link& link, const Bonds& bonds, const double* on_i,
                          const double* on_j) {
  const std::size_t count = link.last - link.first;
  const ParticleIndex *i = &bonds.i[link.first], *j = &bonds.j[link.first];
  if (link.chain) {
    to[i[0]] += on_i[0];
    for (std::size_t k = 1; k < count; ++k) to[i[k]] += on_i[k] + on_j[k - 1];
    to[j[count - 1]] += on_j[count - 1];
    return;
  }
  for (std::size_t k = 0; k < count; ++k) to[i[k]] += on_i[k];
  for (std::size_t k = 0; k < count; ++k) to[j[k]] += on_j[k];
}

/// Adds what a link's bonds give to their first ends and to their second ones.
inline void add_rows(std::vector<double>& to, const BondLayout::Link& link, const Bonds& bonds, const double* on_i,
                     const double* on_j) {
  if (!link.in_line) return add_scattered(to, link, bonds, on_i, on_j);
  const std::size_t count = link.last - link.first;
  double *i = to.data() + link.i, *j = to.data() + link.j;
  if (link.chain) {  // bead k is the first end of bond k and the second one of bond k - 1
    i[0] += on_i[0];
    LAHAR_INDEPENDENT
    for (std::size_t k = 1; k < count; ++k) i[k] += on_i[k] + on_j[k - 1];
    i[count] += on_j[count - 1];
    return;
  }
  LAHAR_INDEPENDENT
  for (std::size_t k = 0; k < count; ++k) i[k] += on_i[k];
  LAHAR_INDEPENDENT
  for (std::size_t k = 0; k < count; ++k) j[k] += on_j[k];
}

/// Adds a tile's forces and torques to its particles.
inline void scatter(const BondLayout::Link* link, const BondLayout::Link* end, const Bonds& bonds, const BondTile& tile,
                    Particles& particles) {
  const std::size_t base = link->first;
  for (; link != end; ++link) {
    const std::size_t w = link->first - base;
    add_rows(particles.force.x, *link, bonds, &tile.force.x[w], &tile.reaction.x[w]);
    add_rows(particles.force.y, *link, bonds, &tile.force.y[w], &tile.reaction.y[w]);
    add_rows(particles.force.z, *link, bonds, &tile.force.z[w], &tile.reaction.z[w]);
    add_rows(particles.torque.x, *link, bonds, &tile.moment_i.x[w], &tile.moment_j.x[w]);
    add_rows(particles.torque.y, *link, bonds, &tile.moment_i.y[w], &tile.moment_j.y[w]);
    add_rows(particles.torque.z, *link, bonds, &tile.moment_i.z[w], &tile.moment_j.z[w]);
  }
}

}  // namespace lahar::dem
